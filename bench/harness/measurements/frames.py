# SPDX-License-Identifier: MIT
"""Times the frames of a scene on every device of every backend."""
import math
from pathlib import Path
from statistics import median

from harness.chart import files
from harness.chart.axes import Axis
from harness.chart.lines import Line, lines
from harness.chart.rows import Row, ms, rows
from harness.chart.sheet import device_title
from harness.command.bench import Bench
from harness.measure.jobs import counted_frames, picture_groups
from harness.measure.numbers import number, rays, spread, spread_text
from harness.measurements.animation import by_frame, most_varied
from harness.page import tables
from harness.page.section import MS, TIME_AXIS, ratio, ticks_of
from harness.run.program import Problem
from harness.store.result import machine_words, scene_words

HEAD = ["backend", "device", "trace ms [q1..q3]", "frame ms", "frames/s", "M rays/s", "M shadow tests/s", "ratio"]
OF_SCENE = ("width", "height", "samples", "depth")


def rate(count, seconds):
    """Returns a rate, or None for a time too short for the clock."""
    return count / seconds if seconds > 0 else None


def median_rate(frames, count):
    rates = [rate(count(frame), frame["seconds"]["trace"]) for frame in frames]
    return None if None in rates else median(rates)


def summary(frames):
    """Returns the summary, or None if no frame counts. Rates are those of the median frame."""
    if not frames:
        return None
    whole = median(sum(frame["seconds"].values()) for frame in frames)
    return {"frames": len(frames), "trace_ms": spread([1e3 * frame["seconds"]["trace"] for frame in frames]),
            "frame_ms": 1e3 * whole, "frames_per_second": rate(1, whole), "rays_per_second": median_rate(frames, rays),
            "shadow_tests_per_second": median_rate(frames, lambda frame: frame["shadow_tests"])}


def trace_ms(job):
    return job["summary"]["trace_ms"]["median"]


