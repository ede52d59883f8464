# SPDX-License-Identifier: MIT
"""FFmpeg's time for a film alone: its arguments and frames are recorded in a run of hedron, and given to it again with nothing
else running."""
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from statistics import median

RECORDER = """#!/bin/sh
printf '%s\\n' "$@" >'{folder}/arguments'
tee '{folder}/frames' | '{ffmpeg}' "$@"
"""


class Recording:
    """Stands before FFmpeg in `path`. `folder` is temporary and has a name without quotes."""

    def __init__(self, folder, name):
        self.ffmpeg, self.folder = shutil.which("ffmpeg"), Path(folder, name)
        self.folder.mkdir()
        recorder = self.folder / "ffmpeg"
        recorder.write_text(RECORDER.format(folder=self.folder, ffmpeg=self.ffmpeg), encoding="utf-8")
        recorder.chmod(0o755)
        self.path = f"{self.folder}{os.pathsep}{os.environ['PATH']}"

    def arguments(self):
        return (self.folder / "arguments").read_text(encoding="utf-8").splitlines()

    def setting(self, option):
        """Returns the value of an option of FFmpeg, such as -preset."""
        words = self.arguments()
        return words[words.index(option) + 1] if option in words else None

    def replay(self, cores):
        """Returns FFmpeg's seconds for the recorded frames, on `cores` as in the recorded run."""
        command = [self.ffmpeg, *self.arguments()[:-1], f"file:{self.folder / 'film.mp4'}"]
        with open(self.folder / "frames", "rb") as frames:
            start = time.monotonic()
            subprocess.run(command, stdin=frames, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True,
                           preexec_fn=cores and (lambda: os.sched_setaffinity(0, cores)))
            return time.monotonic() - start


def alone(plan, device, scene, lengths, cores):
    """Returns (seconds of FFmpeg alone for a frame in steady state, its settings), or the reason why there are none."""
    if shutil.which("ffmpeg") is None:
        return "there is no ffmpeg"
    with tempfile.TemporaryDirectory(dir=plan.folder) as place:
        recordings = [Recording(place, f"film-{count}") for count in lengths]
        for count, recording in zip(lengths, recordings):
            run = plan.program.render(device, scene, f"0-{count}", plan.options, place, output="film.mp4", path=recording.path)
            if run["code"] != 0:
                return run["message"]
        short, long = recordings
        return (median((long.replay(cores) - short.replay(cores)) / (lengths[1] - lengths[0]) for _ in range(3)),
                {key: short.setting(f"-{key}") for key in ("preset", "crf", "pix_fmt")})
