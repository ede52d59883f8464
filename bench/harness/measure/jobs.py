# SPDX-License-Identifier: MIT
"""A job: runs of hedron that differ in nothing but the time of day, as stored; its figures, and whether jobs made the
same pictures."""
from statistics import mean

from harness.measure.numbers import spread

PICTURES = "#######.data"
FRAME_KEYS = ("frame", "width", "height", "samples", "depth", "seconds", "began", "rays", "shadow_tests", "missing")
CLASSIC_STAGES = ("prepare", "trace", "copy")  # printed by the classic mode as a frame's time
FREE = ("--threads", "--pipeline", "--accel", "--lanes", "--block", "--grid")  # options that change no byte of a picture


def job(device, scene, frames, options=(), *, output=PICTURES, warm_up=True, scale=1, cold=False, **more):
    """Returns a job. `warm_up`: the first of several frames does not count; `scale`: a factor of its times; `cold`: hedron
    finds no compiled kernels. `more` may have `slow` (once is enough) and `few_cores` (on at most the target's cores)."""
    return {**more, "device": device, "scene": scene, "options": list(options), "frames": frames, "output": output,
            "warm_up": warm_up, "scale": scale, "cold": cold, "renderer": None, "reason": None, "failed": False,
            "summary": None, "runs": [], "rejected": []}


def kept_run(entry, repeat, run):
    """Returns the job as stored."""
    several = len(run["frames"]) > 1 or run["code"] is None  # a completed run has all frames
    frames = [{**{key: frame[key] for key in FRAME_KEYS if key in frame},
               "warm_up": entry["warm_up"] and place == 0 and several,
               "picture": run["digests"].get(frame["frame"])} for place, frame in enumerate(run["frames"])]
    return {"repeat": repeat, **{key: run[key] for key in ("wall", "cpu", "load", "others", "noisy")}, "frames": frames}


def run_of(entry, repeat):
    return next((run for run in entry["runs"] if run["repeat"] == repeat), None)


def counted(run):
    return [frame for frame in run["frames"] if not frame["warm_up"]]


def counted_frames(entry):
    return [frame for run in entry["runs"] for frame in counted(run)]


def chosen_runs(entry):
    """Returns the undisturbed runs, or all if there are none."""
    return [run for run in entry["runs"] if not run["noisy"]] or entry["runs"]


def run_ms(entry, run, stages=("trace",)):
    """Returns the mean of its frames."""
    return 1e3 * entry["scale"] * mean(sum(frame["seconds"][stage] for stage in stages) for frame in counted(run))


def summarize(entries):
    """Fills in the figures that follow from the runs."""
    for entry in entries:
        runs = chosen_runs(entry)
        entry["summary"] = runs and {
            "runs": len(runs), "noisy": any(run["noisy"] for run in runs), "rejected": len(entry["rejected"]),
            "trace_ms": spread([run_ms(entry, run) for run in runs]),
            "frame_ms": spread([run_ms(entry, run, CLASSIC_STAGES) for run in runs])} or None


def failures(entries):
    """Returns reasons of failed runs."""
    return {f"{entry['device']}, {entry.get('part', entry['scene'])}, {' '.join(entry['options'])}: {entry['reason']}"
            for entry in entries if entry["failed"]}


# ---- pictures

def picture_groups(entries, devices):
    """Returns {reason for equal pictures: {digest: [job]}}. Neither threads, lanes and kernels nor the search of
    triangles may change a byte. `devices` by their labels."""
    groups = {}
    for entry in entries:
        words = list(entry["options"])
        options = " ".join(words)
        if "--math fast" in options or "--math=fast" in options or not devices[entry["device"]]["strict"]:
            continue
        for free in FREE:
            if free in words:
                del words[words.index(free):words.index(free) + 2]
        for frame in (frame for run in entry["runs"] for frame in run["frames"] if frame["picture"]):
            groups.setdefault((entry["scene"], tuple(words), frame["frame"]), {}).setdefault(
                frame["picture"], []).append(f"{entry['device']} {options}".strip())
    return groups


def compare_pictures(entries, devices):
    """Returns {"same": true, false or null, "compared": number of frames, "sentence"}."""
    groups = picture_groups(entries, devices)
    several = [makers for makers in groups.values() if len({maker for who in makers.values() for maker in who}) > 1]
    for (scene, _, number), makers in groups.items():
        if len(makers) > 1:
            who = " / ".join(", ".join(sorted(set(each))) for each in makers.values())
            return {"same": False, "compared": len(several),
                    "sentence": f"THE PICTURES DIFFER, so these times do not count: {scene}, frame {number}: {who}."}
    if not several:
        return {"same": None, "compared": 0, "sentence": "No pictures were compared, because none was made in two ways."}
    return {"same": True, "compared": len(several),
            "sentence": f"The same bytes from every device and pipeline, in {len(several)} frames made in two ways or more."}
