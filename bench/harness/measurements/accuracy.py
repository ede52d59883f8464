# SPDX-License-Identifier: MIT
"""Error against time for many settings, and the targets of accuracy; the study has the chart of each device."""
import argparse
import re

from harness.accuracy import chart, choices, front, settings
from harness.accuracy.points import SCENE, Points, empty_memory, equal_error, recommended
from harness.accuracy.targets import SceneTargets
from harness.chart.lines import lines
from harness.chart.rows import ms
from harness.command.bench import Bench
from harness.measure.numbers import number, spread_text
from harness.measure.plan import Plan
from harness.measure.rows import NONE, Target
from harness.page import answer
from harness.page.section import Part, all_devices, dagger
from harness.run import devices
from harness.run.program import ROOT

EQUAL_ERROR = Target(1 / 3, 1 / 10, False)
# GPUs have all of the scene's pixels; smaller frames are too short to be timed there.
SIZE, SIZE_OF_GPUS = {False: (128, 96), True: (64, 48)}, (640, 360)
ON_ALL_SCENES = ("arithmetic", "truncation")
# Scenes besides the built-in one; of several frames each, because the neighbours of the first give the time.
FRONT_SCENES, FRONT_FAMILIES = ("five", "official", "starter"), ("grid", "multijitter", "fine", "deep", "promise")
HEAD = ["setting", "device", "ms [q1..q3]", "RMSE", "largest", "M rays", "front", "recommended"]


def size(text):
    if not re.fullmatch("[1-9][0-9]{0,4}x[1-9][0-9]{0,4}", text):
        raise argparse.ArgumentTypeError(f"'{text}' is no size such as 128x96")
    return tuple(map(int, text.split("x")))


def cells(point):
    return [point["name"], point["device"], spread_text(point["trace_ms"]), number(point["rmse"], 3), number(point["largest"], 3),
            number(1e-6 * sum(point["rays"].values()), 3), "front" if point["on_front"] else "", point["recommended"] or ""]


def point_words(result):
    truth = result["truth"]
    edge = f"at most {truth['edge_error']} of 255 off on an edge between black and white" if truth["edge_error"] else (
        "coarser than hedron's own")
    yield (f"Reference: {truth['samples']} x {truth['samples']} dense samples in double, {edge}; what it leaves out is "
           f"at most {number(truth['missing']['largest'], 2)} of 255 (--max-error {truth['max_error']:g}); a "
           f"reference of a quarter of the samples has RMSE {number(truth['to_quarter_of_samples']['rmse'], 3)} "
           f"and is off by {number(truth['to_quarter_of_samples']['largest'], 3)} at most. "
           f"{number(truth['seconds'], 3)} s on {truth['device']}.")
    for device in result["devices"]:
        for word, point in recommended([each for each in result["points"] if each["device"] == device["label"]]):
            yield (f"Recommended on {point['device']}, {word}: {' '.join(point['options'])}: {number(point['ms'], 3)} ms, "
                   f"RMSE {number(point['rmse'], 3)}, largest {number(point['largest'], 3)}.")
    for each in result["equal_error"] or []:
        yield (f"Equal RMSE on {each['device']}: at {number(each['rmse'], 3)} multi-jittered samples and bounded depth "
               f"take {number(each['ratio'], 3)} of the time of the grid in full depth.")
    absent = {}
    for each in result["not_tried"] or []:
        absent.setdefault((each["device"], each["family"], each["reason"].split(" some ")[0]), []).append(each["name"])
    for (device, _, reason), names in absent.items():
        yield f"Not tried on {device}: {', '.join(names)}: {reason}{' too long' if reason.endswith('take') else ''}"


