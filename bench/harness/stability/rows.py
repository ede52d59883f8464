# SPDX-License-Identifier: MIT
"""The rows of bench/study stability that have targets."""
from harness.measure.rows import NONE, Missing, Target, known
from harness.stability import methods, pictures

PATHS, NEAR = Target(99, 99.99), Target(99.9, 99.99)


def percent(part, whole):
    if not whole:
        raise Missing("it was not measured")
    return [100 * part / whole]


def in_target(counts, method):
    return methods.select(counts, "paths", method=method, place=methods.is_in_target)


def followed(counts, method, far=False):
    """(those that followed, all), where the target holds"""
    strayed, tried = methods.tally(in_target(counts, method), "far" if far else "paths")
    return tried - strayed, tried


def worst_place(counts, method):
    found = methods.worst(in_target(counts, method), "paths")
    if found is None:
        return None
    share, each = found
    strayed, tried = methods.tally(in_target(counts, method), "paths")
    return (f"{methods.NAMES[method]}: {strayed} of {tried} paths stray; least at one place {100 - 100 * share:.2f} % of "
            f"{each['tried']} ({each['case']}, scale {each['scale']:g}, offset {each['offset']:g})")


def add_paths(plan, counts):
    for method in ("ours_solids", "ours_triangles", methods.CHECK):
        plan.row("paths", f"paths that follow the double path after 30 bounces, {methods.NAMES[method]}", "%",
                 lambda method=method: percent(*followed(counts, method)),
                 target=None if method == methods.CHECK else PATHS, note=worst_place(counts, method))
    for method in ("ours_solids", "ours_triangles"):
        plan.row("paths", f"  after 300 bounces, {methods.NAMES[method]}", "%",
                 lambda method=method: percent(*followed(counts, method, True)))


def add_wrong(plan, counts):
    words = {"crossings": "rays that miss, count twice or are misplaced", "shadows": "segments wrongly blocked or opened",
             "sums": "pixels whose sum depends on the order"}
    for study, what in words.items():
        def figure(study=study):
            these = known([each for each in counts if each["study"] == study and each["method"] in methods.OURS] or None)
            wrong = methods.tally(these, study)[0]
            return [wrong + (methods.tally(these, "misplaced")[0] if study == "crossings" else 0)]
        plan.row(study, f"{what}, ours", study == "sums" and "pixels" or "count", figure, target=NONE)


def add_pictures(plan, entries):
    for what, target in ((pictures.FLOAT, NEAR), (pictures.FAST, None)):
        for geometry in pictures.GEOMETRIES:
            plan.row("precision", f"pixels within 1 of 255, {what}, all scenes, {geometry}", "%",
                     lambda what=what, geometry=geometry: percent(*pictures.total(entries, what, geometry)),
                     target=target, note=off_words(entries, what, geometry))


def off_words(entries, what, geometry):
    near, pixels = pictures.total(entries, what, geometry)
    return f"{what}, {geometry}: {pixels - near} of {pixels} pixels off" if pixels else None


def add_odd(plan, precision, odd):
    frames = [*(precision or []), *(odd or [])] or None
    plan.row("odd", "pixels that are no numbers or infinite, all frames", "pixels",
             lambda: [sum(each["nan"] for each in known(frames))], target=NONE)
    plan.row("odd", "odd scenes that neither render nor are refused with a clear error", "scenes",
             lambda: [sum(not each["as_it_should"] for each in known(odd or None))], target=NONE)


def add(plan, result):
    counts = result["counts"] or []
    add_paths(plan, counts)
    add_wrong(plan, counts)
    add_pictures(plan, result["precision"] or [])
    add_odd(plan, result["precision"], result["odd"])
