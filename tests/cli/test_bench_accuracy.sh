#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/study accuracy: its arithmetic on made-up numbers, and a tiny run.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
bench=("$project/bench/study" accuracy)

# expect_value EXPECTED EXPRESSION: what Python makes of the result `r`, its rows by key and its points by name.
expect_value() {
    expect_python "$1" 'import json' 'r = json.load(open("out/accuracy.json", encoding="utf-8"))' \
        'rows = {row["key"]: row for row in reversed(r["rows"])}' \
        'points = {point["name"]: point for point in r["points"] or []}' "print(json.dumps($2))"
}

# ---- the front: nothing slower that is no better; times at equal error on straight lines of the logarithms
cat >front.py <<'PYTHON'
from harness.accuracy.front import cheapest, front, ratios, time_at
def made(*pairs):
    return [{"name": f"{ms}", "ms": ms, "rmse": error} for ms, error in pairs]
some = made((100, 1), (1, 100), (2, 100), (50, 200), (10, 30), (10, 10))
print([each["name"] for each in front(some)])
print([time_at(some, "rmse", error) for error in (200, 100, 10, 1, 0.5)], round(time_at(some, "rmse", 10 ** 0.5), 3))
print([(error, round(ratio, 4)) for error, ratio in ratios(some, made((1000, 0.5), (500, 10 ** 0.5), (20, 200), (30, 300)))])
print(cheapest(some, 30)["name"], cheapest(some, 0.1), time_at([], "rmse", 1), ratios([], some))
PYTHON
expect_python "['1', '10', '100']
[1, 1, 10.0, 100.0, None] 31.623
[(200, 0.05), (3.1622776601683795, 0.0632)]
10 None None []" "$(cat front.py)"

# ---- what is recommended: the fastest of those as good as the grid; what hedron chooses by itself is none
cat >recommend.py <<'PYTHON'
from harness.accuracy.points import equal_error, recommend
def point(family, name, ms, error):
    return {"device": "c:0", "family": family, "name": name, "ms": ms, "rmse": error, "recommended": None}
points = [point("grid", "grid 2", 4, 20), point("grid", "grid 4", 16, 10), point("deep", "deep 3", 5, 9.9),
          point("adaptive", "adaptive 2", 3, 20), point("arithmetic", "fast", 1, 1), point("full", "full 3", 50, 9.9)]
recommend(points)
print([(each["name"], each["recommended"]) for each in points if each["recommended"]])
print(equal_error(points, "c:0"), equal_error(points, "c:1"), equal_error(points, "c:0", ("adaptive",), "grid"))
PYTHON
expect_python "[('deep 3', 'usual'), ('adaptive 2', 'draft')]
[(9.9, 0.1)] [] [(20, 0.75)]" "$(cat recommend.py)"

# ---- the fronts of all devices: without what the reference cannot judge, and each device's own
cat >fronts.py <<'PYTHON'
from harness.accuracy.chart import fronts, fronts_chart
def point(device, ms, error):
    return {"device": device, "name": f"{ms}", "ms": ms, "rmse": error}
memory = {"truth": {"to_quarter_of_samples": {"rmse": 10 ** 0.5}},
          "points": [point("c:0", 1, 50), point("c:0", 2, 60), point("c:0", 5, 12), point("c:0", 9, 9.9), point("opencl:0", 3, 20)]}
limit, drawn = fronts(memory)
print(round(limit, 9), {label: [each["ms"] for each in these] for label, these in drawn.items()})
devices = [{"label": label, "name": "N", "reason": None} for label in ("cuda:0", "c:0", "opencl:0")]
about = {"hedron": {"version": "1"}, "machine": {"words": "M"}, "scene": {"name": "S"}, "devices": devices}
drawn = fronts_chart(about, memory).document()
print([word in drawn for word in (">c:0 N<", ">opencl:0 N<", "cuda", "<title>c:0 N: 5, 12.0<", "9.9")])
print(fronts_chart(about, {**memory, "points": memory["points"][3:4]}))
PYTHON
expect_python "10.0 {'c:0': [1, 5], 'opencl:0': [3]}
[True, True, False, True, False]
None" "$(cat fronts.py)"

