# SPDX-License-Identifier: MIT
"""A run of one frame, from the start of the program to the file."""
from statistics import median

from harness.chart.rows import Row, ms, rows
from harness.measure.jobs import chosen_runs
from harness.measure.numbers import spread
from harness.measure.plan import DEFAULT
from harness.page.section import Part, few

COLD, WARM = "nothing compiled", "compiled before"
STAGES = ("program and device start", "compiling kernels", "scene and kernels to the device", "prepare", "trace",
          "read back", "convert and encode PNG")


def add(plan):
    for label, device in plan.runnable.items():
        for cold, series in ((True, COLD), (False, WARM))[device["backend"] == "c":]:  # C is compiled ahead
            plan.point(series, 0, label, DEFAULT, ("--size", "640x360"), frames="0", output="#######.png",
                       warm_up=False, cold=cold)


def stage_seconds(run):
    """Returns seconds of the stages of a run of one frame; None: a warm run builds no kernels."""
    frame = run["frames"][0]
    seconds, began = frame["seconds"], {stage: value for stage, value in frame["began"].items() if value is not None}
    end = max(value + seconds[stage] for stage, value in began.items())
    return dict(zip(STAGES, (max(0.0, run["wall"] - end), None, min(began.values()), seconds["prepare"], seconds["trace"],
                             seconds["copy"], seconds["convert"] + seconds["store"])))


def stage_spreads(device):
    """Returns {stage: spread in milliseconds}."""
    warm, cold = [[run for entry in device.entries(series=series) for run in chosen_runs(entry)] for series in (WARM, COLD)]
    if not warm:
        return {}
    each = [stage_seconds(run) for run in warm]
    found = {name: spread([1e3 * seconds[name] for seconds in each]) for name in STAGES if each[0][name] is not None}
    if cold:
        usual = median(run["wall"] for run in warm)
        found["compiling kernels"] = spread([max(0.0, 1e3 * (run["wall"] - usual)) for run in cold])
    return found


def fill(section):
    drawn, sentences = [], []
    for device in section.devices:
        found = stage_spreads(device)
        drawn += [Row(name, found[name], ms(found[name]["median"]), device.place, group=device.name) for name in STAGES
                  if name in found]
        if found:
            longest = max(found, key=lambda name: found[name]["median"])
            sentences.append(f"on {device.name} the longest stage is {longest}: {ms(found[longest]['median'])}")
    if drawn:
        section.draw(rows, "one frame of the built-in scene to PNG, 640 x 360",
                     "Start-up and stages of a run of one frame", few(sentences), "milliseconds", drawn)
        section.tabulate(lambda entry: entry["series"])


PART = Part(13, "Start-up and stages", "Whole runs of one frame. The time of compiling is how much longer a run takes with empty "
            "caches; the kernels of the C backend are compiled ahead.", add, fill=fill)
