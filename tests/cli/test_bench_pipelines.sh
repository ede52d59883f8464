#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/study pipelines: its arithmetic on made-up numbers, and a tiny run of the programs themselves.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
bench=("$project/bench/study" pipelines)
orders=$(dirname "$hedron")/bench/hedron_queue_order

# expect_value EXPECTED EXPRESSION: what Python makes of the result `r`.
expect_value() {
    expect_python "$1" 'import json' 'r = json.load(open("out/pipelines.json", encoding="utf-8"))' "print(json.dumps($2))"
}

# ---- the orders: times for each ray of all levels, medians of the rounds, 40 of 8 bundles alive
cat >orders.py <<'PYTHON'
from harness.pipelines import order as queue_order
found = queue_order.parse("""build avx512 16
order a.json 256 product 0 0 0 0 0
order a.json 256 appended 60 40 8 12 16
time a.json 256 product 0 2e-6 0 0
time a.json 256 appended 1e-6 2e-6 0 1e-6
time a.json 256 product 0 2e-6 0 0
time a.json 256 appended 1e-6 4e-6 0 1e-6
time a.json 256 product 0 8e-6 0 0
time a.json 256 appended 1e-6 9e-6 0 3e-6
""")
product, appended = found["orders"]
print(found["lanes"], product["scene"], product["rays"], product["lanes_alive"], round(product["ns_a_ray"]["all"], 6))
print([round(value, 6) for value in appended["ns_a_ray"].values()], appended["lanes_alive"],
      appended["touched_a_bundle"], appended["met_a_bundle"])
PYTHON
expect_python $'16 a 100 None 20.0\n[10.0, 40.0, 0.0, 10.0, 60.0] 5.0 1.5 2.0' "$(cat orders.py)"

# ---- what the CUDA programs say becomes tables; sums in fixed point that differ are told
cat >cuda.py <<'PYTHON'
from harness.chart import files
from harness.pipelines import cuda as cuda_studies
def sums(ulps):
    spread = {"max": 0.25, "rms": 0.125, "differing": 0.5}
    return {"ms": 2.0, "ns_each": 4.0, "runs_differ_by_255ths": spread, "runs_differ_by_ulps": {"max": ulps, "rms": 0},
            "runs_differ_by_bytes": spread, "error_255ths": spread}
found = {"device": "a GPU", "contributions": 5, "levels": 2, "runs": 10, **{name: sums(0) for name in cuda_studies.SUMS}}
print(cuda_studies.fixed_is_exact(found), cuda_studies.fixed_is_exact({**found, "fixed_samples": sums(1)}))
print(cuda_studies.sum_cells(found, "float_pixels"))
error = {"max": 0.5, "rms": 0.25}
lookups = {"device": "a GPU", "side": 8, "none": {"coherent_ns": 1.0, "random_ns": 2.0},
           **{name: {"coherent_ns": 1.0, "random_ns": 2.0, "error_noise": error, "error_smooth": error}
              for name in cuda_studies.LOOKUPS if name != "none"}}
print(cuda_studies.lookup_cells(lookups, "own"), cuda_studies.lookup_cells(lookups, "none"))
result = {"image_sums": found, "texture_lookups": lookups, "hedron": {"version": "0"}, "scene": {"name": "a", "width": None},
          "machine": {"cpu": "a CPU", "cores": 1}}
import pathlib
drawn = files.draw({"image_sums": cuda_studies.sum_chart(result), "texture_lookups": cuda_studies.lookup_chart(result)},
                   pathlib.Path("."))
