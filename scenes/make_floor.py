#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes floor.png: light and dark tiles with joints between them that fade to black outwards, so that a
floor has no visible end. Usage: make_floor.py floor.png"""
import math
import struct
import sys
import zlib

SIDE = 1024  # pixels
TILES = 16  # on a side
LIGHT, DARK, JOINT = (212, 214, 226), (38, 40, 54), (12, 13, 18)  # sRGB
JOINT_WIDTH = 0.018  # of a tile
FADE_START, FADE_WIDTH = 0.35, 0.63  # of half the side


def fade(u, v):
    """1 in the middle, 0 beyond the circle, smooth between."""
    rest = 1 - min(1, max(0, (math.hypot(u, v) - FADE_START) / FADE_WIDTH))
    return rest * rest * (3 - 2 * rest)


def pixel(x, y):
    u, v = (x + 0.5) / SIDE, (y + 0.5) / SIDE
    s, t = u * TILES % 1, v * TILES % 1
    colour = LIGHT if (int(u * TILES) + int(v * TILES)) % 2 else DARK
    if min(s, 1 - s, t, 1 - t) < JOINT_WIDTH:
        colour = JOINT
    weight = fade(2 * u - 1, 2 * v - 1)
    return bytes(int(c * weight + 0.5) for c in colour)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def main():
    rows = b"".join(
        b"\0" + b"".join(pixel(x, y) for x in range(SIDE)) for y in range(SIDE)
    )
    header = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 2, 0, 0, 0)
    with open(sys.argv[1], "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")):
            file.write(chunk(kind, data))


if __name__ == "__main__":
    main()
