# SPDX-License-Identifier: MIT
"""The time of a frame against its depth."""
from harness.chart.axes import Axis
from harness.page.section import Part, growth_words

DEPTHS = {True: (0, 2, 6, 14, 30), False: (0, 1, 2, 4, 6, 10, 14, 20, 30)}


def add(plan):
    plan.sweep("--depth", DEPTHS[plan.quick])


def fill(section):
    section.sweep("Time against depth", Axis("mirrorings and passings of a ray, at most"),
                  lambda drawn: growth_words(drawn, "in depth"))


PART = Part(7, "Depth", "--depth, with the scene's own cut-off.", add, fill=fill)
