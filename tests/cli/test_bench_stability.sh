#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/study stability: what ours may never do, which it does not, and what plain methods do, which shows that
# the bench can see it; the pictures' arithmetic; a tiny run of all parts.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
bench=("$project/bench/study" stability)
tool=$(dirname "$hedron")/bench/hedron_stability_methods
if [[ ! -x $tool ]]; then
    skip "there is no $tool"
fi

# expect_value EXPECTED EXPRESSION: what Python makes of the result `r`; `wrong(study, case, method, key,
# place)` is what was counted, over all places or those of which `place` is true.
expect_value() {
    expect_python "$1" 'import json' 'from harness.stability import methods as m' \
        'r = json.load(open("out/stability.json", encoding="utf-8"))' \
        'def these(study, case, method, place=None): return m.select(r["counts"], study, case and [case], method, place)' \
        'def wrong(study, case, method, key, place=None): return sum(e[key] for e in these(study, case, method, place))' \
        'def tried(*which): return wrong(*which[:3], "tried", *which[3:])' \
        "print(json.dumps($2))"
}

# ---- PFM: both byte orders, what is near on the curve, what is no number
cat >pfm.py <<'PYTHON'
import math, struct
from harness.run import pfm
def write(name, numbers, order="<"):
    with open(name, "wb") as file:
        file.write(b"PF\n2 1\n%s1.0\n" % (b"-" if order == "<" else b""))
        file.write(struct.pack(f"{order}6f", *numbers))
    return pfm.read(name)
step = 1 / 255 / 12.92  # of the straight part of the curve
a = write("a", [0, 0, 0, 0.5, 2, 0.25])
print(a == write("b", [0, 0, 0, 0.5, 2, 0.25], ">"), a[:2])
print([pfm.near_pixels(a, write("c", [0.99 * step, 0, 0, 0.5, 9, 0.25])),
       pfm.near_pixels(a, write("d", [0, 0, 1.01 * step, 0.5, 9, 0.25])),
       pfm.near_pixels(a, write("e", [1, 1, 1, 0.5, 9, 0.25]), write("f", [0, 0, 0, 1, 1, 1]))])
odd = write("g", [0, math.nan, math.inf, 1, 1, -math.inf])
print(pfm.odd_numbers(a), pfm.odd_numbers(odd), pfm.near_pixels(a, odd))
PYTHON
expect_python "True (2, 1)
[2, 1, 2]
0 2 0" "$(cat pfm.py)"

# ---- what ours may never do is a failure
cat >never.py <<'PYTHON'
from harness.stability import methods as m
def text(wrong, lost, blocked):
    return (f"crossings edges pluecker 1 0 tried=9 missed=5 twice=5 wrong=8 misplaced=0\n"
            f"crossings edges ours_solids 1 0 tried=9 missed={wrong} twice=0 wrong={wrong} misplaced=0\n"
            f"paths inside ours_triangles 1 0 tried=9 completed={9 - lost} followed=5 tried_far=2 followed_far=1\n"
            f"shadows face_lights ours_double 1 0 tried=9 blocked=9 tried_shut=3 opened=0 nan=0\n"
            f"shadows edge_lights ours_double 1 0 tried=9 blocked={blocked} tried_shut=3 opened=0 nan=0\n"
            f"crossings t_junctions ours_triangles 1 0 tried=9 missed=1 twice=1 wrong=2 misplaced=0\n"
            f"shadows face_lights ours 1 0 tried=9 blocked={blocked} tried_shut=3 opened=0 nan=0\n")
counts = m.parse(text(0, 0, 0))
print(m.failures(counts), m.share(m.select(counts, "crossings", method="pluecker"), "crossings"),
      m.tally(m.select(counts, "paths"), "paths"), m.tally(m.select(counts, "shadows", method="ours_double"), "shadows"))
print(*m.failures(m.parse(text(1, 2, 3))), sep="\n")
PYTHON
expect_python "[] 0.8888888888888888 (4, 9) (9, 24)
crossings, edges, ours, half-spaces: 1 missed of 9
paths, inside, ours, triangles: 2 lost of 9
shadows, face_lights, ours: 3 blocked of 9
shadows, edge_lights, ours, in double: 3 blocked of 9" "$(cat never.py)"

