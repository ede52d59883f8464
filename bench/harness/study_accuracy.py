# SPDX-License-Identifier: MIT
"""Error against time, measured as bench/accuracy does; an interrupted study goes on where it was."""
import hashlib
import shutil

from harness import accuracy_points, study_state
from harness.accuracy_points import Points
from harness.accuracy_truth import Truth, choose_judge
from harness.speed_plan import Plan

AGAIN = 2  # times that a disturbed run is done again, at most
MOST_REJECTED = 40  # in all
ROUNDS = {True: 1, False: 3}  # at most
SIZES = {"cpu": {True: (48, 36), False: (64, 48)}, "gpu": {True: (320, 180), False: (640, 360)}}


class KeptTruth(Truth):
    """The picture stays in the output folder."""

    def __init__(self, memory, file, *arguments):
        super().__init__(*arguments)
        self.memory, self.kept = memory, file

    def digest(self):
        return hashlib.sha256(self.kept.read_bytes()).hexdigest() if self.kept.is_file() else None

    def make(self, news):
        if self.memory["truth"] and self.memory["truth_sha256"] == self.digest():
            self.facts, self.file = self.memory["truth"], self.kept
            return
        self.memory.update(empty_memory())  # errors against another picture are worth nothing
        super().make(news)
        shutil.copyfile(self.file, self.kept)
        self.memory.update(truth=self.facts, truth_sha256=self.digest())


class KeptPoints(Points):
    """What is in the memory is not measured again."""

    def __init__(self, memory, save, *arguments):
        super().__init__(*arguments)
        self.memory, self.save = memory, save

    def key(self, job):
        return f"{job.device} {' '.join(job.options)}"

    def run(self, program, job):
        number, kept = len(self.plan.runs[job]), self.memory["runs"].setdefault(self.key(job), [])
        if number < len(kept):
            self.plan.runs[job].append({**kept[number], "digests": {}})
            return
        super().run(program, job)
        if self.plan.reasons.get(job):
            return
        self.run_again(program, job)
        run = self.plan.runs[job][-1]
        kept.append({**{key: run[key] for key in ("wall", "cpu", "load", "others", "noisy")},
                     "frames": [study_state.kept_frame(frame) for frame in run["frames"]]})
        if number > 0:  # the first one is saved with its error
            self.save()

    def run_again(self, program, job):
        runs = self.plan.runs[job]
        for _ in range(AGAIN):
            if not runs[-1]["noisy"] or self.memory["rejected"] >= MOST_REJECTED:
                return
            super().run(program, job)
            if self.plan.reasons.pop(job, None):
                return
            one, other = runs.pop(), runs.pop()
            runs.append(min(one, other, key=lambda run: (run["noisy"], run["others"] or 0)))
            self.memory["rejected"] += 1

    def judge(self, program, label, setting, job):
        key = self.key(job)
        if key in self.memory["errors"]:
            error, odd = self.memory["errors"][key]
            self.errors[label, setting] = error
            self.not_finite += odd
            return
        before = self.not_finite
        super().judge(program, label, setting, job)
        self.memory["errors"][key] = [self.errors[label, setting], self.not_finite - before]
        self.save()


def empty_memory():
    return {"size": None, "truth": None, "truth_sha256": None, "runs": {}, "errors": {}, "rejected": 0, "points": [],
            "equal_error": [], "not_tried": [], "not_finite": 0, "failures": []}


def measure_group(memory, size, devices, judge, program, out, folder, arguments, save, news):
    truth = KeptTruth(memory, out / f"study_truth_{size[0]}x{size[1]}.pfm", program, judge, None, size, arguments.options,
                      folder, arguments.quick)
    plan = Plan(devices, {accuracy_points.SCENE: None})
    points = KeptPoints(memory, lambda: (fill(memory, points, devices, plan), save()), plan, devices, truth, size,
                        arguments.options, arguments.quick, folder)
    points.measure(program, min(arguments.repeats, ROUNDS[arguments.quick]), news)
    fill(memory, points, devices, plan)
    save()


def fill(memory, points, devices, plan):
    memory["size"] = list(points.truth.size)
    memory["points"] = points.points()
    memory["equal_error"] = [{"device": label, "rmse": error, "ratio": ratio} for label in devices
                             for error, ratio in accuracy_points.equal_error(memory["points"], label)]
    memory["not_tried"] = points.absent()
    memory["not_finite"] = points.not_finite
    memory["failures"] = sorted(plan.failures)


def measure(result, devices, backends, program, out, folder, arguments, save, news):
    """Fills result["accuracy"]: `cpu` and `gpu`, for they render pictures of different sizes. Returns why there is
    nothing, or None."""
    judge = choose_judge(devices.values(), backends)
    if judge is None:
        return "No device that is strict has double precision, so there is no reference."
    result["accuracy"] = result["accuracy"] or {}
    for kind, is_cpu in (("cpu", True), ("gpu", False)):
        group = {label: device for label, device in devices.items() if device["is_cpu"] is is_cpu}
        if group:
            memory, size = result["accuracy"].setdefault(kind, empty_memory()), SIZES[kind][arguments.quick]
            measure_group(memory, size, group, judge, program, out, folder, arguments, save, news)
    return None


def failures(result):
    found = []
    for memory in (result["accuracy"] or {}).values():
        found += [f"accuracy: {words}" for words in memory["failures"]]
        if memory["not_finite"]:
            found.append(f"accuracy: {memory['not_finite']} values are NaN or infinite")
    return found
