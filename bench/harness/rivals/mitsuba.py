# SPDX-License-Identifier: MIT
"""Scenes for Mitsuba 3, and its runs."""
import json
import math
import subprocess
import sys

from harness.rivals import shapes
from harness.run import machine
from harness.run.program import ROOT, Problem, message_in

PROGRAM = ROOT / "bench/rivals/mitsuba_pictures.py"
PLACES = (sys.executable, ROOT / "build/rivals/bin/python")  # where it may be installed
NONE = ("Mitsuba 3 is not installed: python3 -m venv build/rivals && build/rivals/bin/pip install mitsuba; it needs an LLVM "
        "(DRJIT_LIBLLVM_PATH)")
SAMPLERS = ("independent", "multijitter")


def find():
    """The Python that has it; raises Problem where there is none."""
    for place in PLACES:
        try:
            found = subprocess.run([place, "-c", "import mitsuba"], capture_output=True).returncode == 0
        except OSError:
            found = False
        if found:
            return place
    raise Problem(3, NONE)


def write_object(polygons, file):
    corners = [corner for triangle in shapes.triangles(polygons) for corner in triangle]
    file.write_text("".join(f"v {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in corners) + "".join(
        f"f {i} {i + 1} {i + 2}\n" for i in range(1, len(corners), 3)), encoding="utf-8")
    return {"type": "obj", "filename": str(file), "face_normals": True}


def face(material):
    return {"type": "whitted", **{name: {"colour": shapes.times(material[share], material[tint])} for name, share, tint in (
        ("lit", "diffuse", "colour"), ("mirror", "reflection", "mirror_tint"), ("through", "transmission", "colour"))}}


def sensor(scene, size, sampler):
    camera = scene["camera"]
    return {"type": "perspective", "fov": camera["field_of_view"], "fov_axis": "x",
            "to_world": {"look_at": {"origin": camera["eye"], "target": camera["target"], "up": [0, 0, 1]}},
            "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "rfilter": {"type": "box"}, "pixel_format": "rgb",
                     "component_format": "float32"}, "sampler": {"type": sampler}}


def light(each):
    """Of an inverse square, which hedron's falloff comes to far away from where it begins."""
    value = shapes.times(math.pi * each["falloff_distance"] ** 2, shapes.colour_of(each))
    return {"type": "point", "position": each["position"], "intensity": {"type": "rgb", "value": value}}


def plugins(scene, size, folder):
    """The volumetric path tracer's shadow rays go through what lets light pass, those of the other one do not."""
    return {"type": "scene", "integrator": {"type": "volpath", "max_depth": scene["image"]["depth"] + 2},
            **{f"sensor{i}": sensor(scene, size, sampler) for i, sampler in enumerate(SAMPLERS)},
            **{f"light{i}": light(each) for i, each in enumerate(scene["lights"])},
            **{f"shape{i}": {**write_object(polygons, folder / f"mitsuba-{i}.obj"), "bsdf": face(material)}
               for i, (polygons, material) in enumerate(shapes.things(scene))}}


class Mitsuba:
    name = "Mitsuba 3"

    def __init__(self, scene, size, folder):
        self.python, self.version = find(), None
        self.folder, self.scene = folder, plugins(scene, size, folder)

    @staticmethod
    def settings(quick):
        """{name: (sampler, samples a pixel)}"""
        counts = (4, 64, 256) if quick else (4, 16, 64, 256, 1024)
        return {f"{sampler} {count}": (place, count) for place, sampler in enumerate(SAMPLERS) for count in counts}

    @staticmethod
    def deep(quick):
        return 1, 1024 if quick else 4096

    def render(self, setting, file, turn):
        asked = {"threads": machine.cores(), "scene": self.scene, "sampler": setting[0], "spp": setting[1], "seed": turn + 1,
                 "file": str(file)}
        done = subprocess.run([self.python, PROGRAM], input=json.dumps(asked), capture_output=True, text=True)
        if done.returncode != 0:
            raise Problem(3, f"Mitsuba 3 cannot render: {message_in(done.stderr)[:200]}; an LLVM that is too old ends it "
                             "(DRJIT_LIBLLVM_PATH names another)")
        found = json.loads(done.stdout)
        self.version = found.pop("version")
        return found
