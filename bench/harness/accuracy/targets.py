# SPDX-License-Identifier: MIT
"""Targets that hold on every scene that ships."""
from harness.accuracy.truth import render
from harness.measure.rows import Missing, Target
from harness.run import pfm

ARITHMETIC = Target(99.9, 99.99)
TRUNCATION = Target(1, 1, False)
BOUND = Target(4, 4, False)
LIMIT, NEARER = "1", "0.03"
# Each of its rays continues twice at every hit, so that a tighter bound takes hours. A small cut-off promises nothing,
# but a tenth of it changes this picture by a tenth as much.
BRANCHING, FEW_PIXELS, LESS_NEAR = "knot", ("--size", "8x6", "--samples", "1"), ("--depth", "400", "--cutoff", "1e-8")
VIEWS = {True: (("--size", "64x48", "--samples", "1"), ("--size", "32x24", "--samples", "1")),
         False: (("--size", "160x90", "--samples", "2"), ("--size", "64x48", "--samples", "1"))}


def there(found):
    """Returns the values without those that could not be measured."""
    return {name: each for name, each in found.items() if not isinstance(each, str)}


class SceneTargets:
    """Measures the targets of accuracy on `scenes`, which are files. All runs use one device, because the bytes are
    the same on all."""

    def __init__(self, plan, device, scenes):
        self.plan, self.device, self.scenes = plan, device, scenes
        self.arithmetic_view, self.truncation_view = VIEWS[plan.quick]
        self.arithmetic, self.truncation = {}, {}
        self.not_finite = self.frames = 0

    def render(self, scene, name, *options):
        """Returns (statistics, file)."""
        file = self.plan.folder / f"{name}.pfm"
        frame = render(self.plan, self.device, scene, options, file)
        self.not_finite += pfm.not_finite(file)
        self.frames += 1
        return frame, file

    def measure_scenes(self, what, found, measure):
        for scene in self.scenes:
            self.plan.news(f"{what}: {scene.stem}")
            found[scene.stem] = self.plan.tried(measure, scene)

    # ---- float and double

    def measure_arithmetic(self):
        def both(scene):
            single, double = [self.render(scene, precision, *self.arithmetic_view, "--precision", precision)[1]
                              for precision in ("float", "double")]
            return pfm.errors(self.plan.program, single, double)
        self.measure_scenes("float against double", self.arithmetic, both)

    def add_arithmetic(self):
        shares = {name: found if isinstance(found, str) else 100 * (1 - found["above_1"])
                  for name, found in self.arithmetic.items()}
        self.worst("arithmetic", "float against double, pixels within 1 of 255, worst scene", "%", shares, ARITHMETIC,
                   min, f"same samples, {' '.join(self.arithmetic_view)}")
        self.each("arithmetic", "%", shares)

    # ---- truncation

    def truncated(self, scene):
        view, nearer = self.truncation_view, ("--max-error", NEARER)
        if scene.stem == BRANCHING:
            view, nearer = FEW_PIXELS, LESS_NEAR
        view = (*view, "--precision", "double")
        frame, cut = self.render(scene, "cut", *view, "--max-error", LIMIT)
        nearly, truth = self.render(scene, "whole", *view, *nearer)
        return {"size": view[1], "measured": pfm.errors(self.plan.program, cut, truth)["largest"],
                "bound": frame["missing"]["largest"], "mean_bound": frame["missing"]["mean"],
                "truth_bound": nearly["missing"]["largest"] if "missing" in nearly else None}

    def measure_truncation(self):
        self.measure_scenes(f"--max-error {LIMIT}", self.truncation, self.truncated)

    def add_truncation(self):
        measured = {name: found if isinstance(found, str) else found["measured"] for name, found in self.truncation.items()}
        bounds = {name: found if isinstance(found, str) else found["bound"] / found["measured"]
                  for name, found in self.truncation.items()
                  if isinstance(found, str) or found["bound"] > 0 and found["measured"] > 0}
        self.worst("truncation", f"--max-error {LIMIT}: largest error by what is left out, worst scene", "of 255",
                   measured, TRUNCATION, max,
                   f"against --max-error {NEARER}, both double, same samples; {BRANCHING}, {FEW_PIXELS[1]}, against "
                   f"{' '.join(LESS_NEAR)}")
        self.each("truncation", "of 255", measured)
        self.worst("bound", "the bound by the measured error, worst scene", "times", bounds, BOUND, max,
                   "of the largest of each frame; asked for by the aim only; scenes from which nothing was left out "
                   "have none")
        self.each("bound", "times", bounds)

    # ---- rows

    def worst(self, key, what, unit, values, target, choose, note):
        def figure():
            for value in values.values():
                if isinstance(value, str):
                    raise Missing(value)
            return [choose(values.values())] if values else []
        self.plan.row(key, what, unit, figure, device=self.device["label"], target=target, note=note)

    def each(self, key, unit, values):
        for name, value in there(values).items():
            self.plan.row(key, f"  {name}", unit, lambda value=value: [value], device=self.device["label"])
