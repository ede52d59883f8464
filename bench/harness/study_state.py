# SPDX-License-Identifier: MIT
"""The result of bench/study, which is also what an interrupted study goes on from: it is saved after every
measurement, and what the same program measured before is kept."""
import datetime
import hashlib
import json
from statistics import mean

from harness import machine, report, summary
from harness.program import Problem
from harness.study_points import PARTS

UNITS = ("bounds", "accuracy", "stability")  # parts that are no frames, measured as other benches do
ALL_PARTS = (*PARTS, *UNITS)
FRAME_KEYS = ("frame", "width", "height", "samples", "depth", "seconds", "began", "rays", "shadow_tests", "missing",
              "renderer")
KEYS = ("complete", "date", "quick", "hedron", "machine", "devices", "parts", "done", "left_out", "failed", "measurements",
        "bounds", "accuracy", "stability")
SAME = ("bench", "quick")  # what must be alike for a study to go on
SAME_OF_DEVICES = ("label", "name", "driver", "reason")
SAME_OF_HEDRON = ("options", "sha256")


def begin(program, arguments, devices):
    place = machine.describe()
    return {
        "hedron_bench": report.VERSION,
        "bench": "study",
        "complete": False,
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "quick": arguments.quick,
        "repeats": arguments.repeats,
        "hedron": {"version": program.version, "options": arguments.options,
                   "sha256": hashlib.sha256(program.path.read_bytes()).hexdigest()},
        "machine": {"name": arguments.machine, **place},
        "interference_limit": arguments.others / 100,
        "devices": devices,
        "parts": [],
        "done": [],
        "left_out": {},
        "failed": {},
        "measurements": [],
        "bounds": None,
        "accuracy": None,
        "stability": None,
        "pictures": None,
        "failures": [],
    }


def read(file):
    """A result of bench/study; raises Problem where the file is none."""
    try:
        result = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise Problem(2, f"cannot read {file}: {error.strerror}") from error
    except ValueError as error:
        raise Problem(2, f"{file} is no JSON, or damaged: {error}") from error
    check(file, result)
    return result


def check(file, result):
    if not isinstance(result, dict) or result.get("bench") != "study":
        raise Problem(2, f"{file} is not what bench/study writes")
    if result.get("hedron_bench") != report.VERSION:
        raise Problem(2, f"{file} has version {result.get('hedron_bench')} of the format, expected {report.VERSION}")
    missing = [key for key in KEYS if key not in result]
    if missing:
        raise Problem(2, f"{file} is damaged: it has no {', '.join(missing)}")
    try:
        summarize(result)
    except (KeyError, TypeError, IndexError, AttributeError, ValueError) as error:
        raise Problem(2, f"{file} is damaged: {type(error).__name__} {error}") from error


def is_continued(old, new):
    """Whether the measurements of both answer the same question."""
    devices = [[[device[key] for key in SAME_OF_DEVICES] for device in result["devices"]] for result in (old, new)]
    return (devices[0] == devices[1] and old["machine"]["cpu"] == new["machine"]["cpu"]
            and all(old[key] == new[key] for key in SAME)
            and all(old["hedron"][key] == new["hedron"][key] for key in SAME_OF_HEDRON))


# ---- measurements

def entry_of(point):
    job = point.job
    return {"part": point.part, "series": point.series, "x": point.x, "device": point.device, "scene": job.scene,
            "options": list(job.options), "frames": job.frames, "output": job.output, "warm_up": point.warm_up,
            "scale": point.scale, "cold": point.cold, "renderer": None, "reason": None, "failed": False,
            "summary": None, "runs": [], "rejected": []}


IDENTITY = ("part", "series", "x", "device", "scene", "options", "frames", "output", "warm_up", "scale", "cold")


def identity(entry):
    return json.dumps([entry[key] for key in IDENTITY])


def kept_frame(frame):
    return {key: frame[key] for key in FRAME_KEYS if key in frame}


def kept_run(entry, repeat, run):
    """As it is written."""
    frames = []
    for place, frame in enumerate(run["frames"]):
        kept = kept_frame(frame)
        del kept["renderer"]
        frames.append({**kept, "warm_up": entry["warm_up"] and place == 0, "picture": run["digests"].get(frame["frame"])})
    return {"repeat": repeat, "wall": run["wall"], "cpu": run["cpu"], "load": run["load"], "others": run["others"],
            "noisy": run["noisy"], "frames": frames}


def merge(old, new, points, parts):
    """`new` with what `old`, if any, has of the same measurements. Parts that are not asked for stay as they were."""
    entries = [entry_of(point) for point in points]
    if old is not None:
        known = {identity(entry): entry for entry in old["measurements"]}
        entries = [known.get(identity(entry), entry) for entry in entries]
        entries += [entry for entry in old["measurements"] if entry["part"] not in parts]
        for key in ("date", "bounds", "accuracy", "stability"):
            new[key] = old[key]
        new["machine"] = {**old["machine"], "name": new["machine"]["name"] or old["machine"]["name"]}
    new["machine"]["name"] = new["machine"]["name"] or new["machine"]["cpu"]
    before = old or {"parts": [], "done": [], "left_out": {}, "failed": {}}
    new["parts"] = [part for part in ALL_PARTS if part in parts or part in before["parts"]]
    new["done"] = [part for part in before["done"] if part not in parts]
    for key in ("left_out", "failed"):
        new[key] = {part: words for part, words in before[key].items() if part not in parts}
    new["measurements"] = sorted(entries, key=lambda entry: ALL_PARTS.index(entry["part"]))
    return new


# ---- what came of them

def counted(run):
    return [frame for frame in run["frames"] if not frame["warm_up"]]


def chosen_runs(entry):
    """Those that nothing disturbed; all, where there are none."""
    return [run for run in entry["runs"] if not run["noisy"]] or entry["runs"]


def spread(values):
    first, middle, third = summary.quartiles(values)
    return {"median": middle, "q1": first, "q3": third}


def values_of(entry, seconds):
    """Milliseconds: for each run the mean of its frames."""
    return [1e3 * entry["scale"] * mean(seconds(frame) for frame in counted(run)) for run in chosen_runs(entry)]


def trace_seconds(frame):
    return frame["seconds"]["trace"]


def frame_seconds(frame):
    """What the classic mode prints as the time of a frame."""
    return sum(frame["seconds"][stage] for stage in ("prepare", "trace", "copy"))


def summarize(result):
    """Fills in what follows from the runs."""
    for entry in result["measurements"]:
        runs = chosen_runs(entry)
        entry["summary"] = runs and {
            "runs": len(runs), "noisy": any(run["noisy"] for run in runs), "rejected": len(entry["rejected"]),
            "trace_ms": spread(values_of(entry, trace_seconds)),
            "frame_ms": spread(values_of(entry, frame_seconds))} or None


def of_part(result, part, **wanted):
    """The measured entries."""
    return [entry for entry in result["measurements"] if entry["part"] == part and entry["summary"]
            and all(entry[key] == value for key, value in wanted.items())]
