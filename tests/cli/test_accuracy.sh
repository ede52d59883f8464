#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What is promised of a picture's error, and what is kept: --max-error, --aa, --reference, --crop.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
if ! command -v jq >"$logs/which"; then
    skip "there is no jq"
fi
render=("$hedron" render --quiet --backend c)

# expect_all FILE FILTER: what jq says of each line is true.
expect_all() {
    if ! jq -e -s "all(.[]; $2)" "$1" >"$logs/jq" 2>&1; then
        fail "$1: not $2: $(tr '\n' ' ' <"$1" | cut -c1-600)"
    fi
}

# compare A B: into compared.json.
compare() {
    "$hedron" compare --json "$1" "$2" >compared.json || true
}

# ---- what is left out: within the bound, which is within the limit
for scene in "$project"/scenes/*.json; do
    size=(--size 24x18)
    limit=1
    nearer=0.03
    # Every ray goes on twice there, at every hit: what is bounded costs rays as 1 over the bound.
    if [[ $scene == */knot.json ]]; then
        size=(--size 8x6)
        limit=16
        nearer=2
    fi
    expect_exit 0 "${render[@]}" "$scene" --frames 0 --samples 1 "${size[@]}" --max-error "$limit" -o one.pfm \
        --stats one.jsonl
    expect_all one.jsonl ".missing.largest <= $limit and .missing.mean <= .missing.largest"
    expect_exit 0 "${render[@]}" "$scene" --frames 0 --samples 1 "${size[@]}" --max-error "$nearer" \
        --precision double -o truth.pfm --stats truth.jsonl
    expect_all truth.jsonl ".missing.largest <= $nearer"
    compare one.pfm truth.pfm
    expect_all compared.json '.first.not_finite == 0 and .second.not_finite == 0'
    # Rays that meet another thing in float than in double are another error: few, and not left out.
    expect_all compared.json ".display.above_1 <= 0.005"
done

# ---- a looser limit takes fewer rays; what was left out is told also where the depth does it
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 --max-error 8 -o loose.pfm --stats loose.jsonl
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 --max-error 0.5 -o tight.pfm --stats tight.jsonl
rays='.rays.mirrored + .rays.transmitted'
if (($(jq "$rays" loose.jsonl) * 10 > $(jq "$rays" tight.jsonl) * 9)); then
    fail "an error of 8 takes $(jq "$rays" loose.jsonl) rays, one of 0.5 $(jq "$rays" tight.jsonl)"
fi
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 --max-error 1 --depth 2 -o shallow.pfm --stats shallow.jsonl
expect_all shallow.jsonl '.missing.largest > 1 and .depth == 2'
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 -o plain.pfm --stats plain.jsonl
expect_all plain.jsonl '.missing == null'

# ---- adaptive: seven tenths of the samples, and 99.9 % of the pixels within 2 steps of the grid's
expect_exit 0 "${render[@]}" --frames 0 --samples 4 -o grid.pfm --stats grid.jsonl
expect_exit 0 "${render[@]}" --frames 0 --samples 4 --aa adaptive -o adaptive.pfm --stats adaptive.jsonl
compare adaptive.pfm grid.pfm
expect_all compared.json '.display.rmse > 0 and .display.p999 <= 2'
if (($(jq .rays.primary adaptive.jsonl) * 10 > $(jq .rays.primary grid.jsonl) * 7)); then
    fail "adaptive sampling takes $(jq .rays.primary adaptive.jsonl) samples, the grid $(jq .rays.primary grid.jsonl)"
fi
# One sample a pixel leaves nothing to choose.
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 --samples 1 -o a.pfm
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 --samples 1 --aa adaptive -o b.pfm
expect_same a.pfm b.pfm
# A frame alone is that of the sequence, on any number of threads and lanes.
expect_exit 0 "${render[@]}" --frames 3-5 --size 64x48 --samples 3 --aa adaptive --max-error 2 -o 'many##.pfm'
expect_exit 0 "${render[@]}" --frames 5 --size 64x48 --samples 3 --aa adaptive --max-error 2 --threads 1 --lanes 1 \
    -o alone.pfm
expect_same many05.pfm alone.pfm

# ---- a crop is that part of the picture, byte for byte
expect_exit 0 "${render[@]}" --frames 7 --size 64x48 --samples 3 -o whole.pfm
expect_exit 0 "${render[@]}" --frames 7 --size 64x48 --samples 3 --crop 20x11+9+30 -o part.pfm
expect_exit 0 "${render[@]}" --frames 7 --size 64x48 --samples 3 --crop 64x48+0+0 -o all.pfm
expect_same whole.pfm all.pfm
# rows LEFT TOP WIDTH HEIGHT FILE WIDE HIGH: the bytes of a part; PFM has its rows from the bottom.
rows() {
    local header row
    header=$(($(head -c 100 "$5" | head -n 3 | wc -c)))
    for ((row = $7 - $2 - $4; row < $7 - $2; row++)); do
        tail -c "+$((header + 1 + (row * $6 + $1) * 12))" "$5" | head -c "$(($3 * 12))"
    done
}
rows 9 30 20 11 whole.pfm 64 48 >expected.bytes || true
rows 0 0 20 11 part.pfm 20 11 >own.bytes || true
expect_same expected.bytes own.bytes
expect_exit 0 "${render[@]}" --frames 7 --size 64x48 --aa adaptive --max-error 4 --crop 9x9+55+39 -o corner.pfm

