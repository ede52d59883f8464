# SPDX-License-Identifier: MIT
"""The charts of bench/study stability: failures of methods by the size of things and by their distance."""
import math

from harness.chart.dots import Block, Dots, dots
from harness.chart.rows import Row, one_value, rows
from harness.stability import methods, pictures

EDGES = ("edges", "corners")


def power(value):
    """Returns a power of ten, short enough for many columns."""
    exponents = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"
    if value in (0, 1):
        return f"{value:g}"
    exponent = round(math.log10(value))
    return "10" + "\u207b" * (exponent < 0) + "".join(exponents[int(digit)] for digit in str(abs(exponent)))


def shares(counts, what, key, places):
    """Returns shares of failures at each place, all cases together; None if nothing was tried."""
    return [methods.share([each for each in counts if each[key] == place], what) for place in places]


def places_of(counts, key):
    return sorted({each[key] for each in counts})


def blocks(result, study, cases, what, title, words, named):
    """Returns a chart: a row for each method, columns for sizes at the origin and for distances at size 1."""
    counts = methods.select(result["counts"], study, cases)
    sides = [("scale", [each for each in counts if methods.is_at_origin(each)]),
             ("offset", [each for each in counts if each["scale"] == 1])]
    places = [places_of(these, key) for key, these in sides]
    drawn = []
    for method in methods.methods(counts, study):
        found = [shares(methods.select(these, study, method=method), what, key, at) for (key, these), at in zip(sides, places)]
        drawn.append(Dots(methods.NAMES[method], found, method in methods.OURS))
    names = [list(map(power, at)) for at in places]
    return dots(result, title, f"{words_of(result['counts'], study, cases, what, named)} {words}".strip(),
                [Block("size of things, at the origin", names[0]), Block("distance from the origin, in sizes", names[1])], drawn)


def words_of(counts, study, cases, what, named):
    """Returns sentences: which methods never fail, and how often others do at their worst place."""
    worst = {method: methods.worst(methods.select(counts, study, cases, method), what) for method in named}
    never = [methods.NAMES[method] for method, found in worst.items() if found and not found[0]]
    most = [f"{100 * found[0]:.3g} % with {methods.NAMES[method]}" for method, found in worst.items() if found and found[0]]
    said = [f"No failures occur with {' and '.join(never)}."] * bool(never) + [f"Failures reach {'; '.join(most)}."] * bool(most)
    return " ".join(said)


# For each chart: study, cases, failure, title, end of the caption, methods that the caption names.
PANELS = {
    "stability_crossings": (
        "crossings", EDGES, "crossings", "Rays at edges and corners of closed solids",
        "Dots show the share of rays aimed at edges and corners that miss a triangle or meet one twice.",
        ("moeller_trumbore_0", "watertight", "ours_solids", "ours_triangles")),
    "stability_misplaced": (
        "crossings", ("interior",), "misplaced", "Hits at a wrong distance",
        "World coordinates in float lose what lies far away, whatever the test; hedron's coordinates are relative. "
        "Dots show the share of rays whose hit is off by more than a thousandth of the solid's size.", ()),
    "stability_paths": (
        "paths", None, "paths", "Mirror paths that leave the double path within 30 bounces",
        "Dots show the share of mirror paths, inside and between solids, that meet other faces than the path in double.",
        ("epsilon_1e-3", "waechter_binder", "own_face", "ours_solids", "ours_triangles")),
    "stability_shadows": (
        "shadows", ("edge_lights", "edge_lights_from_within", "face_lights"), "shadows",
        "Shadow segments to lights on the surface",
        "Dots show the share of segments to lights on edges and faces that are wrongly blocked or wrongly open.",
        ("normalised", "normalised_epsilon_1e-4", "ours")),
}


def precision(result):
    """Returns a chart of the pixels that differ, for each scene."""
    entries = [each for each in result["precision"] if each["what"] == pictures.FLOAT]
    near, pixels = pictures.total(entries, pictures.FLOAT)
    order = {scene: 1 - pictures.share([each for each in entries if each["scene"] == scene])
             for scene in dict.fromkeys(each["scene"] for each in entries)}
    shown = [scene for scene in sorted(order, key=order.get, reverse=True) if order[scene] > 0 or not any(order.values())]
    others = len(order) - len(shown)
    drawn = [Row(each["scene"], one_value(1 - pictures.share([each])), colour="ink", variant=each["geometry"])
             for scene in shown for each in entries if each["scene"] == scene]
    return rows(result, "Float against double", f"{100 * near / pixels:.3f} % of all pixels in float are within 1 of 255 of those in double, "
                "on the sRGB curve. Dots show the share of others" + (f"; {others} more scenes have none." if others else "."),
                "share of pixels", drawn)


def charts(result):
    """Returns {name: chart}."""
    studies = {each["study"] for each in result["counts"] or []}
    found = {name: blocks(result, *panel) for name, panel in PANELS.items() if panel[0] in studies}
    if result["precision"]:
        found["stability_precision"] = precision(result)
    return found
