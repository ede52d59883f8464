# SPDX-License-Identifier: MIT
"""Textures by docs/reference/files.md, of the data format, and their lookup by docs/model.md."""
import math
import struct

from vectors import BLACK, along


def off_the_srgb_curve(s):
    """Returns linear light of a value on the curve."""
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4


class Texture:
    """Texels in linear light, in steps of 1/65535."""

    def __init__(self, path, curve, repeats, *, clamps_rows=False):
        data = path.read_bytes()
        self.width, self.height = struct.unpack("<ii", data[:8])
        light = off_the_srgb_curve if curve == "srgb" else float
        level = [math.floor(light(value / 255) * 65535 + 0.5) / 65535 for value in range(256)]
        self.texels = [tuple(level[value] for value in data[i:i + 3]) for i in range(8, len(data), 4)]
        self.repeats, self.clamps_rows = repeats, clamps_rows or not repeats

    def at(self, s, t):
        """Returns the value, bilinear between texel centres."""
        p, q = s * self.width - 0.5, t * self.height - 0.5
        if not self.repeats:
            p = min(max(p, 0), self.width - 1)
        if self.clamps_rows:
            q = min(max(q, 0), self.height - 1)
        column, row = math.floor(p), math.floor(q)
        p, q = p - column, q - row
        total = BLACK
        for below, down in ((0, 1 - q), (1, q)):
            for beside, across in ((0, 1 - p), (1, p)):
                cell = (row + below) % self.height * self.width + (column + beside) % self.width
                total = along(total, across * down, self.texels[cell])
        return total
