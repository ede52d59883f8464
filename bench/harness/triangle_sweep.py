# SPDX-License-Identifier: MIT
"""The time of a frame against the number of triangles, by the hierarchy and by brute force."""
import math
from statistics import median

from harness import charts, report, summary, triangle_models
from harness.speed_plan import Missing, Target

# The smallest are there for brute force, which is the faster one for a handful.
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


class Sweep:
    """`triangles` has the true number of triangles for each count whose scene was made."""

    def __init__(self, plan, runnable, triangles, options):
        self.plan, self.runnable, self.triangles, self.options = plan, runnable, triangles, tuple(options)
        self.jobs = {}  # (device, way, count): job
        for label in runnable:
            for count in triangles:
                self.add_job(label, "bvh", count)

    def add_job(self, label, way, count):
        slow = way == "brute" and count >= SLOW_FROM
        view = VIEWS[self.runnable[label]["is_cpu"]][1]
        job = self.plan.job(label, scene_name(count), "0,1" if slow else "0-3",
                            (*view, "--accel", way, *self.options), slow=slow)
        self.jobs[label, way, count] = job
        return job

    def probe_brute(self, label, program, folder, most, news):
        """Adds what can be timed in reasonable time: each further count waits for the one before."""
        for count in self.triangles:
            if count > most:
                return
            job = self.add_job(label, "brute", count)
            news(f"{label}, brute force, {triangle_models.words(count)} triangles")
            self.plan.run_job(job, program, folder, None)
            if self.plan.reasons.get(job) or median(self.plan.medians(job)) > ENOUGH_SECONDS:
                return

    def points(self):
        """What was measured, as it is written."""
        found = []
        for (label, way, count), job in self.jobs.items():
            point = {"device": label, "way": way, "asked": count, "triangles": self.triangles[count],
                     "trace_ms": None, "reason": None}
            try:
                first, middle, third = summary.quartiles(self.plan.trace_ms(job))
                point["trace_ms"] = {"median": middle, "q1": first, "q3": third}
            except Missing as missing:
                point["reason"] = str(missing)
            found.append(point)
        return found

    def place(self, item):
        label, way, count = item[0]
        return list(self.runnable).index(label), list(WAYS).index(way), count

    def add_rows(self):
        for label in self.runnable:
            self.add_growth(label)
        for (label, way, count), job in sorted(self.jobs.items(), key=self.place):
            self.plan.row("sweep", f"  a frame by {WAYS[way]}, {triangle_models.words(count)} triangles", "ms",
                          lambda job=job: self.plan.trace_ms(job), device=label)

    def add_growth(self, label):
        most = max(self.triangles, default=MOST)
        many, few = self.jobs.get((label, "bvh", most)), self.jobs.get((label, "bvh", BASE))
        is_whole = most == MOST

        def figure():
            if many is None or few is None or most <= BASE:
                raise Missing(f"there are no scenes of {BASE} and more triangles")
            return self.plan.ratios(many, few)
        view = VIEWS[self.runnable[label]["is_cpu"]][0]
        self.plan.row("growth", f"time of a frame, {triangle_models.words(most)} triangles against "
                      f"{triangle_models.words(BASE)}", "times", figure, device=label,
                      target=TARGET if is_whole else None,
                      note=view + ("" if is_whole else f"; the target is for {triangle_models.words(MOST)}"))


# ---- the chart

def line(points, label, way):
    """[(triangles, milliseconds)]"""
    return sorted((each["triangles"], each["trace_ms"]["median"]) for each in points
                  if each["trace_ms"] and (each["device"], each["way"]) == (label, way))


def crossover(brute, tree):
    """The number of triangles where both take the same time, interpolated between neighbours of the
    logarithms; the words tell where that lies beyond what was measured. None: nothing to compare."""
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


def growth_words(points, label):
    times = {each["asked"]: each["trace_ms"]["median"] for each in points
             if (each["device"], each["way"]) == (label, "bvh")}
    most = max(times, default=0)
    if BASE not in times or most == BASE:
        return None
    return (f"On {label} a frame of {triangle_models.words(most)} triangles takes "
            f"{report.number(times[most] / times[BASE], 3)} times as long as one of {triangle_models.words(BASE)}")


def caption(points, labels):
    grown = [growth_words(points, label) for label in labels]
    crossed = {label: crossover(line(points, label, "brute"), line(points, label, "bvh")) for label in labels}
    sentences = [f"{words} with the hierarchy." for words in grown if words]
    if any(crossed.values()):
        sentences.append("Brute force and the hierarchy cross " + ", ".join(
            f"{words} triangles on {label}" for label, words in crossed.items() if words) + ".")
    return " ".join([*sentences, "Points are medians; the first frame of each run does not count."])


def plots(result, labels):
    """(commands with the data, parts of gnuplot's plot)"""
    data, parts = [], []
    for place, label in enumerate(labels):
        device = next(each for each in result["devices"] if each["label"] == label)
        for way, dashes, mark in (("bvh", 1, 7), ("brute", 2, 6)):
            found = line(result["sweep"], label, way)
            if not found:
                continue
            data += [f"${way}{place} << END", *(f"{count} {ms!r}" for count, ms in found), "END"]
            title = f"{charts.device_title(device)}, {WAYS[way]}, {VIEWS[device['is_cpu']][0]}"
            parts.append(f"${way}{place} using 1:2 with linespoints linewidth 2 dashtype {dashes} pointsize 1 "
                         f"pointtype {mark} linecolor rgb '{charts.colour(place)}' title {charts.quoted(title)}")
    return data, parts


def chart(result):
    """(height, commands)"""
    measured = [each for each in result["sweep"] if each["trace_ms"]]
    labels = list(dict.fromkeys(each["device"] for each in measured))
    data, parts = plots(result, labels)
    times = [each["trace_ms"]["median"] for each in measured]
    ticks = ", ".join(f"'{triangle_models.words(10 ** power)}' {10 ** power}" for power in range(1, 8))
    commands = charts.style(result, "Time of a frame against the number of triangles", caption(measured, labels),
                            len(parts))
    commands += [
        "set logscale xy",
        f"set xrange [{COUNTS[0] / 1.5!r}:{COUNTS[-1] * 1.5!r}]",
        f"set yrange [{min(times) / 1.5!r}:{max(times) * 1.5!r}]",
        "set xlabel 'triangles (logarithmic)'",
        "set ylabel 'milliseconds for each frame (logarithmic)'",
        f"set xtics ({ticks})",
        "set format y '%g'",
        f"set key at graph 0.5, graph 1.03 center bottom vertical maxrows {len(parts)} Left reverse noenhanced "
        "samplen 5",
        *data,
        "plot " + ", ".join(parts),
    ]
    return 560 + 20 * len(parts), commands


def drawable(result):
    return {"triangles": chart} if any(each["trace_ms"] for each in result["sweep"] or []) else {}
