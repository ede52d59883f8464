# SPDX-License-Identifier: MIT
"""Threads of the C backend."""
from harness.chart.lines import Axis
from harness.page.part import Part
from harness.page.section import few, growth, speed_words, sweep


def counts(cores):
    """All, and half of them, down to one."""
    found = {cores}
    while min(found) > 1:
        found.add(min(found) // 2)
    return sorted(found)


def add(points):
    points.sweep("--threads", counts(points.cores), lambda device: device["backend"] == "c",
                 none="The C backend, which has a choice of threads, was not measured.")


def words(line):
    x, first, last_x, last = growth(line)
    if last_x == x:
        return f"{line.short} has one core"
    return f"{last_x:g} threads are {speed_words(first / last, f'{x:g}')} on {line.short}"


def fill(sources, section):
    sweep(sources, section, "Time against threads of the C backend", Axis("threads", True),
          lambda drawn: few(list(map(words, drawn))) + ".", bounded=True)


PART = Part(9, "Threads", "--threads of the C backend.", add, fill=fill)