# ---- the reference: double, many samples, and nearer to itself than any other
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 --crop 8x6+28+20 --reference -o reference.pfm --stats reference.jsonl
expect_all reference.jsonl '.samples == 32 and .missing.largest <= 0.016 and .rays.primary >= 8 * 6 * 1024'
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 --crop 8x6+28+20 --samples 2 -o coarse.pfm
expect_exit 0 "${render[@]}" --frames 0 --size 64x48 --crop 8x6+28+20 --samples 16 --max-error 0.5 -o fine.pfm
compare coarse.pfm reference.pfm
coarse=$(jq .display.rmse compared.json)
compare fine.pfm reference.pfm
expect_all compared.json ".display.rmse < $coarse / 3"

# ---- a scene file says it too
expect_exit 0 "${render[@]}" --set image.aa=adaptive --set image.max_error=2 --frames 0 --size 32x24 -o file.pfm
expect_exit 0 "${render[@]}" --aa adaptive --max-error 2 --frames 0 --size 32x24 -o option.pfm
expect_same file.pfm option.pfm

# ---- promises that cannot be kept are not: the bound is told, and the run ends
python3 - <<'END'
import json


def write(name, material, solids, **more):
    json.dump({"hedron": 1, "camera": {"field_of_view": 30, "eye": [0.6, -6, 2.3]}, "materials": {"glass": material},
               "solids": solids, "output": {"curve": "linear"}, **more}, open(name, "w", encoding="utf-8"))


write("nested.json", {"reflection": 0.5, "transmission": 0.5},
      [{"kind": "cube", "circumradius": 3 - 0.1 * i, "material": "glass"} for i in range(20)], background=[0.8] * 3)
write("dark.json", {"colour": [0.0095] * 3, "ambient": 0.045, "reflection": 0.02, "transmission": 0.98,
                    "inner_reflection": 0.01, "inner_transmission": 0.99, "index_of_refraction": 10},
      [{"kind": "icosahedron", "circumradius": 2, "material": "glass"}])
END
if ! "$hedron" check nested.json >"$logs/nested" 2>&1; then
    fail "nested.json: $(cat "$logs/nested")"
fi
expect_exit 0 "$hedron" render nested.json --backend c --frames 0 --size 4x3 --samples 1 --max-error 16 -o nested.pfm \
    --stats nested.jsonl
if jq -e '.missing.largest > 16' nested.jsonl >"$logs/jq"; then
    expect_stderr_contains 'may be missing from a pixel, more than the 16 of --max-error'
fi
# Total reflection, dark glass: what white mirrors of it show is bounded too.
expect_exit 0 "${render[@]}" dark.json --frames 0 --size 24x18 --samples 1 --max-error 1 -o dark.pfm
expect_exit 0 "${render[@]}" dark.json --frames 0 --size 24x18 --samples 1 --max-error 0.01 --precision double -o truth.pfm
compare dark.pfm truth.pfm
expect_all compared.json '.display.above_1 <= 0.005'

# ---- wrong options
expect_exit 2 "${render[@]}" --reference --aa adaptive -o a.pfm
expect_sentence "--reference has samples of its own: leave out --aa"
expect_exit 2 "${render[@]}" --set image.max_error=1e-300 -o a.pfm
expect_exit 2 "${render[@]}" --max-error 0 -o a.pfm
expect_sentence "--max-error is '0', expected a number from 0.001 to 255"
expect_exit 2 "${render[@]}" --max-error -1 -o a.pfm
expect_exit 2 "${render[@]}" --max-error nan -o a.pfm
expect_exit 2 "${render[@]}" --aa smart -o a.pfm
expect_sentence "--aa is 'smart', expected grid or adaptive"
for crop in 8 8x8 8x8+1 8x8+1+ 0x8+1+1 8x8-1+1 8x8+1+1x 8x8+1+99999999999; do
    expect_exit 2 "${render[@]}" --crop "$crop" -o a.pfm
    expect_sentence "--crop is '$crop', expected WIDTHxHEIGHT+X+Y such as 64x64+320+200"
done
expect_exit 2 "${render[@]}" --size 64x48 --crop 8x8+57+0 -o a.pfm
expect_sentence "the picture has 64 x 48 pixels"
finish
