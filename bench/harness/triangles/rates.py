# SPDX-License-Identifier: MIT
"""Rates of the kernels' searches of meshes beside those of Embree, and the time of building. `objects` has for each number of
triangles what `run` gave, or the reason why there is nothing."""
from statistics import median

from harness.measure.numbers import count_words
from harness.measure.rows import NONE, Target, known
from harness.run.program import run_tool

COUNTS = (1000, 80000, 1000000)
KINDS = ("primary", "mirrored", "diffuse", "shadow")
NO_RIVAL = "Embree is not installed (libembree-dev), so hedron stands alone"
BUNDLED = ("packets", "streams")
ANY = ("single", *BUNDLED)
# What is compared: rays, triangles, with which of Embree's ways, target.
RATES = [
    *((kind, count, BUNDLED, Target(0.8, 1.3)) for kind in ("primary", "mirrored") for count in COUNTS),
    *(("diffuse", count, ANY, Target(0.5, 1.0)) for count in COUNTS[1:]),
    ("shadow", COUNTS[0], ANY, Target(1.0, 1.5)),
]
BUILD_COUNT, BUILD_TARGET = COUNTS[-1], Target(2, 1, False)
SAME_FROM = 0.99  # a fast wrong search is no result


def parse(text):
    """{"instruction_set", "lanes", "triangles", "rates": {kind: {who: [...]}}, "same": {kind: {way: share}},
    "aimed": {who: [rays, leaks, odd crossings]}, "built": {who: [...]}} of one object; rates a CPU-second, one for each
    round."""
    found = {"instruction_set": None, "lanes": None, "triangles": None, "rates": {}, "same": {}, "aimed": {}, "built": {}}
    for what, first, *rest in map(str.split, text.splitlines()):
        if what == "build":
            found["instruction_set"], found["lanes"] = first, int(rest[0])
        elif what == "object":
            found["triangles"] = int(first)
        elif what == "rate":
            found["rates"].setdefault(first, {}).setdefault(rest[1], []).append(float(rest[2]))
        elif what == "same":
            found["same"].setdefault(first, {})[rest[1]] = float(rest[2])
        elif what == "aimed":
            found["aimed"][rest[0]] = list(map(int, rest[1:]))
        elif what == "built":
            found["built"].setdefault(rest[0], []).append(float(rest[1]))
    return found


def run(program, count, seconds, rounds, threads):
    """Raises Problem with the reason where it cannot be."""
    return parse(run_tool(program.beside("bench/hedron_mesh_rates"), "--seconds", seconds, "--rounds", rounds, "--threads",
                          threads, count).stdout)


def best_way(rates, allowed):
    """The fastest of those of Embree's ways by its median; None where there is no Embree."""
    ways = [who for who in rates if who.startswith(allowed)]
    return max(ways, key=lambda way: median(rates[way]), default=None)


def against(ours, theirs):
    """Ours, each by the median of theirs: the median of these is the ratio of the medians."""
    return [each / median(theirs) for each in ours]


def least_same(measured):
    """(share, kind, way) of the rays that met the same, where that is least; None without Embree."""
    return min(((share, kind, way) for kind, ways in measured["same"].items() for way, share in ways.items()),
               default=None)


def failures(objects):
    """What makes the rates no result."""
    found = []
    for count, measured in objects.items():
        share, kind, way = (None if isinstance(measured, str) else least_same(measured)) or (1, "", "")
        if share <= SAME_FROM:
            found.append(f"THE SEARCHES DIFFER, so their rates are no result: only {100 * share:.2f} % of the "
                         f"{kind} rays meet the same at {count_words(count)} as Embree's {way}")
        rays, leaks, odd = (0, 0, 0) if isinstance(measured, str) else measured["aimed"]["hedron"]
        if leaks or odd:
            found.append(f"of {rays} rays aimed at edges and corners of {count_words(count)} triangles {leaks} leak and {odd} cross "
                         "the closed surface an odd number of times")
    return found


def add_comparison(plan, objects, kind, count, allowed, target):
    measured = objects.get(count)
    way = best_way(measured["rates"][kind], allowed) if isinstance(measured, dict) else None
    named = f"Embree's {way.replace('_', ' ')}" if way else "Embree"

    def figure():
        rates = known(measured)["rates"][kind]
        return against(rates["hedron"], known(way and rates[way], NO_RIVAL))
    plan.row("rates", f"{kind} rays, {count_words(count)} triangles, against {named}", "times", figure, target=target)


def add_rows(plan, objects):
    for comparison in RATES:
        add_comparison(plan, objects, *comparison)
    what = f"building, {count_words(BUILD_COUNT)} triangles"

    def built():
        return known(objects.get(BUILD_COUNT))["built"]
    plan.row("rates", f"time of {what}, against Embree's medium build", "times",
             lambda: against(built()["hedron"], known(built().get("embree"), NO_RIVAL)), target=BUILD_TARGET,
             note="rates on one thread and the build on all, by the processor's time; quartiles of ratios are of hedron's rounds")
    plan.row("rates", f"  {what}", "CPU s", lambda: built()["hedron"])
    for kind in KINDS:
        for count in COUNTS:
            plan.row("rates", f"  {kind} rays a CPU-second, {count_words(count)} triangles", "M/s",
                     lambda kind=kind, count=count: [
                         1e-6 * value for value in known(objects.get(count))["rates"][kind]["hedron"]])
    for count in COUNTS:
        plan.row("rates", f"  rays that meet the same as Embree's, least, {count_words(count)} triangles", "%",
                 lambda count=count: [100 * known(least_same(known(objects.get(count))), NO_RIVAL)[0]])
    for count in COUNTS:
        plan.row("rates", f"rays aimed at edges and corners that leak, or cross the closed surface an odd number of times, {count_words(count)} "
                 "triangles", "rays", lambda count=count: [sum(known(objects.get(count))["aimed"]["hedron"][1:])], target=NONE)
