# SPDX-License-Identifier: MIT
"""Lines with quartiles."""
import math
import textwrap
from dataclasses import dataclass, field

from harness.chart import gnuplot
from harness.chart.gnuplot import data, numbers, quoted

TICKS = ((1, 2, 5), (1,))  # digits of the labels of a logarithmic axis: of few powers of ten, of many
FEW_POWERS = 3
BOUND = "#666666"
MARKS = (7, 5, 9, 13, 11)
LEGEND_COLUMNS = 2


@dataclass(frozen=True)
class Line:
    name: str
    points: list  # (x, {"median", "q1", "q3"})
    colour: int
    dash: int = 1
    mark: int = 0
    short: str = ""  # in sentences


@dataclass
class Axis:
    words: str
    logarithmic: bool = False
    ticks: dict = field(default_factory=dict)  # words: place; none: gnuplot's own


def axis_number(value):
    """For an axis: no exponent and no trailing zeros."""
    return f"{value:,.12f}".rstrip("0").rstrip(".") if value < 1e15 else f"{value:g}"


def tick_words(low, high):
    """{words: value} for a logarithmic axis."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    digits = TICKS[0] if math.log10(high / low) <= FEW_POWERS else TICKS[1]
    values = [digit * 10.0 ** power for power in powers for digit in digits]
    return {axis_number(value): value for value in values if low <= value <= high}


def axis_commands(name, axis, low, high):
    if axis.logarithmic:
        low, high = low / 1.4, high * 1.4
    commands = [f"set logscale {name}"] if axis.logarithmic else []
    ticks = axis.ticks or (tick_words(low, high) if axis.logarithmic else {})
    if ticks:
        commands.append(f"set {name}tics (" + ", ".join(f"{quoted(words.replace('%', '%%'))} {value!r}"
                                                         for words, value in ticks.items()) + ") noenhanced")
    words = axis.words + (" (logarithmic)" if axis.logarithmic else "")
    return [*commands, f"set {name}label {quoted(words)}", f"set {name}range [{low!r}:{high!r}]"]


def caption_height(caption):
    return 23 * len(textwrap.wrap(caption, gnuplot.CAPTION_LENGTH))


def lines(about, title, caption, x_axis, y_axis, drawn, bounds=(), bound_name=""):
    """(height, commands). `bounds` are lists of (x, y) that cannot be undercut."""
    drawn = [line for line in drawn if line.points]
    rows = (len(drawn) + bool(bounds) + LEGEND_COLUMNS - 1) // LEGEND_COLUMNS
    xs = [x for line in drawn for x, _ in line.points]
    ys = [spread[key] for line in drawn for _, spread in line.points for key in ("median", "q1", "q3")]
    shown = [y for points in bounds for _, y in points]
    low, high = (min([*ys, *shown]), max([*ys, *shown])) if y_axis.logarithmic else (0, 1.1 * max([*ys, *shown]))
    pad = 0 if x_axis.logarithmic else max(0.04 * (max(xs) - min(xs)), 1e-6)
    commands = gnuplot.style(about, title, caption, rows)
    commands += axis_commands("x", x_axis, min(xs) - pad, max(xs) + pad)
    commands += axis_commands("y", y_axis, low, high)
    commands.append(f"set key at graph 0.5, graph 1.03 center bottom vertical maxrows {rows} Left reverse noenhanced "
                    "samplen 3")
    plots = []
    for place, points in enumerate(bounds):
        commands += data(f"bound{place}", (numbers(x, y) for x, y in points))
        plots.append(f"$bound{place} using 1:2 with lines linewidth 2 dashtype 3 linecolor rgb '{BOUND}' "
                     + (f"title {quoted(bound_name)}" if place == 0 else "notitle"))
    for place, line in enumerate(drawn):
        commands += data(f"line{place}", (numbers(x, each["median"], each["q1"], each["q3"]) for x, each in line.points))
        look = f"linecolor rgb '{gnuplot.colour(line.colour)}'"
        plots += [f"$line{place} using 1:2:3:4 with yerrorbars pointtype -1 linewidth 1.5 {look} notitle",
                  f"$line{place} using 1:2 with linespoints linewidth 2 dashtype {line.dash} pointsize 1 "
                  f"pointtype {MARKS[line.mark % len(MARKS)]} {look} title {quoted(gnuplot.plain(line.name, 56))}"]
    commands.append("plot " + ", ".join(plots))
    return 515 + 24 * rows + caption_height(caption), commands
