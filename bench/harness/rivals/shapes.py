# SPDX-License-Identifier: MIT
"""What other programs can be told of a scene: still views of solids with faces of one material each, a floor, and lights, as
docs/model.md has them; as polygons in the world's coordinates, counterclockwise from outside."""
import itertools
import math

from harness.run.program import Problem

KEYS = {
    "": {"hedron", "image", "camera", "materials", "solids", "lights", "floor"},
    "camera": {"field_of_view", "eye", "target"},
    "material": {"colour", "diffuse", "reflection", "transmission", "mirror_tint"},
    "solid": {"kind", "centre", "circumradius", "rotation", "material"},
    "light": {"position", "colour", "intensity", "falloff_distance"},
    "floor": {"corners", "material"},
}
DEFAULTS = {"colour": [1, 1, 1], "diffuse": 0, "reflection": 0, "transmission": 0, "mirror_tint": [1, 1, 1]}
PHI = (1 + 5 ** 0.5) / 2


def checked(scene):
    """The scene; raises Problem where it has what there is no word for."""
    parts = [("", scene), ("camera", scene["camera"]), ("floor", scene["floor"]),
             *(("material", each) for each in scene["materials"].values()),
             *(("solid", each) for each in scene["solids"]), *(("light", each) for each in scene["lights"])]
    for name, part in parts:
        if not set(part) <= KEYS[name]:
            raise Problem(1, f"other programs cannot be told of {', '.join(sorted(set(part) - KEYS[name]))}")
    return scene


# ---- vectors

def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def times(factor, a):
    return [factor * x for x in a]


def unit(a):
    return times(1 / math.sqrt(dot(a, a)), a)


def turned(a, degrees):
    """About x, then y, then z."""
    for axis, angle in enumerate(map(math.radians, degrees)):
        p, q = (axis + 1) % 3, (axis + 2) % 3
        a = list(a)
        a[p], a[q] = a[p] * math.cos(angle) - a[q] * math.sin(angle), a[p] * math.sin(angle) + a[q] * math.cos(angle)
    return a


# ---- solids

def signs(point):
    return [[x * sign for x, sign in zip(point, turn)] for turn in itertools.product((1, -1), repeat=3)]


def rings(a, b):
    return [point for sign in itertools.product((1, -1), repeat=2) for p, q in [(a * sign[0], b * sign[1])]
            for point in ([0, p, q], [q, 0, p], [p, q, 0])]


TETRAHEDRON = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
OCTAHEDRON = [[sign * (i == k) for k in range(3)] for sign in (1, -1) for i in range(3)]
CORNERS = {"tetrahedron": TETRAHEDRON, "cube": signs([1, 1, 1]), "octahedron": OCTAHEDRON,
           "dodecahedron": signs([1, 1, 1]) + rings(PHI, 1 / PHI), "icosahedron": rings(1, PHI)}
DIRECTIONS = {"tetrahedron": [times(-1, v) for v in TETRAHEDRON], "cube": OCTAHEDRON, "octahedron": signs([1, 1, 1]),
              "dodecahedron": rings(1, PHI), "icosahedron": CORNERS["dodecahedron"]}


def faces(solid):
    """[[corner]]"""
    found, centre, size = [], solid["centre"], solid["circumradius"]
    corners = [unit(v) for v in CORNERS[solid["kind"]]]
    for normal in map(unit, DIRECTIONS[solid["kind"]]):
        inradius = max(dot(normal, v) for v in corners)
        own = [v for v in corners if dot(normal, v) > inradius - 1e-9]
        right = unit(minus(own[0], times(inradius, normal)))
        up = cross(normal, right)
        own.sort(key=lambda v: math.atan2(dot(v, up), dot(v, right)))
        found.append([[c + size * x for c, x in zip(centre, turned(v, solid.get("rotation", [0, 0, 0])))] for v in own])
    return found


def triangles(polygons):
    return [[corners[0], b, c] for corners in polygons for b, c in zip(corners[1:], corners[2:])]


def things(scene):
    """[(polygons, material)], the floor last."""
    materials = {name: {**DEFAULTS, **each} for name, each in scene["materials"].items()}
    found = [(faces(solid), materials[solid["material"]]) for solid in scene["solids"]]
    floor = scene["floor"]
    return [*found, ([floor["corners"][::-1]], materials[floor["material"]])]


# ---- camera and lights

def view(scene):
    """(eye, forward, right, up, tangent of half the field of view)"""
    camera = scene["camera"]
    forward = unit(minus(camera["target"], camera["eye"]))
    right = unit(cross(forward, [0, 0, 1]))
    return camera["eye"], forward, right, cross(right, forward), math.tan(math.radians(camera["field_of_view"]) / 2)


def colour_of(light):
    return times(light.get("intensity", 1), light.get("colour", [1, 1, 1]))
