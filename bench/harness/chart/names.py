# SPDX-License-Identifier: MIT
"""Finds room for names beside points of a chart with logarithmic axes."""
import math

# Characters that the plot is wide and high, and how wide one of a name is: all about, for gnuplot does not tell.
PLOT = (133.0, 25.0)
LETTER, LINE, MARK = 0.86, 0.85, 0.8
# Where a name may stand, the best first: how it is aligned, and how far it is from the point.
SIDES = (("left", 0.8, 0.6), ("right", -0.8, -0.7), ("left", 0.8, -0.7), ("right", -0.8, 0.6), ("left", 0.8, 1.5),
         ("right", -0.8, -1.6), ("left", 0.8, -1.6), ("right", -0.8, 1.5))


def is_free(box, taken):
    inside = 0 <= box[0] and box[2] <= PLOT[0] and 0 <= box[1] and box[3] <= PLOT[1]
    return inside and not any(box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3]
                              for other in taken)


def find_room(ranges, points, names):
    """For each (point, name, whether it must be named): (alignment, characters to the right, up), or None where there is no
    room. `ranges` are of x and y; `points` are pairs that names must not hide."""
    def position(point):
        return [size * math.log(value / first) / math.log(last / first)
                for size, value, (first, last) in zip(PLOT, point, ranges)]
    taken = [(x - MARK, y - MARK / 2, x + MARK, y + MARK / 2) for x, y in map(position, points)]
    for point, name, must in names:
        (x, y), width, boxes = position(point), LETTER * (len(name) + 1), {}
        for side in SIDES:
            left, middle = x + side[1] - (width if side[0] == "right" else 0), y + side[2]
            boxes[side] = (left, middle - LINE / 2, left + width, middle + LINE / 2)
        found = next((side for side, box in boxes.items() if is_free(box, taken)), SIDES[0] if must else None)
        taken += [boxes[found]] if found else []
        yield found
