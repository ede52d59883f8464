# SPDX-License-Identifier: MIT
"""Time and error of every setting on every device; saved measurements are kept."""
from pathlib import Path
from statistics import median

from harness.accuracy import front, settings
from harness.accuracy.truth import Truth
from harness.measure.jobs import run_of
from harness.measure.numbers import spread
from harness.run import pfm
from harness.run.program import digest

SCENE = "built-in"
FRAMES = "0-3"  # the first gives the error and warms up; its neighbours give the time
ENOUGH_SECONDS, ENOUGH_QUICKLY = 3.0, 0.4  # of a frame: slower settings are left out
ONCE_SECONDS = 0.4  # slower frames are timed in the first round only


def empty_memory():
    return {"size": None, "truth": None, "jobs": {}, "points": [], "equal_error": [], "not_tried": [], "not_finite": 0,
            "failures": []}


class Points:
    """Measures every setting of every device. Fills `memory` and calls `save` after every run; `memory` may hold the
    points of an interrupted call. The scene is one of the plan's, the families are of settings.FAMILIES."""

    def __init__(self, plan, judge, size, memory, truth_file, save=lambda: None, *, scene=SCENE, families=settings.FAMILIES):
        self.plan, self.memory, self.size, self.save_memory = plan, memory, size, save
        self.scene, self.families = scene, families
        self.truth = Truth(plan, judge, scene, size, truth_file)
        self.settings, self.left_out = {}, {}  # (device, setting): job, and the reason if there is none
        plan.once_seconds = ONCE_SECONDS

    def job(self, label, setting):
        output = str(self.plan.folder / f"{len(self.settings)}-####.pfm")
        made = self.plan.job(label, self.scene, FRAMES, (*setting.options, "--size", f"{self.size[0]}x{self.size[1]}"), output=output)
        key = " ".join([label, *setting.options])
        kept = self.memory["jobs"].get(key)
        if kept and kept["runs"]:
            made.update(kept, output=output)
        self.memory["jobs"][key] = self.settings[label, setting] = made
        return made

    # ---- running

    def first_round(self):
        """Runs the settings of a family in order; each one's time predicts the next one's."""
        for label in self.plan.runnable:
            for name, family in settings.settings(self.plan.quick).items():
                before = None
                for setting in family if name in self.families else ():
                    if before and not self.is_affordable(label, setting, before):
                        continue
                    self.plan.news(f"{self.scene}, {label}, {setting.name}")
                    made = self.job(label, setting)
                    if not run_of(made, 0):
                        self.plan.measure(made, 0)
                    if not made["reason"]:
                        before = setting
                        self.judge(made)

    def is_affordable(self, label, setting, before):
        seconds = median(self.plan.medians(self.settings[label, before])) * setting.work / before.work
        if seconds > (ENOUGH_QUICKLY if self.plan.quick else ENOUGH_SECONDS):
            self.left_out[label, setting] = f"a frame would take some {seconds:.1f} s"
            return False
        return True

    def judge(self, made):
        """Notes the error of the first frame, and the NaNs and infinities of all."""
        if "error" in made:
            return
        frames = made["runs"][0]["frames"]
        files = [Path(made["output"].replace("####", f"{frame['frame']:04}")) for frame in frames]
        made["error"] = pfm.errors(self.plan.program, files[0], self.truth.file)
        made["not_finite"] = sum(map(pfm.not_finite, files))
        for frame, file in zip(frames, files):
            frame["picture"] = digest(file)
        self.save()

    def measure(self, repeats):
        if not self.truth.is_made(self.memory["truth"]):
            self.memory.update(empty_memory())  # errors against another picture mean nothing
            self.truth.make()
            self.memory["truth"] = self.truth.facts
        self.first_round()
        self.plan.save = self.save  # a first run is saved with its error
        self.plan.run_all(repeats)
        self.save()

    # ---- results

    def save(self):
        points = self.points()
        self.memory.update(
            size=list(self.size), points=points, not_tried=self.absent(), not_finite=sum(
                made.get("not_finite", 0) for made in self.settings.values()), failures=sorted(self.plan.all_failures()),
            equal_error=[{"device": label, "rmse": error, "ratio": ratio} for label in self.plan.runnable
                         for error, ratio in equal_error(points, label)])
        self.save_memory()

    def point(self, label, setting, made):
        times, frame = spread(self.plan.trace_ms(made)), made["runs"][0]["frames"][0]
        return {"device": label, "family": setting.family, "name": setting.name, "options": list(setting.options),
                "ms": times["median"], "trace_ms": times, "runs": len(made["runs"]), **made["error"], "rays": frame["rays"],
                "missing": frame.get("missing"), "renderer": made["renderer"], "on_front": False, "recommended": None}

    def points(self):
        """Returns all points, with the front and recommended settings marked; of an unfinished run those that it has."""
        found = []
        for label in self.plan.runnable:
            points = [self.point(label, setting, made) for (which, setting), made in self.settings.items()
                      if which == label and "error" in made]
            for point in front.front(points):
                point["on_front"] = True
            recommend(points)
            found += points
        return found

    def absent(self):
        """Returns the settings that could not be tried, and why."""
        refused = {key: made["reason"] for key, made in self.settings.items() if made["reason"]}
        return [{"device": label, "family": setting.family, "name": setting.name, "reason": reason}
                for (label, setting), reason in {**refused, **self.left_out}.items()]


def recommend(points):
    """Marks the fastest settings that are at least as good as some grids, without those that hedron chooses by itself."""
    others = [point for point in points if point["family"] != settings.CHOSEN]
    for number, word in settings.DRAFT_USUAL_FINE.items():
        grid = next((each for each in points if each["name"] == f"grid {number}"), None)
        best = grid and front.cheapest(others, grid["rmse"])
        if best:
            best["recommended"] = " and ".join(filter(None, (best["recommended"], word)))


def recommended(points):
    """Returns [(word, point)], from the draft on."""
    words = list(settings.DRAFT_USUAL_FINE.values())
    return sorted(((point["recommended"], point) for point in points if point["recommended"]),
                  key=lambda each: words.index(each[0].split()[0]))


def equal_error(points, label, families=settings.BOUNDED_FAMILIES, baseline=settings.BASELINE):
    """Returns [(error, ratio)] of some families' time by another's; by default of multi-jittered samples and bounded
    depth by the grid in full depth."""
    own = [each for each in points if each["device"] == label]
    return front.ratios([each for each in own if each["family"] in families],
                        [each for each in own if each["family"] == baseline])
