# SPDX-License-Identifier: MIT
"""Error against time, measured as bench/study accuracy does; an interrupted study goes on where it was."""
from harness.accuracy import chart
from harness.accuracy.points import SCENE, Points, empty_memory, recommended
from harness.measure.numbers import number
from harness.measure.plan import Plan
from harness.page.part import Part
from harness.run import devices

ROUNDS = {True: 1, False: 3}  # at most
SIZES = {"cpu": {True: (48, 36), False: (64, 48)}, "gpu": {True: (320, 180), False: (640, 360)}}


def measure(study):
    """Fills `cpu` and `gpu`, for they render pictures of different sizes."""
    arguments, judge = study.arguments, devices.judge(study.runnable.values())
    if judge is None:
        return "No device that is strict has double precision, so there is no reference."
    memories = study.result["accuracy"] = study.result["accuracy"] or {}
    for kind, sizes in SIZES.items():
        group = {label: device for label, device in study.runnable.items() if device["is_cpu"] is (kind == "cpu")}
        if group:
            size, memory = sizes[arguments.quick], memories.setdefault(kind, empty_memory())
            plan = Plan(group, {SCENE: None}, study.program, study.folder, study.news)
            Points(plan, group, judge, size, arguments.options, arguments.quick, memory,
                   arguments.out / f"study_truth_{size[0]}x{size[1]}.pfm", study.save
                   ).measure(min(arguments.repeats, ROUNDS[arguments.quick]))
    return None


def about_device(device, memory):
    """A result as the chart wants it."""
    width, height = memory["size"]
    place = device.result["machine"]
    named = {**place, "words": f"{place['name']}, {place['cores']} cores"}
    return {"hedron": device.result["hedron"], "machine": named, "devices": [device.entry], "points": memory["points"],
            "truth": memory["truth"], "scene": {"name": f"built-in scene, {width} x {height}"}}


def add_device(section, device, memory):
    label, own = device.label, [point for point in memory["points"] if point["device"] == device.label]
    if not own:
        return
    name = f"study_accuracy{device.machine}_{label.replace(':', '')}"
    section.charts[name] = chart.chart(about_device(device, memory), label, "rmse")
    told = [f"{word}: {' '.join(point['options'])} in {number(point['ms'], 3)} ms" for word, point in recommended(own)]
    section.captions[name] = (f"On {device.short} {sum(point['on_front'] for point in own)} of {len(own)} settings are on the "
                              f"front, which no other beats in both time and error; recommended: {'; '.join(told)}.")
    section.table += [[label, device.result["machine"]["name"], point["name"], " ".join(point["options"]),
                       number(point["ms"]), number(point["rmse"], 3), number(point["largest"], 3),
                       "yes" if point["on_front"] else "", point["recommended"] or ""] for point in own]


def fill(sources, section):
    section.table = [["device", "machine", "setting", "options", "milliseconds", "RMSE", "largest error", "front",
                      "recommended"]]
    for device in sources.devices:
        for memory in (device.result["accuracy"] or {}).values():
            add_device(section, device, memory)


def failures(result):
    found = []
    for memory in (result["accuracy"] or {}).values():
        found += memory["failures"]
        if memory["not_finite"]:
            found.append(f"{memory['not_finite']} values are NaN or infinite")
    return found


PART = Part(15, "Speed against accuracy", "Root mean square error of many settings against a reference of dense samples in "
            "double, by the time of a frame of the built-in scene; see bench/README.md, bench/study accuracy.", measure=measure,
            fill=fill, failures=failures)
