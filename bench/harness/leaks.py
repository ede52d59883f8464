# SPDX-License-Identifier: MIT
"""The leak hunt: rays aimed at edges and corners of closed meshes, on every backend."""
import re
import subprocess

from harness import triangle_models
from harness.program import Problem
from harness.speed_plan import Missing, Target

TOTAL = re.compile(r"total of (\d+) renderers:\s+(\d+) rays, (\d+) leaks, (\d+) double hits")
NOTHING_OPENS = 77


def parse(text):
    """{"renderers", "rays", "leaks", "double_hits"}, or None where the hunt did not come to its end."""
    found = TOTAL.search(text)
    return found and dict(zip(("renderers", "rays", "leaks", "double_hits"), map(int, found.groups())))


def run(program, backend, rays):
    """Raises Problem with the reason where it cannot be."""
    if not program.is_file():
        raise Problem(3, f"there is no {program}: ./dev build builds it")
    done = subprocess.run([program, str(rays), "--backend", backend], capture_output=True, text=True)
    if done.returncode == NOTHING_OPENS:
        raise Problem(3, f"no device of {backend} opens")
    total = parse(done.stdout)
    if total is None:
        raise Problem(1, f"{program.name} --backend {backend}: {done.stderr.strip() or 'it says nothing'}")
    return total


def count(total):
    return total["leaks"] + total["double_hits"]


def failures(hunts):
    return [f"{backend}: {total['leaks']} leaks and {total['double_hits']} double hits"
            for backend, total in hunts.items() if not isinstance(total, str) and count(total) > 0]


def add_rows(plan, hunts):
    """`hunts` has for each backend what `run` gave, or the reason why there is nothing."""
    for backend, total in hunts.items():
        aimed = "" if isinstance(total, str) else (
            f" of {triangle_models.words(float(format(total['rays'], '.3g')))} rays aimed at edges and corners, "
            f"{total['renderers']} renderers")

        def figure(total=total):
            if isinstance(total, str):
                raise Missing(total)
            return [count(total)]
        plan.row("leaks", f"leaks and double hits{aimed}", "rays", figure, device=backend, target=Target(0, 0, False))
