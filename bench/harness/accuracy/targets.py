# SPDX-License-Identifier: MIT
"""Targets that are held on every scene that ships, and on the built-in scene at its own size."""
from harness.accuracy.truth import run
from harness.measure.rows import Missing, Target, known
from harness.run import pfm
from harness.run.program import Problem

ARITHMETIC = Target(99.9, 99.99)
TRUNCATION = Target(1, 1, False)
BOUND = Target(4, 4, False)
SAMPLES = RAYS = Target(1 / 2, 1 / 4, False)
WITHIN = Target(99.9, 99.99)
LIMIT, NEARER = "1", "0.03"
# Each of its rays goes on twice at every hit, so that a nearer bound takes hours. A small cut-off promises nothing, but
# a tenth of it changes this picture by a tenth as much.
BRANCHING, FEW_PIXELS, LESS_NEAR = "knot", ("--size", "8x6", "--samples", "1"), ("--depth", "400", "--cutoff", "1e-8")
VIEWS = {True: (("--size", "64x48", "--samples", "1"), ("--size", "32x24", "--samples", "1")),
         False: (("--size", "160x90", "--samples", "2"), ("--size", "64x48", "--samples", "1"))}


class SceneTargets:
    """`scenes` are the files; all is done on one device, for the bytes are the same everywhere."""

    def __init__(self, plan, device, scenes, options, quick):
        self.plan, self.device, self.scenes, self.options = plan, device, scenes, tuple(options)
        self.arithmetic_view, self.truncation_view = VIEWS[quick]
        self.arithmetic, self.truncation, self.adaptive = {}, {}, {}
        self.not_finite = self.frames = 0

    def render(self, scene, name, *options):
        """(statistics, file)"""
        file = self.plan.folder / f"{name}.pfm"
        frame = run(self.plan.program, self.device, scene, (*options, *self.options), file)
        self.not_finite += pfm.not_finite(file)
        self.frames += 1
        return frame, file

    def tried(self, measure):
        try:
            return measure()
        except Problem as problem:
            if problem.code != 3:
                self.plan.failures.add(str(problem))
            return str(problem)

    # ---- float and double

    def both_precisions(self, scene):
        _, single = self.render(scene, "float", *self.arithmetic_view, "--precision", "float")
        _, double = self.render(scene, "double", *self.arithmetic_view, "--precision", "double")
        return pfm.errors(self.plan.program, single, double)

    def measure_arithmetic(self):
        for scene in self.scenes:
            self.plan.news(f"float against double: {scene.stem}")
            self.arithmetic[scene.stem] = self.tried(lambda scene=scene: self.both_precisions(scene))

    def add_arithmetic(self):
        view = " ".join(self.arithmetic_view)
        shares = {name: found if isinstance(found, str) else 100 * (1 - found["above_1"])
                  for name, found in self.arithmetic.items()}
        self.worst("arithmetic", "float against double, pixels within 1 of 255, worst scene", "%", shares, ARITHMETIC,
                   min, f"same samples, {view}")
        self.each("arithmetic", "%", shares)

    # ---- what is left out

    def truncated(self, scene):
        view, nearer = self.truncation_view, ("--max-error", NEARER)
        if scene.stem == BRANCHING:
            view, nearer = FEW_PIXELS, LESS_NEAR
        view = (*view, "--precision", "double")
        frame, cut = self.render(scene, "cut", *view, "--max-error", LIMIT)
        nearly, truth = self.render(scene, "whole", *view, *nearer)
        found = pfm.errors(self.plan.program, cut, truth)
        return {"size": view[1], "measured": found["largest"], "bound": frame["missing"]["largest"],
                "mean_bound": frame["missing"]["mean"],
                "truth_bound": nearly["missing"]["largest"] if "missing" in nearly else None}

    def measure_truncation(self):
        for scene in self.scenes:
            self.plan.news(f"--max-error {LIMIT}: {scene.stem}")
            self.truncation[scene.stem] = self.tried(lambda scene=scene: self.truncated(scene))

    def add_truncation(self):
        whole = {name: found for name, found in self.truncation.items() if not isinstance(found, str)}
        told = {name: found for name, found in self.truncation.items() if isinstance(found, str)}
        measured = {**{name: found["measured"] for name, found in whole.items()}, **told}
        bounds = {name: found["bound"] / found["measured"] for name, found in whole.items()
                  if found["bound"] > 0 and found["measured"] > 0}
        self.worst("truncation", f"--max-error {LIMIT}: largest error by what is left out, worst scene", "of 255",
                   measured, TRUNCATION, max,
                   f"against --max-error {NEARER}, both double, same samples; {BRANCHING}, {FEW_PIXELS[1]}, against "
                   f"{' '.join(LESS_NEAR)}")
        self.each("truncation", "of 255", measured)
        self.worst("bound", "the bound by the measured error, worst scene", "times", {**bounds, **told}, BOUND, max,
                   "of the largest of each frame; asked for by the aim only; scenes from which nothing was left out "
                   "have none")
        self.each("bound", "times", bounds)

    # ---- adaptive sampling

    def both_samplings(self):
        options = ("--samples", "4", "--aa")
        grid, plain = self.render(None, "grid", *options, "grid")
        frame, adaptive = self.render(None, "adaptive", *options, "adaptive")
        return {"width": frame["width"], "height": frame["height"],
                "samples": frame["rays"]["primary"] / grid["rays"]["primary"],
                "rays": sum(frame["rays"].values()) / sum(grid["rays"].values()),
                "time": frame["seconds"]["trace"] / grid["seconds"]["trace"],
                "within_2": 100 * pfm.share_within(adaptive, plain, 2),
                **pfm.errors(self.plan.program, adaptive, plain)}

    def measure_adaptive(self):
        self.plan.news("adaptive against grid 4 x 4, the scene's own size")
        self.adaptive = self.tried(self.both_samplings)

    def add_adaptive(self):
        def figure(key):
            return [known(self.adaptive or None)[key]]
        measured = self.adaptive and not isinstance(self.adaptive, str)
        size = f"{self.adaptive['width']} x {self.adaptive['height']}" if measured else None
        for key, what, unit, target in (("samples", "samples", "times", SAMPLES), ("rays", "rays", "times", RAYS),
                                        ("time", "time, one frame", "times", None),
                                        ("within_2", "pixels within 2 of 255", "%", WITHIN)):
            self.plan.row("adaptive", f"adaptive against grid 4 x 4, built-in scene: {what}", unit,
                          lambda key=key: figure(key), device=self.device["label"], target=target, note=size)

    # ---- rows

    def worst(self, key, what, unit, values, target, choose, note):
        def figure():
            known = [value for value in values.values() if not isinstance(value, str)]
            if len(known) < len(values):
                raise Missing(next(value for value in values.values() if isinstance(value, str)))
            return [choose(known)] if known else []
        self.plan.row(key, what, unit, figure, device=self.device["label"], target=target, note=note)

    def each(self, key, unit, values):
        for name, value in values.items():
            if not isinstance(value, str):
                self.plan.row(key, f"  {name}", unit, lambda value=value: [value], device=self.device["label"])