# ---- settings: families that go on only where the one before was affordable are ordered by their work
expect_python True 'from harness.accuracy.settings import FAMILIES, settings' \
    'both = [settings(quick) for quick in (False, True)]' \
    'print(all(list(each) == list(FAMILIES) and all([s.work for s in f] == sorted(s.work for s in f) for f in each.values()) for each in both))'

# ---- the bench's own look at a picture: hedron's shares, and what is not finite
"$hedron" render --quiet --backend c --frames 0 --size 32x24 --samples 1 -o one.pfm >"$logs/stdout"
"$hedron" render --quiet --backend c --frames 0 --size 32x24 --samples 2 -o two.pfm >"$logs/stdout"
cat >look.py <<'PYTHON'
import struct
from harness.run import pfm
from harness.run.program import Problem
with open("bad.pfm", "wb") as file:
    file.write(b"PF\n2 1\n-1.0\n" + struct.pack("<6f", 0, 1, float("inf"), -float("inf"), float("nan"), 2))
print(pfm.not_finite("one.pfm"), pfm.not_finite("bad.pfm"))
class Program:
    path = PATH
share = 1 - pfm.errors(Program, "one.pfm", "two.pfm")["above_1"]
print(abs(pfm.share_within("one.pfm", "two.pfm", 1) - share) < 1e-12, 0.1 < share < 0.9,
      pfm.share_within("one.pfm", "one.pfm", 0))
print(pfm.compare(Program, "bad.pfm", "bad.pfm")["first"]["not_finite"])
try:
    pfm.compare(Program, "one.pfm", "bad.pfm")
except Problem as problem:
    print(problem.code)
PYTHON
expect_python '0 3
True True 1.0
3
1' "$(sed "s|PATH|'$hedron'|" look.py)"

# ---- targets: the worst scene counts; nothing left out is met, and one that failed leaves no figure
cat >targets.py <<'PYTHON'
from harness.accuracy.targets import SceneTargets
from harness.measure.plan import Plan
def told(truncation, arithmetic):
    plan = Plan({}, {}, quick=True)
    targets = SceneTargets(plan, {"label": "c:0"}, [])
    targets.truncation = {name: found if isinstance(found, str) else {"measured": found[0], "bound": found[1]}
                          for name, found in truncation.items()}
    targets.arithmetic = {name: {"above_1": share} for name, share in arithmetic.items()}
    targets.add_truncation()
    targets.add_arithmetic()
    rows = [row for row in plan.finished() if not row["what"].startswith(" ")]
    return [(row["figure"], row["verdict"] or row["reason"]) for row in rows]
print(told({"a": (0.5, 0.9), "b": (0, 0.1)}, {"a": 0.0005, "b": 0}))
print(told({"a": (1.5, 0.9), "b": (0.01, 0.1)}, {"a": 0.002, "b": 0}))
print(told({"a": (0, 0), "b": (0, 0)}, {"a": 0}))
print(told({"a": (0.5, 0.9), "b": "no room"}, {}))
PYTHON
expect_python "[(0.5, 'aim'), (1.8, 'aim'), (99.95, 'least')]
[(1.5, 'missed'), (10.0, 'missed'), (99.8, 'missed')]
[(0.0, 'aim'), (None, 'nothing was measured'), (100.0, 'aim')]
[(None, 'no room'), (None, 'no room'), (None, 'nothing was measured')]" "$(cat targets.py)"

# ---- who makes references: a GPU before a CPU, and nobody without double precision
expect_python 'cuda:0 c:0 None' 'from harness.run.devices import judge' \
    'made = lambda doubles: [{"label": f"{b}:0", "backend": b, "strict": True, "is_cpu": b != "cuda", "has_double": b in doubles} for b in ("opencl", "c", "cuda")]' \
    'names = [judge(made(doubles)) for doubles in (("c", "cuda"), ("opencl", "c"), ())]' \
    'print(*(name and name["label"] for name in names))'
# What is stated of the reference's samples is what their test measures.
expect_python True 'from harness.accuracy.truth import SAMPLE_ERROR' \
    "print(f'#define REFERENCE_SAMPLE_ERROR {SAMPLE_ERROR}\n' in open('$project/tests/unit/render/test_samples.c', encoding='utf-8').read())"

