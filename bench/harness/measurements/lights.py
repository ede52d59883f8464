# SPDX-License-Identifier: MIT
"""The default scene under many point lights."""
from harness.chart.axes import Axis
from harness.measure.scenes import write_lights
from harness.page.section import Part

LIGHTS = {True: (1, 10, 100, 1000), False: (1, 3, 10, 30, 100, 300, 1000)}


def scenes(plan):
    return {f"lights-{count}": write_lights(plan.folder, count) for count in LIGHTS[plan.quick]}


def add(plan):
    for label, _, view, scale in plan.each():
        for count in LIGHTS[plan.quick]:
            plan.point("", count, label, f"lights-{count}", view, scale=scale)


def fill(section):
    section.sweep("Time against the number of lights", Axis("point lights", True),
                  scene="default scene under point lights, 1280 x 720, 2 x 2 samples")


PART = Part(5, "Number of lights", "The default scene under 1 to 1000 point lights with shadows.", add, scenes, fill=fill)
