# SPDX-License-Identifier: MIT
"""Strict and fast arithmetic, float and double."""
from harness.chart.rows import Row, rows
from harness.measure.numbers import number
from harness.measure.plan import DEFAULT
from harness.page.section import TOO_LITTLE, WHOLE_FRAME, Part, few, middle, ratio, relative

ARITHMETIC = [(precision, math) for precision in ("float", "double") for math in ("strict", "fast")]


def add(plan):
    for label, device, view, scale in plan.each():
        for place, (precision, math) in enumerate(ARITHMETIC):
            if (precision == "float" or device["has_double"]) and (math == "strict" or device["backend"] != "c"):
                plan.point("", place, label, DEFAULT, (*view, "--precision", precision, "--math", math), scale=scale)


def fill(section):
    drawn, sentences = [], []
    for device in section.devices:
        found = {ARITHMETIC[int(entry["x"])]: entry for entry in device.entries()}
        base = found.get(("float", "strict"))
        drawn += [Row(device.name, relative(entry, base), f"{number(middle(entry) / middle(base), 3)} x", device.place,
                      variant=", ".join(kind)) for kind, entry in found.items() if base and entry is not base]
        others = [f"{words} takes {ratio(middle(found[kind]) / middle(base))} as long" for kind, words in
                  ((("float", "fast"), "fast arithmetic"), (("double", "strict"), "double")) if base and kind in found]
        if others:
            sentences.append(f"on {device.name} {' and '.join(others)} as strict float")
    caption = few(sentences) or TOO_LITTLE
    if drawn:
        section.draw(rows, WHOLE_FRAME, "Strict and fast, float and double", caption, "times the time in float, strict", drawn)
    section.tabulate(lambda entry: ", ".join(ARITHMETIC[int(entry["x"])]))


PART = Part(12, "Arithmetic", "Options --math strict and fast, --precision float and double.", add, fill=fill)
