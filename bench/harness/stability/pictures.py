# SPDX-License-Identifier: MIT
"""Pictures of one scene in float and in double, in strict and in fast arithmetic."""
from harness.measure.scenes import read_scene
from harness.run import pfm
from harness.run.program import Problem

DEVICE = {"backend": "c", "index": 0}
GEOMETRIES = ("solids", "triangles")
PICTURES = "#######.pfm"
KINDS = {"double": ("--precision", "double"), "float": (), "fast": ("--math", "fast")}
FLOAT, FAST = "float against double", "fast against strict"


def render(program, scene, frames, options, folder):
    """{"code", "message": None or why there are no pictures, "said", "pictures": {frame: picture}, "clamps"}"""
    run = program.render(DEVICE, scene, frames, list(options), folder, output=PICTURES, look=lambda place: {
        int(file.stem): pfm.read(file) for file in sorted(place.glob("*.pfm"))})
    failed = run["code"] != 0
    return {"code": run["code"], "message": run["message"] if failed else None, "said": run["said"],
            "pictures": {} if failed else run["seen"],
            "clamps": sum(frame["clamps"] for frame in run["frames"])}


def compare(one, other):
    """{"pixels", "near"} of the frames that both have."""
    frames = one["pictures"].keys() & other["pictures"].keys()
    sizes = [one["pictures"][frame] for frame in frames]
    return {"pixels": sum(width * height for width, height, _ in sizes),
            "near": sum(pfm.near_pixels(one["pictures"][frame], other["pictures"][frame]) for frame in frames)}


def odd_numbers(runs):
    return sum(pfm.odd_numbers(picture) for run in runs for picture in run["pictures"].values())


def study_scene(program, file, options, folder):
    """An entry for each geometry and comparison, of the first frame and the middle one."""
    entries, name = [], file.stem
    count = read_scene(file)["camera"].get("frames", 1)
    frames = "0" if count < 2 else f"0,{count // 2}"
    for geometry in GEOMETRIES:
        runs = {}
        for kind, own in KINDS.items():
            runs[kind] = render(program, file, frames, ("--geometry", geometry, *own, *options), folder)
            if runs[kind]["message"]:
                raise Problem(runs[kind]["code"], f"{name}: {runs[kind]['message']}")
        for what, one, other in ((FLOAT, "float", "double"), (FAST, "fast", "float")):
            entries.append({"scene": name, "geometry": geometry, "what": what,
                            "nan": odd_numbers([runs[one], runs[other]]), **compare(runs[one], runs[other])})
    return entries


def total(entries, what, geometry=None):
    """(near, pixels)"""
    these = [each for each in entries if each["what"] == what and geometry in (None, each["geometry"])]
    return sum(each["near"] for each in these), sum(each["pixels"] for each in these)


def share(entries):
    pixels = sum(each["pixels"] for each in entries)
    return sum(each["near"] for each in entries) / pixels if pixels else None
