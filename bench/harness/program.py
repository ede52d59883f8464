# SPDX-License-Identifier: MIT
"""Runs hedron. Its statistics are the source of times: no start of a program, no compiling of kernels
is in them. What a whole run takes is beside them, as `wall`."""
import hashlib
import json
import os
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path


class Problem(Exception):
    """Ends the bench with an exit code and a sentence."""

    def __init__(self, code, sentence):
        super().__init__(sentence)
        self.code = code


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a run; `run` has the frames that were done."""

    def __init__(self, run):
        super().__init__()
        self.run = run


class Program:
    def __init__(self, path):
        self.path = path.resolve()
        if not self.path.is_file():
            raise Problem(2, f"there is no program {path}: build it with ./dev build, or name it with --hedron")
        self.version = self._ask("--version").removeprefix("hedron ").strip()

    def _ask(self, *words):
        try:
            answer = subprocess.run([self.path, *words], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        except OSError as error:
            raise Problem(2, f"cannot run {self.path}: {error.strerror}") from error
        if answer.returncode != 0:
            raise Problem(2, f"{self.path} {' '.join(words)} fails: {message_in(answer.stderr)}")
        return answer.stdout

    def has_option(self, option):
        """Whether `hedron render` knows it."""
        return f" {option} " in self._ask("help", "render")

    def backends(self):
        """The list of `hedron devices --json`."""
        try:
            return json.loads(self._ask("devices", "--json"))["backends"]
        except (ValueError, KeyError, TypeError) as error:
            raise Problem(2, f"{self.path} devices --json prints no list of backends") from error

    def render(self, device, scene, frames, options, folder, output="#######.data", cores=None, path=None,
               look=None, variables=None):
        """One run, in a new folder within the temporary one, so that no name in the path counts as a
        pattern; on `cores` alone, with `path` for PATH and these variables of the environment, where given. Returns {"code",
        "message", "said", "frames", "digests", "wall", "cpu"}: the exit code (None where a run was interrupted),
        the first line of what hedron said, all of it, the lines of the statistics, for each frame the digest of its picture if that is a
        file of its own, the seconds from the start to the end of the program, and those that processors
        worked for it and its children. `look` is called with the folder before that goes, and what it
        gives is there as `seen`.
        """
        place = Path(folder, "run")
        place.mkdir()
        command = [self.path, "render", "--quiet", *options, "--backend", device["backend"],
                   "--device", str(device["index"]), "--frames", frames, "--stats", "stats.jsonl",
                   "-o", output]
        if scene is not None:
            command.append(scene)
        environment = {**os.environ, **(variables or {}), **({} if path is None else {"PATH": path})}
        try:
            start, worked = time.monotonic(), children_seconds()
            # A session of its own: Ctrl-C then reaches hedron once, from here.
            child = subprocess.Popen(command, cwd=place, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                     stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True,
                                     env=environment, preexec_fn=cores and (lambda: os.sched_setaffinity(0, cores)))
            try:
                message = child.communicate()[1]
            except KeyboardInterrupt:
                stop(child)
                raise Interrupted(collect(place, None, "")) from None
            return {**collect(place, child.returncode, message), "wall": time.monotonic() - start,
                    "cpu": children_seconds() - worked, "seen": look and look(place)}
        finally:
            shutil.rmtree(place)


def stop(child):
    """Hedron ends after the frame that it is at; a device that hangs is not waited for."""
    child.send_signal(signal.SIGINT)
    try:
        child.communicate(timeout=30)
    except subprocess.TimeoutExpired:
        child.kill()
        child.communicate()


def children_seconds():
    """Processor time of all children that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def collect(place, code, message):
    frames = []
    stats = place / "stats.jsonl"
    if stats.exists():
        for line in stats.read_text(encoding="utf-8").splitlines(keepends=True):
            if line.endswith("\n"):  # else it was cut off
                frames.append(json.loads(line))
    pictures = {frame["frame"]: place / f"{frame['frame']:07}.data" for frame in frames}
    digests = {number: digest(file) for number, file in pictures.items() if file.exists()}
    return {"code": code, "message": message_in(message), "said": message, "frames": frames, "digests": digests}


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def message_in(text):
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[0].removeprefix("hedron: ") if lines else "it says nothing"
