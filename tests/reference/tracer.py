# SPDX-License-Identifier: MIT
"""Renders a scene file to a PFM by docs/model.md and docs/reference/ alone, as the reference for hedron. It is slow, in
double, and knows nothing of hedron's code. Textures are those of the data format."""
import array
import itertools
import json
import math
import sys
from pathlib import Path

from obj_files import Model, from_mtl, smooth_normals
from textures import Texture
from vectors import BLACK, WHITE, along, blend, cross, dot, length, minus, product, times, turning, unit

OUTER, INNER = 0, 1
CONTRIBUTION_LIMIT = 2.0**16
LEAST_POWER, LEAST_PRODUCT = 2.0**-60, 2.0**-40


class Material:
    """Coefficients; `shares` are (reflection, transmission) of the outer and of the inner side."""

    def __init__(self, keys):
        self.colour = tuple(keys.get("colour", WHITE))
        self.tint = tuple(keys.get("mirror_tint", WHITE))
        self.ambient, self.diffuse = keys.get("ambient", 0), keys.get("diffuse", 0)
        self.specular = keys.get("specular", 0)
        self.shininess = keys.get("shininess", 64)
        outer = (keys.get("reflection", 0), keys.get("transmission", 0))
        inner = (keys.get("inner_reflection", outer[0]), keys.get("inner_transmission", outer[1]))
        self.shares = (outer, inner)
        self.index = keys.get("index_of_refraction", 1)
        self.lit_from_behind = keys.get("lit_from_behind", False)


class Surface:
    """A ray's view of a point: `normal` points to the ray's origin."""
    __slots__ = ("point", "normal", "thing", "side", "material", "colour", "emission", "face", "ends", "lift")

    def __init__(self, point, normal, thing, side, material):
        self.point, self.normal, self.thing, self.side, self.material = point, normal, thing, side, material
        self.colour = material.colour
        self.emission = BLACK
        self.face = None
        self.lift = BLACK  # the way to the smooth surface
        self.ends = False  # a disc: only the emission counts


class Light:
    """A point light; one of an edge knows its solid and the two faces that hold it."""

    def __init__(self, position, colour, keys, solid=None, faces=()):
        self.position = tuple(position)
        self.colour = times(keys.get("intensity", 1), colour)
        self.distance, self.end = keys.get("falloff_distance"), keys.get("falloff_end")
        self.solid, self.faces = solid, faces

    def reaching(self, distance):
        """Returns its colour at a distance."""
        if self.distance is not None:
            return times(1 / (1 + (distance / self.distance)**2), self.colour)
        if self.end is not None:
            return times(max(0, 1 - (distance / self.end)**2)**2, self.colour)
        return self.colour


PHI = (1 + math.sqrt(5)) / 2
SIGNS = list(itertools.product((1, -1), repeat=3))


def cyclic(a, b):
    """Returns R(a, b) of the page: twelve points."""
    return [v for p in (a, -a) for q in (b, -b) for v in ((0, p, q), (q, 0, p), (p, q, 0))]


TETRAHEDRON = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
OCTAHEDRON = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)]
DODECAHEDRON = SIGNS + cyclic(PHI, 1 / PHI)
ICOSAHEDRON = cyclic(1, PHI)
FLAT_INRADIUS, ROUND_INRADIUS = 1 / math.sqrt(3), math.sqrt((5 + 2 * math.sqrt(5)) / 15)
KINDS = {  # corners, directions of the faces, inradius of circumradius 1
    "tetrahedron": (TETRAHEDRON, [times(-1, v) for v in TETRAHEDRON], 1 / 3),
    "cube": (SIGNS, OCTAHEDRON, FLAT_INRADIUS),
    "octahedron": (OCTAHEDRON, SIGNS, FLAT_INRADIUS),
    "dodecahedron": (DODECAHEDRON, ICOSAHEDRON, ROUND_INRADIUS),
    "icosahedron": (ICOSAHEDRON, DODECAHEDRON, ROUND_INRADIUS),
}


