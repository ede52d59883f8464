# SPDX-License-Identifier: MIT
"""Error against time: a chart for each device and each kind of error, and one for each scene with the fronts of all."""
from harness.accuracy import front
from harness.accuracy.points import recommended
from harness.accuracy.settings import FAMILIES
from harness.accuracy.truth import own_error
from harness.chart.axes import Axis
from harness.chart.lines import Line, lines
from harness.chart.rows import one_value
from harness.chart.sheet import device_title
from harness.measure.numbers import number

ERRORS = {"rmse": "root mean square error", "largest": "largest error"}
ENOUGH_NEARER = 10  # ratio of an error to the reference's own, below which the reference cannot judge it
LEAST = 1e-4  # steps of 255: smaller errors are drawn there
TIME = Axis("milliseconds for each frame", True)


def error_axis(error):
    return Axis(f"{ERRORS[error]}, steps of 255", True)


def caption(truth, points, error):
    words = [f"{word.capitalize()}: {' '.join(point['options'])} takes {number(point['ms'], 3)} ms."
             for word, point in recommended(points)]
    words += ["These are the fastest settings at least as good as grids of 2 x 2, 4 x 4 and 8 x 8."] * bool(words)
    made = (f"The reference has {truth['samples']} x {truth['samples']} samples and an error of at most "
            f"{number(truth['missing']['largest'], 2)} of 255; a reference of a quarter of the samples differs by "
            f"{number(truth['to_quarter_of_samples'][error], 2)}.")
    return " ".join([*words, made, "Times are medians of neighbouring frames."])


def point_line(name, points, error, **named):
    return Line(name, [(point["ms"], one_value(point[error])) for point in points], **named)


def chart(result, label, error):
    """Returns a chart of every setting of a device by its family, the best front, and recommended settings."""
    points = [{**point, error: max(point[error], LEAST)} for point in result["points"] if point["device"] == label]
    device = next(each for each in result["devices"] if each["label"] == label)
    title = f"{ERRORS[error].capitalize()} against time, {device_title(device)}"
    drawn = [device_front(points, error, "the best front", 0)]
    for place, family in enumerate(name for name in FAMILIES if any(each["family"] == name for each in points)):
        drawn.append(point_line(FAMILIES[family], [each for each in points if each["family"] == family], error, colour=place + 1,
                                mark=place, joined=False))
    return lines(result, title, caption(result["truth"], points, error), TIME, error_axis(error), drawn)


def device_front(points, error, name, colour, **named):
    """Returns the best front of a device's points, with labels at recommended settings."""
    words = {}
    for word, point in recommended(points):
        words.setdefault((point["ms"], point[error]), word)
    return point_line(name, front.front(points, error), error, colour=colour,
                      labels=tuple((*place, word) for place, word in words.items()), **named)


# ---- all devices

def fronts(memory):
    """Returns (smallest error drawn, {device: its front}) of points far enough from the truth for the reference to judge."""
    limit = ENOUGH_NEARER * own_error(memory["truth"])
    points = [point for point in memory["points"] if point["rmse"] >= max(limit, LEAST)]
    labels = dict.fromkeys(point["device"] for point in points)
    return limit, {label: front.front([point for point in points if point["device"] == label]) for label in labels}


def fronts_caption(limit, drawn):
    sentences = [f"{label} comes to {number(these[-1]['rmse'], 3)} in {number(these[-1]['ms'], 3)} ms ({these[-1]['name']})."
            for label, these in drawn.items()]
    return (f"{' '.join(sentences)} The chart ends at {ENOUGH_NEARER} times the reference's own error of "
            f"{number(limit / ENOUGH_NEARER, 2)}.")


def fronts_chart(about, memory):
    """Returns a chart of the fronts of a machine's devices, or None if the reference can judge no point."""
    limit, drawn = fronts(memory)
    if not drawn:
        return None
    titles = {device["label"]: device_title(device) for device in about["devices"]}
    return lines(about, "Error against time, the front of every device", fronts_caption(limit, drawn), TIME, error_axis("rmse"), [
        point_line(titles[label], these, "rmse", colour=place, mark=place) for place, (label, these) in enumerate(drawn.items())])


def fronts_charts(result):
    """Returns {name: chart}."""
    found = {}
    for scene, memory in (result["fronts"] or {}).items():
        width, height = memory["size"]
        chart_of_scene = fronts_chart({**result, "scene": {"name": f"{scene}, {width} x {height}"}}, memory)
        if chart_of_scene:
            found[f"accuracy_fronts_{scene}"] = chart_of_scene
    return found


def charts(result):
    """Returns {name: chart}."""
    labels = dict.fromkeys(point["device"] for point in result["points"] or [])
    return {f"accuracy_{label.replace(':', '')}_{error}": chart(result, label, error) for label in labels
            for error in ERRORS} | fronts_charts(result)
