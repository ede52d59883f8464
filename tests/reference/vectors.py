# SPDX-License-Identifier: MIT
"""Vectors and colours: tuples of three."""
import math

BLACK, WHITE = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)


def dot(a, b):
    """Returns the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    """Returns the cross product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a, b):
    """Returns a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def along(a, factor, b):
    """Returns a + factor b."""
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


def times(factor, a):
    """Returns factor a."""
    return (factor * a[0], factor * a[1], factor * a[2])


def product(a, b):
    """Returns a * b, channel by channel."""
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


def length(a):
    """Returns |a|."""
    return math.sqrt(dot(a, a))


def unit(a):
    """Returns a, normalised."""
    return times(1 / length(a), a)


def blend(shares, vectors):
    """Returns the sum of vectors of any length, each times its share."""
    return tuple(sum(map(float.__mul__, shares, column)) for column in zip(*vectors))


def turning(rotation):
    """Returns the function that rotates a vector: about x, then y, then z."""
    angles = [(math.cos(math.radians(a)), math.sin(math.radians(a))) for a in rotation]

    def turn(v):
        v = list(v)
        for axis, (c, s) in enumerate(angles):
            i, j = (axis + 1) % 3, (axis + 2) % 3
            v[i], v[j] = v[i] * c - v[j] * s, v[i] * s + v[j] * c
        return tuple(v)

    return turn
