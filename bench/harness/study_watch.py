# SPDX-License-Identifier: MIT
"""Runs hedron, and tells how much of the processors something else took meanwhile."""
import os

from harness import machine
from harness.program import Program

LIMIT = 0.1  # of all processors' time: a run that had to share more is measured again, if not said
LEAST_SECONDS = 0.04  # of it; the system counts in hundredths


def own_seconds():
    """Processor time of this process."""
    used = os.times()
    return used.user + used.system


class WatchedProgram(Program):
    """Its runs have `others`: the share of all usable processors' time that others took, or None where the
    system does not tell; and `noisy`, whether that is more than `limit`."""

    def __init__(self, path, limit=LIMIT):
        super().__init__(path)
        self.limit = limit

    def render(self, *arguments, **named):
        busy, own = machine.busy_seconds(), own_seconds()
        run = super().render(*arguments, **named)
        after = machine.busy_seconds()
        run["load"] = machine.load()[0]
        run["others"], run["noisy"] = None, False
        if busy is not None and after is not None:
            seconds = max(0.0, after - busy - run.get("cpu", 0) - (own_seconds() - own))
            whole = run.get("wall", 0) * machine.cores()
            run["others"] = round(min(1.0, seconds / whole), 4) if whole > 0 else None
            run["noisy"] = seconds > LEAST_SECONDS and seconds > self.limit * whole and self.limit < 1
        return run
