# SPDX-License-Identifier: MIT
"""Charts error against time for many settings, and measures the targets of accuracy."""
import argparse
import re

from harness.accuracy import chart
from harness.accuracy.choices import Choices
from harness.accuracy.points import SCENE, Points, empty_memory, equal_error, recommended
from harness.accuracy.targets import SceneTargets
from harness.command.bench import Bench
from harness.measure.numbers import number, spread_text
from harness.measure.rows import NONE, Target
from harness.run import devices
from harness.run.program import ROOT

EQUAL_ERROR = Target(1 / 3, 1 / 10, False)
# GPUs have all of the scene's pixels; smaller frames are too short to be timed there.
SIZE, SIZE_OF_GPUS = {False: (128, 96), True: (64, 48)}, (640, 360)
ON_ALL_SCENES = ("arithmetic", "truncation", "adaptive")


def size(text):
    if not re.fullmatch("[1-9][0-9]{0,4}x[1-9][0-9]{0,4}", text):
        raise argparse.ArgumentTypeError(f"'{text}' is no size such as 128x96")
    return tuple(map(int, text.split("x")))


def point_rows(points):
    rows = [["setting", "device", "ms [q1..q3]", "RMSE", "largest", "M rays", "front", "recommended"]]
    for point in points:
        rows.append([point["name"], point["device"], spread_text(point["trace_ms"]), number(point["rmse"], 3),
                     number(point["largest"], 3), number(1e-6 * sum(point["rays"].values()), 3),
                     "front" if point["on_front"] else "", point["recommended"] or ""])
    return rows


def choice_rows(table):
    rows = [["choice", "way", "device", "scene", "ms [q1..q3]", "to automatic", "RMSE", "largest"]]
    for entry in table:
        if entry["trace_ms"] is None:
            rows.append([entry["choice"], entry["way"], entry["device"], entry["scene"], entry["reason"] or "-"] + [""] * 3)
            continue
        rows.append([entry["choice"], entry["way"], entry["device"], entry["scene"], spread_text(entry["trace_ms"]),
                     number(entry["ratio"], 3), number(entry["rmse"], 3),
                     number(entry["largest"], 3)])
    return rows


def truth_words(result):
    truth = result["truth"]
    edge = f"at most {truth['edge_error']} of 255 off on an edge between black and white" if truth["edge_error"] else (
        "coarser than hedron's own")
    return (f"Reference: {truth['samples']} x {truth['samples']} dense samples in double, {edge}; what it leaves out is "
            f"at most {number(truth['missing']['largest'], 2)} of 255 (--max-error {truth['max_error']:g}); a "
            f"reference of a quarter of the samples has RMSE {number(truth['to_quarter_of_samples']['rmse'], 3)} "
            f"and is off by {number(truth['to_quarter_of_samples']['largest'], 3)} at most. "
            f"{number(truth['seconds'], 3)} s on {truth['device']}.")


def equal_words(result):
    return [f"Equal RMSE on {each['device']}: at {number(each['rmse'], 3)} adaptive sampling and bounded depth "
            f"take {number(each['ratio'], 3)} of the time of the grid in full depth."
            for each in result["equal_error"] or []]


def recommended_words(result):
    return [f"Recommended on {point['device']}, {word}: {' '.join(point['options'])}: {number(point['ms'], 3)} ms, "
            f"RMSE {number(point['rmse'], 3)}, largest {number(point['largest'], 3)}."
            for device in result["devices"] for word, point in recommended(
                [each for each in result["points"] if each["device"] == device["label"]])]


def absent_words(result):
    said = {}
    for each in result["not_tried"] or []:
        said.setdefault((each["device"], each["family"], each["reason"].split(" some ")[0]), []).append(each["name"])
    return [f"Not tried on {device}: {', '.join(names)}: {reason}{' too long' if reason.endswith('take') else ''}"
            for (device, _, reason), names in said.items()]


def sections(result):
    """[(title, rows, lines)]"""
    found = []
    if result["points"]:
        found.append(("Settings", point_rows(result["points"]),
                      [truth_words(result), *recommended_words(result), *equal_words(result), *absent_words(result)]))
    if result["choices"]:
        found.append(("What hedron chooses by itself", choice_rows(result["choices"]),
                      ["Errors are against double with the same samples, and solids in place of triangles."]))
    return found


