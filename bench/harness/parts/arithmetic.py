# SPDX-License-Identifier: MIT
"""Strict and fast arithmetic, float and double."""
from harness.chart.bars import Row, rows, spread_words
from harness.measure.points import DEFAULT, WHOLE_FRAME
from harness.page.part import Part
from harness.page.section import TOO_LITTLE, few, middle, ratio, sentence, table_of

ARITHMETIC = [(precision, math) for precision in ("float", "double") for math in ("strict", "fast")]


def add(points):
    for label, device, view, scale in points.each():
        for place, (precision, math) in enumerate(ARITHMETIC):
            if precision == "float" or device["has_double"]:
                points.add("", place, label, DEFAULT, (*view, "--precision", precision, "--math", math), scale=scale)


def fill(sources, section):
    drawn, told = [], []
    for device in sources.with_part("arithmetic"):
        found = {ARITHMETIC[int(entry["x"])]: entry for entry in device.entries("arithmetic")}
        for kind, entry in found.items():
            drawn.append(Row(f"{device.short}, {kind[0]}, {kind[1]}", entry["summary"]["trace_ms"],
                             spread_words(entry["summary"]["trace_ms"]), ARITHMETIC.index(kind), group=str(device.place)))
        base = found.get(("float", "strict"))
        others = [f"{words} takes {ratio(middle(found[kind]) / middle(base))} as long" for kind, words in
                  ((("float", "fast"), "fast arithmetic"), (("double", "strict"), "double")) if base and kind in found]
        if others:
            told.append(f"on {device.short} {' and '.join(others)}")
    caption = sentence(few(told) + ", all against strict arithmetic in float.") if told else TOO_LITTLE
    section.draw("arithmetic", rows, sources.about(WHOLE_FRAME), "Strict and fast, float and double", caption,
                 "milliseconds for each frame", drawn)
    section.table = table_of(sources, "arithmetic", lambda entry: ", ".join(ARITHMETIC[int(entry["x"])]), "what")


PART = Part(12, "Arithmetic", "--math strict and fast, --precision float and double.", add, fill=fill)
