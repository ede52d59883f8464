# SPDX-License-Identifier: MIT
"""Threads of the C backend."""
from harness.chart.axes import Axis
from harness.page.section import Part, few, growth, proportional, speed_words
from harness.run import machine


def counts(cores):
    """Returns all threads, half of them, and so on down to one."""
    found = [cores]
    while found[0] > 1:
        found.insert(0, found[0] // 2)
    return found


def add(plan):
    plan.sweep("--threads", counts(machine.cores()), lambda device: device["backend"] == "c",
               none="The C backend was not measured; only it has --threads.")


def words(line):
    x, first, last_x, last = growth(line)
    if last_x == x:
        return f"{line.short} has one core"
    return f"{last_x:g} threads are {speed_words(first / last, f'{x:g}')} on {line.short}"


def fill(section):
    section.sweep("Time against threads of the C backend", Axis("threads", True),
                  lambda drawn: few(list(map(words, drawn))), bounds=proportional)


PART = Part(9, "Threads", "Option --threads of the C backend.", add, fill=fill)
