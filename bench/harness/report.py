# SPDX-License-Identifier: MIT
"""The result: choosing devices, collecting runs, the JSON file and the table."""
import datetime
import json
import math
import os
from pathlib import Path

from harness import machine, pictures, summary
from harness.program import Problem

VERSION = 1


def device_entry(backend, index, name, driver, strict, reason):
    return {"backend": backend, "index": index, "name": name, "driver": driver, "renderer": None, "strict": strict,
            "reason": reason, "failed": False, "summary": None, "runs": []}


def entries(backends):
    """An entry for each device, and for each backend without one."""
    for backend in backends:
        for device in backend["devices"]:
            yield device_entry(backend["name"], device["index"], device["name"], device["driver"],
                               device["not_strict"] is None, device["unusable"])
        if not backend["devices"]:
            yield device_entry(backend["name"], None, None, None, None, backend["reason"] or "it has no device")


def chosen(backends, wishes):
    """The devices that are asked for, or all."""
    found = list(entries(backends))
    if not wishes:
        return found
    picked = []
    for wish in wishes:
        name, colon, number = wish.partition(":")
        names = [backend["name"] for backend in backends]
        if name not in names or (colon and not number.isdecimal()):
            raise Problem(2, f"--device is '{wish}', expected BACKEND or BACKEND:NUMBER with one of the backends "
                             f"{', '.join(names)}")
        matches = [entry for entry in found if entry["backend"] == name
                   and (not colon or entry["index"] is None or entry["index"] == int(number))]
        if not matches:
            raise Problem(3, f"--device is '{wish}', and 'hedron devices' lists no such device")
        picked += [entry for entry in matches if entry not in picked]
    return picked


def begin(program, arguments):
    return {
        "hedron_bench": VERSION,
        "bench": "frames",
        "complete": False,
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "hedron": {"version": program.version, "options": arguments.options},
        "machine": machine.describe(),
        "scene": {"name": arguments.scene.stem if arguments.scene else "built-in scene",
                  "width": None, "height": None, "samples": None, "depth": None, "rays_per_frame": None},
        "frames": arguments.frames,
        "repeats": arguments.repeats,
        "pictures": None,
        "devices": chosen(program.backends(), arguments.device),
    }


def add_run(result, device, repeat, run):
    """A run that failed gives a reason, and the frames before the failure are no result. A wrong scene
    or option is the same for every device, and ends it all."""
    if run["code"] == 2:
        raise Problem(2, run["message"])
    interrupted = run["code"] is None
    if run["code"] not in (0, None):
        device["reason"] = run["message"]
        device["failed"] = run["code"] != 3
        return
    if not run["frames"]:
        return
    if len(run["frames"]) < 2 and not interrupted:
        raise Problem(2, f"--frames is '{result['frames']}', expected at least two frames, for the first warms up")
    first = run["frames"][0]
    device["renderer"] = first["renderer"]
    result["scene"].update({key: first[key] for key in ("width", "height", "samples", "depth")})
    device["runs"].append({"repeat": repeat, "frames": [
        {"frame": frame["frame"], "warm_up": place == 0, "seconds": frame["seconds"], "rays": frame["rays"],
         "shadow_tests": frame["shadow_tests"], "picture": run["digests"][frame["frame"]]}
        for place, frame in enumerate(run["frames"])]})


def complete(result):
    """Everything that is computed from the runs."""
    devices = result["devices"]
    for device in devices:
        device["summary"] = summary.summarize(device)
    summary.add_ratios(devices)
    result["pictures"] = pictures.compare(devices, result["hedron"]["options"])
    counts = {}
    for device in devices:
        for frame in summary.timed_frames(device):
            counts.setdefault(frame["frame"], summary.rays(frame))
    if counts:
        result["scene"]["rays_per_frame"] = sum(counts.values()) / len(counts)


def write(file, result):
    """The file is the old one or the new one, never a part."""
    part = Path(f"{file}.tmp-{os.getpid()}")
    try:
        part.write_text(json.dumps(result, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")
        part.replace(file)
    except OSError as error:
        raise Problem(1, f"cannot write {file}: {error.strerror}") from error


def number(value, digits=4):
    """So many significant digits, without an exponent."""
    if value is None:
        return "-"
    before = 1 + math.floor(math.log10(value)) if value > 0 else 1
    return f"{value:.{max(0, digits - before)}f}"


def row(device):
    each = device["summary"]
    trace = each["trace_ms"]
    millions = [value if value is None else value / 1e6
                for value in (each["rays_per_second"], each["shadow_tests_per_second"])]
    return [device["backend"], f"{device['index']}  {device['name']}",
            f"{number(trace['median'])} [{number(trace['q1'])}..{number(trace['q3'])}]", number(each["frame_ms"]),
            number(each["frames_per_second"]), number(millions[0]), number(millions[1]),
            number(each["ratio_to_fastest"], 3)]


def lines(rows):
    """The first two columns to the left, the others to the right."""
    widths = [max(len(cells[column]) for cells in rows) for column in range(len(rows[0]))]
    return ["  ".join(cell.ljust(width) if column < 2 else cell.rjust(width)
                      for column, (cell, width) in enumerate(zip(cells, widths))).rstrip() for cells in rows]


def settings(result):
    """The scene in words."""
    scene = result["scene"]
    words = scene["name"]
    if scene["width"] is not None:
        words += (f", {scene['width']} x {scene['height']}, {scene['samples']} x {scene['samples']} samples, "
                  f"depth {scene['depth']}")
    return words


def machine_words(result):
    place = result["machine"]
    if "words" in place:
        return place["words"]
    return f"{place['cpu']}, {place['cores']} {'core' if place['cores'] == 1 else 'cores'}"


def text(result):
    """The table, what could not run, and what was checked."""
    words = [f"hedron {result['hedron']['version']}, {settings(result)}", machine_words(result), ""]
    rows = [["backend", "device", "trace ms [q1..q3]", "frame ms", "frames/s", "M rays/s", "M shadow tests/s",
             "ratio"]]
    rows += [row(device) for device in result["devices"] if device["summary"]]
    if len(rows) > 1:
        words += lines(rows) + [""]
    for device in result["devices"]:
        if device["reason"] is not None:
            kind = "failed" if device["failed"] else "cannot run"
            words.append(f"{summary.label(device)} {kind}: {device['reason']}")
    if not result["complete"]:
        words.append("Interrupted: only what was measured before counts.")
    words.append(result["pictures"]["sentence"])
    return "\n".join(words)
