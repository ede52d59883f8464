#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Wrong scene files: exit code 2, a message that names the file and the place, no file; and notes on unusual settings. The unit
# tests cover every kind of mistake (input).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

command -v jq >"$logs/which" || skip "there is no jq"
make_texture floor.data
cat >good.json <<'JSON'
{
  "hedron": 1,
  "image": {"width": 8, "height": 8, "samples": 1, "depth": 1},
  "camera": {"field_of_view": 50, "frames": 3, "eye": [4, -3, 2], "target": [0, 0, 0]},
  "materials": {"glass": {"colour": [0.8, 0.9, 1], "diffuse": 0.5, "reflection": 0.3, "transmission": 0.5},
                "stone": {"diffuse": 0.8}},
  "solids": [
    {"kind": "cube", "circumradius": 1, "material": "glass", "rim": {"width": 0.1, "material": "stone"}},
    {"kind": "octahedron", "centre": [5, 0, 0], "circumradius": 1, "material": "glass"}
  ],
  "lights": [{"position": [3, -4, 5]}],
  "floor": {"corners": [[-5, 5, -1], [5, 5, -1], [5, -5, -1], [-5, -5, -1]], "material": "glass",
            "texture": {"file": "floor.data"}}
}
JSON
render=("$hedron" render --backend c --frames 0 --quiet -o picture.data)

# refuse WHAT...: bad.json is refused, with each of these in the message; 'render' prints the same and makes no file.
refuse() {
    local what
    expect_exit 2 timeout "$time_limit" "$hedron" check bad.json
    for what in "$@"; do
        expect_stderr_contains "$what"
    done
    expect_stdout_lines 0
    grep -q -E '^hedron: (cannot read the scene )?bad\.json' "$logs/stderr" || fail 'the message names no file'
    cp "$logs/stderr" "$work/checked"
    expect_exit 2 timeout "$time_limit" "${render[@]}" bad.json
    expect_stdout_lines 0
    expect_same "$logs/stderr" "$work/checked"
}

# wrong FILTER WHAT...: the good scene after a change by jq is refused.
wrong() {
    jq "$1" good.json >bad.json
    refuse "${@:2}"
}

expect_exit 0 "${render[@]}" good.json
expect_data picture.data 8 8
rm picture.data

# ---- no file, no text, no JSON
expect_refusal 2 "${render[@]}" missing.json
expect_stderr_contains 'cannot read the scene missing.json'
expect_refusal 2 "${render[@]}" .
expect_refusal 2 "${render[@]}" ''
: >bad.json
refuse 'bad.json is empty'

# ---- a key, a value, relations between values, and all of it at once
wrong '.image.widht = 1' 'bad.json: image.widht is an unknown key; did you mean "width"?'
wrong '.image.width = 0 | .solids[1].circumradius = -1' 'bad.json: 2 problems' '  image.width is 0' \
    '  solids[1].circumradius is -1'
wrong '.materials.glass.index_of_refraction = 1.5 | .materials.plain = {} | .floor.material = "plain" |
    .solids[1].centre = [0.5,0,0]' 'solids[0] (cube): it refracts and overlaps solids[1] (octahedron)'
wrong '.floor.texture.file = "missing.png"' 'bad.json: floor.texture.file: cannot read the texture missing.png'

# ---- one picture for many frames: a rendering may choose one
jq '.output.path = "picture.data"' good.json >bad.json
expect_exit 2 "$hedron" check bad.json
expect_stderr_contains 'bad.json: output.path is "picture.data", which names one picture, but camera.frames is 3'
expect_exit 0 "$hedron" render --backend c --frames 0 --quiet bad.json
rm picture.data

# ---- an unusual setting gives a note, not an error
jq '.materials.paper = {} | .output.path = "film.mp4" | .output.bits = 16' good.json >bad.json
expect_exit 0 "$hedron" check bad.json
expect_silent_stderr
expect_stdout_lines 4 'bad\.json: (fine, .*|note: .*)'
expect_stdout_contains 'bad.json: note: output.bits is 16, but output.path is a film, which has 8 bits a channel'
expect_stdout_contains 'bad.json: note: materials.paper is used nowhere'
expect_stdout_contains 'bad.json: note: solids[1] touches the floor'

# ---- one kind of input for the other
cp "$cli_folder/official.in" bad.json
refuse 'bad.json: this looks like a classic input'
expect_refusal 2 "$hedron" convert good.json
expect_stderr_contains 'good.json: this looks like a scene file'
expect_refusal 2 "$hedron" --cpu <good.json
expect_stderr_contains 'standard input: this looks like a scene file'

# ---- a scene on standard input: textures count from the current folder
mkdir folder
mv good.json folder/piped.json
expect_exit 0 "$hedron" check - <folder/piped.json
expect_stdout_contains 'standard input: fine, 2 solids'
expect_exit 2 "$hedron" check --set image.width=0 - <folder/piped.json
expect_stderr_contains 'image.width is 0'
expect_exit 0 "${render[@]}" - <folder/piped.json
expect_data picture.data 8 8
expect_refusal 2 "${render[@]}" - < <(jq '.image.width = 0' folder/piped.json)
expect_stderr_contains 'hedron: standard input: image.width is 0'
rm -r picture.data folder bad.json
expect_files . floor.data

# ---- no message quotes a file that is not a scene
echo 'root:secret:0:0' >secrets
expect_refusal 2 "$hedron" check secrets
expect_stderr_contains 'secrets is not a scene: expected the ending .json or text that begins with {'
! grep -q -e root -e secret: "$logs/stderr" || fail 'a message quotes the file'
printf 'solid teapot' >teapot.stl
expect_refusal 2 "$hedron" render teapot.stl
expect_stderr_contains 'teapot.stl is a mesh by its ending'
finish
