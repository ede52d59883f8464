#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/study stability: hedron never fails as it must not, and plain methods fail, which shows that the bench can detect it;
# pictures and odd scenes.
set -euo pipefail
# shellcheck source=bench_lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/bench_lib.sh"

tool=$(dirname "$hedron")/bench/hedron_stability_methods
[[ -x $tool ]] || skip "there is no $tool"

# expect_counts EXPECTED STATEMENT...: `wrong(study, case, method, key, place)` is the share of failures, over all places or
# those for which `place` is true.
expect_counts() {
    local expected=$1
    shift
    expect_python "$expected" 'import json, re' 'from harness.stability import methods as m' \
        'r = json.load(open("out/stability.json", encoding="utf-8"))' \
        'def total(these, key): return sum(each[key] for each in these)
def wrong(study, case, method, key, place=None):
    these = m.select(r["counts"], study, case and [case], method, place)
    return total(these, key) / total(these, "tried")' "$@"
}

# ---- rays, paths and segments
expect_exit 0 "$bench" stability --hedron "$hedron" --out out --parts crossings,paths,shadows --rays 60
expect_stdout_contains 'tested by'
expect_counts '["stability", true, [], true]' \
    'print(json.dumps([r["bench"], r["complete"], r["failures"], len(r["table"]) > 20]))'
# Hedron is never wrong except at the cracks of a mesh, which exist for every method; and for paths in places without a target.
expect_counts 0.0 'print(sum(wrong("crossings", None, method, key, lambda e: e["case"] not in m.CRACKS) for method in ("ours_solids", "ours_triangles") for key in ("missed", "twice", "wrong", "misplaced"))
    + sum(wrong("paths", None, method, "lost") for method in ("ours_solids", "ours_triangles")) + wrong("paths", None, "ours_double", "strayed")
    + sum(wrong("shadows", None, "ours", key) for key in ("blocked", "opened", "nan")))'
expect_counts True 'print(all(wrong("paths", None, method, "strayed", m.is_in_target) <= 0.01 for method in ("ours_solids", "ours_triangles")))'
# Failures of others: small triangles by a determinant below 1e-6, edges and corners, distant things by world coordinates.
# Paths and shadows fail by an epsilon, lights on edges; and there are cases without failures.
expect_counts '[]' 'some = [("crossings", "t_junctions", "ours_triangles", "missed", None, 0.001),
    ("crossings", "interior", "moeller_trumbore_1e-6", "missed", lambda e: e["scale"] < 1e-3, 0.95),
    ("crossings", "corners", "watertight", "twice", m.is_at_origin, 0.02),
    ("crossings", "interior", "watertight_tie", "misplaced", lambda e: e["offset"] == 1e6, 0.2),
    ("shadows", "edge_lights", "normalised", "blocked", None, 0.05),
    ("shadows", "face_lights", "normalised_epsilon_1e-4", "opened", lambda e: e["scale"] == 1e-6, 0.1),
    ("shadows", "light_at_the_point", "unnormalised", "nan", None, 0.99)]' \
    'some += [("paths", None, "epsilon_1e-4", "strayed", m.is_in_target, 0.2), ("crossings", "edges", "pluecker", "wrong", m.is_at_origin, 0.05)]' \
    'none = [("crossings", "interior", "moeller_trumbore_0", "missed", m.is_at_origin), ("crossings", "corners", "watertight_tie", "wrong", m.is_at_origin)]' \
    'print([(*each[:4], wrong(*each[:5])) for each in some if wrong(*each[:5]) <= each[5]] + [each[:4] for each in none if wrong(*each)])'
expect_svg out/stability_paths.svg out/stability_crossings.svg
# The table names existing tests.
ctest --test-dir "$(dirname "$hedron")" -N >tests.txt
expect_counts 'True []' 'from harness.stability import table as t' 'there = re.findall(r"Test +#\d+: (\S+)", open("tests.txt").read())' \
    'named = set(re.findall(r"\b(?:unit|cli|conformance|leak_hunt)_\w+", " ".join(each[-1] for each in (*t.PLACES.values(), *t.MORE.values()))))' \
    'print(len(named) > 5, sorted(named - set(there)))'

# ---- pictures: a scene looks the same at any place and size; one pixel may be off in so small a picture
mkdir scenes
cp "$project/scenes/octahedron.json" scenes
expect_exit 0 "$bench" stability --hedron "$hedron" --out out --parts precision,odd --quick --scenes scenes -- --size 16x12 --depth 3
expect_counts '[["octahedron", "solids"], ["octahedron", "triangles"]]' \
    'print(json.dumps([[e["scene"], e["geometry"]] for e in r["precision"] if e["what"].startswith("float") and e["near"] >= 0.98 * e["pixels"] and e["nan"] == 0]))'
expect_counts "[[], ['colour_above_1', 'light_of_1e30'], []]" 'refused = sorted({e["scene"] for e in r["odd"] if e["outcome"].startswith("refused: ")})' \
    'print([r["failures"], refused, [e["scene"] for e in r["odd"] if e["nan"] or not e["as_it_should"] or e["outcome"][:7] not in ("rendere", "refused")
    or (e["like"] and e["near"] < 0.98 * e["pixels"]) or (e["geometry"] == "solids" and e["beside_near"] is not None and e["beside_near"] < 0.98 * e["pixels"])
    or (e["scene"] == "light_of_1e12" and not e["clamps"])]])'
finish
