# SPDX-License-Identifier: MIT
"""Times one, two, four, ... devices that share the frames of a scene."""
from pathlib import Path
from statistics import median

from harness.command.bench import Bench
from harness.command.options import whole_number
from harness.measure.numbers import number
from harness.run.program import ROOT, Problem

HEAD = ["devices", "frames/s", "least", "most", "times one"]


def steady_rate(frames):
    """Returns frames a second: the sum of each device's rate from the end of its first frame to that of its last. It includes
    neither the compiling of kernels nor the last device's wait for the others. 0 if a device made fewer than two frames."""
    ends = {}
    for frame in frames:
        ends.setdefault((frame["backend"], frame["index"]), []).append(frame["began"]["trace"] + frame["seconds"]["trace"])
    if any(len(times) < 2 for times in ends.values()):
        return 0.0
    return sum((len(times) - 1) / (max(times) - min(times)) for times in ends.values())


def counts(total):
    """Returns 1, 2, 4, ... and the number of all."""
    found = [1]
    while found[-1] * 2 <= total:
        found.append(found[-1] * 2)
    return found + [total] * (found[-1] != total)


class Devices(Bench):
    name = "devices"
    about = "Time one device, then two, four, ... that share the frames of a scene; CUDA devices by default."
    quick, repeats = None, (3,)
    keys = ("rates", "frames")

    def add_options(self, parser):
        super().add_options(parser)
        parser.add_argument("scene", nargs="?", type=Path, default=ROOT / "scenes/official.json", metavar="SCENE.json",
                            help="scene to render (default: scenes/official.json)")
        parser.add_argument("--frames", type=whole_number, default=48, metavar="N",
                            help="frames of each device, at least 3 (default: 48)")

    def complete(self, arguments):
        super().complete(arguments)
        arguments.device = arguments.device or ["cuda"]
        if arguments.frames < 3:
            raise ValueError("at least 3 frames are needed")

    def prepare(self):
        if not self.arguments.scene.is_file():
            raise Problem(2, f"the scene file {self.arguments.scene} does not exist")
        self.demand_device()
        self.pictures = {}
        self.result.update(frames=self.arguments.frames, scene={"name": self.arguments.scene.stem}, rates=[
            {"devices": count, "frames_per_second": None, "times": None, "runs": []} for count in counts(len(self.runnable))])

    def run_once(self, row):
        several = {"backend": "auto", "index": ",".join(list(self.runnable)[:row["devices"]])}
        run = self.program.render(several, self.arguments.scene.resolve(), f"0-{self.arguments.frames * row['devices'] - 1}",
                                  self.arguments.options, self.folder)
        if run["code"] != 0:
            raise Problem(run["code"] if run["code"] in (2, 3) else 1, run["message"])
        made_by = {(frame["backend"], frame["index"]) for frame in run["frames"]}
        row["runs"].append({"rate": steady_rate(run["frames"]), "devices": len(made_by)})
        for frame, picture in run["digests"].items():
            if self.pictures.setdefault(frame, picture) != picture:
                raise Problem(1, f"frame {frame} of {row['devices']} devices is another picture than before, so these times do "
                                 "not count")

    def measure(self):
        for repeat in range(self.arguments.repeats):
            for row in self.result["rates"]:
                self.news(f"round {repeat + 1} of {self.arguments.repeats}: {row['devices']} devices")
                self.run_once(row)

    def fill(self):
        for row in filter(lambda row: row["runs"], self.result["rates"]):
            row["frames_per_second"] = median(run["rate"] for run in row["runs"])
            alone = self.result["rates"][0]["frames_per_second"]
            row["times"] = row["frames_per_second"] / alone if alone > 0 else None

    def compared(self):
        return {"same": True, "sentence": "Every number of devices made the same pictures."}

    def tables(self):
        rows = [[str(row["devices"]), number(row["frames_per_second"]),
                 *(number(pick(run["rate"] for run in row["runs"])) for pick in (min, max)), number(row["times"], 3)]
                for row in self.result["rates"] if row["runs"]]
        return [("Devices that share the frames", [HEAD, *rows], [])]


BENCH = Devices
