# SPDX-License-Identifier: MIT
"""What bench/study measures: points of charts, each of which is one job of hedron on one device."""
from dataclasses import dataclass

from harness import light_scenes, triangle_models
from harness.program import Problem
from harness.speed_plan import Job

DEFAULT, OFFICIAL = "default", "official"
# A GPU's frame of the CPUs' size is too short to be timed; times of CPUs are multiplied by what they do less.
VIEWS = {True: (("--size", "320x180", "--samples", "2"), 16), False: (("--size", "1280x720", "--samples", "2"), 1)}
SIZES = {True: (("--size", "160x90"), 64), False: (("--size", "1280x720"), 1)}  # where samples are what changes
MESH_VIEWS = {True: (("--size", "320x240"), 64), False: (("--size", "1280x960", "--samples", "2"), 1)}
WHOLE_FRAME = "one frame of the built-in scene, 1280 x 720, 2 x 2 samples"

OFFICIAL_FRAMES = ",".join(map(str, range(0, 1024, 128)))
ANIMATION = {True: 24, False: 8}  # frames between those that are timed, quickly and not so quickly: they are 240
TRIANGLES = {True: (12, 100, 1000, 10000, 100000), False: (12, 48, 100, 1000, 10000, 100000, 1000000)}
BRUTE_MOST = {True: {True: 100, False: 1000}, False: {True: 1000, False: 10000}}  # CPUs or not, quickly or not
LIGHTS = {True: (1, 10, 100, 1000), False: (1, 3, 10, 30, 100, 300, 1000)}
SAMPLES = {True: (1, 2, 4), False: (1, 2, 3, 4, 6, 8)}
DEPTHS = {True: (0, 2, 6, 14, 30), False: (0, 1, 2, 4, 6, 10, 14, 20, 30)}
BLOCKS = (32, 64, 128, 256, 512, 1024)
GRIDS = (1, 4, 16, 64, 256, 1024, 4096, 16384, 65536)
LANES = (1, 4, 8, 16)
PIPELINES = ("mega", "wavefront", "wavefront-uncompacted")
ARITHMETIC = [(precision, math) for precision in ("float", "double") for math in ("strict", "fast")]

ONE_LANE, ONE_THREAD, ALL = "one thread, one ray at a time", "one thread", "all of it"
COLD, WARM = "nothing compiled", "compiled before"


@dataclass(frozen=True)
class Point:
    part: str
    series: str  # which line of the chart, within the device
    x: float
    device: str
    job: Job
    warm_up: bool = True  # the first frame of each run does not count
    scale: int = 1  # times are multiplied by it
    cold: bool = False  # hedron finds no compiled kernels

    def key(self):
        return f"{self.part}/{self.series}/{self.x:g}/{self.device}"


