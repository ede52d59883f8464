# SPDX-License-Identifier: MIT
"""Reports what became slower or faster between two results of bench/study, beyond the noise."""
import math
from pathlib import Path
from statistics import median

from harness.command.options import Command
from harness.measure.numbers import number
from harness.page import tables
from harness.run.program import Problem
from harness.store import result as results

LEAST = 0.03  # share below which a difference counts as none, however quiet the machine was
ERRORS = 3.0  # standard errors beyond which a difference is no noise
QUARTILES = 1.349  # standard deviations between the quartiles of a normal distribution
MEDIAN = 1.2533  # standard error of a median by that of a mean
SLOWER, FASTER, SAME = "slower", "faster", "within the noise"
HEAD = ["measurement", "device", "old ms", "new ms", "change", "noise", "verdict"]


def deviation(entry):
    """Returns the relative standard deviation of the runs, from the quartiles."""
    spread = entry["summary"]["trace_ms"]
    return (spread["q3"] - spread["q1"]) / QUARTILES / spread["median"] if spread["median"] > 0 else 0


def measured(result):
    """Returns {identity: entry}; the name of the device is part of it, because c:0 of another machine is another device."""
    names = {device["label"]: device["name"] for device in result["devices"]}
    return {(results.identity(entry), names[entry["device"]]): entry for entry in result["measurements"]
            if entry["summary"]}


def compare(old, new):
    """Returns [{"entry", "old_ms", "new_ms", "change": share, "limit": share, "verdict", "disturbed"}] of the entries that
    both, as `measured` gives them, have in common; the most slowed first."""
    common = [key for key in old if key in new]
    if not common:
        raise Problem(2, "the two have no measurement in common: their devices differ, or only one of them is quick")
    # Few runs may lie together by chance, so none counts as quieter than half of all.
    usual = [median(deviation(each[key]) for key in common) for each in (old, new)]
    found = []
    for pair in ((old[key], new[key]) for key in common):
        times = [entry["summary"]["trace_ms"]["median"] for entry in pair]
        if min(times) <= 0:
            continue
        errors = [MEDIAN * max(deviation(entry), least) / math.sqrt(entry["summary"]["runs"])
                  for entry, least in zip(pair, usual)]
        change, limit = math.log(times[1] / times[0]), max(math.log1p(LEAST), ERRORS * math.hypot(*errors))
        found.append({"entry": pair[1], "old_ms": times[0], "new_ms": times[1], "change": math.expm1(change),
                      "limit": math.expm1(limit), "verdict": SAME if abs(change) <= limit else SLOWER if change > 0 else FASTER,
                      "disturbed": any(entry["summary"]["noisy"] for entry in pair)})
    return sorted(found, key=lambda each: -each["change"])


def row(each):
    entry = each["entry"]
    name = f"{entry['part']} {entry['series']} {entry['x']:g}".replace("  ", " ")
    return [name, entry["device"], number(each["old_ms"]), number(each["new_ms"]),
            f"{100 * each['change']:+.1f} %", f"{100 * each['limit']:.1f} %",
            each["verdict"] + (", disturbed" if each["disturbed"] else "")]


class Compare(Command):
    name = "compare"
    about = "Report what became slower or faster between two results of bench/study, beyond the noise."
    codes = "exit codes: 0 nothing is slower beyond the noise, 1 something is, 2 wrong usage or input"

    def add_options(self, parser):
        parser.add_argument("old", type=Path, metavar="OLD.json", help="result of bench/study before the change")
        parser.add_argument("new", type=Path, metavar="NEW.json", help="result after the change")
        parser.add_argument("--all", action="store_true", help="list changes within the noise too")

    def run(self, arguments):
        both = {"old": results.read_study(arguments.old), "new": results.read_study(arguments.new)}
        ours, theirs = map(measured, both.values())
        found = compare(ours, theirs)
        for name, each in both.items():
            print(f"{name}: hedron {each['hedron']['version']} ({each['hedron']['sha256'][:12]}), {each['date']}, "
                  f"{each['machine']['name']}")
        shown = [each for each in found if arguments.all or each["verdict"] != SAME]
        print("", *([*tables.lines([HEAD, *map(row, shown)]), ""] if shown else []), sep="\n")
        counts = [f"{sum(each['verdict'] == name for each in found)} {name}" for name in (SLOWER, FASTER, SAME)]
        print(f"{', '.join(counts)}.")
        for name, one, other in (("old", ours, theirs), ("new", theirs, ours)):
            if one.keys() - other.keys():
                print(f"{len(one.keys() - other.keys())} measurements are only in the {name} one.")
        return 1 if any(each["verdict"] == SLOWER for each in found) else 0


BENCH = Compare
