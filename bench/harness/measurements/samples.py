# SPDX-License-Identifier: MIT
"""The time of a frame against its samples."""
from dataclasses import replace

from harness.chart.axes import Axis
from harness.page.section import Part

SIDES = {True: (1, 2, 4), False: (1, 2, 3, 4, 6, 8)}
VIEWS = {True: (("--size", "160x90"), 64), False: (("--size", "1280x720"), 1)}


def add(plan):
    plan.sweep("--samples", SIDES[plan.quick], views=VIEWS)


def bounds(drawn):
    x, first = min(((line.points[0][0], line.points[0][1]["median"]) for line in drawn), key=lambda point: point[1])
    last = max(x for line in drawn for x, _ in line.points)
    return {"bounds": [[(x, first), (last, first * last / x)]] if last > x else (), "bound_name": "in proportion to the samples"}


def fill(section):
    section.sweep("Time against samples per pixel", Axis("samples per pixel", True), bounds=bounds,
                  points=lambda line: replace(line, points=[(x * x, spread) for x, spread in line.points]),
                  scene="one frame of the built-in scene, 1280 x 720", name=lambda x: f"{x ** 2:g}")


PART = Part(6, "Samples per pixel", "Option --samples N: a pixel has N x N samples.", add, fill=fill)
