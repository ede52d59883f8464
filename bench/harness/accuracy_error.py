# SPDX-License-Identifier: MIT
"""Errors of pictures: `hedron compare`, and what it does not count."""
import json
import math
import subprocess
from array import array

from harness.program import Problem, message_in


def compare(program, first, second):
    """What `hedron compare --json` prints. The first is held to the second."""
    done = subprocess.run([program.path, "compare", "--json", first, second], capture_output=True, text=True)
    if done.returncode not in (0, 1) or not done.stdout:  # 1: there are NaNs
        raise Problem(1, f"hedron compare: {message_in(done.stderr)}")
    return json.loads(done.stdout)


def values(file):
    """All numbers of a PFM that hedron wrote."""
    with open(file, "rb") as stream:
        kind, size, order = (stream.readline().split() for _ in range(3))
        if kind != [b"PF"] or float(order[0]) >= 0:
            raise Problem(1, f"{file} is no PFM with colours, little endian")
        found = array("f", stream.read())
    if len(found) != 3 * int(size[0]) * int(size[1]):
        raise Problem(1, f"{file} is cut off")
    return found


def not_finite(file):
    """How many numbers are NaN or infinite."""
    found = values(file)
    return 0 if math.isfinite(sum(found)) else sum(not math.isfinite(value) for value in found)


def step(value):
    """The place on the sRGB curve, 0..255, not rounded."""
    value = min(max(value, 0.0), 1.0)
    return 255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)


def share_within(first, second, steps):
    """Of the pixels, with no channel off by more than so many steps of 255."""
    pairs = [abs(step(one) - step(two)) if one != two else 0.0 for one, two in zip(values(first), values(second))]
    pixels = zip(pairs[0::3], pairs[1::3], pairs[2::3])
    return sum(max(pixel) <= steps for pixel in pixels) / (len(pairs) // 3)


def figures(program, picture, truth):
    """{"rmse", "largest", "p999", "above_1"} in steps of 255 on the display's curve."""
    found = compare(program, picture, truth)
    return {**{key: found["display"][key] for key in ("rmse", "largest", "p999")}, "above_1": found["above_1"]}
