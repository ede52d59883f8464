# SPDX-License-Identifier: MIT
"""Reads OBJ and MTL by docs/reference/files.md, smooth normals by docs/model.md; polygons are fans of a corner."""
import math
import struct

from vectors import BLACK, WHITE, along, cross, dot, minus, times, unit


def single(value):
    """Returns a number rounded to float."""
    return struct.unpack("f", struct.pack("f", value))[0]


class Model:
    """An OBJ file: faces of corners (v, vt, vn), each None or a tuple, and the material that each has."""

    def __init__(self, path):
        self.path, self.faces, self.libraries = path, [], []
        points = {"v": [], "vt": [], "vn": []}
        faces, name = [], None
        for line in path.read_text("utf-8").splitlines():
            word, _, rest = line.strip().partition(" ")
            if word in points:
                numbers = [single(float(number)) for number in rest.split()]
                points[word].append(tuple(numbers[:3] if word != "vt" else (numbers + [0.0])[:2]))
            elif word == "f":
                faces.append((name, [self.corner(text) for text in rest.split()]))
            elif word == "usemtl":
                name = rest.strip()
            elif word == "mtllib":
                self.libraries.append(rest.strip())
        for name, corners in faces:
            corners = [[None if i is None else own[i] for own, i in zip(points.values(), corner)]
                       for corner in corners]
            self.faces += [(name, (corners[0], b, c)) for b, c in zip(corners[1:], corners[2:])]

    @staticmethod
    def corner(text):
        """Returns the three indices of a corner, from 0; None for missing ones."""
        return [int(number) - 1 if number else None for number in (text.split("/") + ["", ""])[:3]]

    def statements(self):
        """Returns the statements of each material of the libraries, by name."""
        found, current = {}, None
        for library in self.libraries:
            for line in (self.path.parent / library).read_text("utf-8").splitlines():
                word, _, rest = line.strip().partition(" ")
                if word == "newmtl":
                    current = {}
                    found.setdefault(rest.strip(), current)
                elif current is not None and word:
                    current[word] = rest.strip()
        return found


def from_mtl(statements):
    """Returns the keys of a material of an MTL library."""
    def numbers(word, unless):
        return [float(number) for number in statements[word].split()] if word in statements else unless

    illum = int(statements.get("illum", -1))
    shine, passing = numbers("Ks", BLACK), numbers("Tf", WHITE)
    opacity = numbers("d", [1 - numbers("Tr", [0])[0]])[0]
    keys = {"colour": numbers("Kd", WHITE), "ambient": sum(numbers("Ka", BLACK)) / 3,
            "specular": 0 if illum in (0, 1) else sum(shine) / 3,
            "shininess": min(max(math.floor(numbers("Ns", [64])[0] + 0.5), 1), 65536),
            "transmission": 1 - opacity, "diffuse": opacity}
    if 3 <= illum <= 9 and max(shine) > 0:
        keys.update(reflection=max(shine), mirror_tint=times(1 / max(shine), shine))
    if illum in (6, 7) and opacity == 1:
        keys.update(transmission=max(passing), diffuse=1 - max(passing))
    if max(keys["colour"]) == 0 and keys["transmission"] > 0:
        keys.update(colour=times(1 / max(passing), passing), diffuse=0)
    if keys["transmission"] > 0 and illum in (-1, 6, 7):
        keys["index_of_refraction"] = numbers("Ni", [1])[0]
    total = keys.get("reflection", 0) + keys["transmission"]
    if total > 1:
        keys.update(reflection=keys["reflection"] / total, transmission=keys["transmission"] / total)
    return keys


def smooth_normals(triangles, crease):
    """Returns three corner normals for each triangle: means of classes about each place."""
    normals = [unit(cross(minus(b, a), minus(c, a))) for a, b, c in triangles]
    about = {}
    for number, triangle in enumerate(triangles):
        for corner in range(3):
            about.setdefault(triangle[corner], []).append((number, corner))
    found = [[None] * 3 for _ in triangles]
    for users in about.values():
        classes = []
        for number, corner in users:
            own = {"members": [(number, corner)]}
            others = {triangles[number][(corner + 1) % 3], triangles[number][(corner + 2) % 3]}
            joined = [c for c in classes if any(
                others & {triangles[n][(k + 1) % 3], triangles[n][(k + 2) % 3]}
                and math.degrees(math.acos(min(1, dot(normals[n], normals[number])))) <= crease
                for n, k in c["members"])]
            for other in joined:
                own["members"] += other["members"]
            classes = [c for c in classes if c not in joined] + [own]
        for members in (c["members"] for c in classes):
            total = BLACK
            for n, k in members:
                a, b, c = (triangles[n][(k + i) % 3] for i in range(3))
                total = along(total, math.acos(dot(unit(minus(b, a)), unit(minus(c, a)))), normals[n])
            for n, k in members:
                found[n][k] = unit(total)
    return found
