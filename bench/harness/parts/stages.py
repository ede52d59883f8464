# SPDX-License-Identifier: MIT
"""A run of one frame, with all that comes before and after."""
from statistics import median

from harness.chart.bars import Row, ms, rows
from harness.measure.jobs import chosen_runs
from harness.measure.numbers import spread
from harness.measure.points import DEFAULT
from harness.page.part import Part
from harness.page.section import few, sentence, table_of

COLD, WARM = "nothing compiled", "compiled before"
STAGES = ("program and device start", "kernels built", "scene and kernels to the device", "prepare", "trace",
          "read back", "convert and encode PNG")


def add(points):
    for label, device in points.devices.items():
        for cold, series in ((True, COLD), (False, WARM))[device["backend"] == "c":]:  # C is compiled ahead
            points.add(series, 0, label, DEFAULT, ("--size", "640x360"), frames="0", output="#######.png",
                       warm_up=False, cold=cold)


def stage_seconds(run):
    """Seconds of the parts of a run of one frame, without the building of kernels."""
    frame = run["frames"][0]
    seconds, began = frame["seconds"], frame["began"]
    end = max(began[stage] + seconds[stage] for stage in began if began[stage] is not None)
    return {"program and device start": max(0.0, run["wall"] - end),
            "scene and kernels to the device": min(value for value in began.values() if value is not None),
            "prepare": seconds["prepare"], "trace": seconds["trace"], "read back": seconds["copy"],
            "convert and encode PNG": seconds["convert"] + seconds["store"]}


def stage_spreads(device):
    """{part of a run: spread in milliseconds}"""
    warm, cold = [device.entries("stages", series=series) for series in (WARM, COLD)]
    if not warm:
        return {}
    each = [stage_seconds(run) for run in chosen_runs(warm[0])]
    found = {name: spread([1e3 * seconds[name] for seconds in each]) for name in each[0]}
    if cold:
        usual = median(run["wall"] for run in chosen_runs(warm[0]))
        found["kernels built"] = spread([max(0.0, 1e3 * (run["wall"] - usual)) for run in chosen_runs(cold[0])])
    return found


def fill(sources, section):
    drawn, told = [], []
    for device in sources.with_part("stages"):
        found = stage_spreads(device)
        for place, name in enumerate(STAGES):
            if name in found:
                drawn.append(Row(f"{device.short}, {name}", found[name], ms(found[name]["median"]), place,
                                 group=str(device.place)))
        if found:
            longest = max(found, key=lambda name: found[name]["median"])
            told.append(f"{longest} takes longest on {device.short}, {ms(found[longest]['median'])}")
    if not drawn:
        return
    section.draw("stages", rows, sources.about("one frame of the built-in scene to PNG, 640 x 360, 3 x 3 samples"),
                 "Start-up and stages of a run of one frame", sentence(few(told) + "."), "milliseconds", drawn)
    section.table = table_of(sources, "stages", lambda entry: entry["series"], "what")


PART = Part(13, "Start-up and stages", "Whole runs of one frame. What a run takes longer with empty caches is the building of "
            "kernels; those of the C backend are compiled ahead.", add, fill=fill)