class Solid:
    """A convex body within its faces."""

    def __init__(self, keys, materials):
        corners, directions, inradius = KINDS[keys["kind"]]
        turn = turning(keys.get("rotation", (0, 0, 0)))
        self.centre = tuple(keys.get("centre", (0, 0, 0)))
        self.radius = keys.get("circumradius", 1)
        self.height = inradius * self.radius
        self.normals = [turn(unit(v)) for v in directions]
        self.corners = [along(self.centre, self.radius, turn(unit(v))) for v in corners]
        self.material, self.index_around = materials[keys["material"]], 1
        pairs = list(itertools.combinations(range(len(corners)), 2))
        least = min(math.dist(corners[a], corners[b]) for a, b in pairs)
        self.edges = [pair for pair in pairs if math.dist(corners[pair[0]], corners[pair[1]]) < least * 1.001]
        self.rim_width, self.rim = 0, None
        if "rim" in keys:
            self.rim_width = keys["rim"]["width"]
            self.rim = materials[keys["rim"]["material"]]
        self.borders = [self.border(face) for face in range(len(directions))]
        self.lights, self.discs = [], []
        self.add_lights(keys.get("edge_lights", {"per_edge": 0}))

    def room(self, face, point):
        """Returns how far a point lies behind the plane of a face."""
        return self.height - dot(self.normals[face], minus(point, self.centre))

    def holds(self, points):
        """Returns whether points are within it."""
        return all(self.room(face, point) > 0 for face in range(len(self.normals)) for point in points)

    def holding(self, edge):
        """Returns the two faces of an edge."""
        return [face for face in range(len(self.normals))
                if all(self.room(face, self.corners[corner]) < 1e-6 * self.radius for corner in edge)]

    def border(self, face):
        """Returns for each edge of a face a point of it and the direction inwards, in the face."""
        found = []
        for edge in self.edges:
            if face in self.holding(edge):
                a, b = (self.corners[corner] for corner in edge)
                inwards = unit(cross(self.normals[face], minus(b, a)))
                found.append((a, inwards if dot(inwards, minus(self.centre, a)) > 0 else times(-1, inwards)))
        return found

    def add_lights(self, keys):
        """Adds the lights of the edges, and the discs in order of the edges."""
        count, colours = keys["per_edge"], keys.get("colours", [WHITE])
        self.disc_radius = keys.get("disc_radius", 0)
        for number, edge in enumerate(self.edges):
            a, b = (self.corners[corner] for corner in edge)
            colour = tuple(colours[number % len(colours)])
            for k in range(count):
                place = along(a, (k + 0.5) / count, minus(b, a))
                self.discs.append((place, times(keys.get("disc_radiance", 0), colour)))
                if keys.get("intensity", 0) > 0:
                    self.lights.append(Light(place, colour, keys, self, self.holding(edge)))

    def span(self, origin, direction):
        """Returns entry and exit of a line: (distance, face) twice, or None if it misses."""
        x, y, z = minus(origin, self.centre)
        dx, dy, dz = direction
        axis = cross((x, y, z), direction)
        if dot(axis, axis) > self.radius**2 * dot(direction, direction):
            return None
        first, last, entered, left = -math.inf, math.inf, None, None
        for face, (nx, ny, nz) in enumerate(self.normals):
            speed = nx * dx + ny * dy + nz * dz
            room = self.height - (nx * x + ny * y + nz * z)
            if speed > 0:
                if room < last * speed:
                    last, left = room / speed, face
            elif speed < 0:
                if room < first * speed:
                    first, entered = room / speed, face
            elif room < 0:
                return None
        return ((first, entered), (last, left)) if first < last else None

    def way_out(self, origin, direction):
        """Returns the exit of a ray from within: (distance, face)."""
        found = []
        for face, normal in enumerate(self.normals):
            speed = dot(normal, direction)
            if speed > 0:
                found.append((max(0, self.room(face, origin) / speed), face))
        return min(found)

    def meet(self, origin, direction, left, within):
        """Returns the hit of a ray that left a thing inwards or outwards: (distance, side, face)."""
        if left is self:
            if not within:
                return None
            distance, face = self.way_out(origin, direction)
            return (distance, INNER, face)
        span = self.span(origin, direction)
        if span and span[0][0] > 0:
            return (span[0][0], OUTER, span[0][1])
        if span and span[1][0] > 0:
            return (span[1][0], INNER, span[1][1])
        return None

    def on_rim(self, face, point):
        """Returns whether a point of a face is on the rim."""
        return self.rim is not None and any(
            dot(inwards, minus(point, corner)) < self.rim_width for corner, inwards in self.borders[face])

    def surface(self, point, _, side, face):
        """Returns the surface at a point."""
        rim = self.on_rim(face, point)
        normal = self.normals[face] if side == OUTER else times(-1, self.normals[face])
        found = Surface(point, normal, self, side, self.rim if rim else self.material)
        found.face = face
        if self.disc_radius > 0:
            for place, radiance in self.discs:
                if math.dist(place, point) < self.disc_radius:
                    found.emission, found.ends = radiance, True
        return found

    def crossed(self, face, point, side):
        """Returns the factor of light that crosses a face."""
        if self.on_rim(face, point):
            return BLACK
        return times(self.material.shares[side][1], self.material.colour)

    def passed(self, point, way, light, within):
        """Returns the factor of a segment; `within`: whether it starts within this solid; None: it is not on it."""
        if within is False or (light.solid is self and within):
            return WHITE
        if within:
            distance, face = self.way_out(point, way)
            return self.crossed(face, along(point, distance, way), INNER) if distance < 1 else WHITE
        if light.solid is self and any(self.room(face, point) <= 0 for face in light.faces):
            return WHITE
        span = self.span(point, way)
        if span is None:
            return WHITE
        factor = WHITE
        (first, entered), (last, left) = span
        if 0 < first < 1:
            factor = self.crossed(entered, along(point, first, way), OUTER)
        if 0 < last < 1 and light.solid is not self:
            factor = product(factor, self.crossed(left, along(point, last, way), INNER))
        return factor


