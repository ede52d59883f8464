# SPDX-License-Identifier: MIT
"""Runs the other programs that measurements ask: those that the build puts beside hedron, and compilers."""
import subprocess

from harness.run.program import Problem


def run(program, *words, accepted=(0,), limit=None):
    """The finished process, with its `stdout`. Raises Problem with the reason where there is none: 3 where the program is
    not there or takes more than `limit` seconds, 1 where it ends with a code that is not accepted."""
    if not program.is_file():
        raise Problem(3, f"there is no {program}: ./dev build builds it")
    try:
        done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              timeout=limit)
    except subprocess.TimeoutExpired as expired:
        raise Problem(3, f"{program.name} took more than {limit} s, on a busy machine") from expired
    if done.returncode not in accepted:
        said = done.stderr or done.stdout
        raise Problem(1, f"{program.name}: {said.strip()[-600:] or f'it ended with {done.returncode}'}")
    return done