class Accuracy(Bench):
    name = "accuracy"
    about = "Draw error against time for many settings, and measure the targets of accuracy."
    codes = """exit codes: 0 done, 1 pictures differ, have values that are not finite, or a run failed,
2 wrong usage or input, 3 no device can be timed, 130 interrupted (what was measured is kept)"""
    quick, repeats = "few settings, small frames, a coarser reference; rough", (3, 1)
    own_options = (*Bench.own_options, "--size", "--samples", "--depth", "--cutoff", "--aa", "--max-error", "--reference",
                   "--crop", "--precision", "--math", "--geometry", "--pipeline", "--accel", "--divisions")
    parts = ("settings", *ON_ALL_SCENES, "choices")
    chart_files = ("accuracy_*",)
    keys = ("size", "truth", "points", "equal_error", "not_tried", "targets", "choices")

    @classmethod
    def add_options(cls, parser):
        super().add_options(parser)
        parser.add_argument("--size", type=size, metavar="WxH",
                            help="of the frames of the settings (default: 128x96, with --quick 64x48, where all devices "
                                 "are GPUs 640x360)")

    def __init__(self, arguments, program, folder):
        super().__init__(arguments, program, folder)
        judge, options, plan = devices.judge(self.runnable.values()), arguments.options, self.plan
        scenes = sorted((ROOT / "scenes").glob("*.json"))
        plan.scenes = {SCENE: None, "few": ROOT / "bench/scenes/few.json", **{file.stem: file for file in scenes}}
        self.judge, self.memory = judge, empty_memory()
        self.targets = self.points = self.choices = None
        only_gpus = self.runnable and all(device["is_cpu"] is False for device in self.runnable.values())
        frame = arguments.size or (SIZE_OF_GPUS if only_gpus else SIZE[arguments.quick])
        self.result["size"] = list(frame)
        if not judge:
            return
        self.targets = SceneTargets(plan, judge, scenes, options, arguments.quick)
        if self.wants("settings"):
            self.points = Points(plan, self.runnable, judge, frame, options, arguments.quick, self.memory, folder / "truth.pfm")
        if self.wants("choices"):
            self.choices = Choices(plan, self.runnable, judge, frame, options)

    def measure(self):
        if not self.judge:
            self.plan.absent("reference", "reference", "", None, "no device that is strict has double precision")
            return False
        for part in filter(self.wants, ON_ALL_SCENES):
            getattr(self.targets, f"measure_{part}")()
        for study in filter(None, (self.points, self.choices)):
            study.measure(self.arguments.repeats)
        return True

    # ---- what came of it

    def add_equal_error(self):
        for label in self.runnable:
            for key, what, families, target, note in (
                    ("equal_error", "time at equal RMSE, adaptive and bounded depth against grid and full depth", (),
                     EQUAL_ERROR, "full depth is 40 without a cut-off, and deeper would take longer still; the median over "
                                  "the errors that both have"),
                    ("equal_error_sampling", "  of adaptive sampling alone, against the grid of the same depth",
                     (("adaptive",), "grid"), None, None)):
                found = [ratio for _, ratio in equal_error(self.memory["points"], label, *families)]
                self.plan.row(key, what, "times", lambda found=found: found, device=label, target=target, note=note)

    def not_finite(self):
        """(values, frames)"""
        count = self.memory["not_finite"] + (self.memory["truth"] or {}).get("not_finite", 0)
        frames = sum(len(job["runs"][0]["frames"]) for job in self.memory["jobs"].values() if "error" in job)
        studies = list(filter(None, (self.targets, self.choices)))
        return count + sum(study.not_finite for study in studies), frames + sum(study.frames for study in studies)

    def fill(self):
        for part in filter(self.wants, ON_ALL_SCENES):
            if self.targets:
                getattr(self.targets, f"add_{part}")()
        if self.points and self.points.truth.facts:
            self.points.save()
            self.add_equal_error()
            self.result.update({key: self.memory[key] for key in ("truth", "points", "equal_error", "not_tried")})
        count, frames = self.not_finite()
        self.plan.row("not_finite", f"values that are NaN or infinite, {frames} frames", "values",
                      lambda: [count] if frames else [], target=NONE)
        if count:
            self.plan.failures.add(f"{count} values are NaN or infinite")
        self.result.update(choices=self.choices and self.choices.table(), targets=self.targets and {
            part: getattr(self.targets, part) or None for part in ON_ALL_SCENES})

    def tables(self):
        return sections(self.result)

    def charts(self):
        return chart.charts(self.result)

    def exit_code(self):
        return super().exit_code() if self.judge else 3


BENCH = Accuracy