class Floor:
    """A flat, convex quadrilateral."""

    def __init__(self, keys, materials, folder):
        self.corners = c = [tuple(corner) for corner in keys["corners"]]
        self.middle = blend([0.25] * 4, c)
        self.normal = unit(cross(minus(c[2], c[0]), minus(c[3], c[1])))
        self.material = materials[keys["material"]]
        self.texture = None
        if "texture" in keys:
            self.texture = Texture(folder / keys["texture"]["file"], keys["texture"]["curve"], False)

    def holds(self, point):
        """Returns whether a point of the plane is within the border."""
        return all(dot(self.normal, cross(minus(b, a), minus(point, a))) >= 0
                   for a, b in zip(self.corners, self.corners[1:] + self.corners[:1]))

    def height(self, point):
        """Returns how far a point is above the plane."""
        return dot(self.normal, minus(point, self.middle))

    def meet(self, origin, direction, left, _):
        """Returns the same as a solid's."""
        speed = dot(self.normal, direction)
        if left is self or speed == 0:
            return None
        distance = -self.height(origin) / speed
        meets = distance > 0 and self.holds(along(origin, distance, direction))
        return (distance, OUTER, None) if meets else None

    def place(self, point):
        """Returns the texture coordinates of a point: of two roots in t the one within the square."""
        c0, c1, c2, c3 = self.corners
        e, f, g = minus(c1, c0), minus(c3, c0), minus(along(c0, 1, c2), along(c1, 1, c3))
        q = minus(point, c0)

        def area(a, b):
            return dot(self.normal, cross(a, b))

        square, linear, constant = -area(f, g), area(q, g) - area(f, e), area(q, e)
        root = math.sqrt(max(0, linear * linear - 4 * square * constant))
        pivot = -(linear + math.copysign(root, linear)) / 2
        roots = [constant / pivot] + ([pivot / square] if square != 0 else [])
        t = min(roots, key=lambda value: abs(value - 0.5))
        across = along(e, t, g)
        return dot(minus(q, times(t, f)), across) / dot(across, across), t

    def surface(self, point, direction, side, _):
        """Returns the same as a solid's."""
        normal = self.normal if dot(self.normal, direction) < 0 else times(-1, self.normal)
        found = Surface(point, normal, self, side, self.material)
        if self.texture:
            found.colour = product(found.colour, self.texture.at(*self.place(point)))
        return found

    def passed(self, point, way, _, within):
        """Returns the same as a solid's: all or nothing."""
        if within is not None:
            return WHITE
        here, there = self.height(point), self.height(along(point, 1, way))
        if abs(there) < 1e-12 or here * there >= 0:
            return WHITE
        return BLACK if self.holds(along(point, here / (here - there), way)) else WHITE


