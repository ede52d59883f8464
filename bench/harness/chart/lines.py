# SPDX-License-Identifier: MIT
"""Lines with quartiles."""
from dataclasses import dataclass, field

from harness.chart.gnuplot import Chart, colour, plain, quoted

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
    ticks: dict = field(default_factory=dict)  # words: place; none: usual ones


def lines(about, title, caption, x_axis, y_axis, drawn, bounds=(), bound_name=""):
    """A chart; `bounds` are lists of (x, y) that cannot be undercut."""
    drawn = [line for line in drawn if line.points]
    rows = (len(drawn) + bool(bounds) + LEGEND_COLUMNS - 1) // LEGEND_COLUMNS
    xs = [x for line in drawn for x, _ in line.points]
    ys = [spread[key] for line in drawn for _, spread in line.points for key in ("median", "q1", "q3")]
    ys += [y for points in bounds for _, y in points]
    pad = 0 if x_axis.logarithmic else max(0.04 * (max(xs) - min(xs)), 1e-6)
    chart = Chart(about, title, caption, rows)
    chart.axis("x", x_axis.words, min(xs) - pad, max(xs) + pad, x_axis.logarithmic, x_axis.ticks)
    chart.axis("y", y_axis.words, *((min(ys), max(ys)) if y_axis.logarithmic else (0, 1.1 * max(ys))), y_axis.logarithmic)
    chart.legend(rows, " samplen 3")
    for place, points in enumerate(bounds):
        chart.data(f"bound{place}", points)
        chart.plot(f"$bound{place} using 1:2 with lines linewidth 2 dashtype 3 linecolor rgb '{BOUND}' "
                   + (f"title {quoted(bound_name)}" if place == 0 else "notitle"))
    for place, line in enumerate(drawn):
        chart.data(f"line{place}", ((x, each["median"], each["q1"], each["q3"]) for x, each in line.points))
        look = f"linecolor rgb '{colour(line.colour)}'"
        chart.plot(f"$line{place} using 1:2:3:4 with yerrorbars pointtype -1 linewidth 1.5 {look} notitle")
        chart.plot(f"$line{place} using 1:2 with linespoints linewidth 2 dashtype {line.dash} pointsize 1 "
                   f"pointtype {MARKS[line.mark % len(MARKS)]} {look} title {quoted(plain(line.name, 56))}")
    return chart.finished(515 + 24 * rows + chart.caption_height)
