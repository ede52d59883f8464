# SPDX-License-Identifier: MIT
"""The result of bench/study, which is also what an interrupted study goes on from: it is saved after every
measurement, and what the same program measured before is kept."""
import json

from harness.measure.jobs import summarize
from harness.run.program import Problem
from harness.store import result as results

KEYS = ("complete", "date", "quick", "hedron", "machine", "devices", "parts", "done", "left_out", "failed", "measurements",
        "bounds", "accuracy", "stability")
KEPT = ("date", "bounds", "accuracy", "stability")  # what goes on with the measurements
SAME_OF_DEVICES = ("label", "name", "driver", "reason")
SAME_OF_HEDRON = ("options", "sha256")
IDENTITY = ("part", "series", "x", "device", "scene", "options", "frames", "output", "warm_up", "scale", "cold")


def read(file):
    """A result of bench/study; raises Problem where the file is none."""
    result = results.read(file, "study")
    missing = [key for key in KEYS if key not in result]
    if missing:
        raise Problem(2, f"{file} is damaged: it has no {', '.join(missing)}")
    try:
        summarize(result["measurements"])
    except (KeyError, TypeError, IndexError, AttributeError, ValueError) as error:
        raise Problem(2, f"{file} is damaged: {type(error).__name__} {error}") from error
    return result


def question(result):
    """What must be alike for the measurements of two to answer the same one."""
    return [result["bench"], result["quick"], result["machine"]["cpu"], *(result["hedron"][key] for key in SAME_OF_HEDRON),
            *(device[key] for device in result["devices"] for key in SAME_OF_DEVICES)]


def is_continued(old, new):
    return question(old) == question(new)


def identity(entry):
    return json.dumps([entry[key] for key in IDENTITY])


def merge(old, new, entries, parts, order):
    """Fills `new` with these measurements, of which `old`, if any, may have some. Parts that are not asked for stay as they
    were. `order` has all parts."""
    if old is not None:
        known = {identity(entry): entry for entry in old["measurements"]}
        entries = [known.get(identity(entry), entry) for entry in entries]
        entries += [entry for entry in old["measurements"] if entry["part"] not in parts]
        new.update({key: old[key] for key in KEPT})
        new["machine"] = {**old["machine"], "name": new["machine"]["name"] or old["machine"]["name"]}
    new["machine"]["name"] = new["machine"]["name"] or new["machine"]["cpu"]
    before = old or {"parts": [], "done": [], "left_out": {}, "failed": {}}
    new["parts"] = [part for part in order if part in parts or part in before["parts"]]
    new["done"] = [part for part in before["done"] if part not in parts]
    for key in ("left_out", "failed"):
        new[key] = {part: words for part, words in before[key].items() if part not in parts}
    new["measurements"] = sorted(entries, key=lambda entry: order.index(entry["part"]))
