# SPDX-License-Identifier: MIT
"""The time of a frame against the number of triangles."""
from dataclasses import replace

from harness.chart.lines import Axis, lines
from harness.measure.numbers import count_words
from harness.page.part import Part
from harness.page.section import few, growth_words, table_of, y_axis
from harness.run.program import Problem
from harness.triangles import models

TRIANGLES = {True: (12, 100, 1000, 10000, 100000), False: (12, 48, 100, 1000, 10000, 100000, 1000000)}
BRUTE_MOST = {True: {True: 100, False: 1000}, False: {True: 1000, False: 10000}}  # CPUs or not, quickly or not
VIEWS = {True: (("--size", "320x240"), 64), False: (("--size", "1280x960", "--samples", "2"), 1)}


def scenes(program, folder, quick, news):
    made = {}
    for count in TRIANGLES[quick]:
        news(f"making {count_words(count)} triangles")
        try:
            made[f"sphere-{count}"] = models.write_in("whole", models.make(program, folder, count)[0], folder, count)
        except Problem as problem:
            made[f"sphere-{count}"] = str(problem)
    return made


def add(points):
    for label, device, view, scale in points.each(VIEWS):
        for way in ("bvh", "brute"):
            for count in TRIANGLES[points.quick]:
                if way == "bvh" or count <= BRUTE_MOST[device["is_cpu"]][points.quick]:
                    points.add(way, count, label, f"sphere-{count}", (*view, "--accel", way), scale=scale)


def crossing_words(device):
    trees = {x: spread["median"] for x, spread in device.line("triangles", series="bvh").points}
    brute = device.line("triangles", series="brute").points
    slower = [x for x, spread in brute if x in trees and spread["median"] > trees[x]]
    where = f"from {count_words(int(min(slower)))} triangles on" if slower else "nowhere that was measured"
    return f"on {device.short} {where}"


def fill(sources, section):
    drawn, trees = [], []
    for device in sources.with_part("triangles"):
        if not device.entries("triangles", series="bvh"):
            continue
        trees.append(device.line("triangles", f"{device.short}, hierarchy", series="bvh"))
        brute = device.line("triangles", f"{device.short}, each triangle tried", series="brute")
        drawn += [trees[-1], replace(brute, dash=4)]
    if not trees:
        return
    caption = growth_words(trees, "triangles", lambda x: count_words(int(x)))
    caption += " The hierarchy is the faster one " + few(list(map(crossing_words, sources.with_part("triangles")))) + "."
    section.draw("triangles", lines, sources.about("mirrored, transparent sphere with bumps, 1280 x 960, 2 x 2 samples"),
                 "Time against the number of triangles", caption, Axis("triangles", True, models.TICKS), y_axis(), drawn)
    section.table = table_of(sources, "triangles", lambda entry: f"{entry['x']:g}, {entry['series']}", "triangles")


PART = Part(4, "Number of triangles", "A sphere of so many triangles, searched by a hierarchy (--accel bvh) and one by one "
            "(--accel brute).", add, scenes, fill=fill)
