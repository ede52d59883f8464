# SPDX-License-Identifier: MIT
"""The pipelines against each other: every device, several scenes."""
from statistics import median

from harness import bars, report, summary
from harness.speed_plan import Missing

PIPELINES = ("mega", "wavefront", "wavefront-uncompacted")
SCENES = ("headline", "fullhd", "default")
# For CPUs, and by what that has less to do.
FEWER = {"fullhd": (("--size", "480x270", "--samples", "2"), 64)}


def add_jobs(plan, runnable, frames, extra):
    """[(device, scene, scale, {pipeline: job})]"""
    jobs = []
    for label, device in runnable.items():
        for scene in SCENES:
            added, scale = FEWER.get(scene, ((), 1)) if device["is_cpu"] else ((), 1)
            jobs.append((label, scene, scale, {
                name: plan.job(label, scene, frames, (*added, *extra, "--pipeline", name)) for name in PIPELINES}))
    return jobs


def processor_ratio(plan, job, base):
    """Of whole runs' processor time, round by round: other work on the machine changes it little."""
    return median(one["cpu"] / other["cpu"] for one, other in zip(plan.done(job), plan.done(base)))


def row(plan, device, scene, scale, pipeline, job, base):
    done = {"device": device, "scene": scene, "pipeline": pipeline, "scale": scale, "trace_ms": None,
            "ratio_to_mega": None, "processor_ratio_to_mega": None, "reason": None}
    try:
        first, middle, third = summary.quartiles(plan.trace_ms(job, scale))
        done["trace_ms"] = {"median": middle, "q1": first, "q3": third}
        ratios = plan.ratios(job, base)
        done["ratio_to_mega"] = median(ratios) if ratios else None
        if plan.devices[device]["is_cpu"]:
            done["processor_ratio_to_mega"] = processor_ratio(plan, job, base)
    except Missing as missing:
        done["reason"] = str(missing)
    return done


def rows(plan, jobs):
    return [row(plan, device, scene, scale, name, each[name], each["mega"])
            for device, scene, scale, each in jobs for name in PIPELINES]


def cells(each):
    scaled = f" (scaled {each['scale']} times)" if each["scale"] != 1 else ""
    start = [each["device"], each["scene"] + scaled, each["pipeline"]]
    if each["reason"]:
        return [*start, each["reason"], "-", "-"]
    times = each["trace_ms"]
    return [*start, f"{report.number(times['median'])} [{report.number(times['q1'])}..{report.number(times['q3'])}]",
            report.number(each["ratio_to_mega"], 3), report.number(each["processor_ratio_to_mega"], 3)]


HEAD = ["device", "scene", "pipeline", "trace ms [q1..q3]", "to mega", "processor time to mega"]


def chart(result):
    """(height, commands)"""
    measured = [each for each in result["pipelines"] if each["ratio_to_mega"]]
    wavefronts = [each for each in measured if each["pipeline"] == "wavefront"]
    best = min(wavefronts or measured, key=lambda each: each["ratio_to_mega"])
    caption = (f"A bar of 1 is as long as the megakernel takes. The wavefront does best on {best['device']} with "
               f"{best['scene']}: {report.number(best['ratio_to_mega'], 3)}. Medians of the rounds' ratios.")
    rows_of_chart = [bars.Bar(f"{each['device']} {each['scene']}, {each['pipeline']}", (each["ratio_to_mega"],),
                              f"{report.number(each['ratio_to_mega'], 3)}  ({report.number(each['trace_ms']['median'], 3)} ms)",
                              PIPELINES.index(each["pipeline"])) for each in measured]
    return bars.chart(result, "Time of tracing, against the megakernel", caption, "times the megakernel's time",
                      rows_of_chart)


def drawable(result):
    return {"pipelines": chart} if any(each["ratio_to_mega"] for each in result["pipelines"] or []) else {}
