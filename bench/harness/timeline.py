# SPDX-License-Identifier: MIT
"""Which stage of a run was busy when, from the statistics' `seconds` and `began`."""
from harness import charts
from harness.speed_plan import Missing


def intervals(frames):
    """{stage: [(begin, end, frame)]}; stages that took no time at all are left out."""
    stages = {}
    for frame in frames:
        for stage, begin in frame.get("began", {}).items():
            length = frame["seconds"].get(stage, 0)
            if length > 0:
                stages.setdefault(stage, []).append((begin, begin + length, frame["frame"]))
    return {stage: sorted(boxes) for stage, boxes in stages.items()}


def busy_seconds(boxes):
    """How long at least one of them was at work."""
    busy, until = 0.0, float("-inf")
    for begin, end, _ in sorted(boxes):
        busy += max(0.0, end - max(begin, until))
        until = max(until, end)
    return busy


def measure(frames):
    """{"seconds", "stages": {stage: {"busy_seconds", "busy_share", "work_seconds"}}, "slowest",
    "ratio_to_slowest"}: the run goes from the first begin of a stage to the last end."""
    stages = intervals(frames)
    if not stages:
        raise Missing("the statistics of this hedron do not tell when stages began")
    begin = min(boxes[0][0] for boxes in stages.values())
    length = max(end for boxes in stages.values() for _, end, _ in boxes) - begin
    busy = {stage: busy_seconds(boxes) for stage, boxes in stages.items()}
    slowest = max(busy, key=busy.get)
    return {
        "seconds": length,
        "stages": {stage: {"busy_seconds": busy[stage], "busy_share": busy[stage] / length,
                           "work_seconds": sum(end - start for start, end, _ in boxes)}
                   for stage, boxes in stages.items()},
        "slowest": slowest,
        "ratio_to_slowest": length / busy[slowest],
        "boxes": {stage: [list(box) for box in boxes] for stage, boxes in stages.items()},
    }


def text(timeline):
    lines = [f"The run took {1e3 * timeline['seconds']:.0f} ms, {timeline['ratio_to_slowest']:.2f} times its slowest "
             f"stage, {timeline['slowest']}. Busy:"]
    for stage, each in sorted(timeline["stages"].items(), key=lambda entry: -entry[1]["busy_share"]):
        lines.append(f"  {stage:<10} {100 * each['busy_share']:5.1f} %  {1e3 * each['busy_seconds']:8.1f} ms")
    return "\n".join(lines)


def chart(result):
    """(height, commands): a row for each stage, a box for each frame."""
    timeline = result["timeline"]
    names = list(timeline["boxes"])
    first = min(box[0] for boxes in timeline["boxes"].values() for box in boxes)
    caption = (f"{timeline['slowest']} sets the pace: the run takes {timeline['ratio_to_slowest']:.2f} times as long as "
               "it is busy. Boxes are frames, of alternating shade.")
    commands = charts.style(result, "Stages of a run", caption)
    ticks = ", ".join(f"{charts.quoted(name)} {-place}" for place, name in enumerate(names))
    commands += ["set xlabel 'milliseconds since the first stage began'", f"set ytics ({ticks}) noenhanced",
                 f"set yrange [{-len(names) + 0.4}:0.6]", "unset key", "set grid noytics", "$data << END"]
    for place, name in enumerate(names):
        for begin, end, frame in timeline["boxes"][name]:
            shade = int(charts.colour(place)[1:], 16)
            light = sum((((shade >> shift & 255) + 255) // 2) << shift for shift in (0, 8, 16))
            commands.append(f"{1e3 * (begin - first)!r} {1e3 * (end - first)!r} {-place} "
                            f"{light if frame % 2 else shade}")
    commands += ["END", "set style fill solid 0.9 noborder",
                 "plot $data using 1:3:1:2:($3-0.35):($3+0.35):4 with boxxyerror linecolor rgb variable"]
    return 260 + 50 * len(names), commands
