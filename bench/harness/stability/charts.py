# SPDX-License-Identifier: MIT
"""The charts of bench/study stability: shares of failures against the scale and against the offset."""
import math

from harness.chart import gnuplot
from harness.chart.gnuplot import quoted
from harness.stability import methods, pictures

MARKS = 15
AT_ORIGIN = 0.1  # where an offset of 0 stands on a logarithmic axis
EDGES = ("edges", "corners")


def line(counts, study, cases, what, method, place, key):
    """[(x, share of failures)], the cases of a place together."""
    values = {}
    for each in methods.select(counts, study, cases, method, place):
        values.setdefault(each[key], []).append(each)
    return [(x, methods.share(these, what)) for x, these in sorted(values.items())]


def lines(counts, study, cases, what):
    """{method: (against the scale, against the offset)}"""
    return {method: (line(counts, study, cases, what, method, methods.is_at_origin, "scale"),
                     line(counts, study, cases, what, method, methods.is_unit_scale, "offset"))
            for method in methods.methods(counts, study)}


def least_share(found):
    """Below all that was seen: what did not fail at all is drawn there, between two powers of ten, whose names have room."""
    shares = [y for both in found.values() for points in both for _, y in points if y]
    return 10.0 ** math.floor(math.log10(min(shares, default=1e-3))) / 3


def data(name, points, floor):
    return gnuplot.data(name, (f"{x or AT_ORIGIN!r} {max(y or 0, floor)!r}" for x, y in points))


def style_of(method, place):
    ours = method in methods.OURS
    plain_colours = len(gnuplot.COLOURS) - 1  # black is for ours
    colour = "#000000" if ours else gnuplot.COLOURS[place % plain_colours]
    dashed = method == "ours_triangles" if ours else place >= plain_colours
    return (f"linewidth {4 if ours else 2} dashtype {2 if dashed else 1} pointtype {place % MARKS + 4} "
            f"linecolor rgb '{colour}'")


def panel(found, side, label, ticks):
    plots = [f"${side}{place} using 1:2 with linespoints {style_of(method, place)} notitle"
             for place, method in enumerate(found)]
    return [f"set xlabel {quoted(label)}", f"set xtics nomirror out ({ticks})", "plot " + ", ".join(plots)]


def legend(found, rows):
    """A plot of nothing, as wide as the picture, for its key alone."""
    plots = [f"NaN with linespoints {style_of(method, place)} title {quoted(methods.NAMES[method])}"
             for place, method in enumerate(found)]
    return [
        "set lmargin screen 0.03", "set rmargin screen 0.97", "set xrange [1:2]", "unset border", "unset tics",
        f"set key at graph 0.5, graph 1.03 center bottom vertical maxrows {rows} Left reverse noenhanced samplen 3",
        "plot " + ", ".join(plots),
        "unset label 1", "unset label 2", "unset key", "set border 3",
    ]


def panels(result, found, title, caption, ylabel):
    """(height, commands): two plots beside each other under one legend."""
    floor, rows = least_share(found), (len(found) + 2) // 3
    commands = gnuplot.style(result, title, caption + " What was not seen to fail is on the lowest line.", rows)
    for place, both in enumerate(found.values()):
        commands += data(f"scale{place}", both[0], floor) + data(f"offset{place}", both[1], floor)
    scales = sorted({x for both in found.values() for x, _ in both[0]})
    offsets = sorted({x for both in found.values() for x, _ in both[1]})
    commands += [
        "set logscale xy",
        f"set yrange [{floor / 1.5!r}:1.5]",
        "set format y '%g'",
        "set multiplot",
        *legend(found, rows),
        f"set ytics nomirror out add ('none' {floor!r})",
        "set lmargin screen 0.1", "set rmargin screen 0.52",
        f"set ylabel {quoted(ylabel)}",
        f"set xrange [{scales[0] / 3!r}:{scales[-1] * 3!r}]",
        *panel(found, "scale", "size of things, at the origin", ticks_of(scales)),
        "unset ylabel",
        "set lmargin screen 0.6", "set rmargin screen 0.97",
        f"set xrange [{AT_ORIGIN / 2!r}:{offsets[-1] * 3!r}]",
        *panel(found, "offset", "distance from the origin, in sizes", ticks_of(offsets)),
        "unset multiplot",
    ]
    return 560 + 24 * rows, commands


def ticks_of(values):
    return ", ".join(f"'{x:g}' {x or AT_ORIGIN!r}" for x in values)


def most(found, side, method):
    return max((y for _, y in found[method][side] if y is not None), default=0) if method in found else 0


def words_of(found, methods_told):
    """How often they fail at most, those that never do last."""
    shares = {method: max(most(found, 0, method), most(found, 1, method)) for method in methods_told if method in found}
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


def panel_chart(result, study, cases, what, title, caption, told, axis):
    found = lines(result["counts"], study, cases, what)
    return panels(result, found, title, f"{caption}{words_of(found, told)}.", axis)


def precision(result):
    """(height, commands): pixels that are off, for each scene."""
    entries = result["precision"]
    scenes = list(dict.fromkeys(each["scene"] for each in entries))
    kinds = [(what, geometry) for what in (pictures.FLOAT, pictures.FAST) for geometry in pictures.GEOMETRIES]
    shares = {kind: [1 - pictures.share([each]) for each in entries if (each["what"], each["geometry"]) == kind]
              for kind in kinds}
    floor = min([y for each in shares.values() for y in each if y > 0], default=1e-4) / 3
    near, pixels = pictures.total(entries, pictures.FLOAT)
    caption = (f"Share of pixels that are off by more than 1 of 255 on the sRGB curve; in all {100 * near / pixels:.3f} % of "
               "those in float are within it of those in double. A scene without a bar had none.")
    commands = gnuplot.style(result, "Float against double, fast against strict", caption, 2)
    commands += [
        "set style data histograms", "set style histogram clustered gap 1", "set style fill solid 0.85 noborder",
        "set logscale y", f"set yrange [{floor!r}:1]", "set format y '%g'", "set ylabel 'share of pixels (logarithmic)'",
        "set xtics rotate by -20 noenhanced",
        "set key at graph 0.5, graph 1.03 center bottom vertical maxrows 2 Left reverse noenhanced",
        *gnuplot.data("data", (f"{gnuplot.plain(scene, 30).replace(' ', '_')} "
                               + gnuplot.numbers(*(max(shares[kind][place], floor) for kind in kinds))
                               for place, scene in enumerate(scenes))),
        "plot " + ", ".join(f"$data using {place + 2}:xtic(1) linecolor rgb '{gnuplot.colour(place)}' "
                            f"title {quoted(f'{what}, {geometry}')}" for place, (what, geometry) in enumerate(kinds)),
    ]
    return 600, commands


def charts(result):
    """{name: (height, commands)}"""
    studies = {each["study"] for each in result["counts"] or []}
    found = {name: panel_chart(result, *panel) for name, panel in PANELS.items() if panel[0] in studies}
    if result["precision"]:
        found["stability_precision"] = precision(result)
    return found
