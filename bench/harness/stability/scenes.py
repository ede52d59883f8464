# SPDX-License-Identifier: MIT
"""Odd scenes: an eye, a light or a number at a place that invites failure."""
import copy
import itertools
import math
import struct
from dataclasses import dataclass

from harness.measure.scenes import read_scene
from harness.run.program import ROOT

FACE = 3 ** -0.5  # half the side of a cube of circumradius 1
LIMIT = 1e12  # range of the numbers of a scene
SCALES = (1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6)
HAIR = 1e-9
GAP = 1e-6
OFFSETS = (0.0, 1.0, 1e2, 1e4, 1e6, 1e9)
SIZE = 10.0  # coordinates of the default scene, in its own unit


@dataclass
class Odd:
    """A scene that is compared in double with the scene `like`, or with itself if that is None. `beside` are the same scenes
    with the odd thing a hair to either side, if that decides what is visible."""
    name: str
    scene: dict
    like: str | None = None
    refused: bool = False  # whether an error is expected
    beside: tuple = ()


def base(**changes):
    """Returns a cube of glass with lit edges and an octahedron over a floor."""
    return {**read_scene(ROOT / "bench/scenes/templates/odd.json"), **changes}


def camera(eye, target=(0.0, 0.0, 0.0), field_of_view=60):
    return {"field_of_view": field_of_view, "eye": list(eye), "target": list(target)}


def at_places(kind, places, make):
    """Yields a scene of each place; if the thing stands on something, also those a hair outwards and inwards of it, for floors
    upwards and downwards."""
    for name, place in places.items():
        up = place[2] < -0.7
        hairs = [[x + sign * HAIR * (k == 2 if up else x > 0.3) for k, x in enumerate(place)] for sign in (1, -1)]
        yield Odd(f"{kind}_{name}", make(place), beside=() if name == "inside" else tuple(map(make, hairs)))


PLACES = {"on_face": [FACE, 0.1, 0.2], "on_edge": [FACE, FACE, 0.1], "on_corner": [FACE] * 3, "inside": [0.1, 0.2, -0.1]}


def eyes():
    yield from at_places("eye", {**PLACES, "on_floor": [1.9, -1.4, -0.8]},
                         lambda at: base(camera=camera(at, (-1.0, 0.3, -0.2))))


def lights():
    looks_at = [1.5, -1.2, -0.8]  # on the floor, in the middle of the picture
    yield from at_places("light", {**PLACES, "at_a_hit_point": looks_at},
                         lambda at: base(lights=[{"position": at}], camera=camera((2.6, -1.9, 1.3), looks_at)))
    for name, (intensity, refused) in {"1e30": (1e30, True), "1e12": (1e12, False), "1e-30": (1e-30, False)}.items():
        yield Odd(f"light_of_{name}", base(lights=[{"position": [3, -4, 5], "intensity": intensity}]), refused=refused)


def views():
    for degrees in (1e-9, 1e-3, 0.01, 178.999, 179):
        yield Odd(f"field_of_view_{degrees:g}", base(camera=camera((2.6, -1.9, 1.3), field_of_view=degrees)))


def glass():
    for name, view in (("from_inside", camera((0.0, 0.0, 0.0), (1.0, 0.9, 0.3), 100)),
                       ("grazing", camera((FACE + 1e-4, -3.0, 0.2), (FACE, 0.0, 0.2), 4))):
        scene = base(camera=view)
        scene["materials"]["glass"] = {"reflection": 0.05, "transmission": 0.9, "index_of_refraction": 1.5}
        yield Odd(f"critical_angle_{name}", scene)


def touching():
    """Solids that share a face, an edge's part or all of themselves; a hair: a gap, or a size."""
    def stacked(gap):
        return base(solids=[cube([0, 0, -0.8 + FACE + gap]), cube([0, 0, -0.8 + 3 * FACE + 2 * gap])])

    def cube(centre, radius=1.0):
        return {"kind": "cube", "material": "glass", "centre": centre, "circumradius": radius}

    def beside(gap):
        return base(solids=[cube([0, 0, 0]), cube([2 * FACE + gap, 0.3, 0.1])])

    def doubled(more):
        return base(solids=[cube([0, 0, 0]), cube([0, 0, 0], 1.0 + more)])
    for name, make in (("stacked_on_the_floor", stacked), ("side_by_side", beside), ("doubled_solid", doubled)):
        yield Odd(name, make(0.0), beside=(make(GAP), make(2 * GAP)))


