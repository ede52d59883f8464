# SPDX-License-Identifier: MIT
"""Error against time: the best front, recommended settings, and the time at equal error."""
import math


def front(points, error="rmse"):
    """Returns the points that no other beats in both time and error, by time. A point is a dictionary with "ms" and
    the error."""
    best = []
    for point in sorted(points, key=lambda each: (each["ms"], each[error])):
        if not best or point[error] < best[-1][error]:
            best.append(point)
    return best


def time_at(points, error, wanted):
    """Returns the time at which the front has the wanted error, interpolated on logarithms. If all points are better
    it is the fastest one's; None if none is as good."""
    best = front(points, error)
    if not best or best[-1][error] > wanted:
        return None
    if best[0][error] <= wanted:
        return best[0]["ms"]
    for slow, fast in zip(best[1:], best):
        if slow[error] <= wanted:
            share = math.log(fast[error] / wanted) / math.log(fast[error] / slow[error])
            return fast["ms"] * (slow["ms"] / fast["ms"]) ** share
    return None


def ratios(points, baseline, error="rmse"):
    """Returns [(error, ratio)]: the points' time by the baseline's, at each error of the baseline's front that they reach."""
    found = []
    for point in front(baseline, error):
        ms = time_at(points, error, point[error])
        if ms is not None:
            found.append((point[error], ms / point["ms"]))
    return found


def cheapest(points, limit, error="rmse"):
    """Returns the fastest point with at most such an error."""
    good = [point for point in points if point[error] <= limit]
    return min(good, key=lambda each: each["ms"], default=None)
