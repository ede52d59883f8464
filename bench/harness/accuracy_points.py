# SPDX-License-Identifier: MIT
"""Time and error of every setting on every device."""
from pathlib import Path
from statistics import median

from harness import accuracy_error, accuracy_front, accuracy_settings, program as programs, summary
from harness.program import Interrupted

SCENE = "built-in"
FRAMES = "0-3"  # the first gives the error and warms up; its neighbours give the time
ENOUGH_SECONDS, ENOUGH_QUICKLY = 3.0, 0.4  # of a frame: what would take longer is left out
ONCE_SECONDS = 0.4  # slower frames are timed in the first round only


class Points:
    """`truth` is made when `measure` is called."""

    def __init__(self, plan, runnable, truth, size, options, quick, folder):
        self.plan, self.runnable, self.truth, self.folder, self.quick = plan, runnable, truth, folder, quick
        self.families = accuracy_settings.settings(quick)
        self.jobs, self.left_out, self.errors = {}, {}, {}
        self.not_finite = self.frames = 0
        self.view = ("--size", f"{size[0]}x{size[1]}", *options)

    def job(self, label, setting):
        file = self.folder / f"{len(self.jobs)}-####.pfm"
        job = self.plan.job(label, SCENE, FRAMES, (*setting.options, *self.view), output=str(file))
        self.jobs[label, setting] = job
        return job

    # ---- the work

    def run(self, program, job):
        try:
            self.plan.run_job(job, program, self.folder, None)
        except Interrupted as interrupted:
            raise KeyboardInterrupt from interrupted

    def seconds(self, job):
        return median(self.plan.medians(job))

    def first_round(self, program, news):
        """Each setting of a family waits for the one before, which tells how long it would take."""
        enough = ENOUGH_QUICKLY if self.quick else ENOUGH_SECONDS
        for label in self.runnable:
            for family in self.families.values():
                before = None
                for setting in family:
                    if before:
                        seconds = self.seconds(self.jobs[label, before]) * setting.work / before.work
                        if seconds > enough:
                            self.left_out[label, setting] = f"a frame would take some {seconds:.1f} s"
                            continue
                    news(f"{label}, {setting.name}")
                    job = self.job(label, setting)
                    self.run(program, job)
                    if self.plan.reasons.get(job):
                        continue
                    before = setting
                    self.judge(program, label, setting, job)

    def judge(self, program, label, setting, job):
        """Error of the first frame, and NaNs and infinities of all."""
        files = [job.output.replace("####", f"{frame['frame']:04}") for frame in self.plan.runs[job][0]["frames"]]
        self.errors[label, setting] = accuracy_error.figures(program, files[0], self.truth.file)
        self.not_finite += sum(map(accuracy_error.not_finite, files))
        self.frames += len(files)
        self.plan.runs[job][0]["digests"] = {number: programs.digest(Path(file))
                                                for number, file in enumerate(files)}

    def measure(self, program, repeats, news):
        self.truth.make(news)
        self.first_round(program, news)
        for repeat in range(1, repeats):
            for (label, setting), job in self.jobs.items():
                if not self.plan.reasons.get(job) and self.seconds(job) <= ONCE_SECONDS:
                    news(f"round {repeat + 1} of {repeats}: {label}, {setting.name}")
                    self.run(program, job)

    # ---- what came of it

    def point(self, label, setting, job):
        first, middle, third = summary.quartiles(self.plan.trace_ms(job))
        frame = self.plan.runs[job][0]["frames"][0]
        return {"device": label, "family": setting.family, "name": setting.name, "options": list(setting.options),
                "ms": middle, "trace_ms": {"median": middle, "q1": first, "q3": third},
                "runs": len(self.plan.runs[job]), **self.errors[label, setting], "rays": frame["rays"],
                "missing": frame.get("missing"), "renderer": frame["renderer"], "on_front": False,
                "recommended": None}

    def of_device(self, label):
        return [self.point(label, setting, self.jobs[label, setting])
                for which, setting in self.errors if which == label]

    def points(self):
        """All, with the front and what is recommended marked. An unfinished run gives what it has."""
        found = []
        for label in self.runnable:
            points = self.of_device(label)
            for point in accuracy_front.front(points):
                point["on_front"] = True
            recommend(points)
            found += points
        return found

    def absent(self):
        """What could not be tried, and why."""
        refused = [{"device": label, "family": setting.family, "name": setting.name,
                    "reason": self.plan.reasons[job]}
                   for (label, setting), job in self.jobs.items() if self.plan.reasons.get(job)]
        return refused + [{"device": label, "family": setting.family, "name": setting.name, "reason": reason}
                          for (label, setting), reason in self.left_out.items()]


def recommend(points):
    """Marks the fastest settings that are at least as good as some grids. What hedron chooses by itself is none."""
    settings = [point for point in points if point["family"] != accuracy_settings.CHOSEN]
    for number, word in accuracy_settings.DRAFT_USUAL_FINE.items():
        grid = next((each for each in points if each["name"] == f"grid {number}"), None)
        best = grid and accuracy_front.cheapest(settings, grid["rmse"])
        if best:
            best["recommended"] = " and ".join(filter(None, (best["recommended"], word)))


def recommended(points):
    """[(word, point)], from the draft on."""
    words = list(accuracy_settings.DRAFT_USUAL_FINE.values())
    return sorted(((point["recommended"], point) for point in points if point["recommended"]),
                  key=lambda each: words.index(each[0].split()[0]))


def equal_error(points, label, families=accuracy_settings.BOUNDED_FAMILIES, baseline=accuracy_settings.BASELINE):
    """[(error, ratio)] of the time of some families by that of another; of adaptive sampling and bounded depth by that
    of the grid in full depth, if not said."""
    own = [each for each in points if each["device"] == label]
    return accuracy_front.ratios([each for each in own if each["family"] in families],
                                 [each for each in own if each["family"] == baseline])
