#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Solids that touch: the picture is that of a gap too small to be seen. What touches, and what a check says of it, is a
# matter of the unit tests (scene/test_contact, input/test_scene_words).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
if ! command -v jq >"$logs/which"; then
    skip "there is no jq"
fi

# NAME.json, whose solids touch, and NAME-gap.json, drawn apart by a millionth by hand.
python3 - <<'END'
import json
import math


def cube(centre, edge, material, shrunk=0.0, **more):
    return {"kind": "cube", "centre": centre, "circumradius": edge * math.sqrt(3) / 2 * (1 - shrunk),
            "material": material, **more}


def scene(solids, light=(3, -4, 6)):
    return {"hedron": 1, "image": {"width": 48, "height": 36, "samples": 1, "depth": 12},
            "camera": {"field_of_view": 40, "eye": [4.1, -5.3, 2.4]}, "background": [0.1, 0.15, 0.25],
            "materials": {"glass": {"colour": [0.9, 0.95, 1], "diffuse": 0.1, "reflection": 0.1, "transmission": 0.8,
                                    "inner_reflection": 0.3, "inner_transmission": 0.6},
                          "red": {"colour": [1, 0.5, 0.4], "diffuse": 0.1, "reflection": 0.1, "transmission": 0.7},
                          "clear": {"reflection": 0.08, "transmission": 0.9, "index_of_refraction": 1.5},
                          "ground": {"diffuse": 0.7, "reflection": 0.15}},
            "solids": solids, "lights": [{"position": light, "intensity": 0.8}],
            "floor": {"corners": [[-6, 6, -1], [6, 6, -1], [6, -6, -1], [-6, -6, -1]], "material": "ground",
                      "texture": {"file": "builtin:floor"}}}


lit = {"edge_lights": {"per_edge": 2, "colours": [[1, 0.3, 0.2]], "intensity": 0.05, "disc_radius": 0.06,
                       "disc_radiance": 2}}
for suffix, gap in (("", 0.0), ("-gap", 1e-6)):
    for name, content in {
            "refracting": scene([cube([0, 0, gap], 2, "clear", **lit)]),
            "stack": scene([cube([0, 0, gap], 2, "glass", rotation=[0, 0, 31]),
                            cube([0, 0, 1.5 + 2 * gap], 1, "red", rotation=[0, 0, 31])]),
            "nested": scene([cube([0, 0, 0.2], 2, "glass"), cube([0.5 - gap, 0.5 - gap, 0.7 - gap], 1, "red")]),
            "one-level": scene([cube([-0.5, 0, 0.2], 2, "glass"), cube([0.5, 0.3, 0.2], 2, "red", gap)]),
            "light": scene([cube([0, 0, 0.2], 2, "glass", gap)], light=(0.3, -1, 0.6))}.items():
        json.dump(content, open(f"{name}{suffix}.json", "w", encoding="utf-8"))
END

for precision in float double; do
    for name in refracting stack nested one-level light; do
        for suffix in '' -gap; do
            expect_exit 0 "$hedron" render "$name$suffix.json" --quiet --backend c --precision "$precision" \
                -o "$name$suffix.pfm"
        done
        "$hedron" compare --json "$name.pfm" "$name-gap.pfm" >compared.json || true
        if ! jq -e '.display.largest <= 1' compared.json >"$logs/jq"; then
            fail "$name, $precision: touching and apart by a millionth differ: $(jq -c .display compared.json)"
        fi
    done
done
finish
