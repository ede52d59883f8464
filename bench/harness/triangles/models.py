# SPDX-License-Identifier: MIT
"""One object of as many triangles as wanted, in two scenes: `whole` has all that a mesh can ask for, mirrored and transmitted
rays, and coloured shadows of two lights; in `near` every primary ray meets the object, and there are no others."""
import re

from harness.measure.numbers import count_words
from harness.measure.scenes import read_scene, write_scene
from harness.run import tool
from harness.run.program import ROOT

SAID = re.compile(r": (\d+) triangles;")
TICKS = {count_words(10 ** power): 10 ** power for power in range(1, 8)}  # of an axis


def make(program, folder, count):
    """(file, triangles): the object, which has about as many as asked for."""
    file = folder / f"sphere-{count}.obj"
    tool.run(program.beside("hedron_model"), "sphere", count, "-o", file)
    with open(file, encoding="utf-8") as lines:
        return file, int(SAID.search(lines.readline()).group(1))


def write_in(kind, file, folder, count):
    """The path of the scene file."""
    scene = read_scene(ROOT / f"bench/scenes/templates/{kind}.json")
    scene["meshes"][0]["file"] = str(file)
    return write_scene(scene, folder / f"{kind}-{count}.json")