class Accuracy(Bench):
    name = "accuracy"
    about = "Chart error against time for many settings, and measure the targets of accuracy."
    codes = """exit codes: 0 done, 1 pictures differ, have values that are not finite, or a run failed,
2 wrong usage or input, 3 no device can be timed, 130 interrupted (what was measured is kept)"""
    quick, repeats = "measure few settings with small frames and a coarse reference; figures are rough", (3, 1)
    own_options = (*Bench.own_options, "--size", "--samples", "--depth", "--cutoff", "--aa", "--max-error", "--reference",
                   "--crop", "--precision", "--math", "--geometry", "--pipeline", "--accel", "--divisions")
    parts = ("settings", "fronts", *ON_ALL_SCENES, "choices")
    chart_files = ("accuracy_*",)
    keys = ("size", "truth", "points", "equal_error", "not_tried", "fronts", "targets", "choices")

    def add_options(self, parser):
        super().add_options(parser)
        parser.add_argument("--size", type=size, metavar="WxH",
                            help="size of frames of the part settings, in pixels (default: 128x96; with --quick 64x48; "
                                 "640x360 if all devices are GPUs)")

    def prepare(self):
        plan, scenes = self.plan, sorted((ROOT / "scenes").glob("*.json"))
        plan.scenes = {SCENE: None, "few": ROOT / "bench/scenes/few.json", **{file.stem: file for file in scenes}}
        self.judge, self.memory = devices.judge(self.runnable.values()), empty_memory()
        self.targets = self.points = self.choices = None
        self.fronts = {}
        only_gpus = self.runnable and all(device["is_cpu"] is False for device in self.runnable.values())
        frame = self.arguments.size or (SIZE_OF_GPUS if only_gpus else SIZE[self.arguments.quick])
        self.result["size"] = list(frame)
        if self.judge:
            self.targets = SceneTargets(plan, self.judge, scenes)
            if self.wants("settings"):
                self.points = Points(plan, self.judge, frame, self.memory, self.folder / "truth.pfm")
            if self.wants("fronts"):
                others = FRONT_SCENES if self.points else (SCENE, *FRONT_SCENES)
                self.fronts = {scene: Points(plan, self.judge, frame, empty_memory(), self.folder / f"truth_{scene}.pfm",
                                             scene=scene, families=FRONT_FAMILIES) for scene in others}
            if self.wants("choices"):
                self.choices = choices.Choices(plan, self.judge, frame)

    def measure(self):
        if not self.judge:
            self.plan.absent("reference", "reference", "", None, "no device that is strict has double precision")
            return False
        for part in filter(self.wants, ON_ALL_SCENES):
            getattr(self.targets, f"measure_{part}")()
        for study in filter(None, (self.points, *self.fronts.values(), self.choices)):
            study.measure(self.arguments.repeats)
        return True

    # ---- results

    def add_equal_error(self, label, key, what, *families, **named):
        self.plan.row(key, what, "times", lambda: [each for _, each in equal_error(self.memory["points"], label, *families)],
                      device=label, **named)

    def add_fronts(self):
        """Fills in the data of each scene's chart."""
        found = {scene: points.memory for scene, points in self.fronts.items() if points.truth.facts}
        for points in (self.fronts[scene] for scene in found):
            points.save()
        if self.wants("fronts") and self.result["points"]:
            found = {SCENE: self.memory, **found}
        self.result["fronts"] = {scene: {key: memory[key] for key in ("size", "truth", "points", "not_tried")}
                                 for scene, memory in found.items()} or None

    def add_not_finite(self):
        studies = list(filter(None, (self.targets, self.choices)))
        memories = [self.memory, *(points.memory for points in self.fronts.values())]
        count = sum(memory["not_finite"] + (memory["truth"] or {}).get("not_finite", 0) for memory in memories) + sum(
            study.not_finite for study in studies)
        frames = sum(len(job["runs"][0]["frames"]) for memory in memories for job in memory["jobs"].values()
                     if "error" in job) + sum(study.frames for study in studies)
        self.plan.row("not_finite", f"values that are NaN or infinite, {frames} frames", "values",
                      lambda: [count] if frames else [], target=NONE)
        if count:
            self.plan.failures.add(f"{count} values are NaN or infinite")

    def fill(self):
        for part in filter(self.wants, ON_ALL_SCENES if self.targets else ()):
            getattr(self.targets, f"add_{part}")()
        if self.points and self.points.truth.facts:
            self.points.save()
            for label in self.runnable:
                self.add_equal_error(
                    label, "equal_error", "time at equal RMSE, multi-jittered samples and bounded depth against grid and full depth",
                    target=EQUAL_ERROR, note="full depth is 40 without a cut-off; more depth takes more time; the median "
                                             "over the errors that both have")
                self.add_equal_error(label, "equal_error_pattern",
                                     "  of multi-jittered samples alone, against the grid", ("multijitter",), "grid")
            self.result.update({key: self.memory[key] for key in ("truth", "points", "equal_error", "not_tried")})
        self.add_fronts()
        self.add_not_finite()
        self.result.update(choices=self.choices and self.choices.table(), targets=self.targets and {
            part: getattr(self.targets, part) or None for part in ON_ALL_SCENES})

    def tables(self):
        found = []
        if self.result["points"]:
            found.append(("Settings", [HEAD, *map(cells, self.result["points"])], list(point_words(self.result))))
        for scene, memory in (self.result["fronts"] or {}).items():
            limit, drawn = chart.fronts(memory)
            rows = [cells(point) for these in drawn.values() for point in these]
            found.append((f"Fronts, {scene}", [HEAD, *rows], [chart.fronts_caption(limit, drawn) if drawn else
                                                              "The reference is too coarse to judge any point."]))
        if self.result["choices"]:
            found.append(("What hedron chooses by itself", [choices.HEAD, *map(choices.cells, self.result["choices"])],
                          ["Errors are against double with the same samples, and solids in place of triangles."]))
        return found

    def charts(self):
        return chart.charts(self.result)

    def exit_code(self):
        return super().exit_code() if self.judge else 3


