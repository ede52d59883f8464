# SPDX-License-Identifier: MIT
"""The same picture by one thread, and by whole devices."""
from harness.chart.rows import Row, ms, rows
from harness.measure.numbers import number
from harness.measure.plan import OFFICIAL
from harness.measurements import bounds
from harness.page.section import MS, Part, middle, speed_words

ONE_LANE, ONE_THREAD, ALL = "one thread, one ray at a time", "one thread", "all of it"


def add(plan):
    """Adds the jobs; a quick one's times are multiplied, because it has fewer samples."""
    options, scale = (("--samples", "2"), 4) if plan.quick else (("--samples", "4"), 1)
    for label, device in plan.runnable.items():
        ways = {ALL: ()}
        if device["backend"] == "c":
            ways = {ONE_LANE: ("--threads", "1", "--lanes", "1"), ONE_THREAD: ("--threads", "1"), **ways}
        for series, more in ways.items():
            plan.point(series, 0, label, OFFICIAL, (*options, *more), frames="0,512", scale=scale)


def fill(section):
    found = [(device, entry) for device in section.devices for entry in device.entries()]
    found.sort(key=lambda pair: -middle(pair[1]))
    base = next((entry for _, entry in found if entry["series"] == ONE_THREAD), None)
    drawn = []
    for device, entry in found:
        against = f", {number(middle(base) / middle(entry), 3)} x" if base else ""
        whole = entry["series"] == ALL
        drawn.append(Row(device.name if whole else f"{device.name}, {entry['series']}", entry["summary"]["trace_ms"],
                         ms(middle(entry)) + against, device.place,
                         bounds.milliseconds(device.result, device.entry, entry) if whole else None))
    fastest, entry = found[-1]
    caption = f"{fastest.name} is the fastest: {ms(middle(entry))} a frame."
    if base:
        caption += f" That is {speed_words(middle(base) / middle(entry), 'one thread of the C backend')}."
        plain = next((each for _, each in found if each["series"] == ONE_LANE and each["device"] == base["device"]), None)
        if plain:
            caption += f" One thread is {speed_words(middle(plain) / middle(base), 'with one lane')}."
    section.draw(rows, "official example, 640 x 480, 4 x 4 samples, depth 10", "One thread against everything else",
                 f"{caption} Factors beside times are against one thread.", MS, drawn, bounds.NAME)
    section.tabulate(lambda entry: entry["series"])


PART = Part(10, "One thread against everything else", "The same picture by one thread of the C backend, with one lane and "
            "with all, and by every whole device.", add, fill=fill)