class Triangle:
    """One triangle in the world; its corners' values are in the file's coordinates."""

    def __init__(self, mesh, corners, places, normals, look):
        self.mesh, (self.a, b, c) = mesh, places
        self.ab, self.ac = minus(b, self.a), minus(c, self.a)
        self.normal = unit(cross(self.ab, self.ac))
        self.normals, self.file_places = normals, [corner[0] for corner in corners]
        own = [corner[1] for corner in corners]
        self.coordinates = [place or (0.0, 1.0) for place in own] if any(own) else None
        self.material, self.texture, self.emission = look

    @property
    def index_around(self):
        """The index of what lies around its mesh."""
        return self.mesh.index_around

    def crossing(self, origin, direction):
        """Returns the hit of a line: (distance, side, shares of the corners), or None."""
        across = cross(direction, self.ac)
        volume = dot(self.ab, across)
        if volume == 0:
            return None
        from_a = minus(origin, self.a)
        b = dot(from_a, across) / volume
        if not 0 <= b <= 1:
            return None
        upright = cross(from_a, self.ab)
        c = dot(direction, upright) / volume
        if c < 0 or b + c > 1:
            return None
        return dot(self.ac, upright) / volume, OUTER if volume > 0 else INNER, (1 - b - c, b, c)

    def way_to_smooth(self, side, shares):
        """Returns the way from a point to the surface that the normals describe."""
        point, way = blend(shares, self.file_places), BLACK
        for share, corner, normal in zip(shares, self.file_places, self.normals):
            normal = normal if side == OUTER else times(-1, normal)
            way = along(way, share * max(0, dot(minus(corner, point), normal)), normal)
        return self.mesh.turn(product(self.mesh.scale, way))

    def shading_normal(self, direction, side, shares):
        """Returns the blended normal if it is usable, else the triangle's own; and the way to the smooth surface."""
        own = self.normal if side == OUTER else times(-1, self.normal)
        if self.normals is None:
            return own, BLACK
        smooth = self.mesh.normal_in_world(blend(shares, self.normals))
        smooth = smooth if side == OUTER else times(-1, smooth)
        speed = dot(smooth, direction)
        if speed < 0 and dot(along(direction, -2 * speed, smooth), own) > 0:
            return smooth, self.way_to_smooth(side, shares)
        return own, BLACK

    def surface(self, point, direction, side, shares):
        """Returns the same as a solid's."""
        normal, lift = self.shading_normal(direction, side, shares)
        found = Surface(point, normal, self, side, self.material)
        found.emission, found.lift = self.emission, lift
        if self.texture and self.coordinates:
            s, t = blend(shares, self.coordinates)
            found.colour = product(found.colour, self.texture.at(s, 1 - t))
        return found