BENCH = Accuracy


# ---- the study's part

ROUNDS = {True: 1, False: 3}  # rounds, at most
SIZES = {"cpu": {True: (48, 36), False: (64, 48)}, "gpu": {True: (320, 180), False: (640, 360)}}


def measure(study):
    """Returns the reason if there is no reference. Fills `cpu` and `gpu`, which render pictures of different sizes; an
    interrupted study continues."""
    arguments, judge = study.arguments, devices.judge(study.runnable.values())
    if judge is None:
        return "No device that is strict has double precision, so there is no reference."
    memories = study.result["accuracy"] = study.result["accuracy"] or {}
    for kind, sizes in SIZES.items():
        group = {label: device for label, device in study.runnable.items() if device["is_cpu"] is (kind == "cpu")}
        if group:
            width, height = sizes[arguments.quick]
            plan = Plan(group, {SCENE: None}, study.program, study.folder, study.news, quick=arguments.quick,
                        options=arguments.options)
            Points(plan, judge, (width, height), memories.setdefault(kind, empty_memory()),
                   arguments.out / f"study_truth_{width}x{height}.pfm", study.save
                   ).measure(min(arguments.repeats, ROUNDS[arguments.quick]))
    return None


LIMITS = (20, 10, 5, 2, 1)  # errors for which the page names a setting
GUIDE = 5  # the error that the chart marks and the first screen shows


def measured(result):
    """Returns what was measured at each size; none if the study was interrupted before its first setting."""
    return [memory for memory in (result["accuracy"] or {}).values() if memory["points"]]


def panels(device, memory):
    """Returns lines of the device's front, and of its other settings."""
    own = [point for point in memory["points"] if point["device"] == device.label and point["rmse"] > 0]
    title = f"{device.name}, {memory['size'][0]} x {memory['size'][1]}"
    others = [point for point in own if not point["on_front"]]
    return [chart.device_front(own, "rmse", "best settings", device.place, mark=device.place, panel=title),
            chart.point_line("other settings", others, "rmse", colour=device.place, mark=device.place + 1, panel=title,
                             joined=False)] if own else []


