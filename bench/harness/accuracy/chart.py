# SPDX-License-Identifier: MIT
"""Error against time: a chart for each device and each kind of error, and one for each scene with the fronts of all."""
import math

from harness.accuracy import front
from harness.accuracy.points import recommended
from harness.accuracy.settings import FAMILIES
from harness.accuracy.truth import own_error
from harness.chart.gnuplot import TICKS, Chart, colour, device_title, plain, quoted
from harness.measure.numbers import number

ERRORS = {"rmse": "root mean square error", "largest": "largest error"}
MARKS = (7, 5, 9, 13, 11, 4, 6, 8, 12)
ENOUGH_NEARER = 10  # times nearer to the truth is a reference than what is held to it
LEAST = 1e-4  # of 255: what is less is drawn there
# Characters that the plot is wide and high, and how wide one of a name is: all about, for gnuplot does not tell.
PLOT = (133.0, 25.0)
LETTER, LINE, MARK = 0.86, 0.85, 0.8
# Where a name may stand, the best first: how it is aligned, and how far it is from the point.
SIDES = (("left", 0.8, 0.6), ("right", -0.8, -0.7), ("left", 0.8, -0.7), ("right", -0.8, 0.6), ("left", 0.8, 1.5),
         ("right", -0.8, -1.6), ("left", 0.8, -1.6), ("right", -0.8, 1.5))


def caption(truth, points, error):
    words = [f"{word}: {' '.join(point['options'])} ({number(point['ms'], 3)} ms)" for word, point in recommended(points)]
    made = (f"The reference has {truth['samples']} x {truth['samples']} samples and misses at most "
            f"{number(truth['missing']['largest'], 2)} of 255; one of a quarter of its samples is off by "
            f"{number(truth['to_quarter_of_samples'][error], 2)}.")
    return " ".join([f"The fastest at least as good as grids of 2, 4 and 8: {'; '.join(words)}." if words else "",
                     made, "Times are medians of frames next to the one that is judged."]).strip()


# ---- names beside points, where there is room

def is_free(box, taken):
    inside = 0 <= box[0] and box[2] <= PLOT[0] and 0 <= box[1] and box[3] <= PLOT[1]
    return inside and not any(box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3]
                              for other in taken)


def find_room(ranges, points, names):
    """For each (point, name, whether it must be named): (alignment, characters to the right, up), or None where there is no
    room. `ranges` are of x and y; `points` are pairs that names must not hide."""
    def position(point):
        return [size * math.log(value / first) / math.log(last / first)
                for size, value, (first, last) in zip(PLOT, point, ranges)]
    taken = [(x - MARK, y - MARK / 2, x + MARK, y + MARK / 2) for x, y in map(position, points)]
    for point, name, must in names:
        (x, y), width, boxes = position(point), LETTER * (len(name) + 1), {}
        for side in SIDES:
            left, middle = x + side[1] - (width if side[0] == "right" else 0), y + side[2]
            boxes[side] = (left, middle - LINE / 2, left + width, middle + LINE / 2)
        found = next((side for side, box in boxes.items() if is_free(box, taken)), SIDES[0] if must else None)
        taken += [boxes[found]] if found else []
        yield found


def labels(points, error, ranges):
    """Those on the front are named where there is room, and what is recommended in words of its own."""
    named = [point for point in points if point["recommended"]]
    named += [point for point in front.front(points, error) if point not in named]
    names = [((point["ms"], point[error]), plain(f"{point['name']} ({point['recommended']})", 40) if point["recommended"] else
              plain(point["name"], 40), point["recommended"]) for point in named]
    rooms = find_room(ranges, [(point["ms"], point[error]) for point in points], names)
    for place, (((x, y), name, _), where) in enumerate(zip(names, rooms)):
        if where:
            to, right, up = where
            yield (f"set label {place + 10} {quoted(name)} at {x!r}, {y!r} {to} offset character {right}, {up} noenhanced "
                   "font ',11'")


# ---- the chart

def ticks(values):
    """1, 2 and 5 times the powers of ten."""
    first, last = math.floor(math.log10(min(values))) - 1, math.ceil(math.log10(max(values))) + 1
    return {f"{digit * 10.0 ** power:g}": digit * 10.0 ** power for power in range(first, last) for digit in TICKS}


