# SPDX-License-Identifier: MIT
"""Block and grid sizes of GPUs."""
from harness.chart.lines import Axis, lines
from harness.measure.points import WHOLE_FRAME
from harness.page.part import Part
from harness.page.section import best_words, table_of, ticks_of, y_axis

BLOCKS = (32, 64, 128, 256, 512, 1024)
GRIDS = (1, 4, 16, 64, 256, 1024, 4096, 16384, 65536)


def add(points):
    for option, values in (("block", BLOCKS), ("grid", GRIDS)):
        points.sweep(f"--{option}", values, lambda device: not device["is_cpu"], series=option,
                     none="There is no GPU, and the CPUs' work groups have one size.")


def fill(sources, section):
    for series, what in (("block", "threads of a work group"), ("grid", "work groups of a launch, at most")):
        drawn = [device.line("blocks", series=series) for device in sources.with_part("blocks")
                 if device.entries("blocks", series=series)]
        if drawn:
            section.draw(f"blocks_{series}", lines, sources.about(WHOLE_FRAME), f"Time against {what}",
                         f"The fastest: {best_words(drawn)}.", Axis(what, True, ticks_of(drawn)), y_axis(drawn), drawn)
    section.table = table_of(sources, "blocks", lambda entry: f"--{entry['series']} {entry['x']:g}", "option")


PART = Part(3, "Block and grid sizes", "--block and --grid of GPUs, each with the other as hedron chooses it.", add, fill=fill)
