# SPDX-License-Identifier: MIT
"""Rows: figures with their targets, computed after all measurements."""
from dataclasses import dataclass

from harness.measure.numbers import quartiles


class Missing(Exception):
    """The reason why a row has no figure."""


@dataclass(frozen=True)
class Target:
    least: float
    aim: float
    more_is_better: bool = True


NONE = Target(0, 0, False)  # target of a forbidden count


def known(measured, reason="it was not measured"):
    """Returns the measured value; raises Missing if it is nothing or a sentence."""
    if measured is None or isinstance(measured, str):
        raise Missing(measured or reason)
    return measured


def judge(target, value):
    """Returns (ratio to least, ratio to aim, verdict); a ratio of 1 or more meets the target."""
    if target is None:
        return None, None, None
    if target.least == 0:  # a forbidden count has no ratio
        return None, None, "aim" if value == 0 else "missed"
    if value == 0 and not target.more_is_better:
        return None, None, "aim"
    least, aim = [value / wanted if target.more_is_better else wanted / value for wanted in (target.least, target.aim)]
    return least, aim, "aim" if aim >= 1 else "least" if least >= 1 else "missed"


class Rows:
    def __init__(self):
        self.rows = []

    def row(self, key, what, unit, figure, *, device=None, target=None, note=None):
        """Adds a row. `figure` is called after all measurements: it returns a list of values, or raises Missing."""
        self.rows.append({"key": key, "what": what, "device": device, "unit": unit, "target": target,
                          "note": note, "figure": figure})

    def absent(self, key, what, unit, target, reason):
        """Adds a row without a figure."""
        self.row(key, what, unit, lambda: known(reason), target=target)

    def finished(self, judged=True):
        """Returns the rows as stored. If `judged` is false the figures do not answer the targets."""
        return [finish(judged=judged, **row) for row in self.rows]


def finish(judged, key, what, device, unit, target, note, figure):
    wanted = target or Target(None, None, None)
    values, ratios, reason = [], (None, None, None), None
    try:
        values = known(figure() or None, "nothing was measured")
    except Missing as missing:
        reason = str(missing)
    first, middle, third = quartiles(values) if values else (None, None, None)
    if judged and values:
        ratios = judge(target, middle)
    return {"key": key, "what": what, "device": device, "unit": unit, "least": wanted.least, "aim": wanted.aim,
            "more_is_better": wanted.more_is_better, "figure": middle, "q1": first, "q3": third, "count": len(values),
            **dict(zip(("ratio_to_least", "ratio_to_aim", "verdict"), ratios)), "note": note, "reason": reason}
