# SPDX-License-Identifier: MIT
"""One object of as many triangles as wanted, in two scenes: mirrored and transparent, and one that only
primary rays meet."""
import json
import re
import subprocess

from harness.program import Problem

SAID = re.compile(r": (\d+) triangles;")
EYE = {"r0": 4.6, "z0": 1.6, "phi_frequency": 1}
# The object stands on a floor in this one, and fills the picture in the other.
FAR, NEAR = 36, 20


def words(count):
    """1 k, 80 k, 1 M: as people say it."""
    for unit, size in (("M", 1000000), ("k", 1000)):
        if count >= size:
            return f"{count / size:g} {unit}"
    return str(count)


def make(program, folder, count):
    """(file, triangles): the object, which has about as many as asked for."""
    if not program.is_file():
        raise Problem(3, f"there is no {program}: ./dev build builds it")
    file = folder / f"sphere-{count}.obj"
    done = subprocess.run([program, "sphere", str(count), "-o", file], capture_output=True, text=True)
    if done.returncode != 0:
        raise Problem(1, f"{program.name}: {done.stderr.strip()}")
    with open(file, encoding="utf-8") as lines:
        return file, int(SAID.search(lines.readline()).group(1))


def start(file, material):
    return {
        "hedron": 1,
        "camera": {"field_of_view": FAR, "frames": 60, "eye": EYE, "target": [0, 0, 0]},
        "background": [0.02, 0.03, 0.06],
        "meshes": [{"file": str(file), "material": material}],
    }


def whole_scene(file):
    """All that a mesh can ask for: mirrored and transmitted rays, and coloured shadows of two lights."""
    return {
        **start(file, "glass"),
        "image": {"width": 320, "height": 240, "samples": 1, "depth": 4, "cutoff": 0},
        "materials": {
            "glass": {"colour": [1, 0.7, 0.5], "diffuse": 0.25, "specular": 0.3, "reflection": 0.45,
                      "transmission": 0.5},
            "floor": {"colour": [0.8, 0.8, 0.85], "diffuse": 0.7, "specular": 0.2, "reflection": 0.25},
        },
        "lights": [
            {"position": [4, -3, 5], "colour": [1, 0.9, 0.8], "intensity": 0.7},
            {"position": [-4, -3, 4], "colour": [0.6, 0.7, 1], "intensity": 0.5},
        ],
        "floor": {
            "corners": [[-6, 6, -1.3], [6, 6, -1.3], [6, -6, -1.3], [-6, -6, -1.3]],
            "material": "floor",
            "texture": {"file": "builtin:floor"},
        },
    }


def primary_scene(file):
    """Every primary ray meets the object, and there are no others."""
    scene = start(file, "clay")
    scene["camera"]["field_of_view"] = NEAR
    return {**scene, "image": {"width": 1920, "height": 1080, "samples": 4, "depth": 0, "cutoff": 0},
            "materials": {"clay": {"colour": [1, 0.7, 0.5], "ambient": 0.5}}}


def write(scene, file):
    file.write_text(json.dumps(scene) + "\n", encoding="utf-8")
    return file