def chart(result, label, error):
    points = [{**point, error: max(point[error], LEAST)} for point in result["points"] if point["device"] == label]
    families = [name for name in FAMILIES if any(each["family"] == name for each in points)]
    device = next(each for each in result["devices"] if each["label"] == label)
    rows = (len(families) + 3) // 2
    made = Chart(result, f"{ERRORS[error].capitalize()} against time, {device_title(device)}",
                 caption(result["truth"], points, error), rows)
    times, errors = [point["ms"] for point in points], [point[error] for point in points]
    ranges = (min(times) / 1.5, max(times) * 2.5), (min(errors) / 1.6, max(errors) * 1.6)
    made.add("set logscale xy", *(f"set {name}range [{low!r}:{high!r}]" for name, (low, high) in zip("xy", ranges)),
             "set xlabel 'milliseconds for each frame (logarithmic)'",
             f"set ylabel '{ERRORS[error]}, steps of 255 (logarithmic)'",
             *labels(points, error, ranges))
    made.ticks("x", ticks(times))
    made.ticks("y", ticks(errors))
    made.legend(rows)

    def draw(name, these, look, title):
        made.data(name, ((each["ms"], each[error]) for each in these))
        made.plot(f"${name} using 1:2 with {look} title {quoted(title)}")
    draw("front", front.front(points, error), "lines linewidth 2.5 linecolor rgb '#999999'", "the best front")
    for place, family in enumerate(families):
        draw(f"f{place}", (each for each in points if each["family"] == family), f"points pointtype {MARKS[place % len(MARKS)]} "
             f"pointsize 1.3 linewidth 1.5 linecolor rgb '{colour(place)}'", FAMILIES[family])
    best = [each for each in points if each["recommended"]]
    if best:
        draw("best", best, "points pointtype 6 pointsize 3 linewidth 2 linecolor rgb '#000000'", "recommended")
    return made.finished(640 + 20 * rows)


# ---- all devices

def fronts(memory):
    """(least error that is drawn, {device: its front}), of points so far from the truth that the reference can judge them."""
    limit = ENOUGH_NEARER * own_error(memory["truth"])
    points = [point for point in memory["points"] if point["rmse"] >= max(limit, LEAST)]
    labels = dict.fromkeys(point["device"] for point in points)
    return limit, {label: front.front([point for point in points if point["device"] == label]) for label in labels}


def fronts_caption(limit, drawn):
    told = [f"{label} comes to {number(these[-1]['rmse'], 3)} in {number(these[-1]['ms'], 3)} ms ({these[-1]['name']})"
            for label, these in drawn.items()]
    return (f"{'; '.join(told)}. The chart ends where the error is {ENOUGH_NEARER} times the reference's own, which is "
            f"{number(limit / ENOUGH_NEARER, 2)}.")


def fronts_chart(about, memory):
    """The front of each device of a machine, all of the same pictures; None: the reference can judge no point."""
    limit, drawn = fronts(memory)
    if not drawn:
        return None
    titles = {device["label"]: device_title(device) for device in about["devices"] if device["label"] in drawn}
    rows = (len(drawn) + 2) // 2
    made = Chart(about, "Error against time, the front of every device", fronts_caption(limit, drawn), rows)
    for name, key, words in (("x", "ms", "milliseconds for each frame"), ("y", "rmse", f"{ERRORS['rmse']}, steps of 255")):
        values = [point[key] for these in drawn.values() for point in these]
        made.axis(name, words, min(values), max(values), True, ticks(values))
    made.legend(rows)
    best = front.front([point for these in drawn.values() for point in these])
    made.data("best", ((each["ms"], each["rmse"]) for each in best))
    made.plot("$best using 1:2 with lines linewidth 7 linecolor rgb '#cccccc' title 'the best of all'")
    for place, (label, these) in enumerate(drawn.items()):
        made.data(f"d{place}", ((each["ms"], each["rmse"]) for each in these))
        made.plot(f"$d{place} using 1:2 with linespoints pointtype {MARKS[place % len(MARKS)]} pointsize 1.2 linewidth 1.5 "
                  f"linecolor rgb '{colour(place)}' title {quoted(titles[label])}")
    return made.finished(640 + 20 * rows)


def fronts_charts(result):
    """{name: chart}"""
    found = {}
    for scene, memory in (result["fronts"] or {}).items():
        width, height = memory["size"]
        chart_of_scene = fronts_chart({**result, "scene": {"name": f"{scene}, {width} x {height}"}}, memory)
        if chart_of_scene:
            found[f"accuracy_fronts_{scene}"] = chart_of_scene
    return found


def charts(result):
    """{name: chart}"""
    labels = dict.fromkeys(point["device"] for point in result["points"] or [])
    return {f"accuracy_{label.replace(':', '')}_{error}": chart(result, label, error) for label in labels
            for error in ERRORS} | fronts_charts(result)
