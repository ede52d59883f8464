# SPDX-License-Identifier: MIT
"""Quartiles, and numbers in words."""
import math
from statistics import quantiles


def quartiles(values):
    """Returns first quartile, median, third quartile: at a quarter, a half and three quarters of the way from smallest
    to largest, linear between neighbours."""
    values = list(values)
    return quantiles(values if len(values) > 1 else 2 * values, n=4, method="inclusive")


def spread(values):
    first, middle, third = quartiles(values)
    return {"median": middle, "q1": first, "q3": third}


def number(value, digits=4):
    """Returns so many significant digits, without an exponent."""
    if value is None:
        return "-"
    before = 1 + math.floor(math.log10(value)) if value > 0 else 1
    return f"{value:.{max(0, digits - before)}f}"


def spread_text(values, dots=".."):
    return f"{number(values['median'])} [{number(values['q1'])}{dots}{number(values['q3'])}]"


def count_words(count):
    """Returns a count as people say it: 1 k, 80 k, 1 M."""
    for unit, size in (("M", 1000000), ("k", 1000)):
        if count >= size:
            return f"{count / size:g} {unit}"
    return str(count)


def rays(frame):
    return sum(frame["rays"].values())
