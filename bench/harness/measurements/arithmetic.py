# SPDX-License-Identifier: MIT
"""Strict and fast arithmetic, float and double."""
from harness.chart.bars import rows
from harness.measure.plan import DEFAULT
from harness.page.section import MS, TOO_LITTLE, WHOLE_FRAME, Part, few, middle, ratio, sentence

ARITHMETIC = [(precision, math) for precision in ("float", "double") for math in ("strict", "fast")]


def add(plan):
    for label, device, view, scale in plan.each():
        for place, (precision, math) in enumerate(ARITHMETIC):
            if (precision == "float" or device["has_double"]) and (math == "strict" or device["backend"] != "c"):
                plan.point("", place, label, DEFAULT, (*view, "--precision", precision, "--math", math), scale=scale)


def fill(section):
    drawn, told = [], []
    for device in section.devices:
        found = {ARITHMETIC[int(entry["x"])]: entry for entry in device.entries()}
        drawn += [section.bar(device, ", ".join(kind), entry, ARITHMETIC.index(kind)) for kind, entry in found.items()]
        base = found.get(("float", "strict"))
        others = [f"{words} takes {ratio(middle(found[kind]) / middle(base))} as long" for kind, words in
                  ((("float", "fast"), "fast arithmetic"), (("double", "strict"), "double")) if base and kind in found]
        if others:
            told.append(f"on {device.short} {' and '.join(others)}")
    caption = sentence(few(told) + ", all against strict arithmetic in float.") if told else TOO_LITTLE
    section.draw(rows, WHOLE_FRAME, "Strict and fast, float and double", caption, MS, drawn)
    section.tabulate(lambda entry: ", ".join(ARITHMETIC[int(entry["x"])]))


PART = Part(12, "Arithmetic", "--math strict and fast, --precision float and double.", add, fill=fill)
