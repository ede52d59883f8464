# SPDX-License-Identifier: MIT
"""What the shadow tests of the official example alone take at the arithmetic peak: the mark in its charts."""
from harness.measure import bounds
from harness.page.part import Part


def measure(study):
    if not study.result["bounds"]:
        study.news("the arithmetic peak")
        study.result["bounds"] = bounds.measure(study.program)


PART = Part(14, "Bounds", "Marks in the charts of others.", measure=measure)
