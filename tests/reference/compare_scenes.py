#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Renders random scenes by hedron, in float and double, and by tracer.py, and compares them pixel by pixel.

    compare_scenes.py HEDRON FIRST_SEED COUNT

A seed's files stay in the current folder: SEED.json, the files that it names, and the pictures SEED-float.pfm,
SEED-double.pfm and SEED-own.pfm. Prints the seed of each scene that differs, and the first pixel from the top. Ends with 1 if
more than a few pixels of all scenes differ.
"""
import array
import json
import subprocess
import sys
from pathlib import Path

import tracer
from random_scenes import HEIGHT, WIDTH, Maker

TOLERANCES = {"float": 1e-4, "double": 1e-6}  # relative; a tenth of it absolute
SHARE_ALLOWED = 0.0005  # share of all pixels: an edge may pass a sample so closely that rounding decides


def values_of(path):
    """Returns the values of a PFM, from the bottom."""
    data = path.read_bytes().split(b"\n", 3)[3]
    values = array.array("f", data)
    if sys.byteorder == "big":
        values.byteswap()
    return values


def compared(first, second, tolerance):
    """Returns the pixels that differ, as (y, x, values, values), and the largest difference of the others."""
    a, b = values_of(first), values_of(second)
    if len(a) != 3 * WIDTH * HEIGHT or len(b) != len(a):
        raise ValueError(f"{first} and {second} have {len(a) // 3} and {len(b) // 3} pixels")
    differing, largest = [], 0
    for i in range(0, len(a), 3):
        pixels = list(a[i:i + 3]), list(b[i:i + 3])
        if all(abs(p - q) <= tolerance * (0.1 + max(abs(p), abs(q))) for p, q in zip(*pixels)):
            largest = max(largest, *(abs(p - q) for p, q in zip(*pixels)))
        else:
            differing.append((HEIGHT - 1 - i // 3 // WIDTH, i // 3 % WIDTH, *pixels))
    return sorted(differing), largest


def rendered(hedron, seed, folder):
    """Returns pictures of a seed's scene: the reference's, and hedron's by precision."""
    keys, frame = Maker(seed, folder).scene()
    scene, own = (folder / f"{seed}{end}" for end in (".json", "-own.pfm"))
    theirs = {precision: folder / f"{seed}-{precision}.pfm" for precision in TOLERANCES}
    scene.write_text(json.dumps(keys, indent=1) + "\n")
    for precision, path in theirs.items():
        subprocess.run([hedron, "render", "--quiet", "--backend", "c", "--precision", precision,
                        "--frames", str(frame), "-o", path, scene], check=True, stdout=subprocess.DEVNULL)
    tracer.write_pfm(own, tracer.Scene(scene, frame).picture())
    return own, theirs


def main():
    """Runs the command line."""
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    first, count = int(sys.argv[2]), int(sys.argv[3])
    total, largest = dict.fromkeys(TOLERANCES, 0), dict.fromkeys(TOLERANCES, 0)
    for seed in range(first, first + count):
        own, theirs = rendered(sys.argv[1], seed, Path("."))
        for precision, tolerance in TOLERANCES.items():
            differing, most = compared(theirs[precision], own, tolerance)
            total[precision] += len(differing)
            largest[precision] = max(largest[precision], most)
            if differing:
                y, x, pixel, expected = differing[0]
                print(f"seed {seed}, {precision}: {len(differing)} pixels differ, the first at {x}, {y}: "
                      f"{pixel}, not {expected}")
    pixels = count * WIDTH * HEIGHT
    for precision in TOLERANCES:
        print(f"{precision}: {total[precision]} of {pixels} pixels differ; "
              f"the others by {largest[precision]:.3g} at most")
    sys.exit(max(total.values()) > SHARE_ALLOWED * pixels)


if __name__ == "__main__":
    main()
