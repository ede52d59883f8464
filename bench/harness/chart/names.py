# SPDX-License-Identifier: MIT
"""Finds room for names beside points of a chart with logarithmic axes."""
import math

# Characters that the plot is wide and high, and how wide one of a name is: all about, for gnuplot does not tell.
PLOT = (133.0, 25.0)
LETTER, LINE, MARK = 0.86, 0.85, 0.8
# Where a name may stand, the best first: how it is aligned, and how far it is from the point.
SIDES = (("left", 0.8, 0.6), ("right", -0.8, -0.7), ("left", 0.8, -0.7), ("right", -0.8, 0.6), ("left", 0.8, 1.5),
         ("right", -0.8, -1.6), ("left", 0.8, -1.6), ("right", -0.8, 1.5))


def overlap(one, other):
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


class Names:
    """`ranges` of x and y; `points` are pairs that names must not hide."""

    def __init__(self, ranges, points):
        self.ranges = ranges
        self.taken = [self.mark(*self.position(point)) for point in points]

    def position(self, point):
        return [size * math.log(value / first) / math.log(last / first)
                for size, value, (first, last) in zip(PLOT, point, self.ranges)]

    @staticmethod
    def mark(x, y):
        return (x - MARK, y - MARK / 2, x + MARK, y + MARK / 2)

    def box(self, point, name, side):
        x, y = self.position(point)
        width = LETTER * (len(name) + 1)
        left = x + side[1] - (width if side[0] == "right" else 0)
        return (left, y + side[2] - LINE / 2, left + width, y + side[2] + LINE / 2)

    def is_free(self, box):
        inside = 0 <= box[0] and box[2] <= PLOT[0] and 0 <= box[1] and box[3] <= PLOT[1]
        return inside and not any(overlap(box, other) for other in self.taken)

    def place(self, point, name, must):
        """(alignment, characters to the right, up), or None where there is no room; what must be named is."""
        side = next((each for each in SIDES if self.is_free(self.box(point, name, each))), SIDES[0] if must else None)
        if side:
            self.taken.append(self.box(point, name, side))
        return side
