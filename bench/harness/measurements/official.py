# SPDX-License-Identifier: MIT
"""The official example beside the figures of the report that defines it, and the first screen's sentences about speed."""
import html
from statistics import median

from harness.chart.rows import Row, ms, one_value, rows, spread_words
from harness.chart.sheet import model
from harness.measure.numbers import number
from harness.measure.plan import OFFICIAL
from harness.measurements import bounds
from harness.page import answer
from harness.page.section import MS, Part, middle, ratio, short_name, speed_words

FRAMES = ",".join(map(str, range(0, 1024, 128)))
CPU, GPU = "the report's CPU", "the report's GTX 1050"
REPORT = {CPU: 84.5e3, GPU: 1.10e3}  # milliseconds of a frame of the same scene
REPORT_COLOUR = "ink"


def add(plan):
    for label, device in plan.runnable.items():
        if not device["is_cpu"]:
            plan.point("", 0, label, OFFICIAL, (), frames=FRAMES)
        elif plan.quick:
            plan.point("", 0, label, OFFICIAL, ("--samples", "4"), frames="0,256,512", scale=16)
        else:
            plan.point("", 0, label, OFFICIAL, (), frames="0,512", warm_up=False)


def fill(section):
    found = [(device, device.entries()[0]) for device in section.devices]
    times = sorted(((entry["summary"]["frame_ms"], device, entry) for device, entry in found), key=lambda each: each[0]["median"])
    drawn = [Row(name, one_value(value), ms(value), REPORT_COLOUR) for name, value in REPORT.items()]
    drawn += [Row(device.name, spread, spread_words(spread), device.place,
                  bounds.milliseconds(device.result, device.entry, entry)) for spread, device, entry in times]
    fastest, slowest = times[0][0]["median"], times[-1][0]["median"]
    caption = (f"{times[0][1].name} is the fastest: {ms(fastest)} a frame, {speed_words(REPORT[CPU] / fastest, CPU)} and "
               f"{speed_words(REPORT[GPU] / fastest, GPU)}.")
    if len(times) > 1:
        caption += f" {times[-1][1].name} is the slowest: {ms(slowest)}, {speed_words(REPORT[CPU] / slowest, CPU)}."
    section.draw(rows, "official example, 640 x 480, 16 x 16 samples, depth 10", "Mean time of a frame", caption, MS, drawn,
                 bounds.NAME)
    section.notes += backend_words(section.results)
    section.tabulate(lambda entry: f"frames {entry['frames']}")


# ---- the first screen

# Parts in which every device does its default work.
ALIKE = ("official", "animation", "triangles", "lights", "samples", "depth")


def times(result, label):
    """Returns {part: median milliseconds} of work that all devices share; of triangles by the hierarchy."""
    return {(entry["part"], entry["x"]): middle(entry) for entry in result["measurements"]
            if entry["device"] == label and entry["part"] in ALIKE and entry["series"] in ("", "bvh") and entry["summary"]}


def ratios(slow, fast):
    return [slow[key] / fast[key] for key in slow if fast.get(key)]


def frame_ms(result, label):
    """Returns the time of a frame of the official example, or None if it was not measured."""
    return next((entry["summary"]["frame_ms"]["median"] for entry in result["measurements"]
                 if (entry["device"], entry["part"]) == (label, "official") and entry["summary"]), None)


def fastest(result, is_cpu):
    """Returns (milliseconds, device), or None if there is none of the kind."""
    found = [(frame_ms(result, device["label"]), device) for device in answer.runnable(result) if device["is_cpu"] is is_cpu]
    return min((pair for pair in found if pair[0]), key=lambda pair: pair[0], default=None)


def opening_cells(device):
    found = frame_ms(device.result, device.label)
    yield "official frame", "frame_ms", found, ms(found) if found else answer.ABSENT
    for name, report in (("cpu", CPU), ("gtx_1050", GPU)):
        factor = REPORT[report] / found if found else None
        yield f"times as fast as {report}", f"times_{name}", factor, number(factor, 3)


def speed_answer(results):
    both = [(gpu[0], cpu[0], gpu[1], result) for result in results
            for gpu, cpu in [(fastest(result, False), fastest(result, True))] if gpu and cpu]
    if not both:
        return "No machine here has both a GPU and a CPU that rendered the official example."
    gpu_ms, cpu_ms, gpu, result = min(both, key=lambda each: each[0])
    return (f"The {html.escape(model(gpu))} is {answer.figure('gpu_to_cpu', cpu_ms / gpu_ms)} times as fast as the "
            f"{result['machine']['cores']} CPU cores beside it: {answer.milliseconds('gpu_ms', gpu_ms)} against "
            f"{answer.milliseconds('cpu_ms', cpu_ms)} for a frame of the official example.")


def backend_words(results):
    """Yields OpenCL against the backend that is made for the same hardware, a sentence for each device."""
    for result in results:
        for device in (each for each in answer.runnable(result) if each["backend"] == "opencl"):
            base = "c" if device["is_cpu"] else "cuda"
            own = next((each for each in answer.runnable(result) if each["backend"] == base
                        and (device["is_cpu"] or each["name"] == device["name"])), None)
            found = ratios(times(result, device["label"]), times(result, own["label"])) if own else []
            if found:
                yield (f"{short_name(result, device)} takes {ratio(median(found))} as long as {short_name(result, own)}, in the "
                       f"median of {len(found)} measurements.")


def trust_answer(results):
    wrong = [result["machine"]["name"] for result in results if result["pictures"] and result["pictures"]["same"] is False]
    count = sum(result["pictures"]["compared"] for result in results if result["pictures"])
    if wrong:
        return f"<strong>Do not trust these figures: the pictures of backends differ on {html.escape(', '.join(wrong))}.</strong>"
    if not count:
        return "Nothing is known about equal pictures, because none was rendered in two ways."
    return (f"Take the fastest backend: all made the same bytes in {answer.figure('frames_alike', count, f'{count}')} compared "
            "frames.")


def answers(results):
    return speed_answer(results), trust_answer(results)


PART = Part(1, "Speed: the mean time of a frame", "The official example, beside the figures of the report that defines it. The "
            "time of a frame includes preparing, tracing and copying.", add, fill=fill, cells=opening_cells, answer=answers, lead=2)