# ---- odd scenes: what is to be rendered is, what is to be refused is, and nothing else ends otherwise
cat >odd.py <<'PYTHON'
from harness.stability.pictures import failures, outcome
from harness.stability.scenes import Odd
refused = {"code": 2, "said": "hedron: x.json: 2 problems\n  a is 1\n  b is 2\n"}
for wanted in (False, True):
    for runs in ([{"code": 0}] * 2, [refused] * 2, [{"code": 0}, {"code": 1, "message": "no room"}]):
        print(*outcome(Odd("a", {}, refused=wanted), runs), sep=", ")
print(failures([{"scene": "a", "geometry": "solids", "outcome": "rendered", "as_it_should": wanted, "nan": 3 * wanted}
                for wanted in (False, True)]))
PYTHON
expect_python "rendered, True
refused: a is 1 (2 problems), False
failed: no room, False
rendered, False
refused: a is 1 (2 problems), True
failed: no room, False
['a, solids: rendered', 'a, solids: 3 pixels are no numbers']" "$(cat odd.py)"

# ---- the table names tests that there are
ctest --test-dir "$(dirname "$hedron")" -N >tests.txt
cat >named.py <<'PYTHON'
import re
from harness.stability import table as t
there = re.findall(r"Test +#\d+: (\S+)", open("tests.txt").read())
said = " ".join([each[-1] for each in (*t.PLACES.values(), *t.MORE.values())])
named = set(re.findall(r"\b(?:unit|cli|conformance|leak_hunt)_[\w*]+", said))
print(len(named) > 5, [name for name in sorted(named)
                       if not any(each == name or each.startswith(name.rstrip("*")) and "*" in name for each in there)])
PYTHON
expect_python 'True []' "$(cat named.py)"

# ---- rays, paths, segments, sums and pixels
expect_exit 0 "${bench[@]}" --hedron "$hedron" --out out --parts crossings,paths,shadows,sums,touching --rays 200
expect_stdout_contains 'kept so by'
expect_value '[1, "stability", true, false, [], null, null]' \
    '[r[key] for key in ("hedron_bench", "bench", "complete", "quick", "failures", "precision", "odd")]'
expect_value '[2200, 2200, 2200, 2200]' \
    '[tried("crossings", case, method) for case, method in (("edges", "ours_solids"), ("corners", "ours_triangles"), ("slivers", "ours_triangles"), ("grazing", "pluecker"))]'
expect_value '[0, 0, 0, 0]' '[sum(wrong("crossings", None, method, key, lambda e: e["case"] != "t_junctions") for method in m.OURS) for key in ("missed", "twice", "wrong", "misplaced")]'
# A mesh with cracks has them for every method.
expect_value true 'all(wrong("crossings", "t_junctions", method, "missed") > 20 for method in ("ours_triangles", "watertight_tie", "moeller_trumbore_0"))'
# A determinant of less than 1e-6 is taken for none: what is small is not met.
expect_value true 'wrong("crossings", "interior", "moeller_trumbore_1e-6", "missed", lambda e: e["scale"] < 1e-3) > 390'
expect_value true 'wrong("crossings", "interior", "moeller_trumbore_0", "missed", m.is_at_origin) == 0'
expect_value true 'all(wrong("crossings", "edges", method, "wrong", m.is_at_origin) > 200 for method in ("moeller_trumbore_0", "baldwin_weber", "pluecker"))'
expect_value true 'wrong("crossings", "corners", "watertight", "twice", m.is_at_origin) > 50'
expect_value 0 'wrong("crossings", "corners", "watertight_tie", "wrong", m.is_at_origin)'
# World coordinates lose what is far away.
expect_value true 'wrong("crossings", "interior", "watertight_tie", "misplaced", lambda e: e["offset"] == 1e6) > 150'
# Paths: the target, and what an epsilon does.
expect_value '[14000, 0, 0]' '[tried("paths", None, "ours_solids"), wrong("paths", None, "ours_solids", "lost"), wrong("paths", None, "ours_triangles", "lost")]'
expect_value '[0, true, true]' '[wrong("paths", None, "ours_double", "strayed"), *(wrong("paths", None, method, "strayed", m.is_in_target) <= 0.01 * tried("paths", None, method, m.is_in_target) for method in ("ours_solids", "ours_triangles"))]'
expect_value true 'all(wrong("paths", None, method, "strayed", m.is_in_target) > 0.2 * tried("paths", None, method, m.is_in_target) for method in ("epsilon_1e-3", "epsilon_1e-4", "epsilon_4e-6", "waechter_binder"))'
expect_value true 'wrong("paths", None, "own_face", "lost", lambda e: e["offset"] == 1e6) > 0'
expect_value '[0, 0, 0]' '[wrong("shadows", None, "ours", key) for key in ("blocked", "opened", "nan")]'
expect_value true 'wrong("shadows", "edge_lights", "normalised", "blocked") > 200'
expect_value true 'wrong("shadows", "face_lights", "normalised_epsilon_1e-4", "opened", lambda e: e["scale"] == 1e-6) > 50'
expect_value 2200 'wrong("shadows", "light_at_the_point", "unnormalised", "nan")'
expect_value '[200, 0]' '[wrong("sums", "pixel", method, "differing") for method in ("float", "ours")]'
# Solids that touch: the usual methods see them rightly only with a gap between them; a plain tracer then has the product's picture.
expect_value '[0, 0, 0, 0]' '[*(wrong("touching", None, method, "off") for method in ("ours_solids", "ours_triangles", "ours_double")), wrong("touching", None, "own_face_with_gap", "off", lambda e: e["scale"] == 1 and e["offset"] == 0)]'
expect_value true 'all(wrong("touching", case, method, "off", m.is_at_origin) > 0.05 * tried("touching", case, method, m.is_at_origin) for case in ("on_the_floor", "stacked", "side_by_side", "doubled") for method in ("epsilon_1e-4", "relative_epsilon", "waechter_binder", "own_face", "moeller_trumbore_epsilon_1e-4"))'
expect_value '["100 %", "0 of 200"]' '[[row["rate"], row["ours"]] for row in r["table"] if row["method"] == "sums of floats"][0]'
if [[ ! -s out/stability.md ]]; then
    fail "there are no tables for documents"
