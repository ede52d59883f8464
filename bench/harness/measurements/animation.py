# SPDX-License-Identifier: MIT
"""The built-in scene along its animation."""
from harness.chart.axes import Axis
from harness.chart.lines import lines
from harness.measure.jobs import chosen_runs, counted
from harness.measure.numbers import spread
from harness.measure.plan import DEFAULT
from harness.page.section import TIME_AXIS, WHOLE_FRAME, Part, ratio

BETWEEN = {True: 24, False: 8}  # frames between timed ones, quickly and not so quickly, of 240


def add(plan):
    for label, _, view, scale in plan.each():
        plan.point("", 0, label, DEFAULT, view, frames=",".join(map(str, range(0, 240, BETWEEN[plan.quick]))), scale=scale)


def by_frame(entry):
    """Returns [(frame, spread)]."""
    times = {}
    for frame in (frame for run in chosen_runs(entry) for frame in counted(run)):
        times.setdefault(frame["frame"], []).append(1e3 * entry["scale"] * frame["seconds"]["trace"])
    return [(frame, spread(values)) for frame, values in sorted(times.items())]


def most_varied(drawn):
    """Returns (line, slowest by fastest) of the line that differs most from frame to frame."""
    times = [[each["median"] for _, each in line.points] for line in drawn]
    ratios = [max(each) / min(each) if min(each) > 0 else 1 for each in times]
    return drawn[ratios.index(max(ratios))], max(ratios)


def fill(section):
    drawn = [device.line(points=by_frame(device.entries()[0])) for device in section.devices]
    line, times = most_varied(drawn)
    slowest = max(line.points, key=lambda point: point[1]["median"])
    section.draw(lines, WHOLE_FRAME, "Time of tracing along the animation",
                 f"Frames differ most on {line.short}: the slowest, frame {slowest[0]}, takes {ratio(times)} as long as the "
                 "fastest.", Axis("frame number"), TIME_AXIS, drawn)
    section.tabulate(lambda entry: f"frames {entry['frames']}")


PART = Part(2, "Along the animation", "Tracing of the built-in scene, frame by frame.", add, fill=fill)
