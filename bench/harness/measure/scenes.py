# SPDX-License-Identifier: MIT
"""Scene files: reads and writes them, makes the default scene under any number of point lights without falloff and
objects of any number of triangles, and counts a scene's contents."""
import json
import math
import re

from harness.measure.numbers import count_words
from harness.run.program import ROOT, Problem, run_tool

DEFAULT = ROOT / "scenes/default.json"
GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))
TOTAL_INTENSITY = 1.2
COLOURS = [[1, 0.9, 0.8], [0.6, 0.7, 1], [0.8, 1, 0.85], [1, 0.8, 1], [1, 1, 0.7]]
FACES = {"tetrahedron": 4, "cube": 6, "octahedron": 8, "dodecahedron": 12, "icosahedron": 20}
EDGES = {"tetrahedron": 6, "cube": 12, "octahedron": 12, "dodecahedron": 30, "icosahedron": 30}
FLOOR_PLANES = 5
SAID = re.compile(r": (\d+) triangles;")
TRIANGLE_TICKS = {count_words(10 ** power): 10 ** power for power in range(1, 8)}  # coordinates of an axis


def read_scene(file):
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Problem(2, f"cannot read {file}: {error}") from error


def write_scene(scene, file):
    file.write_text(json.dumps(scene) + "\n", encoding="utf-8")
    return file


# ---- lights

def position(place, count):
    """Returns positions spread evenly over the upper part of a spheroid around the solids. Most floor points have
    solids between them and some of the lights."""
    height = (place + 0.5) / count
    ring = math.sqrt(1 - height * height)
    angle = place * GOLDEN_ANGLE
    return [round(9 * ring * math.cos(angle), 4), round(9 * ring * math.sin(angle), 4), round(0.2 + 6 * height, 4)]


def lights(count):
    return [{"position": position(place, count), "colour": COLOURS[place % len(COLOURS)],
             "intensity": TOTAL_INTENSITY / count} for place in range(count)]


def write_lights(folder, count):
    """Returns the path of the default scene under so many lights; its edge lights stay bright spots that light nothing."""
    scene = read_scene(DEFAULT)
    for solid in scene["solids"]:
        solid["edge_lights"]["intensity"] = 0
    return write_scene({**scene, "lights": lights(count)}, folder / f"lights-{count}.json")


# ---- triangles

def make_object(program, folder, count):
    """Returns (file, triangles) of the object with about the requested number."""
    file = folder / f"sphere-{count}.obj"
    run_tool(program.beside("hedron_model"), "sphere", count, "-o", file)
    with open(file, encoding="utf-8") as lines:
        return file, int(SAID.search(lines.readline()).group(1))


def write_object_scene(kind, file, folder, count):
    """Returns the path of a scene file with the object. `whole` has everything that a mesh can have: mirrored and transmitted
    rays, coloured shadows of two lights. In `near` every primary ray meets the object, and there are no others."""
    scene = read_scene(ROOT / f"bench/scenes/templates/{kind}.json")
    scene["meshes"][0]["file"] = str(file)
    return write_scene(scene, folder / f"{kind}-{count}.json")


# ---- costs of a frame

def lights_on_edges(solid):
    lights = solid.get("edge_lights", {})
    return lights.get("per_edge", 0) * EDGES[solid["kind"]] if lights.get("intensity", 0) > 0 else 0


def facts(file):
    """Returns {"solids", "meshes", "planes", "lights"}; lights that light nothing are left out."""
    scene = read_scene(file)
    solids = scene.get("solids", [])
    return {"solids": len(solids), "meshes": len(scene.get("meshes", [])),
            "planes": sum(FACES[solid["kind"]] for solid in solids) + (FLOOR_PLANES if "floor" in scene else 0),
            "lights": len(scene.get("lights", [])) + sum(lights_on_edges(solid) for solid in solids)}