# ---- a tiny run
expect_exit 0 "$hedron" check "$project/bench/scenes/few.json"
expect_exit 0 "${no_nvidia[@]}" "${bench[@]}" --hedron "$hedron" --out out --device c --quick --size 16x12 \
    --parts settings,fronts,arithmetic,truncation,choices
expect_stdout_contains 'What hedron chooses by itself:'
expect_stdout_contains 'The same bytes from every device and pipeline'
expect_value '[1, "accuracy", true, true, [16, 12], []]' \
    '[r[key] for key in ("hedron_bench", "bench", "complete", "quick", "size", "failures")]'
expect_value '["aim", "aim", true]' \
    '[rows["truncation"]["verdict"], rows["not_finite"]["verdict"], rows["arithmetic"]["figure"] > 99]'
expect_value "[$(find "$project/scenes" -maxdepth 1 -name '*.json' | wc -l), true]" \
    '[len(r["targets"]["truncation"]), all(0 <= each["measured"] <= each["bound"] + 0.01 <= 1.01 for each in r["targets"]["truncation"].values())]'
# More samples are nearer to the reference, less depth is farther off; an equal picture is equally far.
expect_value '[true, true, true]' \
    '[points["grid 1"]["rmse"] > points["grid 4"]["rmse"], points["depth 4"]["rmse"] > points["depth 30"]["rmse"], points["mega"]["rmse"] == points["wavefront"]["rmse"] == points["grid 4"]["rmse"]]'
expect_value '[true, true, 1]' \
    '[0 < r["truth"]["to_quarter_of_samples"]["rmse"] < points["grid 1"]["rmse"], r["truth"]["missing"]["largest"] <= r["truth"]["max_error"], sum("draft" in (each["recommended"] or "") for each in points.values())]'
# Every scene has its own reference, and points of the same settings.
expect_value '["built-in", "five", "official", "starter"]' 'list(r["fronts"])'
expect_value '[4, true, true]' \
    '[len({m["truth"]["sha256"] for m in r["fronts"].values()}), all({"grid 1", "adaptive 4", "deep 4", "promise 64"} <= {p["name"] for p in m["points"]} for m in r["fronts"].values()), all("full" not in p["family"] for s, m in r["fronts"].items() for p in m["points"] if s != "built-in")]'
# The error is that of frame 0 against its reference.
limit=$(python3 -c 'import json; print(json.load(open("out/accuracy.json", encoding="utf-8"))["truth"]["max_error"])')
frame=("$hedron" render --quiet --backend c --frames 0 --size 16x12)
"${frame[@]}" --reference --samples 16 --max-error "$limit" -o truth.pfm >"$logs/stdout"
"${frame[@]}" --samples 4 -o grid.pfm >"$logs/stdout"
"$hedron" compare --json grid.pfm truth.pfm >compared.json
expect_value '[true, true]' \
    '(lambda d: [points["grid 4"][key] == d[key] for key in ("rmse", "largest")])(json.load(open("compared.json"))["display"])'
expect_value '[0.0, true, true]' \
    '(lambda ways: [ways["double"]["rmse"], 0 < ways["float"]["rmse"] < 0.1, ways["triangles"]["rmse"] > ways["float"]["rmse"]])({each["way"]: each for each in r["choices"]})'
if [[ ! -s out/accuracy.md ]]; then
    fail "there are no tables for documents"
fi
for kind in rmse largest; do
    expect_svg "out/accuracy_c0_$kind.svg"
done

# ---- Ctrl-C leaves what was measured
interrupt_at_work "${bench[@]}" --hedron "$hedron" --out out --device c
expect_stdout_contains Interrupted
expect_value false 'r["complete"]'

# ---- wrong usage
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --parts wrong
expect_stderr_contains 'a part that is none of settings'
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --size 0x4
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --repeats 0
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out -- --depth=3
expect_stderr_contains '--depth=3 cannot stand after --'
expect_exit 2 "${bench[@]}" --hedron no/hedron --out out
expect_exit 3 "${bench[@]}" --hedron "$hedron" --out out --device c:7
finish
