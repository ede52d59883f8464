# SPDX-License-Identifier: MIT
"""The rows of bench/study stability that have targets."""
from harness.measure.rows import NONE, Missing, Target, known
from harness.stability import methods, pictures

PATHS, NEAR = Target(99, 99.99), Target(99.9, 99.99)
WRONG = {"crossings": "rays that miss, count twice or are misplaced", "shadows": "segments wrongly blocked or opened",
         "sums": "pixels whose sum depends on the order"}


def percent(part, whole):
    if not whole:
        raise Missing("it was not measured")
    return [100 * part / whole]


def add_paths(plan, counts, method):
    these = methods.select(counts, "paths", method=method, place=methods.is_in_target)
    (strayed, tried), (far, tried_far) = methods.tally(these, "paths"), methods.tally(these, "far")
    note, found = None, methods.worst(these, "paths")
    if found:
        share, each = found
        note = (f"{methods.NAMES[method]}: {strayed} of {tried} paths stray; least at one place {100 - 100 * share:.2f} % of "
                f"{each['tried']} ({each['case']}, scale {each['scale']:g}, offset {each['offset']:g})")
    plan.row("paths", f"paths that follow the double path after 30 bounces, {methods.NAMES[method]}", "%",
             lambda: percent(tried - strayed, tried), target=None if method == methods.CHECK else PATHS, note=note)
    return f"  after 300 bounces, {methods.NAMES[method]}", lambda: percent(tried_far - far, tried_far)


def add_pictures(plan, entries, what, geometry, target):
    near, pixels = pictures.total(entries, what, geometry)
    plan.row("precision", f"pixels within 1 of 255, {what}, all scenes, {geometry}", "%", lambda: percent(near, pixels),
             target=target, note=f"{what}, {geometry}: {pixels - near} of {pixels} pixels off" if pixels else None)


def add(plan, result):
    counts, precision, odd = [result[key] or [] for key in ("counts", "precision", "odd")]
    after_300 = [add_paths(plan, counts, method) for method in ("ours_solids", "ours_triangles", methods.CHECK)]
    for what, figure in after_300[:2]:
        plan.row("paths", what, "%", figure)
    for study, what in WRONG.items():
        def figure(study=study):
            these = known([each for each in counts if each["study"] == study and each["method"] in methods.OURS] or None)
            return [sum(methods.tally(these, wrong)[0] for wrong in (study, *["misplaced"] * (study == "crossings")))]
        plan.row(study, f"{what}, ours", "pixels" if study == "sums" else "count", figure, target=NONE)
    for what, target in ((pictures.FLOAT, NEAR), (pictures.FAST, None)):
        for geometry in pictures.GEOMETRIES:
            add_pictures(plan, precision, what, geometry, target)
    plan.row("odd", "pixels that are no numbers or infinite, all frames", "pixels",
             lambda: [sum(each["nan"] for each in known([*precision, *odd] or None))], target=NONE)
    plan.row("odd", "odd scenes that neither render nor are refused with a clear error", "scenes",
             lambda: [sum(not each["as_it_should"] for each in known(odd or None))], target=NONE)
