# SPDX-License-Identifier: MIT
"""Scenes in which something is odd: what the eye, a light or a number must not be put on lightly."""
import copy
import math
import struct
from dataclasses import dataclass

from harness.measure.scenes import read_scene
from harness.run.program import ROOT

FACE = 3 ** -0.5  # half the side of a cube of circumradius 1
LIMIT = 1e12  # of the numbers of a scene
SCALES = (1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6)
HAIR = 1e-9
OFFSETS = (0.0, 1.0, 1e2, 1e4, 1e6)
SIZE = 10.0  # of the default scene, in its own unit


@dataclass
class Odd:
    """`like` names the scene whose picture in double is to be matched; None: its own. `beside` are the
    same scenes with the odd thing a hair to either side, where that decides what is seen."""
    name: str
    scene: dict
    like: str | None = None
    refused: bool = False  # whether an error is what is wanted
    beside: tuple = ()


def base(**changes):
    """A cube of glass with lit edges and an octahedron over a floor."""
    return {**read_scene(ROOT / "bench/scenes/templates/odd.json"), **changes}


def camera(eye, target=(0.0, 0.0, 0.0), field_of_view=60):
    return {"field_of_view": field_of_view, "eye": list(eye), "target": list(target)}


def hairs(place, make):
    """Scenes with a thing a little outwards and inwards of its place; floors are left upwards."""
    up = place[2] < -0.7
    return tuple(make([x + sign * HAIR * (k == 2 if up else x > 0.3) for k, x in enumerate(place)]) for sign in (1, -1))


def eyes():
    places = {"eye_on_face": (FACE, 0.1, 0.2), "eye_on_edge": (FACE, FACE, 0.1), "eye_on_corner": (FACE,) * 3,
              "eye_inside": (0.1, 0.2, -0.1), "eye_on_floor": (1.9, -1.4, -0.8)}
    for name, place in places.items():
        def make(at):
            return base(camera=camera(at, (-1.0, 0.3, -0.2)))
        yield Odd(name, make(place), beside=() if name == "eye_inside" else hairs(place, make))


def lights():
    looks_at = [1.5, -1.2, -0.8]  # on the floor, in the middle of the picture
    places = {"light_on_face": [FACE, 0.1, 0.2], "light_on_edge": [FACE, FACE, 0.1], "light_on_corner": [FACE] * 3,
              "light_inside": [0.1, 0.2, -0.1], "light_at_a_hit_point": looks_at}
    for name, place in places.items():
        def make(at):
            return base(lights=[{"position": at}], camera=camera((2.6, -1.9, 1.3), looks_at))
        yield Odd(name, make(place), beside=() if name == "light_inside" else hairs(place, make))
    bright = {"light_of_1e30": (1e30, True), "light_of_1e12": (1e12, False), "light_of_1e-30": (1e-30, False)}
    for name, (intensity, refused) in bright.items():
        yield Odd(name, base(lights=[{"position": [3, -4, 5], "intensity": intensity}]), refused=refused)


def views():
    for degrees in (1e-9, 1e-3, 178.999, 179):
        yield Odd(f"field_of_view_{degrees:g}", base(camera=camera((2.6, -1.9, 1.3), field_of_view=degrees)))


def glass():
    scene = base(camera=camera((0.0, 0.0, 0.0), (1.0, 0.9, 0.3), 100))
    scene["materials"]["glass"] = {"reflection": 0.05, "transmission": 0.9, "index_of_refraction": 1.5}
    yield Odd("critical_angle_from_inside", scene)
    scene = copy.deepcopy(scene)
    scene["camera"] = camera((FACE + 1e-4, -3.0, 0.2), (FACE, 0.0, 0.2), 4)
    yield Odd("critical_angle_grazing", scene)


def colours():
    scene = base()
    scene["materials"]["stone"]["colour"] = [2, 2, 2]
    yield Odd("colour_above_1", scene, refused=True)
    scene = base(background=[LIMIT, 2.0, 0.5])
    scene["solids"][0]["edge_lights"]["disc_radiance"] = LIMIT
    yield Odd("radiance_of_1e12", scene)


def write_texture(file, width, height):
    """A chequered one, in the data format."""
    pixels = [struct.pack("4B", 255, 255, 255, 255), struct.pack("4B", 10, 40, 90, 255)]
    rows = [b"".join(pixels[(x + y) % 2] for x in range(2)) * (width // 2) + pixels[y] * (width % 2) for y in range(2)]
    with open(file, "wb") as stream:
        stream.write(struct.pack("<2i", width, height))
        for y in range(height):
            stream.write(rows[y % 2])


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

def path_point(path):
    """Where a path begins."""
    def wave(name):
        return path.get(f"{name}0", 0) + path.get(f"{name}_amplitude", 0) * math.sin(path.get(f"{name}_phase", 0))
    angle = path.get("phi0", 0)
    return [wave("r") * math.cos(angle), wave("r") * math.sin(angle), wave("z")]


def point(place):
    return place if isinstance(place, list) else path_point(place)


def moved(scene, scale, offset):
    """The scene's first frame so many times as large, `offset` sizes away from the origin."""
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


def largest(scene):
    numbers = [*scene["camera"]["eye"], *(x for corner in scene["floor"]["corners"] for x in corner)]
    return max(map(abs, numbers))


def moved_name(scale, offset):
    return f"scale_{scale:g}_offset_{offset:g}"


def moves(scene, quick):
    for scale in SCALES:
        for offset in OFFSETS:
            if quick and scale != 1.0 and offset not in (0.0, 1e4):
                continue
            there = moved(scene, scale, offset)
            yield Odd(moved_name(scale, offset), there, like=moved_name(1.0, 0.0), refused=largest(there) > LIMIT)


def all_scenes(folder, quick):
    yield from eyes()
    yield from lights()
    yield from views()
    yield from glass()
    yield from colours()
    yield from textures(folder)
    default = read_scene(ROOT / "scenes/default.json")
    yield from sorted(moves(default, quick), key=lambda odd: odd.name != odd.like)
