# SPDX-License-Identifier: MIT
"""Every target of triangles, and time against their number; the study has a chart of all machines."""
from dataclasses import replace
from statistics import median

from harness.chart.axes import Axis
from harness.chart.lines import lines
from harness.command.bench import Bench
from harness.command.options import whole_number
from harness.measure.numbers import count_words, spread
from harness.measure.rows import Missing
from harness.measure.scenes import TRIANGLE_TICKS, make_object, write_object_scene
from harness.page.section import TIME_AXIS, Part, few, growth_words
from harness.triangles import leaks, primary, sweep
from harness.triangles.sweep import scene_name

MOST, BRUTE_MOST_QUICKLY = {True: 1000000, False: sweep.MOST}, 10000
LEAK_RAYS = {True: 10 ** 5, False: 10 ** 8}


class Triangles(Bench):
    name = "triangles"
    about = "Measure every target of triangles, and chart time against their number."
    codes = """exit codes: 0 done, 1 pictures differ, rays leak, or a run failed,
2 wrong usage or input, 3 no device can be timed, 130 interrupted (what was measured is kept)"""
    quick = "measure few rounds and rays and at most 1 M triangles; figures are rough"
    own_options = (*Bench.own_options, "--accel")
    parts = ("sweep", "primary", "leaks")
    scene = "a mirrored, transparent sphere with bumps over a floor, two lights, depth 4"
    chart_files = ("triangles",)
    keys = ("sweep", "leaks", "most")

    def add_options(self, parser):
        super().add_options(parser)
        parser.add_argument("--most", type=whole_number, metavar="N",
                            help="triangles of the largest object (default: 10 M, with --quick 1 M)")
        parser.add_argument("--leak-rays", type=whole_number, metavar="N",
                            help="rays of the leak hunt for each backend and precision (default: 1e8, with --quick 1e5)")

    def complete(self, arguments):
        super().complete(arguments)
        arguments.most = arguments.most or MOST[arguments.quick]
        arguments.leak_rays = arguments.leak_rays or LEAK_RAYS[arguments.quick]

    def prepare(self):
        self.result["most"] = self.arguments.most
        self.hunts, self.unmade = {}, {}
        self.jobs, self.triangles = {}, None  # (device, method, requested): job of the sweep; requested: true number

    def hunt(self):
        for backend in dict.fromkeys(device["backend"] for device in self.runnable.values()):
            self.hunts[backend] = self.tried(f"leak hunt on {backend}", leaks.run, self.program, backend,
                                             self.arguments.leak_rays)

    def make_scenes(self):
        """Returns {count: triangles} of the objects."""
        made = {}
        wanted = {*(sweep.COUNTS if self.wants("sweep") else ()), *(primary.TARGETS if self.wants("primary") else ())}
        for count in sorted(number for number in wanted if number <= self.arguments.most):
            found = self.tried(f"making {count_words(count)} triangles", make_object, self.program, self.folder, count)
            if isinstance(found, str):
                self.unmade[count] = found
                continue
            file, made[count] = found
            for name, kind in ((scene_name(count), "whole"), (primary.scene_name(count), "near")):
                self.plan.scenes[name] = write_object_scene(kind, file, self.folder, count)
        return made

    def measure(self):
        if self.wants("leaks"):
            self.hunt()
        if self.wants("sweep", "primary"):
            made = self.make_scenes()
            if self.wants("sweep"):
                self.begin_sweep(made, BRUTE_MOST_QUICKLY if self.arguments.quick else sweep.MOST)
            if self.wants("primary"):
                primary.add(self.plan)
            self.plan.run_all(self.arguments.repeats)

    # ---- the sweep

    def begin_sweep(self, made, brute_most):
        """Adds brute force as far as its time allows: each further count waits for the one before."""
        self.triangles = made
        for label in self.runnable:
            for count in made:
                self.add_job(label, "bvh", count)
        for label in self.runnable:
            for count in filter(lambda count: count <= brute_most, made):
                job = self.add_job(label, "brute", count)
                self.news(f"{label}, brute force, {count_words(count)} triangles")
                self.plan.measure(job, 0)
                if job["reason"] or median(self.plan.medians(job)) > sweep.ENOUGH_SECONDS:
                    break

    def add_job(self, label, way, count):
        once = {"slow": True} if way == "brute" and count >= sweep.SLOW_FROM else {}
        view = sweep.VIEWS[self.runnable[label]["is_cpu"]][1]
        job = self.plan.job(label, scene_name(count), "0,1" if once else "0-3", (*view, "--accel", way), **once)
        self.jobs[label, way, count] = job
        return job

    def add_growth(self, label):
        most = max(self.triangles, default=sweep.MOST)
        many, few = self.jobs.get((label, "bvh", most)), self.jobs.get((label, "bvh", sweep.BASE))
        is_whole = most == sweep.MOST

        def figure():
            if many is None or few is None or most <= sweep.BASE:
                raise Missing(f"there are no scenes of {sweep.BASE} and more triangles")
            return self.plan.ratios(many, few)
        self.plan.row("growth", f"time of a frame, {count_words(most)} triangles against {count_words(sweep.BASE)}", "times",
                      figure, device=label, target=sweep.TARGET if is_whole else None,
                      note=sweep.VIEWS[self.runnable[label]["is_cpu"]][0]
                      + ("" if is_whole else f"; the target is for {count_words(sweep.MOST)}"))

    def add_sweep(self):
        """Adds the sweep's rows, and its measurements as stored."""
        for label in self.runnable:
            self.add_growth(label)
        places = [list(self.runnable), list(sweep.WAYS)]
        for key in sorted(self.jobs, key=lambda key: (*map(list.index, places, key), key[2])):
            self.plan.row("sweep", f"  a frame by {sweep.WAYS[key[1]]}, {count_words(key[2])} triangles", "ms",
                          lambda job=self.jobs[key]: self.plan.trace_ms(job), device=key[0])
        self.result["sweep"] = [{"device": label, "way": way, "asked": count, "triangles": self.triangles[count],
                                 "trace_ms": spread(self.plan.trace_ms(job)) if job["runs"] else None,
                                 "reason": job["reason"] or (None if job["runs"] else "it was not run")}
                                for (label, way, count), job in self.jobs.items()]

    # ---- results

    def fill(self):
        primary_rows, self.plan.rows = self.plan.rows, []
        if self.triangles is not None:
            self.add_sweep()
        self.plan.rows += primary_rows
        for reason in dict.fromkeys(self.unmade.values()):
            self.plan.absent("scenes", "scenes of the sweep and of primary rays", "", None, reason)
        leaks.add_rows(self.plan, self.hunts)
        # Measurements as stored, or the reason why there are none.
        self.result["leaks"] = [{"backend": backend, **({"reason": total} if isinstance(total, str) else total)}
                                for backend, total in self.hunts.items()] or None

    def charts(self):
        return sweep.charts(self.result)


