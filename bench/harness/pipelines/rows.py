# SPDX-License-Identifier: MIT
"""The pipelines against each other: every device, several scenes."""
from statistics import median

from harness.chart.bars import Row, one_value, rows as bars
from harness.measure.numbers import number, spread, spread_text
from harness.measure.rows import Missing

PIPELINES = ("mega", "wavefront", "wavefront-uncompacted")
SCENES = ("headline", "fullhd", "default")
# For CPUs, and by what that has less to do.
FEWER = {"fullhd": (("--size", "480x270", "--samples", "2"), 64)}


def add_jobs(plan, runnable, frames, extra):
    """[{pipeline: job}]"""
    found = []
    for label, device in runnable.items():
        for scene in SCENES:
            added, scale = FEWER.get(scene, ((), 1)) if device["is_cpu"] else ((), 1)
            found.append({name: plan.job(label, scene, frames, (*added, *extra, "--pipeline", name), scale=scale)
                          for name in PIPELINES})
    return found


def row(plan, pipeline, job, base):
    done = {"device": job["device"], "scene": job["scene"], "pipeline": pipeline, "scale": job["scale"], "trace_ms": None,
            "ratio_to_mega": None, "processor_ratio_to_mega": None, "reason": None}
    try:
        done["trace_ms"] = spread(plan.trace_ms(job))
        ratios = plan.ratios(job, base)
        done["ratio_to_mega"] = median(ratios) if ratios else None
        if plan.devices[job["device"]]["is_cpu"]:  # whole runs' processor time: other work changes it little
            done["processor_ratio_to_mega"] = median(
                one["cpu"] / other["cpu"] for one, other in zip(plan.done(job), plan.done(base)))
    except Missing as missing:
        done["reason"] = str(missing)
    return done


def all_rows(plan, jobs):
    return [row(plan, name, job, each["mega"]) for each in jobs for name, job in each.items()]


def cells(each):
    scaled = f" (scaled {each['scale']} times)" if each["scale"] != 1 else ""
    start = [each["device"], each["scene"] + scaled, each["pipeline"]]
    if each["reason"]:
        return [*start, each["reason"], "-", "-"]
    return [*start, spread_text(each["trace_ms"]), number(each["ratio_to_mega"], 3), number(each["processor_ratio_to_mega"], 3)]


HEAD = ["device", "scene", "pipeline", "trace ms [q1..q3]", "to mega", "processor time to mega"]


def chart(result):
    """(height, commands)"""
    measured = [each for each in result["pipelines"] if each["ratio_to_mega"]]
    wavefronts = [each for each in measured if each["pipeline"] == "wavefront"]
    best = min(wavefronts or measured, key=lambda each: each["ratio_to_mega"])
    caption = (f"A bar of 1 is as long as the megakernel takes. The wavefront does best on {best['device']} with "
               f"{best['scene']}: {number(best['ratio_to_mega'], 3)}. Medians of the rounds' ratios.")
    return bars(result, "Time of tracing, against the megakernel", caption, "times the megakernel's time", [
        Row(f"{each['device']} {each['scene']}, {each['pipeline']}", one_value(each["ratio_to_mega"]),
            f"{number(each['ratio_to_mega'], 3)}  ({number(each['trace_ms']['median'], 3)} ms)",
            PIPELINES.index(each["pipeline"]), group=f"{each['device']} {each['scene']}") for each in measured])
