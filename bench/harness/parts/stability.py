# SPDX-License-Identifier: MIT
"""Where methods fail, counted as bench/study stability does; an interrupted study goes on where it was."""
from harness.page.part import Part
from harness.run.program import ROOT
from harness.stability import charts, methods, pictures, table

FEWER = {True: 20, False: 4}  # by what it counts less
SIZE = ("--size", "80x60", "--samples", "1")


def steps(study):
    """{step: (list, what to do for it)}"""
    fewer, options = FEWER[study.arguments.quick], (*SIZE, *study.arguments.options)
    found = {each: ("counts", lambda each=each: methods.run(study.program, each, methods.COUNTS[each] // fewer))
             for each in methods.STUDIES}
    for file in sorted((ROOT / "scenes").glob("*.json")):
        found[f"precision {file.stem}"] = ("precision", lambda file=file: pictures.study_scene(
            study.program, file, options, study.folder))
    return found


def measure(study):
    """It all runs on the CPU, and every number is the same each time. Raises Problem where it cannot be."""
    memory = study.result["stability"] = study.result["stability"] or {"steps": [], "counts": [], "precision": [], "odd": None}
    for step, (key, work) in steps(study).items():
        if step not in memory["steps"]:
            study.news(f"stability, {step}")
            memory[key] += work()
            memory["steps"].append(step)
            study.save()


def fill(sources, section):
    """Of the first machine that has it: every number is the same everywhere."""
    found = next((result for result in sources.results if result["stability"]), None)
    if found is None:
        return
    about = {**found["stability"], "hedron": found["hedron"], "machine": found["machine"],
             "scene": {"name": "solids and triangles"}}
    section.charts = {f"study_{name}": chart for name, chart in charts.charts(about).items()}
    section.captions = dict.fromkeys(section.charts, "")
    section.table = [table.HEAD, *[list(row.values()) for row in table.rows(about)]]


def failures(result):
    return methods.failures(result["stability"]["counts"]) if result["stability"] else []


PART = Part(16, "Stability", "How often methods of geometry and arithmetic fail, hedron's among them, at many sizes and "
            "distances; see bench/README.md, bench/study stability.", measure=measure, fill=fill, failures=failures)
