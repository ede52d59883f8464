# SPDX-License-Identifier: MIT
"""The megakernel and the wavefront, and the study's chart of all machines."""
from statistics import median

from harness.chart.rows import Row, ms, one_value, rows
from harness.command.bench import Bench
from harness.measure.numbers import number, spread, spread_text
from harness.measure.plan import DEFAULT, OFFICIAL
from harness.measure.rows import Missing
from harness.page.section import TOO_LITTLE, Part, middle, ratio, relative
from harness.run.program import ROOT

PIPELINES = ("mega", "wavefront", "wavefront-uncompacted")
SCENES = {"headline": "bench/scenes/headline.json", "fullhd": "bench/scenes/fullhd.json", "default": "scenes/default.json"}
FEWER = {"fullhd": (("--size", "480x270", "--samples", "2"), 64)}  # view for CPUs, and the factor of its times
HEAD = ["device", "scene", "pipeline", "trace ms [q1..q3]", "to mega", "processor time to mega"]


def cells(each):
    scaled = f" (scaled {each['scale']} times)" if each["scale"] != 1 else ""
    start = [each["device"], each["scene"] + scaled, each["pipeline"]]
    if each["reason"]:
        return [*start, each["reason"], "-", "-"]
    return [*start, spread_text(each["trace_ms"]), number(each["ratio_to_mega"], 3), number(each["processor_ratio_to_mega"], 3)]


class Pipelines(Bench):
    name = "pipelines"
    about = "Measure and chart the wavefront against the megakernel."
    quick = "measure few frames, rounds and samples; figures are rough"
    own_options = (*Bench.own_options, "--pipeline")
    scene = f"scenes {', '.join(SCENES)}"
    chart_files = keys = ("pipelines",)

    def prepare(self):
        self.plan.scenes = {name: ROOT / file for name, file in SCENES.items()}
        self.jobs = []  # (pipeline, job, the megakernel's job)
        for label, device in self.runnable.items():
            for scene in SCENES:
                added, scale = FEWER.get(scene, ((), 1)) if device["is_cpu"] else ((), 1)
                made = [self.plan.job(label, scene, "0-2" if self.arguments.quick else "0-4", (*added, "--pipeline", name),
                                      scale=scale) for name in PIPELINES]
                self.jobs += [(name, job, made[0]) for name, job in zip(PIPELINES, made)]

    def row(self, pipeline, job, base):
        done = {"device": job["device"], "scene": job["scene"], "pipeline": pipeline, "scale": job["scale"], "trace_ms": None,
                "ratio_to_mega": None, "processor_ratio_to_mega": None, "reason": None}
        try:
            done["trace_ms"] = spread(self.plan.trace_ms(job))
            ratios = self.plan.ratios(job, base)
            done["ratio_to_mega"] = median(ratios) if ratios else None
            if self.runnable[job["device"]]["is_cpu"]:  # whole runs' processor time: other work changes it little
                done["processor_ratio_to_mega"] = median(
                    one["cpu"] / other["cpu"] for one, other in zip(self.plan.done(job), self.plan.done(base)))
        except Missing as missing:
            done["reason"] = str(missing)
        return done

    def fill(self):
        self.result["pipelines"] = [self.row(*each) for each in self.jobs]

    def tables(self):
        return [("Pipelines", [HEAD, *map(cells, self.result["pipelines"])], [])]

    def charts(self):
        measured = [each for each in self.result["pipelines"] if each["ratio_to_mega"]]
        return {"pipelines": self.chart(measured)} if measured else {}

    def chart(self, measured):
        wavefronts = [each for each in measured if each["pipeline"] == "wavefront"]
        best = min(wavefronts or measured, key=lambda each: each["ratio_to_mega"])
        caption = (f"The wavefront does best on {best['device']} in the scene {best['scene']}: it takes "
                   f"{number(best['ratio_to_mega'], 3)} times the megakernel's time. Figures are medians of the rounds' ratios.")
        return rows(self.result, "Time of tracing, against the megakernel", caption, "times the megakernel's time", [
            Row(each["pipeline"], one_value(each["ratio_to_mega"]),
                f"{number(each['ratio_to_mega'], 3)}  ({number(each['trace_ms']['median'], 3)} ms)",
                PIPELINES.index(each["pipeline"]), group=f"{each['device']} {each['scene']}") for each in measured])


BENCH = Pipelines


# ---- the study's part

def add(plan):
    for label, _, *own in plan.each():
        for scene, (view, scale) in {DEFAULT: own, OFFICIAL: (("--samples", "2"), 1)}.items():
            for place, name in enumerate(PIPELINES):
                plan.point(scene, place, label, scene, (*view, "--pipeline", name), scale=scale)


def gain_words(gains):
    if not gains:
        return TOO_LITTLE
    best, compacted = min(gains), max(gains, key=lambda each: each[1])
    return (f"The wavefront does best on {best[2]}: it takes {ratio(best[0])} the megakernel's time. Compaction helps most on "
            f"{compacted[2]}: without it the wavefront takes {ratio(compacted[1])} as long.")


def fill(section):
    drawn, gains = [], []
    for device in section.devices:
        for scene in (DEFAULT, OFFICIAL):
            found = {PIPELINES[int(entry["x"])]: entry for entry in device.entries(series=scene)}
            drawn += [Row(scene, relative(found[name], found["mega"]), ms(middle(found[name])), device.place, group=device.name,
                          variant=name) for name in PIPELINES if name in found and "mega" in found]
            if len(found) == len(PIPELINES):
                mega, wavefront, uncompacted = (middle(found[name]) for name in PIPELINES)
                gains.append((wavefront / mega, uncompacted / wavefront, f"{device.name} in the scene {scene}"))
    if drawn:
        section.draw(rows, "built-in scene, 1280 x 720, and official example, 640 x 480, 2 x 2 samples", "Megakernel and wavefront",
                     gain_words(gains), "times the megakernel's time", drawn)
    section.tabulate(lambda entry: f"{entry['series']}, {PIPELINES[int(entry['x'])]}")


PART = Part(11, "Megakernel and wavefront", "Options --pipeline mega, wavefront, and wavefront-uncompacted, which keeps dead "
            "rays.",
            add, fill=fill)
