# SPDX-License-Identifier: MIT
"""Measures every target of triangles, and charts time against their number."""
from harness.command.bench import Bench
from harness.command.options import whole_number
from harness.measure.numbers import count_words
from harness.run import machine
from harness.triangles import leaks, models, primary, rates, sweep

MOST, BRUTE_MOST_QUICKLY = {True: 1000000, False: sweep.MOST}, 10000
LEAK_RAYS = {True: 10 ** 5, False: 10 ** 8}
MOST_THREADS = 64  # that hedron_mesh_rates takes


def entries(key, found):
    """As they are written: what was measured, or the reason why it was not."""
    return [{key: each, **({"reason": measured} if isinstance(measured, str) else measured)}
            for each, measured in found.items()] or None


class Triangles(Bench):
    name = "triangles"
    about = "Measure every target of triangles, and draw time against their number."
    codes = """exit codes: 0 done, 1 pictures or searches differ, rays leak, or a run failed,
2 wrong usage or input, 3 no device can be timed, 130 interrupted (what was measured is kept)"""
    quick = "few rounds and rays, and no more than 1 M triangles; rough"
    own_options = (*Bench.own_options, "--accel")
    parts = ("rates", "sweep", "primary", "leaks")
    scene = "a mirrored, transparent sphere with bumps over a floor, two lights, depth 4"
    chart_files = ("triangles",)
    keys = ("mesh_rates", "sweep", "leaks")

    @classmethod
    def add_options(cls, parser):
        super().add_options(parser)
        parser.add_argument("--most", type=whole_number, metavar="N",
                            help="no object of more triangles (default: 10 M, with --quick 1 M)")
        parser.add_argument("--leak-rays", type=whole_number, metavar="N",
                            help="rays of the leak hunt for each backend and precision (default: 1e8, with --quick 1e5)")

    @classmethod
    def complete(cls, arguments):
        super().complete(arguments)
        arguments.most = arguments.most or MOST[arguments.quick]
        arguments.leak_rays = arguments.leak_rays or LEAK_RAYS[arguments.quick]

    def __init__(self, arguments, program, folder):
        super().__init__(arguments, program, folder)
        self.result["most"] = arguments.most
        self.objects, self.hunts, self.unmade, self.sweep = {}, {}, {}, None

    def measure_rates(self):
        seconds, threads = 0.05 if self.arguments.quick else 0.3, min(machine.cores(), MOST_THREADS)
        for count in rates.COUNTS:
            if count > self.arguments.most:
                self.objects[count] = f"it has more than {count_words(self.arguments.most)} triangles (--most)"
                continue
            self.objects[count] = self.tried(f"rates of searches, {count_words(count)} triangles", rates.run, self.program,
                                             count, seconds, self.arguments.repeats, threads)

    def hunt(self):
        for backend in dict.fromkeys(device["backend"] for device in self.runnable.values()):
            self.hunts[backend] = self.tried(f"leak hunt on {backend}", leaks.run, self.program, backend,
                                             self.arguments.leak_rays)

    def make_scenes(self):
        """{count: triangles} of the objects there are now."""
        made = {}
        wanted = {*(sweep.COUNTS if self.wants("sweep") else ()), *(primary.TARGETS if self.wants("primary") else ())}
        for count in sorted(number for number in wanted if number <= self.arguments.most):
            found = self.tried(f"making {count_words(count)} triangles", models.make, self.program, self.folder, count)
            if isinstance(found, str):
                self.unmade[count] = found
                continue
            file, made[count] = found
            for name, kind in ((sweep.scene_name(count), "whole"), (primary.scene_name(count), "near")):
                self.plan.scenes[name] = models.write_in(kind, file, self.folder, count)
        return made

    def measure_frames(self):
        made = self.make_scenes()
        if self.wants("sweep"):
            self.sweep = sweep.Sweep(self.plan, self.runnable, made, self.arguments.options)
            for label in self.runnable:
                self.sweep.probe_brute(label, BRUTE_MOST_QUICKLY if self.arguments.quick else sweep.MOST)
        if self.wants("primary"):
            primary.add(self.plan, self.runnable, self.arguments.options)
        self.plan.run_all(self.arguments.repeats)

    def measure(self):
        if self.wants("rates"):
            self.measure_rates()
        if self.wants("leaks"):
            self.hunt()
        if self.wants("sweep", "primary"):
            self.measure_frames()

    def fill(self):
        primary_rows, self.plan.rows = self.plan.rows, []
        if self.wants("rates"):
            rates.Rows(self.plan, self.objects).add()
        if self.sweep:
            self.sweep.add_rows()
        self.plan.rows += primary_rows
        for reason in dict.fromkeys(self.unmade.values()):
            self.plan.absent("scenes", "scenes of the sweep and of primary rays", "", None, reason)
        leaks.add_rows(self.plan, self.hunts)
        self.plan.failures |= {*rates.failures(self.objects), *leaks.failures(self.hunts)}
        self.result.update(mesh_rates=entries("asked", self.objects), leaks=entries("backend", self.hunts),
                           sweep=self.sweep and self.sweep.points())

    def charts(self):
        return sweep.charts(self.result)


BENCH = Triangles
