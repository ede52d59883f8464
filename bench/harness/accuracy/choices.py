# SPDX-License-Identifier: MIT
"""What hedron chooses by itself, against what it could have chosen: time, and error of the arithmetic."""
from dataclasses import dataclass
from statistics import median

from harness.accuracy.points import FRAMES, ONCE_SECONDS
from harness.accuracy.truth import run
from harness.measure.jobs import job
from harness.measure.numbers import spread
from harness.run import pfm
from harness.run.program import Problem


@dataclass(frozen=True)
class Choice:
    name: str
    scene: str
    view: tuple
    ways: tuple  # (name, options); the first one is what comes by itself
    part: int = 1  # of the sides of the frame


GRID = ("--samples", "4")
CHOICES = (
    Choice("search of triangles, many", "knot", ("--samples", "1"), (
        ("automatic", ()), ("hierarchy", ("--accel", "bvh")), ("brute force", ("--accel", "brute"))), part=4),
    Choice("search of triangles, few", "few", (*GRID, "--geometry", "triangles"), (
        ("automatic", ()), ("hierarchy", ("--accel", "bvh")), ("brute force", ("--accel", "brute")))),
    Choice("geometry", "built-in", GRID, (
        ("automatic", ()), ("solids", ("--geometry", "solids")), ("triangles", ("--geometry", "triangles")))),
    Choice("precision", "built-in", GRID, (
        ("automatic", ()), ("float", ("--precision", "float")), ("double", ("--precision", "double")))),
    Choice("pipeline", "built-in", GRID, (
        ("automatic", ()), ("mega", ("--pipeline", "mega")), ("wavefront", ("--pipeline", "wavefront")))),
    Choice("arithmetic", "built-in", GRID, (
        ("automatic", ()), ("strict", ("--math", "strict")), ("fast", ("--math", "fast")))),
)


class Choices:
    def __init__(self, plan, runnable, judge, size, options):
        self.plan, self.runnable, self.judge, self.size, self.options = plan, runnable, judge, size, tuple(options)
        self.jobs = {}  # (device, choice, way): job
        self.not_finite = self.frames = 0

    def view(self, choice):
        return "--size", "x".join(str(max(1, length // choice.part)) for length in self.size)

    def reference(self, choice):
        """Double with the same samples, and no triangles in place of solids."""
        file = self.plan.folder / "double.pfm"
        view = [word for word in choice.view if word not in ("--geometry", "triangles")]
        run(self.plan.program, self.judge, self.plan.scenes[choice.scene],
            (*view, *self.view(choice), "--precision", "double", *self.options), file)
        return file

    def measure(self, repeats):
        for choice in CHOICES:
            self.plan.news(f"choices: {choice.name}")
            try:
                self.measure_choice(choice, self.reference(choice), repeats)
            except Problem as problem:
                self.plan.failures.add(str(problem))

    def measure_choice(self, choice, reference, repeats):
        for repeat in range(repeats):  # in turns
            for label in self.runnable:
                for name, options in choice.ways:
                    made = self.job(label, choice, name, options)
                    if not made["reason"] and not self.is_enough(made):
                        self.plan.measure(made, repeat)
                    if not made["reason"]:
                        self.judge_picture(made, reference)

    def is_enough(self, made):
        return made["runs"] and median(self.plan.medians(made)) > ONCE_SECONDS

    def job(self, label, choice, name, options):
        key = label, choice.name, name
        if key not in self.jobs:
            file = self.plan.folder / f"choice-{len(self.jobs)}-####.pfm"
            self.jobs[key] = job(label, choice.scene, FRAMES, (*options, *choice.view, *self.view(choice), *self.options),
                                 output=str(file))
            self.plan.jobs.append(self.jobs[key])
        return self.jobs[key]

    def judge_picture(self, made, reference):
        if "error" not in made:
            file = made["output"].replace("####", "0000")
            made["error"] = pfm.errors(self.plan.program, file, reference)
            self.not_finite += pfm.not_finite(file)
            self.frames += 1

    def table(self):
        """Entries of the report: time, ratio to what comes by itself, and error."""
        found, automatic = [], {}
        for (label, choice, name), made in self.jobs.items():
            entry = {"choice": choice, "scene": made["scene"], "device": label, "way": name, "trace_ms": None,
                     "ratio": None, "rmse": None, "largest": None, "reason": made["reason"]}
            if "error" in made:
                times = spread(self.plan.trace_ms(made))
                base = automatic.setdefault((label, choice), times["median"])
                entry.update(trace_ms=times, ratio=times["median"] / base,
                             **{key: made["error"][key] for key in ("rmse", "largest")})
            found.append(entry)
        return found
