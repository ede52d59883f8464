# SPDX-License-Identifier: MIT
"""The time of a frame against its depth."""
from harness.chart.axes import Axis
from harness.page.section import Part, growth_words

DEPTHS = {True: (0, 2, 6, 14, 30), False: (0, 1, 2, 4, 6, 10, 14, 20, 30)}


def add(plan):
    plan.sweep("--depth", DEPTHS[plan.quick])


def fill(section):
    section.sweep("Time against depth", Axis("maximum ray depth"),
                  lambda drawn: growth_words(drawn, words=lambda x: f"depth {x:g}"))


PART = Part(7, "Depth", "Option --depth: reflections and transmissions in a row, with the cut-off of the scene.", add, fill=fill)
