# SPDX-License-Identifier: MIT
"""The result of bench/speed: the JSON file, the table, and the table for documents."""
import datetime
import os

from harness import gpu_peak, machine, report

CORES = 2
FEW_ROWS = 5


def few_cores():
    """What the targets for two cores are measured on; None: there are no more."""
    usable = sorted(os.sched_getaffinity(0))
    return set(usable[:CORES]) if len(usable) > CORES else None


def device_entry(entry, backends):
    """As of report.device_entry, with what `hedron devices` tells of its speed."""
    known = next((device for backend in backends for device in backend["devices"]
                  if (device["backend"], device["index"]) == (entry["backend"], entry["index"])), {})
    keys = ("backend", "index", "name", "driver", "strict", "reason")
    return {**{key: entry[key] for key in keys},
            **{key: known.get(key) for key in ("is_cpu", "compute_units", "clock_mhz")}}


def begin(program, arguments, devices):
    return {
        "hedron_bench": report.VERSION,
        "bench": "speed",
        "complete": False,
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "quick": arguments.quick,
        "hedron": {"version": program.version, "options": arguments.options},
        "machine": machine.describe(),
        "few_cores": min(CORES, machine.cores()),
        "repeats": arguments.repeats,
        "devices": devices,
        "rows": [],
        "pictures": None,
        "kernel_rates": None,
        "counted": None,
        "film": None,
        "timeline": None,
        "runs": [],
    }


def run_entry(job, run):
    return {"device": job.device, "scene": job.scene, "options": list(job.options), "output": job.output,
            "wall": run["wall"], "cpu": run["cpu"], "frames": [
                {"frame": frame["frame"], "width": frame["width"], "height": frame["height"],
                 "samples": frame["samples"], "depth": frame["depth"], "seconds": frame["seconds"],
                 "rays": frame["rays"], "shadow_tests": frame["shadow_tests"]} for frame in run["frames"]]}


def target_words(row):
    if row["least"] is None:
        return "", ""
    return tuple(report.number(row[key], 3).rstrip("0").rstrip(".") if row[key] < 1 else f"{row[key]:g}"
                 for key in ("least", "aim"))


def cells(row):
    least, aim = target_words(row)
    if row["figure"] is None:
        return [row["what"], row["device"] or "-", least, aim, "-", row["unit"], "", "", ""]
    spread = f"{report.number(row['figure'])} [{report.number(row['q1'])}..{report.number(row['q3'])}]"
    ratios = [report.number(row[key], 3) if row[key] is not None else "" for key in ("ratio_to_least", "ratio_to_aim")]
    return [row["what"], row["device"] or "-", least, aim, spread, row["unit"], *ratios, row["verdict"] or ""]


HEAD = ["what", "device", "least", "aim", "figure [q1..q3]", "unit", "to least", "to aim", "met"]


def remarks(result):
    """What the table alone does not tell, each once, with the rows that it is about; many rows by their
    keys."""
    said = {}
    for row in result["rows"]:
        if row["reason"]:
            alike = [each["what"] for each in result["rows"] if each["reason"] == row["reason"]]
            name = row["what"].strip() if len(alike) <= FEW_ROWS else row["key"]
            said.setdefault(row["reason"], {})[name] = True
        if row["note"]:
            said.setdefault(row["note"], {})[row["key"]] = True
    return [f"{', '.join(who)}: {words}" for words, who in said.items()]


def head_lines(result):
    load = result["machine"]
    few = f"targets for two cores on {result['few_cores']}; " if "few_cores" in result else ""
    lines = [f"hedron {result['hedron']['version']}, {report.machine_words(result)}; {few}"
             f"load {load['load_before'][0]} before, {(load['load_after'] or ['?'])[0]} after"]
    lines += [f"{device['label']}: {device['name'] or '-'}{', cannot run: ' + device['reason'] if device['reason'] else ''}"
              for device in result["devices"]]
    if result["quick"]:
        lines.append("QUICK: few frames and repeats; where a time is scaled, its row says so.")
    if result["hedron"]["options"]:
        lines.append(f"CHANGED by {' '.join(result['hedron']['options'])}: no figure answers to its target.")
    return lines


def tail_lines(result):
    lines = remarks(result)
    if not result["complete"]:
        lines.append("Interrupted: only what was measured before counts.")
    return lines + [result["pictures"]["sentence"]]


def text(result):
    rows = [HEAD, *[cells(row) for row in result["rows"]]]
    return "\n".join([*head_lines(result), "", *report.lines(rows), "", *tail_lines(result)])


def markdown(result):
    def line(words):
        return "| " + " | ".join(word.strip().replace("|", "\\|") for word in words) + " |"
    table = [line(HEAD), "|" + "---|" * len(HEAD), *[line(cells(row)) for row in result["rows"]]]
    return "\n".join([*[f"- {words}" for words in head_lines(result)], "", *table, "",
                      *[f"- {words}" for words in tail_lines(result)], ""])


def peaks(devices):
    """For the model: what each GPU can do at most, in lanes a second."""
    return {device["label"]: gpu_peak.lane_rate(device, devices) for device in devices
            if device["is_cpu"] is False}
