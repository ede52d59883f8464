# SPDX-License-Identifier: MIT
"""Scenes for POV-Ray, and its runs."""
import array
import re
import shutil
import subprocess
import sys

from harness.rivals import shapes
from harness.run import machine, pfm
from harness.run.program import Problem

TOOK = re.compile(r"Trace Time:[^(]*\(([\d.]+) seconds\)\s+using \d+ thread\(s\) with ([\d.]+) CPU-seconds")
HEAD = re.compile(rb"P6\s+(?:#.*\n)*(\d+)\s+(\d+)\s+65535\s")


def vector(numbers):
    return "<" + ", ".join(f"{x:.17g}" for x in numbers) + ">"


def texture(material):
    """There diffuse light is less by the share that passes, which is undone."""
    share = material["transmission"]
    return (f"texture {{ pigment {{ rgbf {vector([*material['colour'], share])} }} finish {{ ambient 0 "
            f"diffuse {material['diffuse'] / (1 - share):.17g} "
            f"reflection {{ rgb {vector(shapes.times(material['reflection'], material['mirror_tint']))} }} }} }}")


def mesh(polygons, material):
    """As fast as an intersection of planes, and the same picture."""
    corners = "\n".join(f"triangle {{ {', '.join(map(vector, triangle))} }}" for triangle in shapes.triangles(polygons))
    return f"mesh {{\n{corners}\n{texture(material)} }}"


def light(each):
    """Its falloff is 2 / (1 + (d / d0)^2)."""
    return (f"light_source {{ {vector(each['position'])}, rgb {vector(shapes.times(0.5, shapes.colour_of(each)))} "
            f"fade_distance {each['falloff_distance']:.17g} fade_power 2 }}")


def scene_text(scene, size):
    eye, forward, right, up, tangent = shapes.view(scene)
    parts = [*map(light, scene["lights"]), *(mesh(*thing) for thing in shapes.things(scene))]
    return f"""#version 3.7;
global_settings {{ assumed_gamma 1 max_trace_level {scene["image"]["depth"] + 1} adc_bailout 0 }}
camera {{ perspective location {vector(eye)} direction {vector(forward)}
right {vector(shapes.times(2 * tangent, right))} up {vector(shapes.times(2 * tangent * size[1] / size[0], up))} }}
""" + "\n".join(parts) + "\n"


def read_picture(file):
    """(width, height, linear values from the top) of 16 bits each."""
    data = file.read_bytes()
    head = HEAD.match(data)
    numbers = array.array("H")
    numbers.frombytes(data[head.end():])
    if sys.byteorder == "little":
        numbers.byteswap()
    return int(head[1]), int(head[2]), [number / 65535 for number in numbers]


def smaller(picture, factor):
    """Each pixel is the mean of a square of pixels."""
    width, height, values = picture
    found = []
    for top in range(0, height, factor):
        rows = [values[3 * width * y:3 * width * (y + 1)] for y in range(top, top + factor)]
        sums = list(map(sum, zip(*rows)))
        found += [sum(sums[3 * x + channel:3 * (x + factor) + channel:3]) / factor ** 2
                  for x in range(0, width, factor) for channel in range(3)]
    return width // factor, height // factor, found


class Povray:
    name = "POV-Ray"

    def __init__(self, scene, size, folder):
        self.path = shutil.which("povray")
        if self.path is None:
            raise Problem(3, "POV-Ray is not installed: its package is povray")
        self.size, self.folder, self.version = size, folder, None
        (folder / "rivals.pov").write_text(scene_text(scene, size), encoding="utf-8")

    @staticmethod
    def settings(quick):
        """{name: (how many times as wide, options)}; method 1 is a grid where neighbours differ, 2 divides pixels further."""
        grids = {f"grid of {n}": (1, f"+AM1 +A0.0 +R{n} -J") for n in ((2, 4) if quick else (2, 3, 4))}
        finer = {f"threshold {threshold}, depth {depth}": (1, f"+AM2 +A{threshold} +R{depth} -J") for threshold, depth in (
            ("0.3", 3), ("0.1", 3), ("0.03", 4), *(() if quick else (("0.1", 4), ("0.01", 5))))}
        return {"one sample": (1, "-A"), **grids, **finer}

    @staticmethod
    def deep(quick):
        return 8 if quick else 16, "-A"

    def render(self, setting, file, _turn):
        factor, options = setting
        done = subprocess.run([self.path, "+Irivals.pov", "+Orivals.ppm", "+FP16", f"+W{factor * self.size[0]}",
                               f"+H{factor * self.size[1]}", "-D", "-V", "File_Gamma=1.0", f"+WT{machine.cores()}",
                               *options.split()], cwd=self.folder, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        took = TOOK.search(done.stderr)
        if done.returncode != 0 or not took:
            raise Problem(3, f"POV-Ray cannot render: {done.stderr.strip()[-200:]}")
        self.version = re.search(r"[Vv]ersion ([\d.]+\d)", done.stderr)[1]
        pfm.write(file, *smaller(read_picture(self.folder / "rivals.ppm"), factor))
        return {"cpu": float(took[2]), "wall": float(took[1])}
