# SPDX-License-Identifier: MIT
"""The time of a frame against the number of triangles, by the hierarchy and by brute force: the comparison and the chart."""
import math

from harness.chart.axes import Axis
from harness.chart.lines import Line, lines
from harness.chart.sheet import device_title
from harness.measure.numbers import count_words, number
from harness.measure.rows import Target
from harness.measure.scenes import TRIANGLE_TICKS
from harness.page.section import MS

# The smallest are there for brute force, which is faster for a handful.
COUNTS = (12, 48, *(10 ** power for power in range(2, 8)))
BASE, MOST, TARGET = 1000, COUNTS[-1], Target(6, 3, False)
WAYS = {"bvh": "hierarchy", "brute": "brute force"}
# A GPU's frame of the CPUs' size is too short to be timed.
VIEWS = {True: ("320 x 240, 1 sample", ("--size", "320x240")),
         False: ("1280 x 960, 2 x 2 samples", ("--size", "1280x960", "--samples", "2"))}
ENOUGH_SECONDS = 2  # ten times as many triangles would take some ten times as long
SLOW_FROM = 10000  # with brute force once is enough


def scene_name(count):
    return f"sphere-{count}"


def spreads(points, label, way):
    """Returns [(triangles, spread of milliseconds)]."""
    return sorted((each["triangles"], each["trace_ms"]) for each in points if (each["device"], each["way"]) == (label, way))


def crossover(brute, tree):
    """Returns in words the number of triangles at which both take equal time, or beyond which, interpolated between logarithms
    of [(triangles, milliseconds)]; None if there is nothing to compare."""
    trees = dict(tree)
    # More than 0: brute force takes longer.
    gaps = [(math.log(count), math.log(ms / trees[count])) for count, ms in brute if count in trees]
    if not gaps:
        return None
    if gaps[0][1] >= 0:
        return f"below {math.exp(gaps[0][0]):,.0f}"
    for (x, gap), (next_x, next_gap) in zip(gaps, gaps[1:]):
        if next_gap >= 0:
            return f"at about {float(f'{math.exp(x - gap * (next_x - x) / (next_gap - gap)):.2g}'):,.0f}"
    return f"beyond {math.exp(gaps[-1][0]):,.0f}"


def caption(points, labels):
    sentences, crossed = [], []
    for label in labels:
        times = {each["asked"]: each["trace_ms"]["median"] for each in points if (each["device"], each["way"]) == (label, "bvh")}
        most = max(times, default=0)
        if BASE in times and most != BASE:
            sentences.append(f"On {label} a frame of {count_words(most)} triangles takes {number(times[most] / times[BASE], 3)} "
                             f"times as long as one of {count_words(BASE)} with the hierarchy.")
        both = [[(x, each["median"]) for x, each in spreads(points, label, way)] for way in ("brute", "bvh")]
        if crossover(*both):
            crossed.append(f"{crossover(*both)} triangles on {label}")
    if crossed:
        sentences.append(f"Brute force and the hierarchy take equal time {', '.join(crossed)}.")
    return " ".join([*sentences, "Points are medians; the first frame of each run does not count."])


def charts(result):
    """Returns {name: chart}."""
    measured = [each for each in result["sweep"] or [] if each["trace_ms"]]
    labels = list(dict.fromkeys(each["device"] for each in measured))
    known = {device["label"]: device for device in result["devices"]}
    drawn = [Line(f"{device_title(known[label])}, {WAYS[way]}, {VIEWS[known[label]['is_cpu']][0]}",
                  spreads(measured, label, way), place, dash, place) for place, label in enumerate(labels)
             for way, dash in (("bvh", 1), ("brute", 2))]
    return {"triangles": lines(result, "Time of a frame against the number of triangles", caption(measured, labels),
                               Axis("triangles", True, TRIANGLE_TICKS), Axis(MS, True), drawn)} if measured else {}