class Mesh:
    """The triangles of an OBJ file in their place."""

    def __init__(self, keys, materials, folder):
        model = Model(folder / keys["file"])
        scale = keys.get("scale", 1)
        self.scale = tuple(scale) if isinstance(scale, list) else (scale,) * 3
        turn, is_y_up = turning(keys.get("rotation", (0, 0, 0))), keys.get("up") == "y"
        self.turn = (lambda p: turn((p[0], -p[2], p[1]))) if is_y_up else turn
        is_mirrored = math.prod(self.scale) < 0  # outer sides stay outer ones
        position = keys.get("position", (0, 0, 0))
        looks = self.looks(model, materials.get(keys.get("material")), keys.get("ambient", 0))
        normals = self.corner_normals(model, keys.get("normals", "file"), keys.get("crease", 40))
        self.triangles = []
        for (name, corners), own in zip(model.faces, normals):
            if is_mirrored:
                corners, own = corners[::-1], own and own[::-1]
            places = [along(position, 1, self.turn(product(self.scale, corner[0]))) for corner in corners]
            self.triangles.append(Triangle(self, corners, places, own, looks[name]))
        places = [[tuple(corner[0]) for corner in corners] for _, corners in model.faces]
        edges = {(face[k - 1], face[k]) for face in places for k in range(3)}
        volume = sum(dot(a, cross(b, c)) for a, b, c in places)  # below 0: a cavity
        self.is_closed = volume > 0 and len(edges) == 3 * len(places) and all((b, a) in edges for a, b in edges)
        self.index_around = 1
        self.corners = points = [p for t in self.triangles for p in (t.a, along(t.a, 1, t.ab), along(t.a, 1, t.ac))]
        self.centre = times(1 / len(points), blend([1.0] * len(points), points))
        self.radius = max(math.dist(point, self.centre) for point in points) * 1.0001

    @staticmethod
    def looks(model, replacement, ambient):
        """Returns (material, texture, emission) of each name."""
        found, statements = {}, model.statements()
        for name in {name for name, _ in model.faces}:
            own = statements.get(name, {})
            texture = Texture(model.path.parent / own["map_Kd"], "srgb", True) if "map_Kd" in own else None
            emission = tuple(float(number) for number in own["Ke"].split()) if "Ke" in own else BLACK
            keys = from_mtl(own)
            keys["ambient"] *= ambient
            found[name] = (replacement or Material(keys), texture, emission)
        return found

    @staticmethod
    def corner_normals(model, kind, crease):
        """Returns the corners' unit normals of each triangle, or None if it is flat."""
        if kind == "smooth":
            return smooth_normals([[corner[0] for corner in corners] for _, corners in model.faces], crease)
        if kind == "flat":
            return [None] * len(model.faces)
        of_file = [[corner[2] for corner in corners] for _, corners in model.faces]
        return [list(map(unit, normals)) if None not in normals and all(map(length, normals)) else None
                for normals in of_file]

    def normal_in_world(self, normal):
        """Returns a normal of the file's coordinates in the world's."""
        return unit(self.turn(tuple(n / s for n, s in zip(normal, self.scale))))

    def missed(self, origin, direction):
        """Returns whether a line certainly misses all of it."""
        axis = cross(minus(origin, self.centre), direction)
        return dot(axis, axis) > self.radius**2 * dot(direction, direction)

    def passed(self, point, way, _, on):
        """Returns the factor of a segment from a point on a triangle, or on none of them."""
        factor = WHITE
        if self.missed(point, way):
            return factor
        for triangle in self.triangles:
            crossing = None if triangle is on else triangle.crossing(point, way)
            if crossing and 0 < crossing[0] < 1:
                material = triangle.material
                factor = product(factor, times(material.shares[crossing[1]][1], material.colour))
        return tuple(channel if channel >= LEAST_PRODUCT else 0.0 for channel in factor)


class Camera:
    """Eye and target of a frame, and the directions of the picture."""

    def __init__(self, keys, frame):
        turn = 2 * math.pi * frame / keys.get("frames", 1)
        self.eye, around = self.place(keys["eye"], turn)
        target, _ = self.place(keys.get("target", (0, 0, 0)), turn)
        self.forward = unit(minus(target, self.eye))
        right = cross(self.forward, (0, 0, 1))
        if length(right) < 1e-9:
            sign = math.copysign(1, self.forward[2])
            self.forward, self.up = (0, 0, sign), times(sign, around)
            self.right = cross(self.forward, self.up)
        else:
            self.right = unit(right)
            self.up = cross(self.right, self.forward)
        self.half = math.tan(math.radians(keys.get("field_of_view", 60)) / 2)

    @staticmethod
    def place(keys, t):
        """Returns a point, and the direction from the axis to it."""
        if not isinstance(keys, dict):
            flat = math.hypot(keys[0], keys[1])
            return tuple(keys), (keys[0] / flat, keys[1] / flat, 0) if flat > 0 else (1, 0, 0)
        r, z = (keys.get(f"{q}0", 0) + keys.get(f"{q}_amplitude", 0)
                * math.sin(keys.get(f"{q}_frequency", 0) * t + keys.get(f"{q}_phase", 0)) for q in "rz")
        phi = keys.get("phi0", 0) + keys.get("phi_frequency", 0) * t
        around = (math.cos(phi), math.sin(phi), 0)
        return (r * around[0], r * around[1], z), around

    def direction(self, i, j, cells):
        """Returns the direction of a sample i and j half cells from the middle, with so many cells to a row."""
        h = self.half / cells
        return unit(along(along(self.forward, i * h, self.right), -j * h, self.up))


