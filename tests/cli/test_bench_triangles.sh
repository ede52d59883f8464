#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/study triangles: its arithmetic on made-up numbers, and a tiny run of the programs themselves.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
bench=("$project/bench/study" triangles)
build=$(dirname "$hedron")

# expect_value EXPECTED EXPRESSION: what Python makes of the result `r` and its rows, by key and device.
expect_value() {
    expect_python "$1" 'import json' 'r = json.load(open("out/triangles.json", encoding="utf-8"))' \
        "rows = {' '.join((row['key'], row['device'] or 'nowhere')): row for row in r['rows']}" "print(json.dumps($2))"
}

# ---- rates: the ratio of the medians, against the best of the ways that count; rays that meet something else
cat >rates.py <<'PYTHON'
from harness.measure.plan import Plan
from harness.triangles import rates as mesh_rates
def text(share, leaks=0, odd=0):
    rounds = zip((3e6, 5e6, 4e6), (9e6, 9e6, 9e6), (1e6, 8e6, 2e6))
    return f"build avx2 8\nobject 1056\nsame primary 1056 single 1\nsame primary 1056 packets_of_8 {share}\n" + "".join(
        f"rate primary 1056 hedron {a}\nrate primary 1056 single {b}\nrate primary 1056 packets_of_8 {c}\n"
        for a, b, c in rounds) + f"aimed 1056 hedron 9 {leaks} {odd}\naimed 1056 single 9 0 3\nbuilt 1056 hedron 3\nbuilt 1056 embree 2\n"
good = mesh_rates.parse(text(0.995))
rates = good["rates"]["primary"]
print(good["triangles"], good["lanes"], good["built"], mesh_rates.against(rates["hedron"], rates["packets_of_8"]))
print(mesh_rates.best_way(rates, mesh_rates.BUNDLED), mesh_rates.best_way(rates, mesh_rates.ANY),
      mesh_rates.best_way({"hedron": [1]}, mesh_rates.ANY))
print(mesh_rates.failures({1000: good, 80000: "why not"}), len(mesh_rates.failures({1000: mesh_rates.parse(text(0.99))})))
print(good["aimed"], mesh_rates.failures({1000: mesh_rates.parse(text(1, 2))}), len(mesh_rates.failures({1000: mesh_rates.parse(text(1, 0, 1))})))
def finished(objects):
    plan = Plan({}, {})
    mesh_rates.add_comparison(plan, objects, "primary", 1000, mesh_rates.BUNDLED, mesh_rates.RATES[0][3])
    row = plan.finished()[0]
    return row["what"], row["figure"], row["verdict"], row["reason"]
for way in ("single", "packets_of_8"):
    print(finished({1000: good}))
    del rates[way]
