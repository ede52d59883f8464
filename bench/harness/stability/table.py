# SPDX-License-Identifier: MIT
"""The table of failure modes: each method at each place, hedron's, and the tests of it."""
from harness.stability import methods, pictures

HEAD = ["place", "method", "fails", "worst", "where", "hedron", "tested by"]

HERE = "cli_bench_stability"
MESHES = "unit_kernels, leak_hunt_c, leak_hunt_opencl, leak_hunt_cuda"
SOLIDS = "conformance_c (edges-and-corners; faces crossed in pairs)"
# study, case: the reason, and the tests that keep hedron correct there
PLACES = {
    ("crossings", "edges"): ("rays at edges miss or count twice", f"{MESHES}, {SOLIDS}"),
    ("crossings", "corners"): ("rays at corners miss or count twice", f"{MESHES}, {SOLIDS}"),
    ("crossings", "interior"): ("rays at the middle of triangles miss or count twice", f"{HERE}, leak_hunt_c"),
    ("crossings", "grazing"): ("grazing rays miss or count twice", HERE),
    ("crossings", "axis_parallel"): ("axis-parallel rays miss or count twice", f"unit_kernels, {HERE}"),
    ("crossings", "slivers"): ("rays at slivers miss or count twice", HERE),
    ("crossings", "zero_area"): ("triangles without an area", f"unit_mesh, {HERE}"),
    ("crossings", "duplicates"): ("coplanar duplicates are not met as one", HERE),
    ("crossings", "t_junctions"): ("rays at T-junctions pass through or count twice", "none: the mesh has cracks"),
    ("paths", "inside"): ("mirror paths in a solid leave the double path within 30 bounces", HERE),
    ("paths", "between"): ("mirror paths between solids leave the double path within 30 bounces", HERE),
    ("shadows", "edge_lights"): ("lights on edges are blocked, or shine through", f"conformance_c (own edge lights), {HERE}"),
    ("shadows", "edge_lights_from_within"): ("lights on edges, seen from inside, are blocked", HERE),
    ("shadows", "face_lights"): ("lights on faces are blocked, or shine through", HERE),
    ("shadows", "light_at_the_point"): ("a light at the lit point gives no number", HERE),
}
# Further failures at the same places.
MORE = {
    "misplaced": ("crossings", ("edges", "corners", "interior"), "hits are off by more than 1/1000 of the size",
                  f"conformance_c (far-from-origin), {HERE}"),
    "lost": ("paths", ("inside", "between"), "mirror paths get out of a closed room", f"conformance_c (mirror box), {HERE}"),
    "far": ("paths", ("inside", "between"), "mirror paths leave the double path within 300 bounces",
            "none: not promised"),
}


def percent(share):
    if share is None:
        return "-"
    if share == 0:
        return "0"
    return f"{100 * share:.3g} %" if share >= 1e-4 else f"{100 * share:.1e} %"


def ours_words(counts, study, cases, what):
    said = []
    for method in methods.OURS:
        these = methods.select(counts, study, cases, method)
        if these:
            wrong, tried = methods.tally(these, what)
            name = methods.NAMES[method].removeprefix("hedron").removeprefix("'s ")
            said.append(f"{name + ' ' if name else ''}{wrong} of {tried}" + (f" ({percent(wrong / tried)})" if wrong else ""))
    return "; ".join(said) or "-"


def method_rows(counts, study, cases, what, words, test):
    for method in [*methods.methods(counts, study), methods.CHECK]:
        these = methods.select(counts, study, cases, method)
        found = methods.worst(these, what)
        if method in methods.OURS or found is None:
            continue
        share, each = found
        yield [words, methods.NAMES[method], percent(methods.share(these, what)), percent(share),
               f"scale {each['scale']:g}, offset {each['offset']:g}" if share else "", ours_words(counts, study, cases, what), test]


def picture_rows(entries):
    entries = [each for each in entries if each["what"] == pictures.FLOAT]
    if not entries:
        return
    found = min(entries, key=lambda each: pictures.share([each]))
    worst = 1 - pictures.share([found])
    yield [f"pixels off by more than 1 of 255, {pictures.FLOAT}, shipped scenes", "float", percent(1 - pictures.share(entries)),
           percent(worst), f"{found['scene']}, {found['geometry']}" if worst else "",
           f"float by default, --precision double; {sum(each['nan'] for each in entries)} NaN", HERE]


def scene_rows(entries):
    for each in (each for each in entries if not each["like"]):
        yield scene_row(each["scene"], [each])
    moved = [each for each in entries if each["like"]]
    for geometry in dict.fromkeys(each["geometry"] for each in moved):
        for name, is_rendered in (("the default scene at every scale and offset", True), ("the same beyond 1e12", False)):
            these = [each for each in moved if each["geometry"] == geometry and (each["outcome"] == "rendered") is is_rendered]
            if these:
                yield scene_row(name, these)


def scene_row(name, entries):
    worst = min(entries, key=lambda each: pictures.share([each]) or 0)
    off = [None if share is None else 1 - share for share in (pictures.share(entries), pictures.share([worst]))]
    said = "rendered" if any(each["outcome"] == "rendered" for each in entries) else worst["outcome"]
    if worst["beside_near"] is not None:
        said += f"; off both pictures with it a hair to either side: {percent(1 - worst['beside_near'] / worst['pixels'])}"
    return [f"{name.replace('_', ' ')}, {worst['geometry']}", "float against double", *map(percent, off),
            worst["scene"] if off[1] and len(entries) > 1 else "",
            f"{said}; {sum(each['nan'] for each in entries)} NaN, {sum(each['clamps'] for each in entries)} clamps", HERE]


def rows(result):
    places = [(study, [case], study, *said) for (study, case), said in PLACES.items()]
    places += [(study, cases, what, *said) for what, (study, cases, *said) in MORE.items()]
    found = [row for place in places for row in method_rows(result["counts"] or [], *place)]
    found += [*picture_rows(result["precision"] or []), *scene_rows(result["odd"] or [])]
    return [dict(zip(("place", "method", "rate", "worst", "where", "ours", "test"), row)) for row in found]
