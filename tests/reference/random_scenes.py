# SPDX-License-Identifier: MIT
"""Makes random scenes with all features of the model: a seed makes the same scene on every machine."""
import math
import random
import struct

KINDS = ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"]
PLACES = [[-1.5, 0, 0], [1.2, -1.1, 0.2], [0.7, 1.5, -0.1]]  # of solids that do not touch
WIDTH, HEIGHT = 24, 18
AROUND = 5  # corners of a ring of a mesh


class Maker:
    """Makes one scene in a folder; the files that it names begin with the seed."""

    def __init__(self, seed, folder):
        self.dice = random.Random(seed)
        self.name = str(seed)
        self.folder = folder
        self.materials = {}

    def chance(self, share):
        """Returns true in that share of all cases."""
        return self.dice.random() < share

    def number(self, low, high):
        """Returns a number between two."""
        return round(self.dice.uniform(low, high), 6)

    def point(self, reach):
        """Returns a point of a cube about the origin."""
        return [self.number(-reach, reach) for _ in range(3)]

    def colour(self, low=0.2):
        """Returns a colour that is not too dark."""
        return [self.number(low, 1) for _ in range(3)]

    def shares(self, inside, opaque):
        """Returns reflection and transmission, either of them often 0."""
        reflection = self.number(0.05, 0.5) if self.chance(0.6) else 0
        transmission = self.number(0.1, 0.5) if not opaque and self.chance(0.7) else 0
        return {f"{inside}reflection": reflection, f"{inside}transmission": transmission}

    def material(self, index=1, opaque=False, alike=False):
        """Makes a material and returns its name; `alike`: on both sides."""
        keys = {"colour": self.colour(), "ambient": self.number(0, 0.3), "diffuse": self.number(0, 1),
                "specular": self.number(0, 1), "shininess": self.dice.choice([1, 5, 64, 300]),
                **self.shares("", opaque), "index_of_refraction": index}
        if self.chance(0.6):
            keys["mirror_tint"] = self.colour()
        if not alike and self.chance(0.6):
            keys |= self.shares("inner_", opaque)
        if self.chance(0.5):
            keys["lit_from_behind"] = True
        name = f"m{len(self.materials)}"
        self.materials[name] = keys
        return name

    def falloff(self):
        """Returns either of the two or none."""
        name, low, high = self.dice.choice([("", 0, 0), ("falloff_distance", 1, 5), ("falloff_end", 5, 12)])
        return {name: self.number(low, high)} if name else {}

    def light(self):
        """Returns a point light: anywhere, in half of the cases in or near solids, or below the floor."""
        place = self.point(3.5)
        if self.chance(0.3):
            place = [a + b for a, b in zip(self.dice.choice(PLACES), self.point(0.2))]
        return {"position": place, "colour": self.colour(), "intensity": self.number(0.3, 1.5),
                **self.falloff()}

    def edge_lights(self, radius):
        """Returns lights with discs, lights alone, or discs alone."""
        keys = {"per_edge": self.dice.choice([1, 2, 3]),
                "colours": [self.colour(0) for _ in range(self.dice.choice([1, 2, 4, 7, 30]))]}
        if self.chance(0.6):
            keys |= {"intensity": self.number(0.02, 0.2), **self.falloff(), "per_edge": 1}
        if self.chance(0.8):
            keys["disc_radius"] = self.dice.choice([0.05, 0.15, 0.5]) * radius
            keys["disc_radiance"] = self.number(0, 3)
        return keys

    def solid(self, centre, radius, refracts, lights):
        """Returns a solid in its place."""
        index = self.dice.choice([0.7, 1.3, 1.5, 2.4]) if refracts else 1
        keys = {"kind": self.dice.choice(KINDS), "centre": centre, "circumradius": radius,
                "rotation": self.point(180), "material": self.material(index)}
        if self.chance(0.6):
            keys["rim"] = {"width": self.number(0.02, 0.12) * radius, "material": self.material(opaque=True)}
        if lights:
            keys["edge_lights"] = self.edge_lights(radius)
        return keys

    def solids(self, overlapping):
        """Returns none to three separate solids, or two about one place."""
        if overlapping:
            return [self.solid(self.point(0.5), self.number(0.7, 1.3), False, i == 0) for i in range(2)]
        places = self.dice.sample(PLACES, self.dice.choice([0, 1, 2, 3, 3]))
        return [self.solid(place, self.number(0.7, 1.1), self.chance(0.5), i == 0 and self.chance(0.7))
                for i, place in enumerate(places)]

    def nested(self, outer):
        """Returns one to three solids, each within the last: opaque, a bubble, or of another index."""
        found, clear = [outer], {f"{side}{share}": 0.4 for side in ("", "inner_") for share in ("reflection", "transmission")}
        self.materials[outer["material"]] |= clear | {"index_of_refraction": 1.5}
        for _ in range(self.dice.choice([1, 1, 2, 3])):
            room = found[-1]["circumradius"] * (0.33 if found[-1]["kind"] == "tetrahedron" else 0.57)  # inscribed sphere
            centre = [c + self.number(-0.05, 0.05) * room for c in found[-1]["centre"]]
            found.append(self.solid(centre, self.number(0.7, 0.9) * room, self.chance(0.7), False))
            self.materials[found[-1]["material"]] |= clear if self.chance(0.7) else dict.fromkeys(clear, 0)
        return found[1:]

    def texture(self, name):
        """Makes a picture in the data format and returns its size."""
        width, height = self.dice.randint(1, 5), self.dice.randint(1, 5)
        pixels = self.dice.randbytes(4 * width * height)
        (self.folder / name).write_bytes(struct.pack("<ii", width, height) + pixels)
        return width, height

    def floor(self, cutting):
        """Returns a quadrilateral below the solids, or a steeper one that cuts them; either side of it may be above."""
        level, slope = (0.1, self.number(-0.5, 0.5)) if cutting else (-1.5, self.number(-0.05, 0.05))
        square = [(-3, 3), (3, 3), (3, -3), (-3, -3)]
        corners = [[coordinate + self.number(-0.5, 0.5) for coordinate in corner] for corner in square]
        keys = {"corners": [[x, y, level + slope * (x - y)] for x, y in corners[::1 if slope > 0 else -1]],
                "material": self.material(alike=True)}
        if self.chance(0.7):
            name = f"{self.name}-floor.data"
            self.texture(name)
            keys["texture"] = {"file": name, "curve": self.dice.choice(["srgb", "linear"])}
        return keys

    def words(self, statement, numbers):
        """Returns a line of a file of numbers."""
        return " ".join([statement, *(f"{number:.6f}" for number in numbers)])

    def library(self):
        """Makes a material library; returns the size of its texture, or (1, 1)."""
        size, lines = (1, 1), []
        for material in ("paint", "glass"):
            black = material == "glass" and self.chance(0.4)
            lines += [f"newmtl {material}", self.words("Kd", [0, 0, 0] if black else self.colour()),
                      self.words("Ka", self.colour(0)), self.words("Ks", self.colour(0)),
                      self.words("Ns", [self.number(1, 90)])]
            lines += [f"illum {self.dice.choice([1, 2, 3, 4, 6, 7])}"] * self.chance(0.9)
            lines += [self.words("Ke", self.colour(0))] * self.chance(0.3)
        if self.chance(0.8):
            size = self.texture(f"{self.name}-mesh.data")
            lines += [f"map_Kd {self.name}-mesh.data"]
        lines += [self.words(self.dice.choice(["d", "Tr"]), [self.number(0.3, 0.9)])] * self.chance(0.7)
        lines += [self.words("Ni", [self.number(1.2, 2)])] * self.chance(0.5)
        lines += [self.words("Tf", self.colour())] * self.chance(0.4)
        (self.folder / f"{self.name}.mtl").write_text("\n".join(lines) + "\n")
        return size

    def model(self):
        """Makes a bumpy shape, often with a hole: rings of quadrilaterals between two poles."""
        size, shift = self.library(), self.dice.choice([0, 1, -2])
        turns = [2 * math.pi * i / AROUND for i in range(AROUND)]
        vertices = [(math.cos(turn) * self.number(0.4, 1), math.sin(turn) * self.number(0.4, 1), z)
                    for z in (-0.4, 0.4) for turn in turns] + [(0, 0, self.number(-1.2, 0)), (0, 0, 1)]
        lines = [f"mtllib {self.name}.mtl"] + [self.words("v", vertex) for vertex in vertices]
        lines += [self.words("vn", [a + b for a, b in zip(vertex, self.point(0.3))]) for vertex in vertices]
        for _ in vertices:  # where the texture begins again is left out
            lines.append(self.words("vt", (shift + self.number(0.51 / n, 1 - 0.51 / n) for n in size)))
        form = self.dice.choice(["{0}", "{0}/{0}", "{0}//{0}", "{0}/{0}/{0}"])
        step = self.dice.choice([1, 1, -1])  # or inside out
        for i in range(AROUND - self.chance(0.3)):
            j = (i + 1) % AROUND
            upper, lower = (AROUND + i, AROUND + j), (j, i)
            for name, face in (("paint", (*lower, 2 * AROUND)), ("glass", (lower[0], *upper[::-1])),
                               ("glass", (upper[0], *lower[::-1])), ("paint", (*upper, 2 * AROUND + 1))):
                lines.append(f"usemtl {name}")
                lines.append("f " + " ".join(form.format(corner + 1) for corner in face[::step]))
        (self.folder / f"{self.name}.obj").write_text("\n".join(lines) + "\n")

    def mesh(self, centre):
        """Returns the shape in a place."""
        keys = {"file": f"{self.name}.obj", "position": centre, "rotation": self.point(180),
                "scale": self.dice.choice([0.8, [0.7, 1, 0.5], [0.7, -1, 0.5]]), "up": self.dice.choice("yz"), "crease": self.dice.choice([20, 60, 180]),
                "normals": self.dice.choice(["file", "flat", "smooth"]), "ambient": self.dice.choice([0, 0.5])}
        if self.chance(0.5):
            keys["material"] = self.material(self.dice.choice([1, 1.4]))
        return keys

    def camera(self, inside):
        """Returns a fixed eye, also upright above the scene, a path, or an eye near a place."""
        keys = {"field_of_view": self.number(25, 60), "target": self.point(0.3),
                "eye": [self.dice.choice([-5, 5]), self.number(-2, 2), self.number(0.3, 3)]}
        if inside:
            keys |= {"eye": [c + self.number(-0.1, 0.1) for c in inside], "target": self.point(2)}
        elif self.chance(0.3):
            laws = [f"{q}_{law}" for q in "rz" for law in ("frequency", "phase", "amplitude")]
            path = {law: self.number(0, 2) for law in laws}
            path |= {"r0": 6, "z0": 2.5, "phi0": self.number(0, 6), "phi_frequency": self.dice.choice([1, 2])}
            keys |= {"frames": 10, "eye": path}
        elif self.chance(0.4):
            keys |= self.dice.choice([{"eye": [0, 0, 5], "target": [0, 0, 0]},
                                      {"eye": [1, 0.5, 6], "target": [1, 0.5, 0]},
                                      {"eye": {"z0": 6, "phi0": 2}, "target": {"phi_frequency": 1}}])
        return keys

    def scene(self):
        """Returns the keys of the scene, and the number of a frame of it."""
        overlapping = self.chance(0.25)
        keys = {"hedron": 1, "materials": self.materials, "solids": self.solids(overlapping),
                "image": {"aa": "grid", "width": WIDTH, "height": HEIGHT, "samples": self.dice.choice([1, 1, 1, 2, 3]),
                          "depth": self.dice.choice([0, 3, 4, 5, 6]), "cutoff": self.dice.choice([0, 0.03]),
                          "exposure": self.number(0.5, 2)},
                "background": self.colour(0),
                "lights": [self.light() for _ in range(self.dice.randint(0, 3))]}
        if self.chance(0.4):
            self.texture(f"{self.name}-sky.data")
            keys["environment"] = {"file": f"{self.name}-sky.data", "intensity": self.number(0.2, 2),
                                   "rotation": self.number(-400, 400), "curve": self.dice.choice(["srgb", "linear"])}
        if self.chance(0.8):
            keys["floor"] = self.floor(overlapping)
        if self.chance(0.5) or not keys["solids"]:
            self.model()
            keys["meshes"] = [self.mesh(self.point(0.3)), self.mesh([0, 0, 1.9])][self.chance(0.3):]
        things = keys["solids"] + keys.get("meshes", [])
        if not overlapping and keys["solids"] and self.chance(0.4):
            keys["solids"] += self.nested(keys["solids"][0])
            inmost = keys["solids"][-1]
            if self.chance(0.7):
                self.model()
                keys["meshes"] = [self.mesh(inmost["centre"]) | {"scale": 0.25 * inmost["circumradius"]}]
            keys["image"] |= {"depth": 6, "cutoff": 0.03}
        inside = self.dice.choice(things) if self.chance(0.25) else {}
        keys["camera"] = self.camera(inside.get("centre") or inside.get("position"))
        return keys, self.dice.randrange(keys["camera"].get("frames", 1))
