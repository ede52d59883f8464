# SPDX-License-Identifier: MIT
"""The result that every measurement writes: one shape, one JSON file. An interrupted bench/study continues from its own
result: it is saved after every measurement, and earlier measurements by the same program are kept."""
import datetime
import json
import os
from pathlib import Path

from harness.measure.jobs import summarize
from harness.run import machine
from harness.run.program import Problem

VERSION = 1


def begin(bench, program, arguments, devices, **more):
    return {"hedron_bench": VERSION, "bench": bench, "complete": False,
            "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
            "quick": arguments.quick, "repeats": arguments.repeats,
            "hedron": {"version": program.version, "options": arguments.options}, "machine": machine.describe(),
            "devices": devices, "pictures": None, "failures": [], **more}


def write_text(file, text):
    """Replaces the file atomically, so that it is the old one or the new one."""
    part = Path(f"{file}.tmp-{os.getpid()}")
    try:
        part.write_text(text, encoding="utf-8")
        part.replace(file)
    except OSError as error:
        raise Problem(1, f"cannot write {file}: {error.strerror}") from error


def write(file, result):
    write_text(file, json.dumps(result, indent=1, ensure_ascii=False, allow_nan=False) + "\n")


def read(file, bench):
    """Returns what `bench` wrote; raises Problem if it did not write the file."""
    try:
        result = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise Problem(2, f"cannot read {file}: {error.strerror}") from error
    except ValueError as error:
        raise Problem(2, f"{file} is not valid JSON: {error}") from error
    if not isinstance(result, dict) or result.get("bench") != bench:
        raise Problem(2, f"{file} is not what bench/study{'' if bench == 'study' else ' ' + bench} writes")
    if result.get("hedron_bench") != VERSION:
        raise Problem(2, f"{file} has version {result.get('hedron_bench')} of the format, expected {VERSION}")
    return result


# ---- of bench/study

KEYS = ("complete", "date", "quick", "hedron", "machine", "devices", "parts", "done", "left_out", "failed", "measurements",
        "bounds", "accuracy", "stability")
# Keys that later measurements extend.
KEPT = ("date", "bounds", "accuracy", "stability", "promise", "certificates", "tuning", "gallery")
SAME_OF_DEVICES = ("label", "name", "driver", "reason")
SAME_OF_HEDRON = ("options", "sha256")
IDENTITY = ("part", "series", "x", "device", "scene", "options", "frames", "output", "warm_up", "scale", "cold")


def read_study(file):
    """Returns a result of bench/study; raises Problem if the file is none."""
    result = read(file, "study")
    missing = [key for key in KEYS if key not in result]
    if missing:
        raise Problem(2, f"{file} is damaged: it has no {', '.join(missing)}")
    try:
        summarize(result["measurements"])
    except (KeyError, TypeError, IndexError, AttributeError, ValueError) as error:
        raise Problem(2, f"{file} is damaged: {type(error).__name__} {error}") from error
    return result


def is_unfinished(result):
    """Returns whether a requested part is not complete."""
    return not set(result["parts"]) <= set(result["done"])


def missing_parts(result, parts):
    """Returns {part: reason why it is missing}."""
    reasons = {**dict.fromkeys(set(parts) - set(result["parts"]), "it was not asked for"),
               **dict.fromkeys(set(result["parts"]) - set(result["done"]), "it was interrupted"),
               **result["left_out"], **result["failed"]}
    return {part: reasons[part] for part in parts if part in reasons}


def question(result):
    """Returns the values that must be equal for a study to continue another."""
    return [result["bench"], result["quick"], result["machine"]["cpu"], *(result["hedron"][key] for key in SAME_OF_HEDRON),
            *(device[key] for device in result["devices"] for key in SAME_OF_DEVICES)]


def identity(entry):
    return json.dumps([entry[key] for key in IDENTITY])


def merge(old, new, entries, parts, order):
    """Fills `new` with these measurements; `old`, if any, may already have some. Parts that were not requested stay unchanged.
    `order` has all parts."""
    if old is not None:
        known = {identity(entry): entry for entry in old["measurements"]}
        entries = [known.get(identity(entry), entry) for entry in entries]
        entries += [entry for entry in old["measurements"] if entry["part"] not in parts]
        new.update({key: old[key] for key in KEPT if key in old})
        new["machine"] = {**old["machine"], "name": new["machine"]["name"] or old["machine"]["name"]}
    new["machine"]["name"] = new["machine"]["name"] or new["machine"]["cpu"]
    before = old or {"parts": [], "done": [], "left_out": {}, "failed": {}}
    new["parts"] = [part for part in order if part in parts or part in before["parts"]]
    new["done"] = [part for part in before["done"] if part not in parts]
    for key in ("left_out", "failed"):
        new[key] = {part: words for part, words in before[key].items() if part not in parts}
    new["measurements"] = sorted(entries, key=lambda entry: order.index(entry["part"]))


# ---- in words

def scene_words(result):
    scene = result["scene"]
    if scene.get("width") is None:
        return scene["name"]
    return (f"{scene['name']}, {scene['width']} x {scene['height']}, {scene['samples']} x {scene['samples']} samples, "
            f"depth {scene['depth']}")


def machine_words(result):
    place = result["machine"]
    return place.get("words") or f"{place['cpu']}, {place['cores']} {'core' if place['cores'] == 1 else 'cores'}"