fi
expect_svg out/stability_paths.svg
expect_svg out/stability_crossings.svg

# ---- pictures
mkdir scenes
cp "$project"/scenes/{octahedron,tunnel}.json scenes
expect_exit 0 "${bench[@]}" --hedron "$hedron" --out out --parts precision,odd --quick --scenes scenes -- --size 24x18 --depth 3
expect_value '[["octahedron", "solids", 432], ["octahedron", "triangles", 432], ["tunnel", "solids", 432], ["tunnel", "triangles", 432]]' \
    '[[e["scene"], e["geometry"], e["pixels"]] for e in r["precision"] if e["what"].startswith("float")]'
expect_value true 'all(e["near"] >= 0.99 * e["pixels"] and e["nan"] == 0 for e in r["precision"])'
expect_value '[[], 0, true]' '[r["failures"], sum(e["nan"] for e in r["odd"]), all(e["as_it_should"] for e in r["odd"])]'
expect_value '["colour_above_1", "light_of_1e30"]' 'sorted({e["scene"] for e in r["odd"] if e["outcome"].startswith("refused")})'
expect_value '["rendered"]' 'sorted({e["outcome"] for e in r["odd"] if not e["outcome"].startswith("refused: ")})'
# Wherever it is and however large, the scene looks the same; a pixel may be off in so small a picture.
expect_value true 'all(e["near"] >= 0.99 * e["pixels"] for e in r["odd"] if e["like"])'
# An eye or a light a hair to either side is one that stands exactly there.
expect_value true 'all(e["beside_near"] >= 0.98 * e["pixels"] for e in r["odd"] if e["geometry"] == "solids" and e["beside_near"] is not None)'
expect_value true 'sum(e["clamps"] for e in r["odd"] if e["scene"] == "light_of_1e12") > 0'

# ---- a hedron without the other program beside it
mkdir alone
printf '#!/bin/sh\nexec "%s" "$@"\n' "$hedron" >alone/hedron
chmod +x alone/hedron
expect_exit 1 "${bench[@]}" --hedron alone/hedron --out out --parts sums
expect_stdout_contains 'alone/bench/hedron_stability_methods: ./dev build builds it'

# ---- Ctrl-C leaves what was measured
interrupt_at_work "${bench[@]}" --hedron "$hedron" --out out
expect_stdout_contains Interrupted
expect_value false 'r["complete"]'

# ---- wrong usage
expect_exit 2 "$tool" wrong 1
expect_exit 2 "$tool" sums 0
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --parts wrong
expect_stderr_contains 'a part that is none of crossings'
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --rays 1.5
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out -- --precision double
expect_stderr_contains '--precision cannot stand after --'
expect_exit 2 "${bench[@]}" --hedron no/hedron --out out
finish
