# SPDX-License-Identifier: MIT
"""The default scene under any number of point lights without falloff; its edge lights stay bright spots
that light nothing."""
import json
import math

GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))
TOTAL_INTENSITY = 1.2
COLOURS = [[1, 0.9, 0.8], [0.6, 0.7, 1], [0.8, 1, 0.85], [1, 0.8, 1], [1, 1, 0.7]]


def position(place, count):
    """Evenly over the upper part of a spheroid around the solids, so that most floor points have
    solids between them and some of the lights."""
    height = (place + 0.5) / count
    ring = math.sqrt(1 - height * height)
    angle = place * GOLDEN_ANGLE
    return [round(9 * ring * math.cos(angle), 4), round(9 * ring * math.sin(angle), 4), round(0.2 + 6 * height, 4)]


def lights(count):
    return [{"position": position(place, count), "colour": COLOURS[place % len(COLOURS)],
             "intensity": TOTAL_INTENSITY / count} for place in range(count)]


def scene(default, count):
    """`default` is the default scene's JSON as read; a copy is returned."""
    changed = json.loads(json.dumps(default))
    for solid in changed["solids"]:
        solid["edge_lights"]["intensity"] = 0
    changed["lights"] = lights(count)
    return changed


def write(default_file, folder, count):
    """The path of the scene file."""
    file = folder / f"lights-{count}.json"
    default = json.loads(default_file.read_text(encoding="utf-8"))
    file.write_text(json.dumps(scene(default, count)) + "\n", encoding="utf-8")
    return file