BENCH = Triangles


# ---- the study's part

TRIANGLES = {True: (12, 100, 1000, 10000, 100000), False: (12, 48, 100, 1000, 10000, 100000, 1000000)}
BRUTE_MOST = {True: {True: 100, False: 1000}, False: {True: 1000, False: 10000}}  # CPUs or not, quickly or not
VIEWS = {is_cpu: (view, 64 if is_cpu else 1) for is_cpu, (_, view) in sweep.VIEWS.items()}


def scenes(plan):
    made = {}
    for count in TRIANGLES[plan.quick]:
        plan.news(f"making {count_words(count)} triangles")
        made[scene_name(count)] = found = plan.tried(make_object, plan.program, plan.folder, count)
        if not isinstance(found, str):
            made[scene_name(count)] = write_object_scene("whole", found[0], plan.folder, count)
    return made


def add(plan):
    for label, device, view, scale in plan.each(VIEWS):
        for way in sweep.WAYS:
            for count in TRIANGLES[plan.quick]:
                if way == "bvh" or count <= BRUTE_MOST[device["is_cpu"]][plan.quick]:
                    plan.point(way, count, label, scene_name(count), (*view, "--accel", way), scale=scale)


def crossing_words(device):
    trees = {x: spread["median"] for x, spread in device.line(series="bvh").points}
    slower = [x for x, spread in device.line(series="brute").points if x in trees and spread["median"] > trees[x]]
    where = f"from {count_words(int(min(slower)))} triangles on" if slower else "at no number measured"
    return f"the hierarchy is faster {where}"


def fill(section):
    drawn, trees = [], []
    for device in section.devices:
        if device.entries(series="bvh"):
            trees.append(device.line(f"{device.name}, hierarchy", series="bvh"))
            drawn += [trees[-1], replace(device.line(f"{device.name}, brute force", series="brute"), dash=4)]
    if not trees:
        return
    caption = growth_words(trees, "triangles", lambda x: count_words(int(x)))
    crossings = {device.name: crossing_words(device) for device in section.devices}
    if len(set(crossings.values())) == 1:
        crossings = {"every device": crossings.popitem()[1]}
    caption += " " + few([f"on {name} {each}" for name, each in crossings.items()])
    section.draw(lines, "mirrored, transparent sphere with bumps, 1280 x 960, 2 x 2 samples",
                 "Time against the number of triangles", caption, Axis("triangles", True, TRIANGLE_TICKS), TIME_AXIS, drawn)
    section.tabulate(lambda entry: f"{entry['x']:g}, {entry['series']}", "triangles")


PART = Part(4, "Number of triangles", "A sphere of 12 to 1 M triangles, searched by a bounding volume hierarchy (--accel bvh) "
            "and one by one (--accel brute).", add, scenes, fill=fill)
