# SPDX-License-Identifier: MIT
"""The scene as hedron renders it, timed as the other programs are."""
from statistics import mean

from harness.measure.scenes import write_scene
from harness.run.program import Problem

DEVICE = {"backend": "c", "index": 0}
MOST_FRAMES, ENOUGH = 64, 128  # so many frames and samples of a pixel tell the time of one frame


class Hedron:
    name = "hedron"

    def __init__(self, program, scene, size, folder):
        self.program, self.folder, self.size = program, folder, f"{size[0]}x{size[1]}"
        self.version = program.version
        still = {**scene, "camera": {**scene["camera"], "frames": MOST_FRAMES + 1}}
        self.scene = write_scene(still, folder / "rivals-hedron.json")

    @staticmethod
    def settings(quick):
        """{name: (samples a pixel at least, options)}"""
        sides = (1, 2, 4, 8) if quick else (1, 2, 3, 4, 6, 8, 12, 16)
        return {**{f"grid of {n}": (n * n, ("--samples", str(n))) for n in sides},
                **{f"adaptive, to {n}": (4, ("--samples", str(n), "--aa", "adaptive")) for n in sides[2:]}}

    def truth(self, file):
        self.run("0", ("--reference", "--samples", "32"), file)

    def grid(self, side, file):
        self.run("0", ("--samples", str(side)), file)

    def run(self, frames, options, file):
        done = self.program.render(DEVICE, self.scene, frames, ("--size", self.size, *options), self.folder,
                                   output=str(file.with_suffix(f".####{file.suffix}")))
        if done["code"] != 0:
            raise Problem(1, f"hedron {' '.join(options)}: {done['message']}")
        file.with_suffix(f".0000{file.suffix}").replace(file)
        return done

    def render(self, setting, file, _turn):
        """Processor time of further frames, so that the start of the program is not in it."""
        samples, options = setting
        more = max(2, min(MOST_FRAMES, ENOUGH // samples))
        one, many = [self.run(frames, options, file) for frames in ("0", f"0-{more}")]
        return {"cpu": (many["cpu"] - one["cpu"]) / more,
                "wall": mean(frame["seconds"]["trace"] for frame in many["frames"][1:])}
