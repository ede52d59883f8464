# SPDX-License-Identifier: MIT
"""Axes: positions of values, and labels."""
import math
from dataclasses import dataclass, field

FEW_POWERS = 3  # powers of ten: below it 2 and 5 times them are labelled too
LINEAR_TICKS = 6


@dataclass(frozen=True)
class Axis:
    words: str
    logarithmic: bool = False
    ticks: dict = field(default_factory=dict)  # {words: place}; empty: usual ones


@dataclass(frozen=True)
class Scale:
    """An axis from low to high, drawn from start to end."""
    axis: Axis
    low: float
    high: float
    start: float
    end: float

    def __call__(self, value):
        low, high = self.low, self.high
        if self.axis.logarithmic:
            low, high, value = math.log(low), math.log(high), math.log(max(value, low))
        return self.start + (self.end - self.start) * (value - low) / (high - low)

    def ticks(self):
        """Returns {words: place}."""
        found = self.axis.ticks or (logarithmic_ticks if self.axis.logarithmic else linear_ticks)(self.low, self.high)
        return {words: self(value) for words, value in found.items() if self.low <= value <= self.high}


def axis_number(value):
    """Returns a number without exponent and trailing zeros; large ones as a word."""
    for unit, size in ((" M", 1e6), (" k", 1e3)):
        if value >= 10 * size and value % size == 0:
            return f"{value / size:g}{unit}"
    return f"{value:,.12f}".rstrip("0").rstrip(".") if value >= 1e-5 or value == 0 else f"{value:g}"


def logarithmic_ticks(low, high):
    powers_of_ten = math.log10(high / low)
    digits = (1,) if powers_of_ten > FEW_POWERS else (1, 2, 5) if powers_of_ten > 1 else (1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9)
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    values = [digit * 10.0 ** power for power in powers for digit in digits]
    return {axis_number(float(f"{value:.6g}")): value for value in values}


def linear_ticks(low, high):
    rough = (high - low) / LINEAR_TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(digit * power for digit in (1, 2, 5, 10) if digit * power >= rough)
    return {axis_number(float(f"{place * step:.6g}")): place * step
            for place in range(math.ceil(low / step), math.floor(high / step) + 1)}


def limits(values, logarithmic, low=None):
    """Returns limits of all values with a margin; `low` is the start of a linear axis."""
    values = [value for value in values if value > 0 or not logarithmic]
    if not values:
        return 1.0, 10.0
    first, last = min(values), max(values)
    if logarithmic:
        return first / 1.3, last * 1.3
    pad = max(0.04 * (last - first), 1e-9)
    return (first - pad if low is None else low), last + pad


def draw_name(sheet, x, y, name, until):
    """Draws a label below its place, unless it would touch the one that ends at `until`; returns the end of the last."""
    half = sheet.length(name) / 2
    x = min(max(x, half), sheet.width - half)
    if x - half < until + 6:
        return until
    sheet.text(x, y, name, "middle", "soft")
    return x + half


def draw_below(sheet, scale, y, words, top=None):
    """Draws an axis at the bottom, with lines up to `top`, without labels that would touch; returns its end."""
    until = -1e9
    sheet.stroke([(scale.start, y), (scale.end, y)], None, 1, 'class="axis"')
    for name, x in sorted(scale.ticks().items(), key=lambda tick: tick[1]):
        before, until = until, draw_name(sheet, x, y + sheet.size + 4, name, until)
        if top is not None and until != before:
            sheet.stroke([(x, top), (x, y)], None, 1, 'class="grid"')
    lines = sheet.wrapped(words, scale.end - scale.start)
    for place, line in enumerate(lines):
        sheet.text(scale.end, y + (place + 2) * sheet.line + 2, line, "end", "soft")
    return y + (1 + len(lines)) * sheet.line + 8
