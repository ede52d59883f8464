# SPDX-License-Identifier: MIT
"""Rows: figures with their targets, computed when all is measured."""
from dataclasses import dataclass

from harness.measure.numbers import quartiles


class Missing(Exception):
    """Why a row has no figure."""


@dataclass(frozen=True)
class Target:
    least: float
    aim: float
    more_is_better: bool = True


NONE = Target(0, 0, False)  # of what must not be at all


def known(measured, reason="it was not measured"):
    """What was measured; raises Missing where there is nothing, or a sentence in its place."""
    if measured is None or isinstance(measured, str):
        raise Missing(measured or reason)
    return measured


def judge(target, value):
    """(ratio to least, ratio to aim, verdict); a ratio of 1 or more says that the target is met."""
    if target is None:
        return None, None, None
    if target.least == 0:  # of what must not be at all, nothing is so many times as good
        return None, None, "aim" if value == 0 else "missed"
    if value == 0 and not target.more_is_better:
        return None, None, "aim"
    least, aim = [value / wanted if target.more_is_better else wanted / value for wanted in (target.least, target.aim)]
    return least, aim, "aim" if aim >= 1 else "least" if least >= 1 else "missed"


class Rows:
    def __init__(self):
        self.rows = []

    def row(self, key, what, unit, figure, *, device=None, target=None, note=None):
        """`figure` is called when all is measured: it gives a list of values, or raises Missing."""
        self.rows.append({"key": key, "what": what, "device": device, "unit": unit, "target": target,
                          "note": note, "figure": figure})

    def absent(self, key, what, unit, target, reason):
        """A row that has no figure here."""
        self.row(key, what, unit, lambda: known(reason), target=target)

    def finished(self, judged=True):
        return [finish(row, judged) for row in self.rows]


def finish(row, judged=True):
    """The row as it is written. Where `judged` is false the figure is no answer to the target."""
    target = row["target"]
    done = {"key": row["key"], "what": row["what"], "device": row["device"], "unit": row["unit"],
            "least": target and target.least, "aim": target and target.aim,
            "more_is_better": None if target is None else target.more_is_better,
            "figure": None, "q1": None, "q3": None, "count": 0, "ratio_to_least": None, "ratio_to_aim": None,
            "verdict": None, "note": row["note"], "reason": None}
    try:
        values = row["figure"]()
        if not values:
            raise Missing("nothing was measured")
    except Missing as missing:
        return {**done, "reason": str(missing)}
    done["q1"], done["figure"], done["q3"] = quartiles(values)
    done["count"] = len(values)
    if judged:
        done["ratio_to_least"], done["ratio_to_aim"], done["verdict"] = judge(target, done["figure"])
    return done
