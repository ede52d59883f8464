# SPDX-License-Identifier: MIT
"""Pictures in the PFM format, read and compared without any library."""
import array
import math
import sys

from harness.program import Problem

STEP = 1.0  # of 255
ROUNDING = 1e-9  # of the curve


def read(file):
    """(width, height, array of all channels in the file's order)"""
    with open(file, "rb") as stream:
        head = [stream.readline() for _ in range(3)]
        width, height = map(int, head[1].split())
        numbers = array.array("f")
        numbers.frombytes(stream.read())
    if head[0].strip() != b"PF" or len(numbers) != 3 * width * height:
        raise Problem(1, f"{file} is no whole PFM file")
    if (float(head[2]) < 0) != (sys.byteorder == "little"):
        numbers.byteswap()
    return width, height, numbers


def odd_numbers(picture):
    """Pixels that have a NaN or an infinity."""
    numbers = picture[2]
    if all(map(math.isfinite, numbers)):
        return 0
    return sum(not all(map(math.isfinite, numbers[i:i + 3])) for i in range(0, len(numbers), 3))


def displayed(value):
    """In steps of 255, on the sRGB curve."""
    value = min(max(value, 0.0), 1.0)
    return 255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)


def is_near(a, b):
    if a == b:
        return True
    return abs(displayed(a) - displayed(b)) <= STEP + ROUNDING


def near_pixels(one, *others):
    """How many pixels are within a step of 255 of those of one of the others, in every channel, on the
    sRGB curve."""
    if any(other[:2] != one[:2] for other in others):
        raise Problem(1, "pictures of different sizes cannot be compared")
    a = one[2]
    return sum(any(all(is_near(a[k], other[2][k]) for k in range(i, i + 3)) for other in others)
               for i in range(0, len(a), 3))
