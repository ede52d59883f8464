# SPDX-License-Identifier: MIT
"""PFM pictures, read and compared without any library, and `hedron compare`."""
import array
import json
import math
import subprocess
import sys

from harness.run.program import Problem, message_in

STEP = 1.0  # of 255
ROUNDING = 1e-9  # of the curve


def read(file):
    """Returns (width, height, array of all channels in the file's order)."""
    with open(file, "rb") as stream:
        head = [stream.readline() for _ in range(3)]
        width, height = map(int, head[1].split())
        numbers = array.array("f")
        numbers.frombytes(stream.read())
    if head[0].strip() != b"PF" or len(numbers) != 3 * width * height:
        raise Problem(1, f"{file} is not a complete PFM file")
    if (float(head[2]) < 0) != (sys.byteorder == "little"):
        numbers.byteswap()
    return width, height, numbers


def odd_numbers(picture):
    """Returns the number of pixels that have a NaN or an infinity."""
    numbers = picture[2]
    if all(map(math.isfinite, numbers)):
        return 0
    return sum(not all(map(math.isfinite, numbers[i:i + 3])) for i in range(0, len(numbers), 3))


def not_finite(file):
    """Returns how many numbers of a file are NaN or infinite."""
    numbers = read(file)[2]
    return 0 if math.isfinite(sum(numbers)) else sum(not math.isfinite(value) for value in numbers)


def displayed(value):
    """Returns values in steps of 255, on the sRGB curve."""
    value = min(max(value, 0.0), 1.0)
    return 255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)


def is_near(a, b, steps=STEP):
    return a == b or abs(displayed(a) - displayed(b)) <= steps + ROUNDING


def near_pixels(one, *others, steps=STEP):
    """Returns how many pixels are within so many steps of 255 of the same pixel of another picture, in every channel, on the
    sRGB curve."""
    if any(other[:2] != one[:2] for other in others):
        raise Problem(1, "pictures of different sizes cannot be compared")
    a = one[2]
    return sum(any(all(is_near(a[k], other[2][k], steps) for k in range(i, i + 3)) for other in others)
               for i in range(0, len(a), 3))


def compare(program, first, second):
    """Returns the output of `hedron compare --json`. The first picture is compared with the second."""
    done = subprocess.run([program.path, "compare", "--json", first, second], capture_output=True, text=True)
    if done.returncode not in (0, 1) or not done.stdout:  # 1: there are NaNs
        raise Problem(1, f"hedron compare: {message_in(done.stderr)}")
    return json.loads(done.stdout)


def errors(program, picture, truth):
    """Returns {"rmse", "largest", "p999", "above_1"} in steps of 255 on the display's curve."""
    found = compare(program, picture, truth)
    return {**{key: found["display"][key] for key in ("rmse", "largest", "p999")}, "above_1": found["above_1"]}