def choice(points, limit):
    """Returns the fastest setting whose error is no greater, without those that hedron chooses by itself."""
    return front.cheapest([point for point in points if point["family"] != settings.CHOSEN], limit)


def choice_rows(memory, names):
    """Yields for each error the setting that is fastest on any device, and its time on each."""
    labels = list(dict.fromkeys(point["device"] for point in memory["points"]))
    yield ["RMSE at most", "setting", *(f"ms on {names[label]}" for label in labels)]
    for limit in LIMITS:
        best = choice(memory["points"], limit)
        if best is None:
            yield [str(limit), "none of those tried", *["-"] * len(labels)]
            return
        same = {point["device"]: point for point in memory["points"] if point["options"] == best["options"]}
        yield [str(limit), " ".join(best["options"]), *(number(same[label]["ms"], 3) if label in same else "-" for label in labels)]


def fill(section):
    section.table = [["device", "machine", "setting", "options", "milliseconds", "RMSE", "largest error", "front",
                      "recommended"]]
    drawn, found = [], all_devices(section.results, section.part)
    for device in found:
        for memory in measured(device.result):
            drawn += panels(device, memory)
            section.table += [[device.label, device.result["machine"]["name"], point["name"], " ".join(point["options"]),
                               number(point["ms"]), number(point["rmse"], 3), number(point["largest"], 3),
                               "yes" if point["on_front"] else "", point["recommended"] or ""]
                              for point in memory["points"] if point["device"] == device.label]
    for result in section.results:
        for memory in measured(result):
            title = f"Fastest settings, {result['machine']['name']}, {memory['size'][0]} x {memory['size'][1]}{dagger(result)}"
            names = {device.label: device.name for device in found if device.result is result}
            section.shown.append((title, list(choice_rows(memory, names))))
    if drawn:
        section.draw(lines, "built-in scene", "Error against time", f"{best_words(found)}Draft, usual and fine are the fastest "
                     "settings at least as good as grids of 2 x 2, 4 x 4 and 8 x 8 samples. Further left is faster; further down "
                     "is nearer to the reference.", chart.TIME, chart.error_axis("rmse"), drawn,
                     guides={f"error {GUIDE}": GUIDE})


def at_guide(device):
    """Returns (size, the device's fastest setting at the error GUIDE, or None), or None if it was not measured."""
    for memory in measured(device.result):
        own = [point for point in memory["points"] if point["device"] == device.label]
        if own:
            return memory["size"], choice(own, GUIDE)
    return None


def time_words(best, size):
    return f"{ms(best['ms'])} at {size[0]} x {size[1]}"


def best_words(found):
    """Returns a sentence about the device that needs the least time for a pixel."""
    candidates = [(best, size, device.name) for device in found for size, best in filter(None, [at_guide(device)]) if best]
    if not candidates:
        return f"No setting comes to an RMSE of {GUIDE}. "
    best, size, name = min(candidates, key=lambda each: each[0]["ms"] / (each[1][0] * each[1][1]))
    return f"An RMSE of {GUIDE} takes {time_words(best, size)} on {name}, by {' '.join(best['options'])}. "


def opening_cells(device):
    size, best = at_guide(device) or (None, None)
    absent = "none reaches it" if size else answer.ABSENT
    yield f"setting for RMSE {GUIDE}", "rmse", best and best["rmse"], " ".join(best["options"]) if best else absent
    yield "its time", "ms_at_error", best and best["ms"], time_words(best, size) if best else "-"


def failures(result):
    found = []
    for memory in (result["accuracy"] or {}).values():
        found += memory["failures"]
        if memory["not_finite"]:
            found.append(f"{memory['not_finite']} values are NaN or infinite")
    return found


PART = Part(15, "Accuracy: error against time", "Root mean square error (RMSE) of many settings, in steps of 255, and the time of "
            "a frame of the built-in scene. The reference has dense samples in double.", measure=measure, fill=fill,
            failures=failures, cells=opening_cells, lead=3)