class Environment:
    """A picture all around."""

    def __init__(self, keys, folder):
        self.texture = Texture(folder / keys["file"], keys.get("curve", "srgb"), True, clamps_rows=True)
        self.intensity, self.turn = keys.get("intensity", 1), keys.get("rotation", 0) / 360

    def at(self, direction):
        """Returns the light from a direction."""
        x, y, z = direction
        s = 0.5 + self.turn - math.atan2(y, x) / (2 * math.pi)
        return times(self.intensity, self.texture.at(s, math.atan2(math.hypot(x, y), z) / math.pi))


class Scene:
    """A scene file, and the light along rays."""

    def __init__(self, path, frame=0):
        path = Path(path)
        keys = json.loads(path.read_text("utf-8"))
        image = keys.get("image", {})
        self.width, self.height = image.get("width", 640), image.get("height", 480)
        self.samples, self.depth = image.get("samples", 3), image.get("depth", 8)
        self.cutoff, self.exposure = image.get("cutoff", 0), image.get("exposure", 1)
        self.background = tuple(keys.get("background", BLACK))
        self.environment = Environment(keys["environment"], path.parent) if "environment" in keys else None
        self.camera = Camera(keys["camera"], frame)
        materials = {name: Material(own) for name, own in keys.get("materials", {}).items()}
        self.things = [Solid(own, materials) for own in keys.get("solids", [])]
        self.meshes = [Mesh(own, materials, path.parent) for own in keys.get("meshes", [])]
        by_size = sorted(self.things, key=lambda solid: -solid.radius)
        for outer, inner in itertools.product(by_size, by_size + [mesh for mesh in self.meshes if mesh.is_closed]):
            if inner is not outer and outer.holds(inner.corners):
                inner.index_around = outer.material.index  # the smallest one that holds it comes last
        if "floor" in keys:
            self.things.append(Floor(keys["floor"], materials, path.parent))
        self.lights = [Light(own["position"], tuple(own.get("colour", WHITE)), own)
                       for own in keys.get("lights", [])]
        self.lights += [light for thing in self.things for light in getattr(thing, "lights", ())]

    def nearest(self, origin, direction, left, within):
        """Returns the first surface that a ray hits, or None."""
        best = (math.inf, None, None)
        found = None
        for thing in self.things:
            hit = thing.meet(origin, direction, left, within)
            if hit and hit[0] < best[0]:
                best, found = hit, thing
        for mesh in self.meshes:
            for triangle in () if mesh.missed(origin, direction) else mesh.triangles:
                hit = None if triangle is left else triangle.crossing(origin, direction)
                if hit and 0 < hit[0] < best[0]:
                    best, found = hit, triangle
        return found and found.surface(along(origin, best[0], direction), direction, best[1], best[2])

    def passing_light(self, surface, way, light, within):
        """Returns T: the share of a light that reaches a point, from inside the surface's thing or from outside."""
        factor = WHITE
        for thing in self.things:
            on = within if thing is surface.thing else None
            factor = product(factor, thing.passed(surface.point, way, light, on))
            if factor == BLACK:
                return factor
        for mesh in self.meshes:
            is_own = mesh is getattr(surface.thing, "mesh", None) and dot(surface.normal, way) > 0
            point = along(surface.point, 1, surface.lift) if is_own else surface.point
            factor = product(factor, mesh.passed(point, way, light, surface.thing))
        return factor

    def shaded(self, surface, direction):
        """Returns the light that a point sends out by itself."""
        if surface.ends:
            return surface.emission
        material, normal = surface.material, surface.normal
        total = along(surface.emission, material.ambient, surface.colour)
        mirrored = along(direction, -2 * dot(normal, direction), normal)
        for light in self.lights:
            way = minus(light.position, surface.point)
            distance = length(way)
            if distance == 0 or light.solid is surface.thing and surface.face in light.faces:
                continue
            upright = dot(normal, way) / distance
            response = BLACK
            if upright > 0:
                shine = max(0, dot(mirrored, way) / distance)**material.shininess
                shine = material.specular * shine if shine >= LEAST_POWER else 0
                response = along((shine,) * 3, material.diffuse * upright, surface.colour)
            elif material.lit_from_behind and upright < 0:
                transmission = material.shares[surface.side][1]
                response = times(transmission * material.diffuse * -upright, surface.colour)
            if response != BLACK:
                within = (surface.side == INNER) == (upright > 0)
                arriving = product(light.reaching(distance), self.passing_light(surface, way, light, within))
                total = along(total, 1, product(arriving, response))
        return total

    def going_on(self, surface, direction):
        """Yields the continuing rays: (factor of the weight, direction, whether within)."""
        material, normal = surface.material, surface.normal
        reflection, transmission = material.shares[surface.side]
        cosine = -dot(normal, direction)
        passing = direction
        index = material.index / getattr(surface.thing, "index_around", 1)
        if index != 1:
            q = 1 / index if surface.side == OUTER else index
            square = 1 - q * q * (1 - cosine * cosine)
            if square < 0:
                reflection, transmission = reflection + transmission, 0
            else:
                passing = along(times(q, direction), q * cosine - math.sqrt(square), normal)
        if reflection > 0:
            mirrored = along(direction, 2 * cosine, normal)
            yield times(reflection, material.tint), mirrored, surface.side == INNER
        if transmission > 0:
            yield times(transmission, surface.colour), passing, surface.side == OUTER

    def beyond(self, direction):
        """Returns what a ray sees that hits nothing."""
        return along(self.background, 1, self.environment.at(direction)) if self.environment else self.background

    def sample(self, direction):
        """Returns the sum of the rays of one tree."""
        total = BLACK
        rays = [(WHITE, 0, self.camera.eye, direction, None, False)]
        while rays:
            weight, level, origin, direction, left, within = rays.pop()
            surface = self.nearest(origin, direction, left, within)
            radiance = self.shaded(surface, direction) if surface else self.beyond(direction)
            radiance = tuple(min(max(self.exposure * r, 0), CONTRIBUTION_LIMIT) for r in radiance)
            total = along(total, 1, product(weight, radiance))
            if surface is None or surface.ends or level == self.depth:
                continue
            for factor, way, inside in self.going_on(surface, direction):
                below = product(weight, factor)
                if max(below) >= self.cutoff:
                    rays.append((below, level + 1, surface.point, way, surface.thing, inside))
        return total

    def pixel(self, x, y):
        """Returns the mean of a pixel's samples."""
        n = self.samples
        total = BLACK
        for b in range(n):
            for a in range(n):
                i = 2 * (x * n + a) + 1 - self.width * n
                j = 2 * (y * n + b) + 1 - self.height * n
                total = along(total, 1, self.sample(self.camera.direction(i, j, self.width * n)))
        return times(1 / (n * n), total)

    def picture(self):
        """Returns all pixels, row by row from the top."""
        return [[self.pixel(x, y) for x in range(self.width)] for y in range(self.height)]


def write_pfm(path, rows):
    """Writes rows from the bottom, little endian."""
    values = array.array("f", (channel for row in reversed(rows) for pixel in row for channel in pixel))
    if sys.byteorder == "big":
        values.byteswap()
    Path(path).write_bytes(f"PF\n{len(rows[0])} {len(rows)}\n-1.0\n".encode() + values.tobytes())
