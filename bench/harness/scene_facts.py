# SPDX-License-Identifier: MIT
"""What a scene file holds, as far as the cost of a frame depends on it."""
import json

FACES = {"tetrahedron": 4, "cube": 6, "octahedron": 8, "dodecahedron": 12, "icosahedron": 20}
EDGES = {"tetrahedron": 6, "cube": 12, "octahedron": 12, "dodecahedron": 30, "icosahedron": 30}
FLOOR_PLANES = 5


def lights_on_edges(solid):
    lights = solid.get("edge_lights", {})
    return lights.get("per_edge", 0) * EDGES[solid["kind"]] if lights.get("intensity", 0) > 0 else 0


def facts(file):
    """{"solids", "planes", "lights"}; lights that light nothing are left out."""
    scene = json.loads(file.read_text(encoding="utf-8"))
    solids = scene.get("solids", [])
    return {"solids": len(solids),
            "planes": sum(FACES[solid["kind"]] for solid in solids) + (FLOOR_PLANES if "floor" in scene else 0),
            "lights": len(scene.get("lights", [])) + sum(lights_on_edges(solid) for solid in solids)}
