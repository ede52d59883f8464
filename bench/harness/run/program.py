# SPDX-License-Identifier: MIT
"""Runs hedron and its companion programs. Hedron's statistics are the source of times: they contain neither the start of a
program nor the compiling of kernels. Beside them are the time of the whole run, as `wall`, and the share of the processors
that other programs took meanwhile."""
import functools
import hashlib
import json
import os
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path

from harness.run import machine

ROOT = Path(__file__).resolve().parents[3]
NEVER = 1.0  # a limit that no run exceeds
LEAST_SECONDS = 0.04  # seconds of a disturbance; the system counts in hundredths


class Problem(Exception):
    """Ends the bench with an exit code and a sentence."""

    def __init__(self, code, sentence):
        super().__init__(sentence)
        self.code = code


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a run; `run` has the finished frames."""

    def __init__(self, run):
        super().__init__()
        self.run = run


class Program:
    """Hedron; a run is disturbed if others took more than `limit`, a share of all usable processors' time."""

    def __init__(self, path, limit=NEVER):
        self.path, self.limit = path.resolve(), limit
        if not self.path.is_file():
            raise Problem(2, f"the program {path} does not exist: build it with ./dev build, or name it with --hedron")
        self.version = self._ask("--version").removeprefix("hedron ").strip()

    def _ask(self, *words):
        try:
            answer = subprocess.run([self.path, *words], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        except OSError as error:
            raise Problem(2, f"cannot run {self.path}: {error.strerror}") from error
        if answer.returncode != 0:
            raise Problem(2, f"{self.path} {' '.join(words)} fails: {message_in(answer.stderr)}")
        return answer.stdout

    @functools.cached_property
    def listed(self):
        """Returns what `hedron devices --json` prints."""
        try:
            found = json.loads(self._ask("devices", "--json"))
            return {"kernels": found.get("kernels"), "backends": found["backends"]}
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise Problem(2, f"{self.path} devices --json prints no list of backends") from error

    def backends(self):
        return self.listed["backends"]

    def kernels(self):
        """Returns the hash of its kernels, or None if it reports none."""
        return self.listed["kernels"]

    def beside(self, name):
        """Returns the path of a program that the build put beside hedron, or below."""
        return self.path.parent / name

    def render(self, device, scene, frames, options, folder, output="#######.data", cores=None, path=None,
               look=None, variables=None):
        """Runs hedron in a new folder, where no name in the path counts as a pattern. `cores`, `path` (for PATH) and
        `variables` of the environment are optional. `look` is called with the folder before its removal, and gives "seen".
        Returns a dictionary: the exit "code" (None if the run was interrupted); the first line of the error output as "message",
        all of it as "said"; "frames", the lines of the statistics. "digests" are of frames that are files of their own. "wall" are
        seconds of the program, "cpu" seconds of it and its children, "load" is the machine's. "others" is the share of all usable
        processors' time that other programs took (None if the system does not report it); "noisy", whether that is too much."""
        place = Path(folder, "run")
        place.mkdir()
        command = [self.path, "render", "--quiet", *options, "--backend", device["backend"],
                   "--device", str(device["index"]), "--frames", frames, "--stats", "stats.jsonl",
                   "-o", output, *([] if scene is None else [scene])]
        environment = {**os.environ, **(variables or {}), **({} if path is None else {"PATH": path})}
        try:
            clock = Clock()
            # A session of its own: Ctrl-C then reaches hedron once, from here.
            child = subprocess.Popen(command, cwd=place, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                     stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True,
                                     env=environment, preexec_fn=cores and (lambda: os.sched_setaffinity(0, cores)))
            try:
                message = child.communicate()[1]
            except KeyboardInterrupt:
                stop(child)
                raise Interrupted({**collect(place, None, ""), **clock.times(self.limit)}) from None
            return {**collect(place, child.returncode, message), **clock.times(self.limit), "seen": look and look(place)}
        finally:
            shutil.rmtree(place)


def processor_seconds(who):
    """Returns the seconds of this process, or of all its ended children."""
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


class Clock:
    """The cost of a run, from its construction on."""

    def __init__(self):
        self.before = self.now()

    @staticmethod
    def now():
        return (time.monotonic(), processor_seconds(resource.RUSAGE_CHILDREN), processor_seconds(resource.RUSAGE_SELF),
                machine.busy_seconds())

    def times(self, limit):
        *now, busy = self.now()
        wall, cpu, own = [after - before for after, before in zip(now, self.before)]
        found = {"wall": wall, "cpu": cpu, "load": machine.load()[0], "others": None, "noisy": False}
        if self.before[-1] is not None and busy is not None:
            seconds = max(0.0, busy - self.before[-1] - cpu - own)
            whole = wall * machine.cores()
            found["others"] = round(min(1.0, seconds / whole), 4) if whole > 0 else None
            found["noisy"] = seconds > LEAST_SECONDS and seconds > limit * whole and limit < NEVER
        return found


def stop(child):
    """Asks hedron to end after its current frame; does not wait for a device that hangs."""
    child.send_signal(signal.SIGINT)
    try:
        child.communicate(timeout=30)
    except subprocess.TimeoutExpired:
        child.kill()
        child.communicate()


def collect(place, code, message):
    stats = place / "stats.jsonl"
    lines = stats.read_text(encoding="utf-8").splitlines(keepends=True) if stats.exists() else []
    frames = [json.loads(line) for line in lines if line.endswith("\n")]  # else it was cut off
    pictures = {frame["frame"]: place / f"{frame['frame']:07}.data" for frame in frames}
    digests = {number: digest(file) for number, file in pictures.items() if file.exists()}
    return {"code": code, "message": message_in(message), "said": message, "frames": frames, "digests": digests}


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def message_in(text):
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[0].removeprefix("hedron: ") if lines else "it says nothing"


def run_tool(program, *words, accepted=(0,), limit=None):
    """Runs a program beside hedron, or a compiler, and returns the finished process, with its `stdout`. Raises Problem: 3 if
    the program does not exist or takes more than `limit` seconds, 1 if its exit code is not accepted."""
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
