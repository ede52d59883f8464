# SPDX-License-Identifier: MIT
"""The official example beside the figures of the report that it comes from."""
from harness.chart.bars import Row, ms, one_value, rows, spread_words
from harness.measure import bounds
from harness.measure.points import OFFICIAL
from harness.page.part import Part
from harness.page.section import speed_words, table_of

FRAMES = ",".join(map(str, range(0, 1024, 128)))
REPORT = {"the report's CPU": 84.5e3, "the report's GTX 1050": 1.10e3}  # milliseconds of a frame of the same scene
REPORT_COLOUR = 6


def add(points):
    for label, device in points.devices.items():
        if not device["is_cpu"]:
            points.add("", 0, label, OFFICIAL, (), frames=FRAMES)
        elif points.quick:
            points.add("", 0, label, OFFICIAL, ("--samples", "4"), frames="0,256,512", scale=16)
        else:
            points.add("", 0, label, OFFICIAL, (), frames="0,512", warm_up=False)


def spread(device):
    return device.entries("official")[0]["summary"]["frame_ms"]


def fill(sources, section):
    devices = sorted(sources.with_part("official"), key=lambda device: spread(device)["median"])
    drawn = [Row(name, one_value(value), ms(value), REPORT_COLOUR, group="report") for name, value in REPORT.items()]
    drawn += [Row(device.name, spread(device), spread_words(spread(device)), device.place,
                  bounds.milliseconds(device.result, device.entry, device.entries("official")[0])) for device in devices]
    fastest = spread(devices[0])["median"]
    cpu, gpu = REPORT
    caption = (f"{devices[0].short} takes {ms(fastest)} for a frame, {speed_words(REPORT[cpu] / fastest, cpu)} and "
               f"{speed_words(REPORT[gpu] / fastest, gpu)}")
    if len(devices) > 1:
        slowest = spread(devices[-1])["median"]
        caption += f"; {devices[-1].short}, the slowest, takes {ms(slowest)}, {speed_words(REPORT[cpu] / slowest, cpu)}"
    section.draw("official", rows, sources.about("official example, 640 x 480, 16 x 16 samples, depth 10"),
                 "Mean time of a frame", caption + ".", "milliseconds for each frame", drawn, bounds.NAME)
    section.table = table_of(sources, "official", lambda entry: f"frames {entry['frames']}", "what")


PART = Part(1, "Mean time of a frame", "The official example beside the figures of the report that it comes from. A frame is "
            "prepared, traced and copied.", add, fill=fill)
