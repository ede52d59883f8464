# SPDX-License-Identifier: MIT
"""The result that every measurement writes: one shape, one file of JSON."""
import datetime
import json
import os
from pathlib import Path

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
    """The file is the old one or the new one, never a part."""
    part = Path(f"{file}.tmp-{os.getpid()}")
    try:
        part.write_text(text, encoding="utf-8")
        part.replace(file)
    except OSError as error:
        raise Problem(1, f"cannot write {file}: {error.strerror}") from error


def write(file, result):
    write_text(file, json.dumps(result, indent=1, ensure_ascii=False, allow_nan=False) + "\n")


def read(file, bench):
    """What `bench` wrote; raises Problem where the file is none."""
    try:
        result = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise Problem(2, f"cannot read {file}: {error.strerror}") from error
    except ValueError as error:
        raise Problem(2, f"{file} is no JSON, or damaged: {error}") from error
    if not isinstance(result, dict) or result.get("bench") != bench:
        raise Problem(2, f"{file} is not what bench/study{'' if bench == 'study' else ' ' + bench} writes")
    if result.get("hedron_bench") != VERSION:
        raise Problem(2, f"{file} has version {result.get('hedron_bench')} of the format, expected {VERSION}")
    return result


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
