# SPDX-License-Identifier: MIT
"""The two kinds of charts that bench/study adds to the others, in the same style: lines with quartiles, and rows of
medians with quartiles."""
import math
import textwrap
from dataclasses import dataclass, field

from harness import charts, report

TICKS = ((1, 2, 5), (1,))  # digits of the labels of a logarithmic axis: of few powers of ten, of many
FEW_POWERS = 3
BOUND = "#666666"
MARKS = (7, 5, 9, 13, 11)


@dataclass(frozen=True)
class Line:
    name: str
    points: list  # (x, {"median", "q1", "q3"})
    colour: int
    dash: int = 1
    mark: int = 0
    short: str = ""  # in sentences


@dataclass(frozen=True)
class Row:
    name: str
    spread: dict  # "median", "q1", "q3"
    words: str  # at its end
    colour: int = 0
    bound: float = None  # what cannot be undercut, as far as is known
    group: str = ""  # rows of a group stand together


@dataclass
class Axis:
    words: str
    logarithmic: bool = False
    ticks: dict = field(default_factory=dict)  # words: place; none: gnuplot's own


def number(value):
    """For an axis: no exponent and no trailing zeros."""
    return f"{value:,.12f}".rstrip("0").rstrip(".") if value < 1e15 else f"{value:g}"


