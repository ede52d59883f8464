# SPDX-License-Identifier: MIT
"""The sections of bench/study's page whose charts are lines: time against what is varied."""
from dataclasses import replace

from harness import study_state, triangle_models
from harness.study_charts import Axis, Line, lines, number
from harness.study_points import WHOLE_FRAME
from harness.study_section import best_words, few, growth, growth_words, ratio, speed_words, table_of, y_axis


def by_frame(entry):
    """[(frame, spread)]"""
    times = {}
    for run in study_state.chosen_runs(entry):
        for frame in study_state.counted(run):
            times.setdefault(frame["frame"], []).append(1e3 * entry["scale"] * frame["seconds"]["trace"])
    return [(frame, study_state.spread(values)) for frame, values in sorted(times.items())]


def animation(sources, section):
    drawn = [Line(device.name, by_frame(device.entries("animation")[0]), device.place, device.machine + 1, device.place,
                  device.short) for device in sources.with_part("animation")]
    times = [[spread["median"] for _, spread in line.points] for line in drawn]
    most = max(range(len(drawn)), key=lambda place: max(times[place]) / min(times[place]))
    slowest = max(drawn[most].points, key=lambda point: point[1]["median"])
    caption = (f"The slowest frame ({slowest[0]}) takes {ratio(max(times[most]) / min(times[most]))} as long as the "
               f"fastest on {drawn[most].short}, where that differs most.")
    section.draw("animation", lines, sources.about(WHOLE_FRAME), "Time of tracing along the animation", caption,
                 Axis("frame number"), y_axis(drawn), drawn)
    section.table = table_of(sources, "animation", lambda entry: f"frames {entry['frames']}", "what")


def blocks(sources, section):
    for series, what in (("block", "threads of a work group"), ("grid", "work groups of a launch, at most")):
        drawn = [device.line("blocks", series=series) for device in sources.with_part("blocks")
                 if device.entries("blocks", series=series)]
        if not drawn:
            continue
        section.draw(f"blocks_{series}", lines, sources.about(WHOLE_FRAME), f"Time against {what}",
                     f"The fastest: {best_words(drawn)}.",
                     Axis(what, True, {number(x): x for line in drawn for x, _ in line.points}), y_axis(drawn), drawn)
    section.table = table_of(sources, "blocks", lambda entry: f"--{entry['series']} {entry['x']:g}", "option")


def crossing_words(device):
    trees = {x: spread["median"] for x, spread in device.line("triangles", series="bvh").points}
    brute = device.line("triangles", series="brute").points
    slower = [x for x, spread in brute if x in trees and spread["median"] > trees[x]]
    where = f"from {triangle_models.words(int(min(slower)))} triangles on" if slower else "nowhere that was measured"
    return f"on {device.short} {where}"


def triangles(sources, section):
    drawn, trees = [], []
    for device in sources.with_part("triangles"):
        if not device.entries("triangles", series="bvh"):
            continue
        trees.append(device.line("triangles", f"{device.short}, hierarchy", series="bvh"))
        brute = device.line("triangles", f"{device.short}, each triangle tried", series="brute")
        drawn += [trees[-1], replace(brute, dash=4)]
    counts = {triangle_models.words(10 ** power): 10 ** power for power in range(1, 8)}
    caption = growth_words(trees, "triangles", lambda x: triangle_models.words(int(x)))
    caption += " The hierarchy is the faster one " + few(list(map(crossing_words, sources.with_part("triangles")))) + "."
    if not trees:
        return
    section.draw("triangles", lines, sources.about("mirrored, transparent sphere with bumps, 1280 x 960, 2 x 2 samples"),
                 "Time against the number of triangles", caption, Axis("triangles", True, counts),
                 Axis("milliseconds for each frame", True), drawn)
    section.table = table_of(sources, "triangles", lambda entry: f"{entry['x']:g}, {entry['series']}", "triangles")


