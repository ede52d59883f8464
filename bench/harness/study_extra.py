# SPDX-License-Identifier: MIT
"""The sections of bench/study's page that bench/accuracy and bench/stability draw the charts of."""
from harness import accuracy_chart, accuracy_points, report, stability_charts, stability_table
from harness.study_sections import Section


def accuracy(sources):
    section = Section("accuracy", "Speed against accuracy",
                      "Root mean square error of many settings against a reference of dense samples in double, by the "
                      "time of a frame of the built-in scene; see bench/README.md, bench/accuracy.")
    section.table = [["device", "machine", "setting", "options", "milliseconds", "RMSE", "largest error", "front",
                      "recommended"]]
    for result in sources.results:
        reason = result["left_out"].get("accuracy")
        if reason:
            section.notes.append(reason)
        for memory in (result["accuracy"] or {}).values():
            add_group(sources, section, result, memory)
    return section


def add_group(sources, section, result, memory):
    if not memory["points"]:
        return
    for device in sources.devices:
        if device.result is result and any(point["device"] == device.label for point in memory["points"]):
            add_device(section, device, memory)


def about_device(device, memory):
    """A result as accuracy_chart wants it."""
    width, height = memory["size"]
    place = device.result["machine"]
    named = {**place, "words": f"{place['name']}, {place['cores']} cores"}
    return {"hedron": device.result["hedron"], "machine": named, "devices": [device.entry], "points": memory["points"],
            "truth": memory["truth"], "scene": {"name": f"built-in scene, {width} x {height}", "width": None}}


def add_device(section, device, memory):
    about, label = about_device(device, memory), device.label
    name = f"study_accuracy{device.machine}_{label.replace(':', '')}"
    section.charts[name] = accuracy_chart.chart(about, label, "rmse")
    own = [point for point in memory["points"] if point["device"] == label]
    front = sum(point["on_front"] for point in own)
    told = [f"{word}: {' '.join(point['options'])} in {report.number(point['ms'], 3)} ms"
            for word, point in accuracy_points.recommended(own)]
    section.captions[name] = (f"On {device.short} {front} of {len(own)} settings are on the front, which no other beats in "
                              f"both time and error; recommended: {'; '.join(told)}.")
    section.table += [[label, device.result["machine"]["name"], point["name"], " ".join(point["options"]),
                       report.number(point["ms"]), report.number(point["rmse"], 3), report.number(point["largest"], 3),
                       "yes" if point["on_front"] else "", point["recommended"] or ""] for point in own]


def stability(sources):
    """Of the first machine that has it: every number is the same each time, and everywhere."""
    section = Section("stability", "Stability", "How often methods of geometry and arithmetic fail, hedron's among them, "
                      "at many sizes and distances; see bench/README.md, bench/stability.")
    for result in sources.results:
        reason = result["left_out"].get("stability")
        if reason:
            section.notes.append(reason)
    found = next((result for result in sources.results if result["stability"]), None)
    if found is None:
        return section
    about = {**found["stability"], "hedron": found["hedron"], "machine": found["machine"],
             "scene": {"name": "solids and triangles", "width": None}}
    for name, chart in stability_charts.drawable(about).items():
        section.charts[f"study_{name}"] = chart(about)
        section.captions[f"study_{name}"] = ""
    section.table = [stability_table.HEAD, *[list(row.values()) for row in stability_table.rows(about)]]
    return section


def sections(sources):
    return [section for section in (accuracy(sources), stability(sources)) if section.charts or section.notes]


