# SPDX-License-Identifier: MIT
"""Block and grid sizes of GPUs."""
from harness.chart.axes import Axis
from harness.chart.lines import lines
from harness.page.section import TIME_AXIS, WHOLE_FRAME, Part, best_words, ticks_of

BLOCKS = (32, 64, 128, 256)
GRIDS = (1, 4, 16, 64, 256, 1024, 4096, 16384, 65536)


def add(plan):
    for option, values in (("block", BLOCKS), ("grid", GRIDS)):
        plan.sweep(f"--{option}", values, lambda device: not device["is_cpu"], series=option,
                   none="No GPU was measured; work groups of CPUs have one size.")


def fill(section):
    for series, what in (("block", "threads of a work group"), ("grid", "work groups of a launch, at most")):
        drawn = [device.line(series=series) for device in section.devices if device.entries(series=series)]
        if drawn:
            words = best_words(drawn, lambda x, series=series: f"--{series} {x:g}")
            section.draw(lines, WHOLE_FRAME, f"Time against {what}", words, Axis(what, True, ticks_of(drawn)), TIME_AXIS, drawn,
                         name=f"blocks_{series}")
    section.tabulate(lambda entry: f"--{entry['series']} {entry['x']:g}", "option")


PART = Part(3, "Block and grid sizes", "Options --block and --grid of GPUs; hedron chooses the other of the two.", add, fill=fill)
