# SPDX-License-Identifier: MIT
"""The charts of bench/study stability: shares of failures against the scale and against the offset."""
import math

from harness.chart.gnuplot import COLOURS, Chart, colour, plain, quoted
from harness.stability import methods, pictures

MARKS = 15
AT_ORIGIN = 0.1  # where an offset of 0 stands on a logarithmic axis
EDGES = ("edges", "corners")


def line(counts, what, key):
    """[(x, share of failures)], the cases of a place together; without shares where nothing was tried."""
    values = {}
    for each in counts:
        values.setdefault(each[key], []).append(each)
    return [(x, methods.share(these, what)) for x, these in sorted(values.items())]


def lines(counts, study, cases, what):
    """{method: (against the scale, against the offset)}"""
    return {method: (line(methods.select(counts, study, cases, method, methods.is_at_origin), what, "scale"),
                     line(methods.select(counts, study, cases, method, lambda each: each["scale"] == 1), what, "offset"))
            for method in methods.methods(counts, study)}


def styles(found):
    """{method: how its line looks}; black is for ours."""
    looks, plain_colours = {}, len(COLOURS) - 1
    for place, method in enumerate(found):
        ours = method in methods.OURS
        dashed = method == "ours_triangles" if ours else place >= plain_colours
        looks[method] = (f"linewidth {4 if ours else 2} dashtype {2 if dashed else 1} pointtype {place % MARKS + 4} "
                         f"linecolor rgb '{'#000000' if ours else COLOURS[place % plain_colours]}'")
    return looks


def panels(result, study, cases, what, title, words, told, ylabel):
    """A chart: two plots beside each other under one legend."""
    found = lines(result["counts"], study, cases, what)
    # Below all that was seen: what did not fail at all is drawn there, between two powers of ten, whose names have room.
    floor = 10.0 ** math.floor(math.log10(min((y for both in found.values() for points in both for _, y in points if y),
                                              default=1e-3))) / 3
    rows, looks = (len(found) + 2) // 3, styles(found)
    chart = Chart(result, title, f"{words}{words_of(found, told)}. What was not seen to fail is on the lowest line.", rows)
    sides = ("scale", "offset")
    for place, both in enumerate(found.values()):
        for side, points in zip(sides, both):
            chart.data(f"{side}{place}", ((x or AT_ORIGIN, max(y or 0, floor)) for x, y in points))
    places = [sorted({x for both in found.values() for x, _ in both[side]}) for side in (0, 1)]
    chart.add("set logscale xy", f"set yrange [{floor / 1.5!r}:1.5]", "set format y '%g'", "set multiplot")
    # The legend is a plot of nothing, as wide as the picture.
    chart.add("set lmargin screen 0.03", "set rmargin screen 0.97", "set xrange [1:2]", "unset border", "unset tics")
    chart.legend(rows, " samplen 3")
    for method, look in looks.items():
        chart.plot(f"NaN with linespoints {look} title {quoted(methods.NAMES[method])}")
    chart.flush()
    chart.add("unset label 1", "unset label 2", "unset key", "set border 3",
              f"set ytics nomirror out add ('none' {floor!r})", f"set ylabel {quoted(ylabel)}")
    for side, at, margins, low, label in (
            ("scale", places[0], (0.1, 0.52), places[0][0] / 3, "size of things, at the origin"),
            ("offset", places[1], (0.6, 0.97), AT_ORIGIN / 2, "distance from the origin, in sizes")):
        ticks = ", ".join(f"'{x:g}' {x or AT_ORIGIN!r}" for x in at)
        chart.add(*(f"set {edge}margin screen {margin}" for edge, margin in zip("lr", margins)),
                  f"set xrange [{low!r}:{at[-1] * 3!r}]", f"set xlabel {quoted(label)}", f"set xtics nomirror out ({ticks})")
        for place, look in enumerate(looks.values()):
            chart.plot(f"${side}{place} using 1:2 with linespoints {look} notitle")
        chart.flush()
        chart.add("unset ylabel")
    chart.add("unset multiplot")
    return chart.finished(560 + 24 * rows)


def words_of(found, methods_told):
    """How often they fail at most, those that never do last."""
    shares = {method: max((y for points in found[method] for _, y in points if y is not None), default=0)
              for method in methods_told if method in found}
    said = [f"{methods.NAMES[method]} up to {100 * share:.3g} %" for method, share in shares.items() if share]
    return "; ".join(said + [f"{methods.NAMES[method]} never" for method, share in shares.items() if not share])


# What each chart is made of: study, cases, what counts as wrong, title, start of the caption, methods that it tells of, axis.
PANELS = {
    "stability_crossings": (
        "crossings", EDGES, "crossings", "Rays at edges and corners of closed solids",
        "Share of rays aimed at edges and corners that miss a triangle or meet one twice: ",
        ("moeller_trumbore_0", "watertight", "ours_solids", "ours_triangles"), "share of rays (logarithmic)"),
    "stability_misplaced": (
        "crossings", ("interior",), "misplaced", "Hits at a wrong distance",
        "Share of rays whose hit is off by more than a thousandth of the solid's size. World coordinates in float "
        "lose what lies far away, whatever the test; ours are relative", (), "share of rays (logarithmic)"),
    "stability_paths": (
        "paths", None, "paths", "Mirror paths that leave the double path within 30 bounces",
        "Share of mirror paths, inside of solids and between them, that meet other faces than the path in double: ",
        ("epsilon_1e-3", "waechter_binder", "own_face", "ours_solids", "ours_triangles"), "share of paths (logarithmic)"),
    "stability_shadows": (
        "shadows", ("edge_lights", "edge_lights_from_within", "face_lights"), "shadows",
        "Shadow segments to lights on the surface",
        "Share of segments to lights on edges and faces that are wrongly blocked, or wrongly open: ",
        ("normalised", "normalised_epsilon_1e-4", "ours"), "share of segments (logarithmic)"),
}


def precision(result):
    """A chart: pixels that are off, for each scene."""
    entries = [each for each in result["precision"] if each["what"] == pictures.FLOAT]
    scenes = list(dict.fromkeys(each["scene"] for each in entries))
    shares = {geometry: [1 - pictures.share([each]) for each in entries if each["geometry"] == geometry]
              for geometry in pictures.GEOMETRIES}
    floor = min([y for each in shares.values() for y in each if y > 0], default=1e-4) / 3
    near, pixels = pictures.total(entries, pictures.FLOAT)
    chart = Chart(result, "Float against double",
                  f"Share of pixels that are off by more than 1 of 255 on the sRGB curve; in all {100 * near / pixels:.3f} % of "
                  "those in float are within it of those in double. A scene without a bar had none.", 2)
    chart.add("set style data histograms", "set style histogram clustered gap 1", "set style fill solid 0.85 noborder",
              "set logscale y", f"set yrange [{floor!r}:1]", "set format y '%g'", "set ylabel 'share of pixels (logarithmic)'",
              "set xtics rotate by -20 noenhanced")
    chart.legend(2)
    chart.data("data", ((plain(scene, 30).replace(" ", "_"), *(max(each[place], floor) for each in shares.values()))
                        for place, scene in enumerate(scenes)))
    for place, geometry in enumerate(shares):
        chart.plot(f"$data using {place + 2}:xtic(1) linecolor rgb '{colour(place)}' title {quoted(geometry)}")
    return chart.finished(600)


def charts(result):
    """{name: chart}"""
    studies = {each["study"] for each in result["counts"] or []}
    found = {name: panels(result, *panel) for name, panel in PANELS.items() if panel[0] in studies}
    if result["precision"]:
        found["stability_precision"] = precision(result)
    return found
