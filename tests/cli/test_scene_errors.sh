#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Wrong scene files: exit code 2, a message that names the place, no file.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

if ! command -v jq >"$logs/which"; then
    skip "there is no jq"
fi
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
render=("$hedron" render --backend c --frames 0 -o picture.data)

# refuse WHAT: bad.json is refused by both commands, with this in the message; the file's name begins it.
refuse() {
    local command
    for command in render check; do
        if [[ $command == render ]]; then
            expect_exit 2 timeout 20 "${render[@]}" bad.json
        else
            expect_exit 2 timeout 20 "$hedron" check bad.json
        fi
        expect_stderr_contains "$1"
        expect_stderr_contains bad.json
        expect_stdout_lines 0
        if ! grep -q '^hedron: ' "$logs/stderr"; then
            fail "the message does not begin with the program's name"
        fi
    done
}

# wrong FILTER WHAT...: the good scene after a change by jq; each WHAT is in the message.
wrong() {
    local what
    jq "$1" good.json >bad.json
    shift
    for what in "$@"; do
        refuse "$what"
    done
}

expect_exit 0 "${render[@]}" --quiet good.json
expect_data picture.data 8 8
rm picture.data

# ---- no file, no text, no JSON
expect_refusal 2 "${render[@]}" missing.json
expect_stderr_contains missing.json
expect_refusal 2 "${render[@]}" .
expect_refusal 2 "${render[@]}" ''
: >bad.json
refuse 'empty'
printf ' \n' >bad.json
refuse bad.json
for bytes in 1 20 200 500; do
    head -c "$bytes" good.json >bad.json
    refuse bad.json
done
{
    cat good.json
    echo '{}'
} >bad.json
refuse bad.json
head -c 3000 /dev/zero >bad.json
refuse 'zero byte'
head -c 3000 /dev/urandom >bad.json
refuse bad.json
printf '{"hedron": 1, "h\xe9dron": 1}' >bad.json
refuse bad.json
head -c 100000 /dev/zero | tr '\0' '[' >bad.json
refuse bad.json
truncate -s 70M bad.json
refuse bytes
for value in NaN Infinity -Infinity nan inf 1e999 0x10 .5 01 '1,'; do
    sed "s/\"field_of_view\": 50/\"field_of_view\": $value/" good.json >bad.json
    refuse bad.json:
done
sed 's/"samples": 1/"samples": 1, "samples": 2/' good.json >bad.json
refuse samples

# ---- wrong types, missing and unknown keys
for value in null true '"50"' '[]' '{}'; do
    wrong ".camera.field_of_view = $value" camera.field_of_view
    wrong ".image.width = $value" image.width
    wrong ".solids[1].circumradius = $value" 'solids[1].circumradius'
done
for value in null 1 '"x"' '{}' '[1,2]' '[1,2,3,4]' '[1,2,"3"]'; do
    wrong ".solids[0].centre = $value" 'solids[0].centre'
done
wrong '.image = []' image
wrong '.solids = {}' solids
wrong '[.]' bad.json
wrong 'del(.hedron)' hedron
wrong '.hedron = 2' hedron
wrong 'del(.camera)' camera
wrong 'del(.camera.eye)' 'camera'
wrong 'del(.solids[0].kind)' 'solids[0]'
wrong '.solids[0].kind = "sphere"' 'solids[0].kind' 'icosahedron'
wrong '.solids[0].material = "gold"' 'solids[0].material' 'gold'
wrong '.solids[0].radius = 1' 'solids[0].radius'
wrong '.image.widht = 1' 'image.widht' '"width"'

# ---- values out of range
for value in 0 -1 65536 1e30 1.5; do
    wrong ".image.width = $value" image.width
    wrong ".image.height = $value" image.height
done
for value in 0 65 -1; do
    wrong ".image.samples = $value" image.samples
done
for value in -1 1001; do
    wrong ".image.depth = $value" image.depth
done
for value in 0 -10 179.5 180 1e300; do
    wrong ".camera.field_of_view = $value" camera.field_of_view
done
for value in 0 -1 10000001; do
    wrong ".camera.frames = $value" camera.frames
done
for value in 0 -1 1e-13 1e13; do
    wrong ".solids[0].circumradius = $value" 'solids[0].circumradius'
done
for value in '[1.5,0,0]' '[0,-0.1,0]'; do
    wrong ".materials.glass.colour = $value" materials.glass.colour
done
wrong '.camera.eye = [0,0,0]' eye target
wrong '.materials.glass.reflection = 1.5' reflection
wrong '.materials.glass.reflection = 0.8' reflection transmission
wrong '.materials.glass.index_of_refraction = 0' index_of_refraction
wrong '.solids[0].rim.width = -1' 'solids[0].rim.width'
wrong '.solids[0].edge_lights = {"per_edge": 100000}' lights
wrong '.lights[0].intensity = -1' 'lights[0].intensity'
wrong '.lights[0].falloff_distance = 0' 'lights[0].falloff_distance'
wrong '.lights = [range(100001) | {"position": [0,0,1]}]' lights
wrong '.solids = [range(257) | {"kind": "cube", "material": "glass", "centre": [(. * 9), 0, 0]}]' solids
wrong '.output = {"bits": 9}' output.bits
wrong '.output = {"frames_per_second": 0}' output.frames_per_second

# ---- what values must be to each other
wrong '.floor.corners[1][2] = 3' floor
wrong '.floor.corners[1] = [5,-5,-1] | .floor.corners[2] = [5,5,-1]' floor
wrong '.floor.corners[1] = .floor.corners[0]' floor
wrong '.materials.glass.index_of_refraction = 1.5 | .solids[1].centre = [0.5,0,0]' 'solids[0]' 'solids[1]'
# Two that merely touch no glass may lie in each other.
jq '.solids[1].centre = [0.5,0,0]' good.json >bad.json
expect_exit 0 "$hedron" check bad.json
# All of it at once.
wrong '.image.width = 0 | .solids[1].circumradius = -1' '2 problems' image.width 'solids[1].circumradius'

# ---- textures
wrong '.floor.texture.file = "missing.png"' missing.png
wrong '.floor.texture.file = 7' floor.texture.file
head -c 20 floor.data >short.data
wrong '.floor.texture.file = "short.data"' short.data
printf 'no picture' >text.png
wrong '.floor.texture.file = "text.png"' text.png
{
    int32 65535
    int32 65535
    head -c 64 /dev/zero
} >large.data
wrong '.floor.texture.file = "large.data"' large.data
wrong '.floor.texture.curve = "gamma"' floor.texture.curve
rm short.data text.png large.data

# ---- outputs that do not suit
for path in a.png a_%d_%d.png a_%s.png '###_#.png' film_%d.mp4 a.jpg; do
    jq --arg path "$path" '.output.path = $path' good.json >bad.json
    expect_refusal 2 "$hedron" render --backend c bad.json
    expect_stderr_contains "$path"
done

rm bad.json
expect_files . floor.data good.json
finish
