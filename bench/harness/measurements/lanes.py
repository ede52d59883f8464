# SPDX-License-Identifier: MIT
"""Lanes of CPUs."""
from harness.chart.axes import Axis
from harness.page.section import Part, best_words, proportional

LANES = (1, 4, 8, 16)


def add(plan):
    plan.sweep("--lanes", LANES, lambda device: device["is_cpu"], none="No CPU was measured.")


def sets_words(entries):
    found = {}
    for entry in entries:
        for name in ("avx512", "avx2", "neon", "generic"):
            if entry["renderer"] and f" {name}" in entry["renderer"]:
                found.setdefault(name, set()).add(int(entry["x"]))
    sentences = [f"{', '.join(map(str, sorted(each)))} by {name}" for name, each in found.items()]
    words = "Hedron takes the best instruction set that the CPU has for a number of lanes"
    return f"{words}: {'; '.join(sentences)}." if sentences else f"{words}."


def fill(section):
    section.sweep("Time against rays traced together", Axis("lanes", True),
                  lambda drawn: best_words(drawn, lambda x: f"--lanes {x:g}"), bounds=proportional)
    section.notes.append(sets_words(section.entries()))


PART = Part(8, "Lanes and instruction sets", "Option --lanes of CPUs: rays that one thread traces together.", add, fill=fill)
