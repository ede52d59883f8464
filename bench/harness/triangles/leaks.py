# SPDX-License-Identifier: MIT
"""The leak hunt: rays aimed at edges and corners of closed meshes, on every backend."""
import re

from harness.measure.numbers import count_words
from harness.measure.rows import NONE, known
from harness.run.program import Problem, run_tool

TOTAL = re.compile(r"total of (\d+) renderers:\s+(\d+) rays, (\d+) leaks, (\d+) double hits")
SOME_LEAK, NOTHING_OPENS = 1, 77


def parse(text):
    """Returns {"renderers", "rays", "leaks", "double_hits"}, or None if the hunt did not finish."""
    found = TOTAL.search(text)
    return found and dict(zip(("renderers", "rays", "leaks", "double_hits"), map(int, found.groups())))


def run(program, backend, rays):
    """Returns the counts; raises Problem with the reason if the hunt fails."""
    done = run_tool(program.beside("tests/leak_hunt/hedron_leak_hunt"), rays, "--backend", backend,
                    accepted=(0, SOME_LEAK, NOTHING_OPENS))
    if done.returncode == NOTHING_OPENS:
        raise Problem(3, f"no device of {backend} opens")
    total = parse(done.stdout)
    if total is None:
        raise Problem(1, f"the leak hunt on {backend} reports no total: {done.stderr.strip() or 'it prints nothing'}")
    return total


def add_rows(plan, hunts):
    """Adds rows and failures; `hunts` has for each backend the result of `run`, or the reason why there is none."""
    for backend, total in hunts.items():
        aimed = ""
        if not isinstance(total, str):
            aimed = (f" of {count_words(float(format(total['rays'], '.3g')))} rays aimed at edges and corners, "
                     f"{total['renderers']} renderers")
            if total["leaks"] + total["double_hits"]:
                plan.failures.add(f"{backend}: {total['leaks']} leaks and {total['double_hits']} double hits")
        plan.row("leaks", f"leaks and double hits{aimed}", "rays", lambda total=total: [
            known(total)["leaks"] + total["double_hits"]], device=backend, target=NONE)