print(all(line.startswith("Chart: ") for line in drawn) or drawn)
PYTHON
expect_python "True False
['float, each pixel a sum', '2.000', '4.00', '0.25', '0.125', '0', '0', '0.5', '0.25']
[\"the kernels' own\", '1.00', '2.00', '0.5', '0.25', '0.5', '0.25'] ['coordinates alone', '1.00', '2.00', '-', '-', '-', '-']
True" "$(cat cuda.py)"

# ---- a tiny run
tiny=(--size 32x24 --samples 1 --depth 2)
expect_exit 0 "${no_nvidia[@]}" "${bench[@]}" --hedron "$hedron" --out out --device c --quick --repeats 1 -- "${tiny[@]}"
expect_stdout_contains 'The same bytes from every device and pipeline'
expect_value '[1, "pipelines", true, true, []]' \
    '[r["hedron_bench"], r["bench"], r["complete"], r["quick"], r["failures"]]'
expect_value '[["mega", 1.0], ["wavefront", true], ["wavefront-uncompacted", true]]' \
    '[[e["pipeline"], e["ratio_to_mega"] if e["pipeline"] == "mega" else e["ratio_to_mega"] > 0] for e in r["pipelines"]][:3]'
expect_value '[9, ["headline", "fullhd", "default"]]' \
    '[len(r["pipelines"]), list(dict.fromkeys(e["scene"] for e in r["pipelines"]))]'
expect_value true 'all(e["processor_ratio_to_mega"] > 0 for e in r["pipelines"])'
expect_value true 'all("reason" in r[name] for name in ("image_sums", "texture_lookups"))'
if [[ -x $orders ]]; then
    expect_value '[28, true]' \
        '[len(r["queue_order"]["orders"]), min(e["ns_a_ray"]["all"] for e in r["queue_order"]["orders"]) > 0]'
    # Bundles keep their dead rays in one order only, and sorting gives bundles with more in common.
    expect_value true 'all(e["lanes_alive"] < f["lanes_alive"] for e in r["queue_order"]["orders"] for f in r["queue_order"]["orders"] if (e["scene"], e["batch"]) == (f["scene"], f["batch"]) and e["order"] == "uncompacted" and f["order"] == "appended")'
    expect_value true 'all(e["touched_a_bundle"] > f["touched_a_bundle"] for e in r["queue_order"]["orders"] for f in r["queue_order"]["orders"] if (e["scene"], e["batch"]) == (f["scene"], f["batch"]) and e["order"] == "appended" and f["order"] == "touched")'
fi
expect_svg out/pipelines.svg
if [[ -x $orders ]]; then
    expect_svg out/queue_order.svg
fi

# ---- the recording has as many rays as the statistics say, and a colour for each
if [[ -x $orders ]]; then
    expect_exit 0 "$hedron" render --quiet --backend c --frames 0 --stats stats.jsonl -o '#.png' \
        "$project/bench/scenes/headline.json"
    expect_exit 0 "$orders" --record recording "$project/bench/scenes/headline.json"
    cat >recording.py <<'PYTHON'
import array, json, pathlib
words = array.array("i", pathlib.Path("recording").read_bytes())
place, levels, numbers = 2, [], True
while words[place]:
    count = words[place]
    levels.append(count)
    numbers = numbers and 0 <= min(words[place + 1:place + 1 + 4 * count:4]) <= max(words[place + 1:place + 1 + 4 * count:4]) < words[0]
    place += 1 + 4 * count
rays = json.loads(pathlib.Path("stats.jsonl").read_text())["rays"]
print(list(words[:2]), len(levels), sum(levels) == sum(rays.values()), numbers, place == len(words) - 1)
PYTHON
    expect_python '[1228800, 4] 7 True True True' "$(cat recording.py)"
    expect_exit 2 "$orders" --record recording
    expect_exit 1 "$orders" no.json
fi

# ---- wrong usage
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out --parts wrong
expect_stderr_contains 'a part that is none of pipelines'
expect_exit 2 "${bench[@]}" --hedron "$hedron" --out out -- --pipeline=mega
expect_stderr_contains '--pipeline=mega cannot stand after --'
expect_exit 2 "${bench[@]}" --hedron no/hedron --out out
expect_exit 3 "${bench[@]}" --hedron "$hedron" --out out --device c:7
finish
