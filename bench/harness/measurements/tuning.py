# SPDX-License-Identifier: MIT
"""The fastest settings of each device by hedron tune. It runs last, because later runs use its choice."""
import json

from harness.measure.numbers import number
from harness.page.section import Part
from harness.run.program import run_tool

SIZE = {True: ("--size", "320x180"), False: ()}
HOW = ("pipeline", "lanes", "block", "registers")


def measure(study):
    """Tunes the devices that the result lacks; raises Problem if a run fails."""
    found = study.result["tuning"] = study.result.get("tuning") or {}
    for label in study.runnable:
        if label not in found:
            study.news(f"tune {label}")
            done = run_tool(study.program.path, "tune", "--json", "--device", label, *SIZE[study.arguments.quick])
            found[label] = json.loads(done.stdout)
            study.save()


def words(candidate):
    return ", ".join(f"{candidate[key]} {key}" if key != "pipeline" else candidate[key] for key in HOW if candidate[key])


def fill(section):
    section.table = [["machine", "device", "candidate", "milliseconds", "ratio to the default"]]
    for result in section.results:
        for label, tuned in (result.get("tuning") or {}).items():
            measured = [each for each in tuned["candidates"] if each["failure"] is None]
            section.table += [[result["machine"]["name"], label, words(each), number(each["ms"], 3), number(each["ratio"], 3)]
                              for each in measured]
            best = min(measured, key=lambda each: each["ms"])
            section.notes.append(f"{words(best)} is the fastest on {label} of {result['machine']['name']}: it takes "
                                 f"{number(best['ratio'], 3)} times the time of the default.")


PART = Part(20, "Tuning", "Times of a frame of the built-in scene by every pipeline, number of lanes and size of groups that the "
            "device supports; see hedron help tune.", measure=measure, fill=fill)
