# SPDX-License-Identifier: MIT
"""The tables of bench/accuracy beside that of the targets: settings, and what hedron chooses by itself."""
from harness import accuracy_points, report, speed_report


def spread(entry):
    return (f"{report.number(entry['trace_ms']['median'])} [{report.number(entry['trace_ms']['q1'])}.."
            f"{report.number(entry['trace_ms']['q3'])}]")


def point_rows(points):
    rows = [["setting", "device", "ms [q1..q3]", "RMSE", "largest", "M rays", "front", "recommended"]]
    for point in points:
        rows.append([point["name"], point["device"], spread(point), report.number(point["rmse"], 3),
                     report.number(point["largest"], 3), report.number(1e-6 * sum(point["rays"].values()), 3),
                     "front" if point["on_front"] else "", point["recommended"] or ""])
    return rows


def choice_rows(table):
    rows = [["choice", "way", "device", "scene", "ms [q1..q3]", "to automatic", "RMSE", "largest"]]
    for entry in table:
        if entry["trace_ms"] is None:
            rows.append([entry["choice"], entry["way"], entry["device"], entry["scene"], entry["reason"] or "-"] + [""] * 3)
            continue
        rows.append([entry["choice"], entry["way"], entry["device"], entry["scene"], spread(entry),
                     report.number(entry["ratio"], 3), report.number(entry["rmse"], 3),
                     report.number(entry["largest"], 3)])
    return rows


def truth_words(result):
    truth = result["truth"]
    edge = f"at most {truth['edge_error']} of 255 off on an edge between black and white" if truth["edge_error"] else (
        "coarser than hedron's own")
    return (f"Reference: {truth['samples']} x {truth['samples']} dense samples in double, {edge}; what it leaves out is "
            f"at most {report.number(truth['missing']['largest'], 2)} of 255 (--max-error {truth['max_error']:g}); a "
            f"reference of a quarter of the samples has RMSE {report.number(truth['to_quarter_of_samples']['rmse'], 3)} "
            f"and is off by {report.number(truth['to_quarter_of_samples']['largest'], 3)} at most. "
            f"{report.number(truth['seconds'], 3)} s on {truth['device']}.")


def equal_words(result):
    return [f"Equal RMSE on {each['device']}: at {report.number(each['rmse'], 3)} adaptive sampling and bounded depth "
            f"take {report.number(each['ratio'], 3)} of the time of the grid in full depth."
            for each in result["equal_error"] or []]


def recommended_words(result):
    return [f"Recommended on {point['device']}, {word}: {' '.join(point['options'])}: {report.number(point['ms'], 3)} ms, "
            f"RMSE {report.number(point['rmse'], 3)}, largest {report.number(point['largest'], 3)}."
            for device in result["devices"] for word, point in accuracy_points.recommended(
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


def text(result):
    parts = [speed_report.text(result)]
    for title, rows, lines in sections(result):
        parts += ["", f"{title}:", *report.lines(rows), "", *lines]
    return "\n".join(parts)


def markdown(result):
    def line(words):
        return "| " + " | ".join(word.replace("|", "\\|") for word in words) + " |"
    parts = [speed_report.markdown(result)]
    for title, rows, lines in sections(result):
        parts += [f"## {title}", "", line(rows[0]), "|" + "---|" * len(rows[0]), *map(line, rows[1:]), "",
                  *[f"- {words}" for words in lines], ""]
    return "\n".join(parts)