def deep():
    scene = base(camera=camera((0.05, 0.1, 0.0), (1.0, 0.9, 0.3), 100))
    scene["image"].update(depth=1000, cutoff=0)
    scene["materials"]["glass"].update(reflection=1, transmission=0, diffuse=0, specular=0)
    yield Odd("mirrors_of_depth_1000", scene)


def colours():
    scene = base()
    scene["materials"]["stone"]["colour"] = [2, 2, 2]
    yield Odd("colour_above_1", scene, refused=True)
    scene = base(background=[LIMIT, 2.0, 0.5])
    scene["solids"][0]["edge_lights"]["disc_radiance"] = LIMIT
    yield Odd("radiance_of_1e12", scene)


def write_texture(file, width, height):
    """Writes a chequered texture in the data format."""
    pixels = bytes([255] * 4), bytes([10, 40, 90, 255])
    rows = [(pixels[y] + pixels[1 - y]) * (width // 2) + pixels[y] * (width % 2) for y in (0, 1)]
    file.write_bytes(struct.pack("<2i", width, height) + b"".join(rows[y % 2] for y in range(height)))


def textures(folder):
    border = ((4.99, -4.0, -0.5), (5.0, -5.0, -0.8))
    for width, height, view in ((1, 1, None), (65535, 16, None), (2, 2, border)):
        write_texture(folder / f"{width}.data", width, height)
        scene = base()
        scene["floor"]["texture"] = {"file": str(folder / f"{width}.data")}
        if view:
            scene["camera"] = camera(*view, 40)
        yield Odd(f"texture_{width}x{height}" + ("_border" if view else ""), scene)


# ---- the default scene, larger and smaller, and elsewhere

def point(place):
    """Returns a position, or the begin of a path."""
    if isinstance(place, list):
        return place
    radius, height = [place.get(f"{name}0", 0) + place.get(f"{name}_amplitude", 0) * math.sin(place.get(f"{name}_phase", 0))
                      for name in "rz"]
    angle = place.get("phi0", 0)
    return [radius * math.cos(angle), radius * math.sin(angle), height]


def moved(scene, scale, offset):
    """Returns the scene's first frame so many times as large, `offset` sizes away from the origin."""
    scene = copy.deepcopy(scene)
    way = [SIZE * offset * part for part in (0.6297, -0.5421, 0.5562)]

    def put(place):
        return [scale * (a + b) for a, b in zip(place, way)]

    def grow(part, *names):
        for name in names:
            if name in part:
                part[name] *= scale
    view = scene["camera"]
    view["eye"], view["target"] = put(point(view["eye"])), put(point(view.get("target", [0, 0, 0])))
    view["frames"] = 1
    for solid in scene["solids"]:
        solid["centre"] = put(solid.get("centre", [0, 0, 0]))
        solid["circumradius"] = scale * solid.get("circumradius", 1)
        grow(solid.get("rim", {}), "width")
        grow(solid.get("edge_lights", {}), "disc_radius", "falloff_distance", "falloff_end")
    for light in scene.get("lights", []):
        light["position"] = put(light["position"])
        grow(light, "falloff_distance", "falloff_end")
    if "floor" in scene:
        scene["floor"]["corners"] = [put(corner) for corner in scene["floor"]["corners"]]
    return scene


def moves(scene, quick):
    """Yields the scenes; the first one is the model of the others."""
    def name(scale, offset):
        return f"scale_{scale:g}_offset_{offset:g}"
    for scale, offset in sorted(itertools.product(SCALES, OFFSETS), key=lambda place: place != (1.0, 0.0)):
        if quick and scale != 1.0 and offset not in (0.0, 1e4):
            continue
        there = moved(scene, scale, offset)
        numbers = [*there["camera"]["eye"], *(x for corner in there["floor"]["corners"] for x in corner)]
        yield Odd(name(scale, offset), there, like=name(1.0, 0.0), refused=max(map(abs, numbers)) > LIMIT)


def all_scenes(folder, quick):
    for scenes in (eyes(), lights(), views(), glass(), touching(), deep(), colours(), textures(folder),
                   moves(read_scene(ROOT / "scenes/default.json"), quick)):
        yield from scenes
