# SPDX-License-Identifier: MIT
"""The official example beside the figures of the report that it comes from."""
from harness.chart.bars import Row, ms, one_value, rows, spread_words
from harness.measure.plan import OFFICIAL
from harness.measurements import bounds
from harness.page.section import MS, Part, speed_words

FRAMES = ",".join(map(str, range(0, 1024, 128)))
CPU, GPU = "the report's CPU", "the report's GTX 1050"
REPORT = {CPU: 84.5e3, GPU: 1.10e3}  # milliseconds of a frame of the same scene
REPORT_COLOUR = 6


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
    drawn = [Row(name, one_value(value), ms(value), REPORT_COLOUR, group="report") for name, value in REPORT.items()]
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


PART = Part(1, "Mean time of a frame", "The official example beside the figures of the report that it comes from. A frame is "
            "prepared, traced and copied.", add, fill=fill)
