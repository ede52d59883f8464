# SPDX-License-Identifier: MIT
"""Runs hedron_stability_methods and adds up its counts."""
from harness.run.program import run_tool

# Rays, paths or segments of each case, method and place.
COUNTS = {"crossings": 20000, "paths": 5000, "shadows": 20000}
STUDIES = tuple(COUNTS)
OURS = ("ours_solids", "ours_triangles", "ours")
CHECK = "ours_double"  # the same in double, which checks the reference

NAMES = {
    "moeller_trumbore_1e-6": "Moeller-Trumbore, epsilon 1e-6",
    "moeller_trumbore_0": "Moeller-Trumbore, epsilon 0",
    "baldwin_weber": "Baldwin-Weber",
    "pluecker": "Pluecker",
    "watertight": "watertight, no tie rule",
    "watertight_tie": "watertight, tie rule",
    "watertight_contracted": "watertight, contracted",
    "watertight_tie_contracted": "tie rule, contracted",
    "epsilon_1e-3": "epsilon 1e-3",
    "epsilon_1e-4": "epsilon 1e-4",
    "epsilon_4e-6": "epsilon 4e-6",
    "relative_epsilon": "relative epsilon 1e-5",
    "waechter_binder": "Waechter-Binder offset",
    "own_triangle": "own triangle skipped",
    "own_face": "own face skipped",
    "moeller_trumbore_epsilon_1e-4": "Moeller-Trumbore, distance above 1e-4",
    "normalised": "unit direction, t < distance",
    "normalised_epsilon_1e-4": "unit direction, epsilon 1e-4",
    "unnormalised": "whole segment, t < 1",
    "unnormalised_epsilon_1e-4": "whole segment, epsilon 1e-4 of it",
    "ours_solids": "hedron's half-spaces",
    "ours_triangles": "hedron's triangles",
    "ours": "hedron",
    CHECK: "hedron in double",
}

# What counts as a failure, and the number of tries.
WRONG = {
    "crossings": [("wrong", "tried")],
    "misplaced": [("misplaced", "tried")],
    "paths": [("strayed", "tried")],
    "lost": [("lost", "tried")],
    "far": [("strayed_far", "tried_far")],
    "shadows": [("blocked", "tried"), ("opened", "tried_shut"), ("nan", "tried")],
}


def parse(text):
    """Returns [{"study", "case", "method", "scale", "offset", and the counts}]."""
    found = []
    for line in text.splitlines():
        study, case, method, scale, offset, *counts = line.split()
        each = {"study": study, "case": case, "method": method, "scale": float(scale), "offset": float(offset)}
        for key, number in (word.split("=") for word in counts):
            each[key] = int(number)
        if study == "paths":
            each["strayed"] = each["tried"] - each["followed"]
            each["lost"] = each["tried"] - each["completed"]
            each["strayed_far"] = each["tried_far"] - each["followed_far"]
        found.append(each)
    return found


def run(program, study, count):
    """Returns the counts; raises Problem with the reason if the program fails."""
    return parse(run_tool(program.beside("bench/hedron_stability_methods"), study, count).stdout)


def is_at_origin(each):
    return each["offset"] == 0


def is_in_target(each):
    """Returns whether the target of the paths holds there."""
    return 1e-4 <= each["scale"] <= 1e4 and each["offset"] <= 1e4


def select(counts, study, cases=None, method=None, place=None):
    return [each for each in counts if each["study"] == study and (cases is None or each["case"] in cases)
            and (method is None or each["method"] == method) and (place is None or place(each))]


def tally(counts, what):
    """Returns (failures, tries); a try that fails in several ways counts once for each."""
    pairs = WRONG[what]
    wrong = sum(each[key] for each in counts for key, _ in pairs)
    tried = sum(each[base] for each in counts for base in dict.fromkeys(base for _, base in pairs))
    return wrong, tried


def share(counts, what):
    wrong, tried = tally(counts, what)
    return wrong / tried if tried else None


def worst(counts, what):
    """Returns (share, place) of the most failures, or None if nothing was tried."""
    shares = [(share([each], what), each) for each in counts if tally([each], what)[1]]
    return max(shares, key=lambda pair: pair[0], default=None)


def methods(counts, study):
    """Returns the methods in the order of printing, hedron's last, without the check."""
    found = dict.fromkeys(each["method"] for each in counts if each["study"] == study)
    return [each for each in found if each not in (*OURS, CHECK)] + [each for each in found if each in OURS]


# Failures that hedron's methods must never have.
NEVER = {"crossings": ("missed", "twice", "misplaced"), "paths": ("lost",), "shadows": ("blocked", "opened", "nan")}
# In double, rounding puts a light on a face to one side of it.
DOUBLE_MAY = ("face_lights",)
CRACKS = ("t_junctions",)  # the corners, as rounded, leave gaps, which no method promises to close


def failures(counts):
    """Returns the failures of hedron's methods, a sentence for each case and method."""
    found = []
    for study, keys in NEVER.items():
        for method in (*OURS, CHECK):
            for case in dict.fromkeys(each["case"] for each in select(counts, study, method=method)):
                these = select(counts, study, [case], method)
                wrong = {key: sum(each[key] for each in these) for key in keys}
                if any(wrong.values()) and case not in CRACKS and not (method == CHECK and case in DOUBLE_MAY):
                    said = ", ".join(f"{count} {key}" for key, count in wrong.items() if count)
                    found.append(f"{study}, {case}, {NAMES[method]}: {said} of {sum(each['tried'] for each in these)}")
    return found
