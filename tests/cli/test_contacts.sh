#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Solids that touch: the picture is that of a gap too small to be seen. What touches, and what a check says of it, is a
# matter of the unit tests (scene/test_contact, input/test_scene_words).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

if ! command -v jq >"$logs/which"; then
    skip "there is no jq"
fi

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
        "$hedron" compare --json 0.pfm 1e-6.pfm >compared.json || true
        jq -e '.display.largest <= 1' compared.json >"$logs/jq" ||
            fail "$1, $precision: touching and apart by a millionth differ: $(jq -c .display compared.json)"
    done
}
# On the floor, on each other, within each other, with tops at one level.
# shellcheck disable=SC2016 # variables of jq
for solids in 'cube([0, 0, $gap]; 2; "clear")' \
    'cube([0, 0, $gap]; 2; "glass"), cube([0, 0, 1.5 + 2 * $gap]; 1; "red") | .rotation = [0, 0, 31]' \
    'cube([0, 0, 0.2]; 2; "glass"), cube([0.5 - $gap, 0.5 - $gap, 0.7 - $gap]; 1; "red")' \
    'cube([-0.5, 0, 0.2]; 2; "glass"), cube([0.5, 0.3, 0.2]; 2 * (1 - $gap); "red")'; do
    expect_gap "$solids" '[3, -4, 6]'
done
# shellcheck disable=SC2016
expect_gap 'cube([0, 0, 0.2]; 2 * (1 - $gap); "glass")' '[0.3, -1, 0.6]' # beside a light
finish
