# SPDX-License-Identifier: MIT
"""The default scene under many point lights."""
from harness.chart.lines import Axis
from harness.measure.scenes import write_lights
from harness.page.part import Part
from harness.page.section import sweep

LIGHTS = {True: (1, 10, 100, 1000), False: (1, 3, 10, 30, 100, 300, 1000)}


def scenes(_program, folder, quick, _news):
    return {f"lights-{count}": write_lights(folder, count) for count in LIGHTS[quick]}


def add(points):
    for label, _, view, scale in points.each():
        for count in LIGHTS[points.quick]:
            points.add("", count, label, f"lights-{count}", view, scale=scale)


def fill(sources, section):
    sweep(sources, section, "Time against the number of lights", Axis("point lights", True),
          scene="default scene under point lights, 1280 x 720, 2 x 2 samples")


PART = Part(5, "Number of lights", "The default scene under so many point lights, each with shadows.", add, scenes, fill=fill)