def tick_words(low, high):
    """{words: value} for a logarithmic axis."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    digits = TICKS[0] if math.log10(high / low) <= FEW_POWERS else TICKS[1]
    values = [digit * 10.0 ** power for power in powers for digit in digits]
    return {number(value): value for value in values if low <= value <= high}


def axis_commands(name, axis, low, high):
    if axis.logarithmic:
        low, high = low / 1.4, high * 1.4
    commands = [f"set logscale {name}"] if axis.logarithmic else []
    ticks = axis.ticks or (tick_words(low, high) if axis.logarithmic else {})
    if ticks:
        commands.append(f"set {name}tics (" + ", ".join(f"{charts.quoted(words.replace('%', '%%'))} {value!r}"
                                                         for words, value in ticks.items()) + ") noenhanced")
    words = axis.words + (" (logarithmic)" if axis.logarithmic else "")
    return [*commands, f"set {name}label {charts.quoted(words)}", f"set {name}range [{low!r}:{high!r}]"]


def caption_height(caption):
    return 23 * len(textwrap.wrap(caption, charts.CAPTION_LENGTH))


def is_wide(values):
    return bool(values) and charts.logarithmic(values)


def lines(about, title, caption, x_axis, y_axis, drawn, bounds=(), bound_name=""):
    """(height, commands). `bounds` are lists of (x, y) that cannot be undercut."""
    drawn = [line for line in drawn if line.points]
    rows = (len(drawn) + bool(bounds) + charts.LEGEND_COLUMNS - 1) // charts.LEGEND_COLUMNS
    xs = [x for line in drawn for x, _ in line.points]
    ys = [spread[key] for line in drawn for _, spread in line.points for key in ("median", "q1", "q3")]
    shown = [y for points in bounds for _, y in points]
    low, high = (min([*ys, *shown]), max([*ys, *shown])) if y_axis.logarithmic else (0, 1.1 * max([*ys, *shown]))
    pad = 0 if x_axis.logarithmic else max(0.04 * (max(xs) - min(xs)), 1e-6)
    commands = charts.style(about, title, caption, rows)
    commands += axis_commands("x", x_axis, min(xs) - pad, max(xs) + pad)
    commands += axis_commands("y", y_axis, low, high)
    commands.append(f"set key at graph 0.5, graph 1.03 center bottom vertical maxrows {rows} Left reverse noenhanced "
                    "samplen 3")
    plots = []
    for place, points in enumerate(bounds):
        commands += [f"$bound{place} << END", *(f"{x!r} {y!r}" for x, y in points), "END"]
        plots.append(f"$bound{place} using 1:2 with lines linewidth 2 dashtype 3 linecolor rgb '{BOUND}' "
                     + (f"title {charts.quoted(bound_name)}" if place == 0 else "notitle"))
    for place, line in enumerate(drawn):
        commands += [f"$line{place} << END", *(f"{x!r} {each['median']!r} {each['q1']!r} {each['q3']!r}"
                                               for x, each in line.points), "END"]
        look = f"linecolor rgb '{charts.colour(line.colour)}'"
        plots += [f"$line{place} using 1:2:3:4 with yerrorbars pointtype -1 linewidth 1.5 {look} notitle",
                  f"$line{place} using 1:2 with linespoints linewidth 2 dashtype {line.dash} pointsize 1 "
                  f"pointtype {MARKS[line.mark % len(MARKS)]} {look} title {charts.quoted(charts.plain(line.name, 56))}"]
    commands.append("plot " + ", ".join(plots))
    return 515 + 24 * rows + caption_height(caption), commands


def rows(about, title, caption, unit, drawn, bound_name=""):
    """(height, commands): a bar for each row, with whiskers to the quartiles, and a mark at its bound."""
    values = [row.spread[key] for row in drawn for key in ("median", "q1", "q3")]
    values += [row.bound for row in drawn if row.bound]
    wide = is_wide([value for value in values if value > 0])
    start = min(value for value in values if value > 0) / 2 if wide else 0
    end = max(values) * min((max(values) / start) ** 0.45, 60) if wide else max(max(values) * 1.5, 1e-9)
    bounded = any(row.bound for row in drawn)
    commands = charts.style(about, title, caption, int(bounded))
    places = row_places(drawn)
    ticks = ", ".join(f"{charts.quoted(charts.plain(row.name, 62).replace('%', '%%'))} {place!r}"
                      for row, place in zip(drawn, places))
    commands += axis_commands("x", Axis(unit, wide), (start or 0) * 1.4, end / 1.4) if wide else [
        f"set xlabel {charts.quoted(unit)}", f"set xrange [0:{end!r}]"]
    commands += [f"set yrange [{places[-1] - 0.7!r}:0.7]", f"set ytics ({ticks}) noenhanced", "set grid noytics",
                 "set key at graph 0.5, graph 1.02 center bottom horizontal Left reverse noenhanced" if bounded
                 else "unset key",
                 "$data << END"]
    commands += [f"{place!r} {max(row.spread['median'], start)!r} {max(row.spread['q1'], start)!r} {row.spread['q3']!r} "
                 f"{int(charts.colour(row.colour)[1:], 16)}" for row, place in zip(drawn, places)]
    commands += ["END", "$words << END", *(f"{max(row.spread['q3'], row.spread['median'], start)!r} {place!r} "
                                           f'"{charts.plain(row.words, 60)}"' for row, place in zip(drawn, places)), "END",
                 "$bounds << END", *(f"{row.bound!r} {place!r}" for row, place in zip(drawn, places) if row.bound), "END",
                 "set style fill solid 0.85 noborder"]
    plots = [f"$data using (($2+{start!r})/2):1:({start!r}):2:($1-0.36):($1+0.36):5 with boxxyerror "
             "linecolor rgb variable notitle",
             "$data using 2:1:3:4 with xerrorbars pointtype -1 linewidth 1.5 linecolor rgb '#222222' notitle",
             "$words using 1:2:3 with labels left offset 0.8, 0 noenhanced notitle"]
    if bounded:
        plots.append(f"$bounds using 1:2 with points pointtype 2 pointsize 1.6 linewidth 2.5 linecolor rgb '#000000' "
                     f"title {charts.quoted(bound_name)}")
    commands.append("plot " + ", ".join(plots))
    return 265 + 24 * bounded + caption_height(caption) + round(34 * (1 - places[-1])), commands


def row_places(drawn):
    """Downwards, with a gap between groups."""
    places, place = [], 0.0
    for before, row in zip([None, *drawn], drawn):
        if before is not None:
            place -= 1.5 if before.group != row.group else 1
        places.append(place)
    return places


def ms(value):
    return f"{report.number(value, 3)} ms" if value < 1000 else f"{report.number(value / 1000, 3)} s"


def spread_words(spread):
    unit, name = (1, "ms") if spread["median"] < 1000 else (1000, "s")
    first, middle, third = (report.number(spread[key] / unit, 3) for key in ("q1", "median", "q3"))
    return f"{middle} {name} [{first} .. {third}]"