class Frames(Bench):
    name = "frames"
    about = ("Time the frames of a scene on every device: hedron renders them several times, and the median counts. The result "
             "is a table, charts (frames.svg, frames_animation.svg) and all times (frames.json).")
    operands = "[SCENE.json] "
    quick, repeats = None, (3,)
    chart_files = ("frames", "frames_animation")
    keys = ("frames",)

    def add_options(self, parser):
        super().add_options(parser)
        parser.add_argument("scene", nargs="?", type=Path, metavar="SCENE.json", help="scene to render (default: the built-in one)")
        parser.add_argument("--frames", default="0-4", metavar="LIST",
                            help="at least two, of which the first warms up and does not count (default: 0-4); "
                                 "a still scene gets them by -- --set camera.frames=5")

    def prepare(self):
        scene, plan = self.arguments.scene, self.plan
        if scene and not scene.is_file():
            raise Problem(2, f"there is no scene file {scene}")
        plan.scenes["scene"] = scene and scene.resolve()
        plan.keeps_parts, plan.save = True, self.check  # the result is written after every run: an interruption loses nothing
        for label in self.runnable:
            plan.job(label, "scene", self.arguments.frames)
        self.result.update(frames=self.arguments.frames, scene={"name": scene.stem if scene else self.scene,
                                                                **dict.fromkeys(OF_SCENE), "rays_per_frame": None})

    def measure(self):
        try:
            super().measure()
        except Problem as problem:
            still = "the scene has one frame" in str(problem)
            raise Problem(problem.code, f"{problem}; a still scene gets more by -- --set camera.frames=5" if still else problem) from None

    def check(self):
        if any(len(run["frames"]) < 2 for job in self.plan.jobs for run in job["runs"]):
            raise Problem(2, f"--frames is '{self.arguments.frames}', expected at least two frames, for the first warms up")
        self.save()

    def fill(self):
        counts, scene = {}, self.result["scene"]
        for job in self.plan.jobs:
            job["summary"] = summary(counted_frames(job))
            for frame in counted_frames(job):
                counts.setdefault(frame["frame"], rays(frame))
                scene.update({key: frame[key] for key in OF_SCENE})
        scene["rays_per_frame"] = sum(counts.values()) / len(counts) if counts else None
        self.measured = [job for job in self.plan.jobs if job["summary"]]
        fastest = min(map(trace_ms, self.measured), default=0)
        for job in self.measured:
            job["summary"]["ratio_to_fastest"] = rate(trace_ms(job), fastest)

    def compared(self):
        jobs, options = self.plan.jobs, self.arguments.options
        names = [job["device"] for job in jobs if self.device(job)["strict"] and job["runs"]]
        if "--math fast" in " ".join(options) or "--math=fast" in options:
            same, names, words = None, [], "The pictures were not compared: --math fast promises no equal bytes."
        elif len(names) < 2:
            same, words = None, "The pictures were not compared: fewer than two strict devices made any."
        else:
            same, words = True, f"The pictures of {', '.join(names)} are the same bytes."
            for (_, _, frame), makers in sorted(picture_groups(jobs, self.plan.devices).items()):
                if same and len(makers) > 1:
                    groups = " / ".join(", ".join(dict.fromkeys(maker.split()[0] for maker in each)) for each in makers.values())
                    same, words = False, f"THE PICTURES DIFFER, so these times do not count: frame {frame}, {groups}."
        return {"same": same, "devices": names, "sentence": words}

    def device(self, job):
        return self.plan.devices[job["device"]]

    # ---- results

    def cells(self, job):
        each, device = job["summary"], self.device(job)
        millions = [each[key] and each[key] / 1e6 for key in ("rays_per_second", "shadow_tests_per_second")]
        return [device["backend"], f"{device['index']}  {device['name']}", spread_text(each["trace_ms"]),
                number(each["frame_ms"]), number(each["frames_per_second"]), *map(number, millions),
                number(each["ratio_to_fastest"], 3)]

    def tell(self):
        printed = [f"hedron {self.program.version}, {scene_words(self.result)}", machine_words(self.result), ""]
        if self.measured:
            printed += [*tables.lines([HEAD, *map(self.cells, self.measured)]), ""]
        printed += [f"{each.get('label') or each['device']} {'failed' if each.get('failed') else 'cannot run'}: {each['reason']}"
                 for each in [*self.result["devices"], *self.plan.jobs] if each["reason"] is not None]
        if not self.result["complete"]:
            printed.append("Interrupted: figures are of what was measured until then.")
        print(*printed, self.result["pictures"]["sentence"], *files.draw(self.charts(), self.arguments.out),
              f"All times: {self.file}", sep="\n")

    def charts(self):
        return {"frames": self.dots(), "frames_animation": self.animation()} if self.measured else {}

    def dots(self):
        fastest, slowest = min(self.measured, key=trace_ms), max(self.measured, key=trace_ms)
        caption = f"{device_title(self.device(fastest))} traces a frame in {ms(trace_ms(fastest))}"
        if slowest is not fastest:
            caption += f"; {slowest['device']}, the slowest, takes {ratio(slowest['summary']['ratio_to_fastest'])} as long"
        return rows(self.result, "Time of a frame on each device",
                    f"{caption}. Dots are medians of {fastest['summary']['frames']} frames; whiskers reach from the first to "
                    "the third quartile.", MS,
                    [Row(device_title(self.device(job)), job["summary"]["trace_ms"],
                         f"{ms(trace_ms(job))}, whole {ms(job['summary']['frame_ms'])}", place, job["summary"]["frame_ms"])
                     for place, job in enumerate(self.measured)], "the whole frame, with copying and storing")

    def animation(self):
        drawn = [Line(device_title(self.device(job)), by_frame(job), place, mark=place, short=job["device"])
                 for place, job in enumerate(self.measured)]
        line, times = most_varied(drawn)
        fastest = {min(drawn, key=lambda line: dict(line.points).get(frame, {"median": math.inf})["median"]).short
                   for frame in {frame for line in drawn for frame, _ in line.points}}
        words = f"The slowest frame takes {ratio(times)} as long as the fastest on {line.short}"
        if len(drawn) > 1:
            words += ", the device that differs most. " + (
                f"{fastest.pop()} is the fastest in every frame" if len(fastest) == 1
                else "The fastest device depends on the frame")
        kind = "the only run" if self.arguments.repeats == 1 else f"the median of {self.arguments.repeats} runs"
        return lines(self.result, "Time of tracing along the animation",
                     f"{words}. Each point is {kind}, without the first frame, which warms up.", Axis("frame number", ticks=ticks_of(drawn)),
                     TIME_AXIS, drawn)

    def exit_code(self):
        code = super().exit_code()
        return 3 if code == 0 and not self.measured else code


BENCH = Frames
