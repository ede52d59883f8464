# SPDX-License-Identifier: MIT
"""What hedron chooses by itself against its alternatives: time, and error of the arithmetic."""
from dataclasses import dataclass

from harness.accuracy.points import FRAMES, ONCE_SECONDS
from harness.accuracy.truth import render
from harness.measure.numbers import number, spread, spread_text
from harness.run import pfm

GRID = ("--samples", "4")
AUTOMATIC = "automatic"
HEAD = ["choice", "way", "device", "scene", "ms [q1..q3]", "to automatic", "RMSE", "largest"]


@dataclass(frozen=True)
class Choice:
    name: str
    option: str
    ways: dict  # by name; the program's own choice comes first
    scene: str = "built-in"
    view: tuple = GRID
    part: int = 1  # of the frame's sides


SEARCHES = {"hierarchy": "bvh", "brute force": "brute"}
CHOICES = (
    Choice("search of triangles, many", "--accel", SEARCHES, "knot", ("--samples", "1"), part=4),
    Choice("search of triangles, few", "--accel", SEARCHES, "few", (*GRID, "--geometry", "triangles")),
    Choice("geometry", "--geometry", {"solids": "solids", "triangles": "triangles"}),
    Choice("precision", "--precision", {"float": "float", "double": "double"}),
    Choice("pipeline", "--pipeline", {"mega": "mega", "wavefront": "wavefront"}),
    Choice("arithmetic", "--math", {"strict": "strict", "fast": "fast"}),
)


class Choices:
    def __init__(self, plan, judge, size):
        self.plan, self.judge, self.size = plan, judge, size
        self.jobs = {}  # (device, choice, variant): job
        self.not_finite = self.frames = 0
        plan.once_seconds = ONCE_SECONDS

    def measure(self, repeats):
        for choice in CHOICES:
            self.plan.news(f"choices: {choice.name}")
            reason = self.plan.tried(self.measure_choice, choice, repeats)
            if reason:
                self.plan.failures.add(reason)

    def measure_choice(self, choice, repeats):
        size = "--size", "x".join(str(max(1, length // choice.part)) for length in self.size)
        reference = self.plan.folder / "double.pfm"
        # Double with the same samples, and no triangles in place of solids.
        view = [word for word in choice.view if word not in ("--geometry", "triangles")]
        render(self.plan, self.judge, self.plan.scenes[choice.scene], (*view, *size, "--precision", "double"), reference)
        ways = {AUTOMATIC: (), **{name: (choice.option, value) for name, value in choice.ways.items()}}
        for repeat in range(repeats):  # interleaved
            for label in self.plan.runnable:
                for name, options in ways.items():
                    made = self.job(label, choice, name, (*options, *choice.view, *size))
                    if self.plan.is_wanted(made, repeat):
                        self.plan.measure(made, repeat)
                    if not made["reason"] and "error" not in made:
                        file = made["output"].replace("####", "0000")
                        made["error"] = pfm.errors(self.plan.program, file, reference)
                        self.not_finite += pfm.not_finite(file)
                        self.frames += 1

    def job(self, label, choice, name, options):
        key = label, choice.name, name
        if key not in self.jobs:
            self.jobs[key] = self.plan.job(label, choice.scene, FRAMES, options,
                                           output=str(self.plan.folder / f"choice-{len(self.jobs)}-####.pfm"))
        return self.jobs[key]

    def table(self):
        """Returns entries of the report: time, ratio to the program's own choice, and error."""
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


def cells(entry):
    start = [entry["choice"], entry["way"], entry["device"], entry["scene"]]
    if entry["trace_ms"] is None:
        return [*start, entry["reason"] or "-", "", "", ""]
    return [*start, spread_text(entry["trace_ms"]), *(number(entry[key], 3) for key in ("ratio", "rmse", "largest"))]
