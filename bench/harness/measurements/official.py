# SPDX-License-Identifier: MIT
"""The official example beside the figures of the report that it comes from; and what the page says first of speed: GPU against
CPU of one machine, and backends of one device against each other."""
import html
from statistics import median

from harness.chart.rows import Row, ms, one_value, rows, spread_words
from harness.measure.plan import OFFICIAL
from harness.measurements import bounds
from harness.page import answer
from harness.page.section import MS, Part, dagger, middle, speed_words

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
    caption = (f"{times[0][1].short} takes {ms(fastest)} for a frame, {speed_words(REPORT[CPU] / fastest, CPU)} and "
               f"{speed_words(REPORT[GPU] / fastest, GPU)}")
    if len(times) > 1:
        caption += f"; {times[-1][1].short}, the slowest, takes {ms(slowest)}, {speed_words(REPORT[CPU] / slowest, CPU)}"
    section.draw(rows, "official example, 640 x 480, 16 x 16 samples, depth 10", "Mean time of a frame", f"{caption}.", MS, drawn,
                 bounds.NAME)
    section.tabulate(lambda entry: f"frames {entry['frames']}")


# ---- what it says first

# Parts in which every device does the same work as it does by default.
ALIKE = ("official", "animation", "triangles", "lights", "samples", "depth")


def times(result, label):
    """{what: median milliseconds} of what all devices do alike; of triangles by the hierarchy."""
    return {(entry["part"], entry["x"]): middle(entry) for entry in result["measurements"]
            if entry["device"] == label and entry["part"] in ALIKE and entry["series"] in ("", "bvh") and entry["summary"]}


def ratios(slow, fast):
    return [slow[key] / fast[key] for key in slow if fast.get(key)]


def frame_ms(result, label):
    """Of the official example; None: not measured."""
    return next((entry["summary"]["frame_ms"]["median"] for entry in result["measurements"]
                 if (entry["device"], entry["part"]) == (label, "official") and entry["summary"]), None)


def fastest(result, is_cpu):
    """(milliseconds, device); None where there is none of the kind."""
    found = [(frame_ms(result, device["label"]), device) for device in answer.runnable(result) if device["is_cpu"] is is_cpu]
    return min((pair for pair in found if pair[0]), key=lambda pair: pair[0], default=None)


def place_words(result):
    return f"“{html.escape(result['machine']['name'])}”{dagger(result)}"


def gpu_words(results):
    both = [(result, fastest(result, False), fastest(result, True)) for result in results]
    both = [each for each in both if each[1] and each[2]]
    if not both:
        yield ("GPU against CPU: <em>missing</em>, for no machine here has a GPU that drew the official example beside its CPU.")
    for result, (gpu_ms, gpu), (cpu_ms, cpu) in both:
        all_ratios = ratios(*(times(result, device["label"]) for device in (cpu, gpu)))
        yield (f"On {place_words(result)} the GPU ({html.escape(gpu['name'])}, {answer.BACKENDS[gpu['backend']]}) is "
               f"{answer.figure('gpu_to_cpu', cpu_ms / gpu_ms)} times as fast as the CPU with all its "
               f"{result['machine']['cores']} cores ({answer.BACKENDS[cpu['backend']]}): "
               f"{answer.milliseconds('gpu_ms', gpu_ms)} against {answer.milliseconds('cpu_ms', cpu_ms)} for a frame of the "
               f"official example, and {answer.figure('gpu_to_cpu_least', min(all_ratios))} to "
               f"{answer.figure('gpu_to_cpu_most', max(all_ratios))} times in other scenes.")


def backend_words(results):
    """OpenCL against the backend that is made for the same hardware, clauses."""
    for base, where in (("c", "CPUs"), ("cuda", "GPUs")):
        told = []
        for result in results:
            for device in (each for each in answer.runnable(result) if each["backend"] == "opencl"):
                own = next((each for each in answer.runnable(result) if each["backend"] == base
                            and each["is_cpu"] is device["is_cpu"] and (device["is_cpu"] or each["name"] == device["name"])), None)
                found = ratios(times(result, device["label"]), times(result, own["label"])) if own else []
                if found:
                    told.append(f"{answer.figure(f'opencl_to_{base}', median(found))} ({place_words(result)})")
        if told:
            yield f"{' and '.join(filter(None, (', '.join(told[:-1]), told[-1])))} times as long as {answer.BACKENDS[base]} on {where}"


def trust_words(results):
    judged = [result["pictures"] for result in results if result["pictures"] and result["pictures"]["same"] is not None]
    wrong = [result["machine"]["name"] for result in results if result["pictures"] and result["pictures"]["same"] is False]
    if wrong:
        return f"<strong>Do not trust these figures: the pictures of backends differ on {html.escape(', '.join(wrong))}.</strong>"
    if not judged:
        return "Which backend to trust: <em>missing</em>, for no pictures were compared."
    count = sum(each["compared"] for each in judged)
    return (f"Trust any backend, for all made the same bytes in {answer.figure('frames_alike', count, f'{count}')} compared "
            "frames, and take the fastest.")


def answers(results):
    yield from gpu_words(results)
    yield trust_words(results)
    clauses = list(backend_words(results))
    if clauses:
        yield f"OpenCL takes {' and '.join(clauses)}."


PART = Part(1, "Speed: the mean time of a frame", "The official example beside the figures of the report that it comes from. A "
            "frame is prepared, traced and copied.", add, fill=fill, answer=answers, lead=2)
