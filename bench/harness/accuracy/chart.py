# SPDX-License-Identifier: MIT
"""Error against time, a chart for each device and each kind of error."""
import math

from harness.accuracy import front
from harness.accuracy.points import recommended
from harness.accuracy.settings import FAMILIES
from harness.chart import gnuplot
from harness.chart.gnuplot import data, numbers, quoted
from harness.chart.names import Names
from harness.measure.numbers import number

ERRORS = {"rmse": "root mean square error", "largest": "largest error"}
MARKS = (7, 5, 9, 13, 11, 4, 6, 8, 12)
LEAST = 1e-4  # of 255: what is less is drawn there


def chart_name(label, error):
    return f"accuracy_{label.replace(':', '')}_{error}"


def drawn(points, error):
    return [{**point, error: max(point[error], LEAST)} for point in points]


def caption(result, points, error):
    words = [f"{word}: {' '.join(point['options'])} ({number(point['ms'], 3)} ms)"
             for word, point in recommended(points)]
    truth = result["truth"]
    made = (f"The reference has {truth['samples']} x {truth['samples']} samples and misses at most "
            f"{number(truth['missing']['largest'], 2)} of 255; one of a quarter of its samples is off by "
            f"{number(truth['to_quarter_of_samples'][error], 2)}.")
    return " ".join([f"The fastest at least as good as grids of 2, 4 and 8: {'; '.join(words)}." if words else "",
                     made, "Times are medians of frames next to the one that is judged."]).strip()


def labels(points, error, ranges):
    """Those on the front are named where there is room, and what is recommended in words of its own."""
    named = [point for point in points if point["recommended"]]
    named += [point for point in front.front(points, error) if point not in named]
    names = Names(ranges, [(point["ms"], point[error]) for point in points])
    lines = []
    for place, point in enumerate(named):
        word = f" ({point['recommended']})" if point["recommended"] else ""
        name = gnuplot.plain(point["name"] + word, 40)
        where = names.place((point["ms"], point[error]), name, bool(word))
        if where:
            to, right, up = where
            lines.append(f"set label {place + 10} {quoted(name)} at {point['ms']!r}, {point[error]!r} {to} "
                         f"offset character {right}, {up} noenhanced font ',11'")
    return lines


def ticks(values):
    """1, 2 and 5 times the powers of ten."""
    first, last = math.floor(math.log10(min(values))) - 1, math.ceil(math.log10(max(values))) + 1
    return "(" + ", ".join(f"'{digit * 10.0 ** power:g}' {digit * 10.0 ** power!r}"
                           for power in range(first, last) for digit in (1, 2, 5)) + ")"


def chart(result, label, error):
    """(height, commands)"""
    def place_lines(these):
        return (numbers(each["ms"], each[error]) for each in these)
    points = drawn([each for each in result["points"] if each["device"] == label], error)
    families = [name for name in FAMILIES if any(each["family"] == name for each in points)]
    device = next(each for each in result["devices"] if each["label"] == label)
    rows = (len(families) + 3) // 2
    commands = gnuplot.style(result, f"{ERRORS[error].capitalize()} against time, {gnuplot.device_title(device)}",
                            caption(result, points, error), rows)
    times, errors = [point["ms"] for point in points], [point[error] for point in points]
    x_range, y_range = (min(times) / 1.5, max(times) * 2.5), (min(errors) / 1.6, max(errors) * 1.6)
    commands += [
        "set logscale xy", f"set xtics {ticks(times)}", f"set ytics {ticks(errors)}",
        f"set xrange [{x_range[0]!r}:{x_range[1]!r}]",
        f"set yrange [{y_range[0]!r}:{y_range[1]!r}]",
        "set xlabel 'milliseconds for each frame (logarithmic)'",
        f"set ylabel '{ERRORS[error]}, steps of 255 (logarithmic)'",
        f"set key at graph 0.5, graph 1.03 center bottom vertical maxrows {rows} Left reverse noenhanced",
        *labels(points, error, (x_range, y_range)),
        *data("front", place_lines(front.front(points, error))),
    ]
    plots = ["$front using 1:2 with lines linewidth 2.5 linecolor rgb '#999999' title 'the best front'"]
    for place, family in enumerate(families):
        commands += data(f"f{place}", place_lines(each for each in points if each["family"] == family))
        plots.append(f"$f{place} using 1:2 with points pointtype {MARKS[place % len(MARKS)]} pointsize 1.3 "
                     f"linewidth 1.5 linecolor rgb '{gnuplot.colour(place)}' "
                     f"title {quoted(FAMILIES[family])}")
    best = [each for each in points if each["recommended"]]
    if best:
        commands += data("best", place_lines(best))
        plots.append("$best using 1:2 with points pointtype 6 pointsize 3 linewidth 2 linecolor rgb '#000000' "
                     "title 'recommended'")
    commands.append("plot " + ", ".join(plots))
    return 640 + 20 * rows, commands


def charts(result):
    """{name: (height, commands)}"""
    labels = dict.fromkeys(point["device"] for point in result["points"] or [])
    return {chart_name(label, error): chart(result, label, error) for label in labels for error in ERRORS}
