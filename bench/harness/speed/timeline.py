# SPDX-License-Identifier: MIT
"""The busy times of a run's stages, from the statistics' `seconds` and `began`."""
from harness.chart.rows import Row, rows
from harness.measure.rows import Missing


def intervals(frames):
    """Returns {stage: [(begin, end, frame)]}; stages that took no time at all are left out."""
    stages = {}
    for frame in frames:
        for stage, begin in frame.get("began", {}).items():
            if frame["seconds"].get(stage, 0) > 0:
                stages.setdefault(stage, []).append((begin, begin + frame["seconds"][stage], frame["frame"]))
    return {stage: sorted(boxes) for stage, boxes in stages.items()}


def busy_seconds(boxes):
    """Returns how long at least one of them was at work."""
    busy, until = 0.0, float("-inf")
    for begin, end, _ in sorted(boxes):
        busy += max(0.0, end - max(begin, until))
        until = max(until, end)
    return busy


def measure(frames):
    """Returns {"seconds", "stages": {stage: {"busy_seconds", "busy_share", "work_seconds"}}, "slowest", "ratio_to_slowest"}.
    The run lasts from the first begin of a stage to the last end."""
    stages = intervals(frames)
    if not stages:
        raise Missing("the statistics of this hedron do not have the times at which stages began")
    begin = min(boxes[0][0] for boxes in stages.values())
    length = max(end for boxes in stages.values() for _, end, _ in boxes) - begin
    busy = {stage: busy_seconds(boxes) for stage, boxes in stages.items()}
    slowest = max(busy, key=busy.get)
    return {"seconds": length, "slowest": slowest, "ratio_to_slowest": length / busy[slowest],
            "stages": {stage: {"busy_seconds": busy[stage], "busy_share": busy[stage] / length,
                               "work_seconds": sum(end - start for start, end, _ in boxes)} for stage, boxes in stages.items()},
            "boxes": {stage: [list(box) for box in boxes] for stage, boxes in stages.items()}}


def table(timeline):
    """Returns (title, rows, lines below)."""
    rows = [[stage, f"{100 * each['busy_share']:.1f} %", f"{1e3 * each['busy_seconds']:.1f}"]
            for stage, each in sorted(timeline["stages"].items(), key=lambda entry: -entry[1]["busy_share"])]
    return ("Stages of a run", [["stage", "busy", "ms"], *rows], [
        f"The run took {1e3 * timeline['seconds']:.0f} ms, {timeline['ratio_to_slowest']:.2f} times its slowest stage, "
        f"{timeline['slowest']}."])


def chart(result):
    """Returns a chart with a row for each stage and a box for each frame."""
    timeline = result["timeline"]
    first = min(box[0] for stage in timeline["boxes"].values() for box in stage)
    caption = (f"{timeline['slowest'].capitalize()} limits the run, which takes {timeline['ratio_to_slowest']:.2f} times as "
               "long as this stage is busy. Frames alternate in colour.")
    drawn = [Row(stage, {"median": 1e3 * (begin - first), "q1": 1e3 * (begin - first), "q3": 1e3 * (end - first)},
                 "" if place else f"{100 * timeline['stages'][stage]['busy_share']:.0f} % busy", frame % 2)
             for stage, frames in timeline["boxes"].items() for place, (begin, end, frame) in enumerate(frames)]
    return rows(result, "Stages of a run", caption, "milliseconds since the first stage began", drawn, spans=True)