def sweep(sources, section, part, title, x_axis, scene=WHOLE_FRAME, what=None, **named):
    """A line for each device."""
    drawn = [device.line(part) for device in sources.with_part(part)]
    logarithmic = Axis("milliseconds for each frame", x_axis.logarithmic) if x_axis.logarithmic else y_axis(drawn)
    section.draw(part, lines, sources.about(scene), title, growth_words(drawn, what or x_axis.words), x_axis,
                 logarithmic, drawn, **named)
    section.table = table_of(sources, part, lambda entry: f"{entry['x']:g}", x_axis.words)


def ticks_of(sources, part):
    return {number(x): x for x in sorted({entry["x"] for entry in sources.measured(part)})}


def lights(sources, section):
    sweep(sources, section, "lights", "Time against the number of lights",
          Axis("point lights", True, ticks_of(sources, "lights")),
          "default scene under point lights, 1280 x 720, 2 x 2 samples")


def samples(sources, section):
    def squared(line):
        return replace(line, points=[(x * x, spread) for x, spread in line.points])
    drawn = [squared(device.line("samples")) for device in sources.with_part("samples")]
    base = min(drawn, key=lambda line: line.points[0][1]["median"])
    x, first = base.points[0][0], base.points[0][1]["median"]
    last = max(x for line in drawn for x, _ in line.points)
    section.draw("samples", lines, sources.about("one frame of the built-in scene, 1280 x 720"),
                 "Time against samples per pixel", growth_words(drawn, "samples per pixel"),
                 Axis("samples per pixel", True, {number(x): x for line in drawn for x, _ in line.points}),
                 Axis("milliseconds for each frame", True), drawn,
                 bounds=[[(x, first), (last, first * last / x)]] if last > x else (),
                 bound_name="in proportion to the samples")
    section.table = table_of(sources, "samples", lambda entry: f"{entry['x'] ** 2:g}", "samples per pixel")


def depth(sources, section):
    sweep(sources, section, "depth", "Time against depth",
          Axis("mirrorings and passings of a ray, at most", False, ticks_of(sources, "depth")), what="in depth")


def ideal(drawn):
    """As if twice as many took half as long, from the first point of each line."""
    bounds = []
    for line in drawn:
        x, first = line.points[0][0], line.points[0][1]["median"]
        bounds.append([(each, first * x / each) for each, _ in line.points])
    return [bound for bound in bounds if len(bound) > 1]


def sets_words(sources):
    found = {}
    for entry in sources.measured("lanes"):
        for name in ("avx512", "avx2", "generic"):
            if entry["renderer"] and f" {name}" in entry["renderer"]:
                found.setdefault(name, set()).add(int(entry["x"]))
    told = [f"{', '.join(map(str, sorted(each)))} by {name}" for name, each in found.items()]
    words = ("Which instruction set runs is no choice of the user's: hedron takes the best build that the CPU has for so "
             "many lanes")
    return f"{words} (here {'; '.join(told)})." if told else f"{words}."


def lanes(sources, section):
    drawn = [device.line("lanes") for device in sources.with_part("lanes")]
    section.draw("lanes", lines, sources.about(WHOLE_FRAME), "Time against rays traced together",
                 f"The fastest: {best_words(drawn, lambda x: f'{x:g} lanes')}.",
                 Axis("lanes", True, ticks_of(sources, "lanes")), Axis("milliseconds for each frame", True), drawn,
                 bounds=ideal(drawn), bound_name="bound: in proportion to one")
    section.notes.append(sets_words(sources))
    section.table = table_of(sources, "lanes", lambda entry: f"{entry['x']:g}", "lanes")


def threads_words(line):
    x, first, last_x, last = growth(line)
    if last_x == x:
        return f"{line.short} has one core"
    return f"{last_x:g} threads are {speed_words(first / last, f'{x:g}')} on {line.short}"


def threads(sources, section):
    drawn = [device.line("threads") for device in sources.with_part("threads")]
    told = [threads_words(line) for line in drawn]
    section.draw("threads", lines, sources.about(WHOLE_FRAME), "Time against threads of the C backend",
                 few(told) + ".",
                 Axis("threads", True, ticks_of(sources, "threads")), Axis("milliseconds for each frame", True), drawn,
                 bounds=ideal(drawn), bound_name="bound: in proportion to one")
    section.table = table_of(sources, "threads", lambda entry: f"{entry['x']:g}", "threads")