class Points:
    """`devices` are those that can run, by their labels; `scenes` has the files of all scenes, once made."""

    def __init__(self, devices, quick, cores, extra):
        self.devices, self.quick, self.cores, self.extra = devices, quick, cores, tuple(extra)
        self.frames = "0-2" if quick else "0-3"
        self.left_out = {}  # part: why there is nothing, or not all
        self.unmade = {}  # scene: why it could not be made
        self.found = []

    def add(self, part, series, x, device, scene, options, *, frames=None, output="#######.data", **named):
        if scene in self.unmade:
            self.left_out[part] = self.unmade[scene]
            return
        job = Job(device, scene, frames or self.frames, (*options, *self.extra), output=output)
        self.found.append(Point(part, series, x, device, job, **named))

    def every(self, wanted=lambda device: True):
        return [(label, device) for label, device in self.devices.items() if wanted(device)]

    def sweep(self, part, option, values, wanted=lambda device: True, views=None, scene=DEFAULT, series=""):
        for label, device in self.every(wanted):
            view, scale = (views or VIEWS)[device["is_cpu"]]
            for value in values:
                self.add(part, series, value, label, scene, (*view, option, str(value)), scale=scale)

    # ---- the parts

    def official(self):
        for label, device in self.every():
            if not device["is_cpu"]:
                self.add("official", "", 0, label, OFFICIAL, (), frames=OFFICIAL_FRAMES)
            elif self.quick:
                self.add("official", "", 0, label, OFFICIAL, ("--samples", "4"), frames="0,256,512", scale=16)
            else:
                self.add("official", "", 0, label, OFFICIAL, (), frames="0,512", warm_up=False)

    def animation(self):
        frames = ",".join(map(str, range(0, 240, ANIMATION[self.quick])))
        for label, device in self.every():
            view, scale = VIEWS[device["is_cpu"]]
            self.add("animation", "", 0, label, DEFAULT, view, frames=frames, scale=scale)

    def blocks(self):
        def is_gpu(device):
            return not device["is_cpu"]
        if not self.every(is_gpu):
            self.left_out["blocks"] = "There is no GPU, and the CPUs' work groups have one size."
        self.sweep("blocks", "--block", BLOCKS, is_gpu, series="block")
        self.sweep("blocks", "--grid", GRIDS, is_gpu, series="grid")

    def triangles(self):
        for label, device in self.every():
            view, scale = MESH_VIEWS[device["is_cpu"]]
            for way in ("bvh", "brute"):
                for count in TRIANGLES[self.quick]:
                    if way == "bvh" or count <= BRUTE_MOST[device["is_cpu"]][self.quick]:
                        self.add("triangles", way, count, label, f"sphere-{count}", (*view, "--accel", way), scale=scale)

    def lights(self):
        for label, device in self.every():
            view, scale = VIEWS[device["is_cpu"]]
            for count in LIGHTS[self.quick]:
                self.add("lights", "", count, label, f"lights-{count}", view, scale=scale)

    def samples(self):
        self.sweep("samples", "--samples", SAMPLES[self.quick], views=SIZES)

    def depth(self):
        self.sweep("depth", "--depth", DEPTHS[self.quick])

    def lanes(self):
        def is_cpu(device):
            return device["is_cpu"]
        if not self.every(is_cpu):
            self.left_out["lanes"] = "No CPU was measured."
        self.sweep("lanes", "--lanes", LANES, is_cpu)

    def thread_counts(self):
        counts = {self.cores}
        while min(counts) > 1:
            counts.add(min(counts) // 2)
        return sorted(counts)

    def threads(self):
        self.sweep("threads", "--threads", self.thread_counts(), lambda device: device["backend"] == "c")
        if not any(point.part == "threads" for point in self.found):
            self.left_out["threads"] = "The C backend, which has a choice of threads, was not measured."

    def one_thread(self):
        """The same picture everywhere; a quick one counts as many times as it has less samples."""
        options, scale = (("--samples", "2"), 4) if self.quick else (("--samples", "4"), 1)
        for label, device in self.every():
            ways = {ALL: ()}
            if device["backend"] == "c":
                ways = {ONE_LANE: ("--threads", "1", "--lanes", "1"), ONE_THREAD: ("--threads", "1"), **ways}
            for series, more in ways.items():
                self.add("one_thread", series, 0, label, OFFICIAL, (*options, *more), frames="0,512", scale=scale)

    def pipelines(self):
        for label, device in self.every():
            views = {DEFAULT: VIEWS[device["is_cpu"]], OFFICIAL: (("--samples", "2"), 1)}
            for scene, (view, scale) in views.items():
                for place, name in enumerate(PIPELINES):
                    self.add("pipelines", scene, place, label, scene, (*view, "--pipeline", name), scale=scale)

    def arithmetic(self):
        for label, device in self.every():
            view, scale = VIEWS[device["is_cpu"]]
            for place, (precision, math) in enumerate(ARITHMETIC):
                if precision == "float" or device["has_double"]:
                    self.add("arithmetic", "", place, label, DEFAULT, (*view, "--precision", precision, "--math", math),
                             scale=scale)

    def stages(self):
        """A run of one frame, with all that comes before and after."""
        for label, device in self.every():
            for cold, series in ((True, COLD), (False, WARM))[device["backend"] == "c":]:  # C is compiled ahead
                self.add("stages", series, 0, label, DEFAULT, ("--size", "640x360"), frames="0", output="#######.png",
                         warm_up=False, cold=cold)

    # ---- their scenes

    def make_scenes(self, parts, root, program, folder, news):
        """{name: file}"""
        scenes = {DEFAULT: root / "scenes/default.json", OFFICIAL: root / "scenes/official.json"}
        if "lights" in parts:
            for count in LIGHTS[self.quick]:
                scenes[f"lights-{count}"] = light_scenes.write(scenes[DEFAULT], folder, count)
        for count in TRIANGLES[self.quick] if "triangles" in parts else ():
            news(f"making {triangle_models.words(count)} triangles")
            try:
                file, _ = triangle_models.make(program.path.parent / "hedron_model", folder, count)
            except Problem as problem:
                self.unmade[f"sphere-{count}"] = str(problem)
                continue
            scenes[f"sphere-{count}"] = triangle_models.write(triangle_models.whole_scene(file),
                                                              folder / f"whole-{count}.json")
        return scenes


PARTS = ("official", "animation", "blocks", "triangles", "lights", "samples", "depth", "lanes", "threads", "one_thread",
         "pipelines", "arithmetic", "stages")
