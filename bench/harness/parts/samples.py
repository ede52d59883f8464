# SPDX-License-Identifier: MIT
"""The time of a frame against its samples."""
from dataclasses import replace

from harness.chart.lines import Axis, lines
from harness.page.part import Part
from harness.page.section import growth_words, table_of, ticks_of, y_axis

SIDES = {True: (1, 2, 4), False: (1, 2, 3, 4, 6, 8)}
VIEWS = {True: (("--size", "160x90"), 64), False: (("--size", "1280x720"), 1)}


def add(points):
    points.sweep("--samples", SIDES[points.quick], views=VIEWS)


def squared(line):
    return replace(line, points=[(x * x, spread) for x, spread in line.points])


def fill(sources, section):
    drawn = [squared(device.line("samples")) for device in sources.with_part("samples")]
    x, first = min(((line.points[0][0], line.points[0][1]["median"]) for line in drawn), key=lambda point: point[1])
    last = max(x for line in drawn for x, _ in line.points)
    section.draw("samples", lines, sources.about("one frame of the built-in scene, 1280 x 720"),
                 "Time against samples per pixel", growth_words(drawn, "samples per pixel"),
                 Axis("samples per pixel", True, ticks_of(drawn)), y_axis(), drawn,
                 bounds=[[(x, first), (last, first * last / x)]] if last > x else (), bound_name="in proportion to the samples")
    section.table = table_of(sources, "samples", lambda entry: f"{entry['x'] ** 2:g}", "samples per pixel")


PART = Part(6, "Samples per pixel", "The grid of --samples N has N x N.", add, fill=fill)
