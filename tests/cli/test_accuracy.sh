#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The error bound of a picture and its measured error: --max-error, --aa, --reference, --crop; solids that touch.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

command -v jq >"$logs/which" || skip "there is no jq"

# render NAME OPTION...: NAME.pfm, with its statistics NAME.jsonl.
render() {
    expect_exit 0 "$hedron" render --quiet --backend c --frames 0 --size 64x48 -o "$1.pfm" --stats "$1.jsonl" "${@:2}"
}

# expect_all FILE FILTER: the jq filter is true of each line.
expect_all() {
    jq -e -s "all(.[]; $2)" "$1" >"$logs/jq" 2>&1 || fail "$1: not $2: $(tr '\n' ' ' <"$1" | cut -c1-600)"
}

compare() { # NAME NAME: into compared.json
    "$hedron" compare --json "$1.pfm" "$2.pfm" >compared.json || true
}

# ---- truncation: within the bound, which is within the limit
for scene in default glass lantern; do
    scene=("$project/scenes/$scene.json" --samples 1 --size 24x18)
    render one "${scene[@]}" --max-error 1
    expect_all one.jsonl '.missing.largest <= 1 and .missing.mean <= .missing.largest'
    render truth "${scene[@]}" --max-error 0.03 --precision double
    expect_all truth.jsonl '.missing.largest <= 0.03'
    compare one truth
    # Rays that hit another thing in float than in double are another error: few, and not truncation.
    expect_all compared.json '.first.not_finite == 0 and .second.not_finite == 0 and .display.above_1 <= 0.005'
done

# ---- a looser limit takes fewer rays; truncation is reported even if the depth causes it
render loose --max-error 8
render tight --max-error 0.5
rays='.rays.mirrored + .rays.transmitted'
(($(jq "$rays" loose.jsonl) * 10 <= $(jq "$rays" tight.jsonl) * 9)) ||
    fail 'an error of 8 takes about as many rays as one of 0.5'
render shallow --max-error 1 --depth 2
expect_all shallow.jsonl '.missing.largest > 1 and .depth == 2'
render plain
expect_all plain.jsonl '.missing == null'

# ---- a scene can request an error bound, too
render a --samples 3 --max-error 2
render b --samples 3 --set image.max_error=2 --threads 1 --lanes 1
expect_same a.pfm b.pfm

# ---- a crop is that part of the picture, byte for byte; PFM has its rows from the bottom
render whole --samples 3
render part --samples 3 --crop 20x11+9+30
for ((row = 48 - 30 - 11; row < 48 - 30; row++)); do
    tail -c +$((15 + (row * 64 + 9) * 12)) whole.pfm | head -c $((20 * 12)) || true # after a head of 14 bytes
done | cmp - <(tail -c +15 part.pfm) || fail 'a crop is another picture than its part of the whole'

# ---- the reference: double, many samples, and closer to itself than any other
render reference --crop 8x6+28+20 --reference
expect_all reference.jsonl '.samples == 32 and .missing.largest <= 0.016 and .rays.primary >= 8 * 6 * 1024'
render coarse --crop 8x6+28+20 --samples 2
render fine --crop 8x6+28+20 --samples 16 --max-error 0.5
compare coarse reference
coarse=$(jq .display.rmse compared.json)
compare fine reference
expect_all compared.json ".display.rmse < $coarse / 3"

# ---- an unreachable error bound is reported, and the run ends
jq -n '{hedron: 1, camera: {field_of_view: 30, eye: [0.6, -6, 2.3]}, background: [0.8, 0.8, 0.8], output: {curve: "linear"},
    materials: {glass: {reflection: 0.5, transmission: 0.5}},
    solids: [range(20) | {kind: "cube", circumradius: (3 - 0.1 * .), material: "glass"}]}' >nested.json
expect_exit 0 "$hedron" render nested.json --backend c --frames 0 --size 1x1 --samples 1 --max-error 16 -o nested.pfm
expect_stderr_contains 'may be missing from a pixel, more than the 16 of --max-error'

# ---- wrong options
wrong() { # WORDS OPTION...
    expect_refusal 2 "$hedron" render --backend c -o wrong.pfm "${@:2}"
    expect_stderr_contains "$1"
}
wrong '--reference has samples of its own: leave out --aa' --reference --aa grid
wrong "max_error is 1e-300, expected 0, or a number from 0.001 to 255" --set image.max_error=1e-300
wrong "--crop is '8x8+1+1x', expected WIDTHxHEIGHT+X+Y such as 64x64+320+200" --crop 8x8+1+1x
wrong 'the area ends outside the picture of 64 x 48 pixels' --size 64x48 --crop 8x8+57+0 --frames 0

# ---- solids that touch: the picture is that of an invisibly small gap
# expect_gap SOLIDS LIGHT: of a scene whose cubes lie $gap apart, or are smaller by it.
expect_gap() {
    local gap precision
    for gap in 0 1e-6; do
        jq -n --argjson gap $gap --argjson light "$2" "def cube(at; edge; material):
            {kind: \"cube\", centre: at, circumradius: (edge * (3 | sqrt) / 2), material: material}; {hedron: 1,
            image: {width: 48, height: 36, samples: 1, depth: 12}, background: [0.1, 0.15, 0.25],
            camera: {field_of_view: 40, eye: [4.1, -5.3, 2.4]}, lights: [{position: \$light, intensity: 0.8}], materials: {
            glass: {colour: [0.9, 0.95, 1], diffuse: 0.1, reflection: 0.1, transmission: 0.8, inner_reflection: 0.3,
                inner_transmission: 0.6},
            red: {colour: [1, 0.5, 0.4], diffuse: 0.1, reflection: 0.1, transmission: 0.7},
            clear: {reflection: 0.08, transmission: 0.9, index_of_refraction: 1.5}, ground: {diffuse: 0.7, reflection: 0.15}},
            floor: {corners: [[-6, 6, -1], [6, 6, -1], [6, -6, -1], [-6, -6, -1]], material: \"ground\",
                texture: {file: \"builtin:floor\"}}, solids: [$1]}" >"$gap.json"
    done
    for precision in float double; do
        for gap in 0 1e-6; do
            expect_exit 0 "$hedron" render $gap.json --quiet --backend c --precision $precision -o $gap.pfm
        done
        compare 0 1e-6
        expect_all compared.json '.display.largest <= 1'
    done
}
# On the floor, on each other, within each other, with tops at one level; beside a light.
# shellcheck disable=SC2016 # variables of jq
for solids in 'cube([0, 0, $gap]; 2; "clear")' \
    'cube([0, 0, $gap]; 2; "glass"), cube([0, 0, 1.5 + 2 * $gap]; 1; "red") | .rotation = [0, 0, 31]' \
    'cube([0, 0, 0.2]; 2; "glass"), cube([0.5 - $gap, 0.5 - $gap, 0.7 - $gap]; 1; "red")' \
    'cube([-0.5, 0, 0.2]; 2; "glass"), cube([0.5, 0.3, 0.2]; 2 * (1 - $gap); "red")'; do
    expect_gap "$solids" '[3, -4, 6]'
done
# shellcheck disable=SC2016
expect_gap 'cube([0, 0, 0.2]; 2 * (1 - $gap); "glass")' '[0.3, -1, 0.6]'
finish
