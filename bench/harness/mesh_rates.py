# SPDX-License-Identifier: MIT
"""Rates of the kernels' searches of meshes beside those of Embree, and the time of building."""
import subprocess
from statistics import median

from harness import triangle_models
from harness.program import Problem
from harness.speed_plan import Missing, Target

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
    "built": {who: [...]}} of one object; rates a CPU-second, one for each round."""
    found = {"instruction_set": None, "lanes": None, "triangles": None, "rates": {}, "same": {}, "built": {}}
    for line in text.splitlines():
        what, *rest = line.split()
        if what == "build":
            found["instruction_set"], found["lanes"] = rest[0], int(rest[1])
        elif what == "object":
            found["triangles"] = int(rest[0])
        elif what == "rate":
            kind, _, who, value = rest
            found["rates"].setdefault(kind, {}).setdefault(who, []).append(float(value))
        elif what == "same":
            kind, _, way, share = rest
            found["same"].setdefault(kind, {})[way] = float(share)
        elif what == "built":
            found["built"].setdefault(rest[1], []).append(float(rest[2]))
    return found


def run(program, count, seconds, rounds, threads):
    """Raises Problem with the reason where it cannot be."""
    if not program.is_file():
        raise Problem(3, f"there is no {program}: ./dev build builds it")
    done = subprocess.run([program, "--seconds", str(seconds), "--rounds", str(rounds), "--threads", str(threads),
                           str(count)], capture_output=True, text=True)
    if done.returncode != 0:
        raise Problem(1, f"{program.name}: {done.stderr.strip() or 'it says nothing'}")
    return parse(done.stdout)


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
        least = None if isinstance(measured, str) else least_same(measured)
        if least and least[0] <= SAME_FROM:
            found.append(f"THE SEARCHES DIFFER, so their rates are no result: only {100 * least[0]:.2f} % of the "
                         f"{least[1]} rays meet the same at {triangle_models.words(count)} as Embree's {least[2]}")
    return found


class Rows:
    """`objects` has for each count what `run` gave, or the reason why there is nothing."""

    def __init__(self, plan, objects):
        self.plan, self.objects = plan, objects

    def demand(self, count):
        measured = self.objects.get(count, "it was not measured")
        if isinstance(measured, str):
            raise Missing(measured)
        return measured

    def way(self, kind, count, allowed):
        measured = self.objects.get(count)
        return best_way(measured["rates"][kind], allowed) if isinstance(measured, dict) else None

    def compare(self, kind, count, allowed, target):
        way = self.way(kind, count, allowed)
        named = f"Embree's {way.replace('_', ' ')}" if way else "Embree"

        def figure():
            rates = self.demand(count)["rates"][kind]
            if way is None:
                raise Missing(NO_RIVAL)
            return against(rates["hedron"], rates[way])
        self.plan.row("rates", f"{kind} rays, {triangle_models.words(count)} triangles, against {named}", "times",
                      figure, target=target)

    def alone(self, kind, count):
        def figure():
            return [1e-6 * value for value in self.demand(count)["rates"][kind]["hedron"]]
        self.plan.row("rates", f"  {kind} rays a CPU-second, {triangle_models.words(count)} triangles", "M/s", figure)

    def same(self, count):
        def figure():
            least = least_same(self.demand(count))
            if least is None:
                raise Missing(NO_RIVAL)
            return [100 * least[0]]
        self.plan.row("rates", f"  rays that meet the same as Embree's, least, {triangle_models.words(count)} "
                      "triangles", "%", figure)

    def build(self):
        what = f"building, {triangle_models.words(BUILD_COUNT)} triangles"

        def ratio():
            built = self.demand(BUILD_COUNT)["built"]
            if "embree" not in built:
                raise Missing(NO_RIVAL)
            return against(built["hedron"], built["embree"])
        self.plan.row("rates", f"time of {what}, against Embree's medium build", "times", ratio, target=BUILD_TARGET,
                      note="rates on one thread and the build on all, by the processor's time; quartiles of ratios are "
                           "of hedron's rounds")
        self.plan.row("rates", f"  {what}", "CPU s", lambda: self.demand(BUILD_COUNT)["built"]["hedron"])

    def add(self):
        for comparison in RATES:
            self.compare(*comparison)
        self.build()
        for kind in KINDS:
            for count in COUNTS:
                self.alone(kind, count)
        for count in COUNTS:
            self.same(count)
