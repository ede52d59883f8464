# SPDX-License-Identifier: MIT
"""Measures the points of bench/study in turns, and again what was disturbed."""
import tempfile
from pathlib import Path
from statistics import median

from harness import study_state
from harness.program import Interrupted, Problem
from harness.speed_plan import Job, Plan, compare_pictures

AGAIN = 2  # times that a disturbed run is measured again, at most
MOST_REJECTED = 0.5  # of all runs that were planned: then the machine is simply busy
SLOW_SECONDS, SLOW_ROUNDS = 6, 2  # a whole run of so long is done so often
CACHES = ("HEDRON_CACHE", "POCL_CACHE_DIR", "CUDA_CACHE_PATH")


def is_slow(entry):
    return bool(entry["runs"]) and entry["runs"][0]["wall"] > SLOW_SECONDS


def run_of(entry, repeat):
    return next((run for run in entry["runs"] if run["repeat"] == repeat), None)


def tries(entry, repeat):
    return sum(run["repeat"] == repeat for run in (*entry["runs"], *entry["rejected"]))


class Runner:
    """`save` is called after every measurement."""

    def __init__(self, result, program, devices, scenes, folder, save, progress):
        self.result, self.program, self.devices, self.scenes = result, program, devices, scenes
        self.folder, self.save, self.progress = folder, save, progress
        self.repeats = result["repeats"]
        self.entries = []

    # ---- one run

    def render(self, entry):
        options, device = entry["options"], self.devices[entry["device"]]
        variables, empty = None, None
        if entry["cold"]:
            empty = tempfile.TemporaryDirectory(dir=self.folder)
            variables = {name: str(Path(empty.name, name)) for name in CACHES}
        try:
            return self.program.render(device, self.scenes[entry["scene"]], entry["frames"], options, self.folder,
                                       output=entry["output"], variables=variables)
        except Interrupted as interrupted:
            raise KeyboardInterrupt from interrupted
        finally:
            if empty:
                empty.cleanup()

    def measure(self, entry, repeat):
        """Of several tries the least disturbed one counts."""
        run = self.render(entry)
        if run["code"] == 2:
            raise Problem(2, f"{entry['device']}, {entry['scene']} {' '.join(entry['options'])}: {run['message']}")
        if run["code"] != 0:
            entry["reason"], entry["failed"] = run["message"], run["code"] != 3
        elif not run["frames"]:
            entry["reason"], entry["failed"] = "it wrote no statistics", True
        else:
            entry["renderer"] = run["frames"][0]["renderer"]
            self.keep(entry, study_state.kept_run(entry, repeat, run))
        self.save()

    def keep(self, entry, run):
        before = run_of(entry, run["repeat"])
        if before is None:
            entry["runs"].append(run)
            return
        better, worse = sorted((before, run), key=lambda each: (each["noisy"], each["others"] or 0))
        entry["runs"][entry["runs"].index(before)] = better
        entry["rejected"].append({"repeat": worse["repeat"], "others": worse["others"], "load": worse["load"],
                                  "trace_ms": study_state.values_of({**entry, "runs": [worse]},
                                                                    study_state.trace_seconds)[0]})

    # ---- turns

    def is_wanted(self, entry, repeat):
        return not (entry["reason"] or run_of(entry, repeat) or (is_slow(entry) and repeat >= SLOW_ROUNDS))

    def rejected(self):
        return sum(len(entry["rejected"]) for entry in self.entries)

    def is_noisy(self, entry, repeat, number):
        run = run_of(entry, repeat)
        return run is not None and run["noisy"] and tries(entry, repeat) == number

    def turn(self, repeat, words, wanted):
        for place, entry in enumerate(self.entries):
            if wanted(entry):
                self.progress(f"{words}, run {place + 1} of {len(self.entries)}: {entry['device']}, {entry['part']}",
                              self.seconds_left(repeat))
                self.measure(entry, repeat)

    def measure_all(self, parts):
        """Every point once a round, so that a slow minute of the machine meets all of them; what was disturbed
        again at the round's end. False: the pictures differ, so that no more is worth measuring."""
        self.entries = [entry for entry in self.result["measurements"] if entry["part"] in parts]
        most = MOST_REJECTED * len(self.entries) * self.repeats
        for repeat in range(self.repeats):
            words = f"round {repeat + 1} of {self.repeats}"
            self.turn(repeat, words, lambda entry: self.is_wanted(entry, repeat))
            for number in range(1, AGAIN + 1):
                self.turn(repeat, f"{words}, again what was disturbed",
                          lambda entry: self.rejected() < most and self.is_noisy(entry, repeat, number))
            if compare(self.result)["same"] is False:
                return False
        return True

    def seconds_left(self, now):
        """By what runs took so far; None: nothing is known yet."""
        walls = {id(entry): min(run["wall"] for run in entry["runs"]) for entry in self.entries if entry["runs"]}
        if not walls:
            return None
        usual = median(walls.values())
        return sum(walls.get(id(entry), usual) for entry in self.entries for repeat in range(now, self.repeats)
                   if self.is_wanted(entry, repeat))


def compare(result):
    """Whether all that must make the same pictures did, as speed_plan.compare_pictures tells."""
    plan = Plan({device["label"]: device for device in result["devices"]}, {})
    for entry in result["measurements"]:
        job = Job(entry["device"], entry["scene"], entry["frames"], tuple(entry["options"]), output=entry["output"])
        plan.runs.setdefault(job, []).extend(
            {"digests": {frame["frame"]: frame["picture"] for frame in run["frames"] if frame["picture"]}}
            for run in entry["runs"])
    return compare_pictures(plan)


def failures(result):
    """What ended a run that should not have."""
    return sorted({f"{entry['device']}, {entry['part']}, {' '.join(entry['options'])}: {entry['reason']}"
                   for entry in result["measurements"] if entry["failed"]})
