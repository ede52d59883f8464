# SPDX-License-Identifier: MIT
"""Measures every target of speed on every device, and draws a timeline."""
import os

from harness.command.bench import Bench
from harness.measure import kernel_rates
from harness.measure.rows import Missing
from harness.measure.scenes import facts, write_lights
from harness.run import devices, machine
from harness.run.program import ROOT
from harness.speed import film, timeline
from harness.speed.rows import COUNTED_LIGHTS, LIGHT_VIEWS, ROWS, Rows

CORES = 2  # that the targets for two cores are measured on


def find_scenes(folder):
    """Every scene that ships, those to measure by, and the made ones."""
    files = [file for place in ("scenes", "bench/scenes") for file in sorted((ROOT / place).glob("*.json"))]
    return {**{file.stem: file for file in files},
            **{f"lights-{count}": write_lights(folder, count) for count in (4, *LIGHT_VIEWS)}}


class Speed(Bench):
    name = "speed"
    about = "Measure every target of speed on every device, and print figures and ratios."
    quick = "few frames and repeats; large pictures on CPUs are smaller, and their times scaled"
    parts = ROWS
    chart_files = ("timeline",)
    keys = ("kernel_rates", "counted", "film", "timeline", "scenes", "peaks")

    def prepare(self):
        self.result["few_cores"] = min(CORES, machine.cores())
        self.plan.scenes = find_scenes(self.arguments.out)
        usable = sorted(os.sched_getaffinity(0))
        self.plan.cores = set(usable[:CORES]) if len(usable) > CORES else None
        self.rows = Rows(self.plan)
        for name in self.arguments.parts:
            getattr(self.rows, name)()

    def measure_loops(self):
        quick, scenes = self.arguments.quick, self.plan.scenes
        seconds, rounds = (0.1, 3) if quick else (0.5, 5)
        if self.wants("searches"):
            views = [scenes["default"], *(scenes[f"lights-{count}"] for count in LIGHT_VIEWS)]
            self.rows.rates = self.tried("rates of the hot loops", kernel_rates.run, self.program, views, seconds, rounds)
        if self.wants("share"):
            views = [scenes["default"], write_lights(self.arguments.out, COUNTED_LIGHTS)]
            self.rows.counts = self.tried("counting the operations of the hot loops", kernel_rates.run, self.program, views,
                                          seconds, rounds, counts=True)

    def measure_film(self):
        device = self.plan.devices[self.rows.cpu("c") or next(iter(self.runnable))]
        for is_cpu in {each["is_cpu"] for each in self.runnable.values()}:
            self.news("FFmpeg alone")
            self.rows.film[is_cpu] = film.alone(self.plan, device, self.plan.scenes["headline"], self.rows.film_lengths(),
                                                self.plan.cores if is_cpu else None)

    def measure_timeline(self):
        label = self.rows.cpu("c") or next(iter(self.runnable))
        self.news("timeline")
        run = self.program.render(self.plan.devices[label], None, f"0-{5 if self.arguments.quick else 23}",
                                  self.arguments.options, self.folder, output="film.mp4")
        self.result["timeline"] = {"device": label, "reason": run["message"]}
        if run["code"] == 0:
            self.result["scene"].update({key: run["frames"][0][key] for key in ("width", "height", "samples", "depth")})
            try:
                self.result["timeline"] = {"device": label, **timeline.measure(run["frames"])}
            except Missing as missing:
                self.result["timeline"]["reason"] = str(missing)

    def measure(self):
        self.measure_loops()
        if self.runnable and self.wants("stage", "headline_film"):
            self.measure_film()
        if self.runnable:
            self.measure_timeline()
        self.plan.run_all(self.arguments.repeats)

    def fill(self):
        for key, found in (("kernel_rates", self.rows.rates), ("counted", self.rows.counts)):
            self.result[key] = {"reason": found} if isinstance(found, str) else found
        settings = next((found[1] for found in self.rows.film.values() if isinstance(found, tuple)), None)
        for row in self.plan.rows:
            if row["key"] == "headline_film" and settings:
                row["note"] += f"; x264 preset {settings['preset']}, crf {settings['crf']}"
        self.result.update(film=settings, scenes={name: facts(file) for name, file in self.plan.scenes.items()}, peaks={
            device["label"]: devices.lane_rate(device, self.result["devices"]) for device in self.result["devices"]
            if device["is_cpu"] is False})

    def tables(self):
        found = self.result["timeline"]
        if found and "stages" not in found:
            return [("Stages of a run", [], [f"None: {found['reason']}."])]
        return [timeline.table(found)] if found else []

    def charts(self):
        return {"timeline": timeline.chart(self.result)} if "stages" in (self.result["timeline"] or {}) else {}


BENCH = Speed