print(finished({1000: good}))
print(finished({}))
PYTHON
expect_python "1056 8 {'hedron': [3.0], 'embree': [2.0]} [1.5, 2.5, 2.0]
packets_of_8 single None
[] 1
{'hedron': [9, 0, 0], 'single': [9, 0, 3]} ['of 9 rays aimed at edges and corners of 1 k triangles 2 leak and 0 cross the closed surface an odd number of times'] 1
(\"primary rays, 1 k triangles, against Embree's packets of 8\", 2.0, 'aim', None)
(\"primary rays, 1 k triangles, against Embree's packets of 8\", 2.0, 'aim', None)
('primary rays, 1 k triangles, against Embree', None, None, 'Embree is not installed (libembree-dev), so hedron stands alone')
('primary rays, 1 k triangles, against Embree', None, None, 'it was not measured')" "$(cat rates.py)"

# ---- where brute force and the hierarchy cross: halfway of the logarithms here; and beyond what was measured
cat >cross.py <<'PYTHON'
from harness.triangles.sweep import caption, crossover
flat = [(100, 1.0), (10000, 1.0), (1000000, 2.0)]
bvh = [(972, 1.0), (10092, 1.0), (1000008, 2.5)]
print(crossover([(100, 0.1), (10000, 10.0)], flat), crossover([(100, 2.0), (10000, 200.0)], flat),
      crossover([(100, 0.1), (10000, 0.2)], flat), crossover([], flat), sep=", ")
def point(way, count, ms):
    return {"device": "c:0", "way": way, "asked": round(count, -2), "triangles": count, "trace_ms": {"median": ms}}
print(caption([point("brute", 972, 0.1), point("brute", 10092, 10.0), *(point("bvh", *each) for each in bvh)], ["c:0"]))
PYTHON
expect_python 'at about 1,000, below 100, beyond 10,000, None
On c:0 a frame of 1 M triangles takes 2.50 times as long as one of 1 k with the hierarchy. Brute force and the hierarchy cross at about 3,100 triangles on c:0. Points are medians; the first frame of each run does not count.' \
    "$(cat cross.py)"

# ---- leaks: none are the target, and any is a failure
cat >leaks.py <<'PYTHON'
from harness.measure.plan import Plan
from harness.triangles import leaks
def total(holes, doubles):
    return leaks.parse(f"c float, a CPU\n  in all   9 rays, 9 leaks, 9 double hits\ntotal of 16 renderers:\n"
                       f"               2386960 rays, {holes} leaks, {doubles} double hits\n")
hunts = {"c": total(0, 0), "opencl": total(2, 1), "cuda": "no driver"}
plan = Plan({}, {})
leaks.add_rows(plan, hunts)
for row in plan.finished():
    print(row["what"], row["figure"], row["verdict"], row["reason"])
print(sorted(plan.failures), leaks.parse("c float, a CPU\n"))
PYTHON
expect_python "leaks and double hits of 2.39 M rays aimed at edges and corners, 16 renderers 0.0 aim None
leaks and double hits of 2.39 M rays aimed at edges and corners, 16 renderers 3.0 missed None
leaks and double hits None None no driver
['opencl: 2 leaks and 1 double hits'] None" "$(cat leaks.py)"

# ---- primary rays: the targets are those of an H200, and the first frame does not count
cat >primary.py <<'PYTHON'
from harness.measure.plan import Plan
from harness.triangles import primary
def told(name, is_cpu):
    devices = {"x:0": {"name": name, "is_cpu": is_cpu}}
    plan = Plan(devices, {"near-1000": "a file"})
    primary.add(plan)
    for job in plan.jobs:
        job["runs"].append({"frames": [{"rays": {"primary": 32e9}, "seconds": {"trace": each}, "warm_up": each == 1}
                                       for each in (1, 4)]})
    return [(row["figure"], row["least"], row["verdict"], row["reason"]) for row in plan.finished()], [
        "--size" in job["options"] for job in plan.jobs]
print(told("NVIDIA H200", False), told("a CPU", True), sep="\n")
PYTHON
expect_python "([(8.0, 5, 'least', None)], [False])
([(8.0, None, None, None), (None, 5, None, 'no H200 here'), (None, 2, None, 'no H200 here')], [True])" "$(cat primary.py)"

# ---- pictures of both ways must be the same
expect_python False 'from harness.measure.plan import Plan' 'plan = Plan({"c:0": {"strict": True}}, {})' \
    'for way in ("bvh", "brute"): plan.job("c:0", "a", "0", ("--accel", way))["runs"].append({"frames": [{"frame": 0, "picture": way}]})' \
    'print(plan.compared()["same"])'

# ---- a tiny run
tiny=(--size 32x24 --samples 1)
expect_exit 0 "${no_nvidia[@]}" "${bench[@]}" --hedron "$hedron" --out out --device c --quick --repeats 1 --most 1000 \
    --parts rates,sweep,primary -- "${tiny[@]}"
expect_stdout_contains 'CHANGED by --size 32x24'
expect_stdout_contains 'The same bytes from every device and pipeline, in 16 frames made in two ways or more.'
expect_value '[1, "triangles", true, true, 1000, [], null]' \
    '[r[key] for key in ("hedron_bench", "bench", "complete", "quick", "most", "failures", "leaks")]'
expect_value '[["bvh", 12], ["bvh", 48], ["bvh", 100], ["bvh", 1000], ["brute", 12], ["brute", 48], ["brute", 100], ["brute", 1000]]' \
    '[[each["way"], each["asked"]] for each in r["sweep"] if each["trace_ms"]["median"] > 0]'
expect_value '[12, 972]' '[r["sweep"][i]["triangles"] for i in (0, 3)]'
expect_value true 'rows["primary c:0"]["figure"] > 0'
if [[ -x $build/bench/hedron_mesh_rates ]]; then
    expect_value '[262144, 0, 0]' 'r["mesh_rates"][0]["aimed"]["hedron"]'
    expect_value '[["primary", "mirrored", "diffuse", "shadow"], true, true]' \
        '[list(r["mesh_rates"][0]["rates"]), r["mesh_rates"][0]["rates"]["diffuse"]["hedron"][0] > 0, "--most" in r["mesh_rates"][1]["reason"]]'
fi
if [[ ! -s out/triangles.md ]]; then
    fail "there is no table for documents"
fi
expect_svg out/triangles.svg

# ---- a hedron without the other programs beside it: reasons, no figures
mkdir alone
printf '#!/bin/sh\nexec "%s" "$@"\n' "$hedron" >alone/hedron
chmod +x alone/hedron
expect_exit 0 "${no_nvidia[@]}" "${bench[@]}" --hedron alone/hedron --out out --device c --quick
expect_stdout_contains 'alone/hedron_model: ./dev build builds it'
expect_stdout_contains 'alone/tests/leak_hunt/hedron_leak_hunt: ./dev build builds it'
expect_value true 'all(row["reason"] for row in r["rows"])'

# ---- Ctrl-C leaves what was measured
interrupt_at_work "${bench[@]}" --hedron "$hedron" --out out --device c
expect_stdout_contains Interrupted
expect_value false 'r["complete"]'

# ---- wrong usage
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --parts wrong
expect_stderr_contains 'a part that is none of rates'
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --most 0
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --leak-rays 1.5
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out -- --accel=brute
expect_stderr_contains '--accel=brute cannot stand after --'
expect_exit 2 "${bench[@]}" --hedron no/hedron --out out
expect_exit 3 "${bench[@]}" --hedron "$hedron" --out out --device c:7
finish
