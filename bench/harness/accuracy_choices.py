# SPDX-License-Identifier: MIT
"""What hedron chooses by itself, against what it could have chosen: time, and error of the arithmetic."""
from dataclasses import dataclass
from statistics import median

from harness import accuracy_error, summary
from harness.accuracy_points import ONCE_SECONDS
from harness.accuracy_truth import run
from harness.program import Interrupted, Problem

FRAMES = "0-3"


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
    def __init__(self, plan, runnable, judge, size, options, folder):
        self.plan, self.runnable, self.judge, self.folder = plan, runnable, judge, folder
        self.size, self.options = size, tuple(options)
        self.jobs, self.errors = {}, {}
        self.not_finite = self.frames = 0

    def view(self, choice):
        return "--size", "x".join(str(max(1, length // choice.part)) for length in self.size)

    def reference(self, program, choice):
        """Double with the same samples, and no triangles in place of solids."""
        file = self.folder / "double.pfm"
        view = [word for word in choice.view if word not in ("--geometry", "triangles")]
        run(program, self.judge, self.plan.scenes[choice.scene],
            (*view, *self.view(choice), "--precision", "double", *self.options), file)
        return file

    def measure(self, program, repeats, news):
        for choice in CHOICES:
            news(f"choices: {choice.name}")
            try:
                reference = self.reference(program, choice)
                self.measure_choice(program, choice, reference, repeats)
            except Problem as problem:
                self.plan.failures.add(str(problem))
            except Interrupted as interrupted:
                raise KeyboardInterrupt from interrupted

    def measure_choice(self, program, choice, reference, repeats):
        for _ in range(repeats):  # in turns
            for label in self.runnable:
                for name, options in choice.ways:
                    job = self.job(label, choice, name, options)
                    if not self.plan.reasons.get(job) and not self.is_enough(job):
                        self.plan.run_job(job, program, self.folder, None)
                    if not self.plan.reasons.get(job):
                        self.judge_picture(program, (label, choice.name, name), job, reference)

    def is_enough(self, job):
        return self.plan.runs[job] and median(self.plan.medians(job)) > ONCE_SECONDS

    def job(self, label, choice, name, options):
        key = label, choice.name, name
        if key not in self.jobs:
            file = self.folder / f"choice-{len(self.jobs)}-####.pfm"
            self.jobs[key] = self.plan.job(label, choice.scene, FRAMES,
                                           (*options, *choice.view, *self.view(choice), *self.options), output=str(file))
        return self.jobs[key]

    def judge_picture(self, program, key, job, reference):
        if key in self.errors:
            return
        file = job.output.replace("####", "0000")
        self.errors[key] = accuracy_error.figures(program, file, reference)
        self.not_finite += accuracy_error.not_finite(file)
        self.frames += 1

    def table(self):
        """Entries of the report: time, ratio to what comes by itself, and error."""
        found, automatic = [], {}
        for (label, choice, name), job in self.jobs.items():
            entry = {"choice": choice, "scene": job.scene, "device": label, "way": name, "trace_ms": None,
                     "ratio": None, "rmse": None, "largest": None, "reason": self.plan.reasons.get(job)}
            if (label, choice, name) in self.errors:
                first, middle, third = summary.quartiles(self.plan.trace_ms(job))
                error = self.errors[label, choice, name]
                automatic.setdefault((label, choice), middle)
                entry.update(trace_ms={"median": middle, "q1": first, "q3": third},
                             ratio=middle / automatic[label, choice], rmse=error["rmse"], largest=error["largest"])
            found.append(entry)
        return found
