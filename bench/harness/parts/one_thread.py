# SPDX-License-Identifier: MIT
"""The same picture by one thread, and by everything else."""
from harness.chart.bars import Row, ms, rows
from harness.measure import bounds
from harness.measure.numbers import number
from harness.measure.points import OFFICIAL
from harness.page.part import Part
from harness.page.section import middle, speed_words, table_of

ONE_LANE, ONE_THREAD, ALL = "one thread, one ray at a time", "one thread", "all of it"


def add(points):
    """A quick one counts as many times as it has less samples."""
    options, scale = (("--samples", "2"), 4) if points.quick else (("--samples", "4"), 1)
    for label, device in points.devices.items():
        ways = {ALL: ()}
        if device["backend"] == "c":
            ways = {ONE_LANE: ("--threads", "1", "--lanes", "1"), ONE_THREAD: ("--threads", "1"), **ways}
        for series, more in ways.items():
            points.add(series, 0, label, OFFICIAL, (*options, *more), frames="0,512", scale=scale)


def fill(sources, section):
    found = [(device, entry) for device in sources.with_part("one_thread") for entry in device.entries("one_thread")]
    found.sort(key=lambda pair: -middle(pair[1]))
    base = next((entry for _, entry in found if entry["series"] == ONE_THREAD), None)
    drawn = []
    for device, entry in found:
        against = f", {number(middle(base) / middle(entry), 3)} x" if base else ""
        bound = bounds.milliseconds(device.result, device.entry, entry) if entry["series"] == ALL else None
        drawn.append(Row(f"{device.short}, {entry['series']}" if entry["series"] != ALL else device.name,
                         entry["summary"]["trace_ms"], ms(middle(entry)) + against, device.place, bound))
    fastest, entry = found[-1]
    caption = f"{fastest.short} traces a frame in {ms(middle(entry))}"
    if base:
        caption += f", {speed_words(middle(base) / middle(entry), 'one thread of the C backend')}"
        plain = next((each for _, each in found if each["series"] == ONE_LANE and each["device"] == base["device"]), None)
        if plain:
            caption += f", which is {speed_words(middle(plain) / middle(base), 'one thread that traces ray by ray')}"
    section.draw("one_thread", rows, sources.about("official example, 640 x 480, 4 x 4 samples, depth 10"),
                 "One thread against everything else", caption + ". The factors at the bars are against one thread.",
                 "milliseconds for each frame", drawn, bounds.NAME)
    section.table = table_of(sources, "one_thread", lambda entry: entry["series"], "what")


PART = Part(10, "One thread against everything else", "The same picture by one thread of the C backend, ray by ray and with "
            "lanes, and by every device with all it has.", add, fill=fill)
