# SPDX-License-Identifier: MIT
"""Quartiles, and numbers as they are told."""
import math


def quartiles(values):
    """First quartile, median, third: at a quarter, a half and three quarters of the way from the
    smallest to the largest, linearly between neighbours."""
    ordered = sorted(values)

    def at(share):
        place = (len(ordered) - 1) * share
        low = int(place)
        high = min(low + 1, len(ordered) - 1)
        return ordered[low] + (ordered[high] - ordered[low]) * (place - low)

    return [at(0.25), at(0.5), at(0.75)]


def spread(values):
    first, middle, third = quartiles(values)
    return {"median": middle, "q1": first, "q3": third}


def number(value, digits=4):
    """So many significant digits, without an exponent."""
    if value is None:
        return "-"
    before = 1 + math.floor(math.log10(value)) if value > 0 else 1
    return f"{value:.{max(0, digits - before)}f}"


def spread_text(values, dots=".."):
    return f"{number(values['median'])} [{number(values['q1'])}{dots}{number(values['q3'])}]"


def count_words(count):
    """1 k, 80 k, 1 M: as people say it."""
    for unit, size in (("M", 1000000), ("k", 1000)):
        if count >= size:
            return f"{count / size:g} {unit}"
    return str(count)


def rays(frame):
    return sum(frame["rays"].values())
