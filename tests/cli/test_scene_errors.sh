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

# refuse WHAT...: bad.json is refused, with each of these in the message, which begins with the file's name.
refuse() {
    local what
    expect_exit 2 timeout "$patience" "$hedron" check bad.json
    for what in "$@"; do
        expect_stderr_contains "$what"
    done
    expect_stdout_lines 0
    if ! grep -q -E '^hedron: (cannot read the scene )?bad\.json' "$logs/stderr"; then
        fail "the message does not begin with the names of the program and the file"
        show_logs
    fi
}

# wrong FILTER WHAT...: the good scene after a change by jq is refused. What values may be is a matter of
# the unit tests; here is one of each class.
wrong() {
    jq "$1" good.json >bad.json
    shift
    refuse "$@"
}

# 'render' says the same as 'check' and makes no file.
render_says_the_same() {
    cp "$logs/stderr" "$work/checked"
    expect_exit 2 timeout "$patience" "${render[@]}" bad.json
    expect_stdout_lines 0
    expect_same "$logs/stderr" "$work/checked"
}

expect_exit 0 "${render[@]}" --quiet good.json
expect_data picture.data 8 8
rm picture.data

# ---- no file, no text, no JSON
expect_refusal 2 "${render[@]}" missing.json
expect_stderr_contains 'cannot read the scene missing.json'
expect_refusal 2 "${render[@]}" .
expect_refusal 2 "${render[@]}" ''
: >bad.json
refuse 'bad.json is empty'
render_says_the_same
printf ' \n' >bad.json
refuse 'bad.json:2:'
for bytes in 1 200; do
    head -c "$bytes" good.json >bad.json
    refuse 'bad.json:'
done
render_says_the_same
{
    cat good.json
    echo '{}'
} >bad.json
refuse 'end of file expected'
head -c 3000 /dev/zero >bad.json
refuse 'bad.json:1:1: there is a zero byte'
printf '\xd5\x9e\xff\x10\x80\xc3(\xf7{' >bad.json
refuse 'bad.json:1:'
printf '{"hedron": 1, "h\xe9dron": 1}' >bad.json
refuse 'bad.json:1:' 'byte 0xe9'
head -c 100000 /dev/zero | tr '\0' '[' >bad.json
refuse 'bad.json:1:' 'expected at most 32'
truncate -s 70M bad.json
refuse 'cannot read the scene bad.json: it has 73400320 bytes'
for value in NaN 1e999 0x10 '1,'; do
    sed "s/\"field_of_view\": 50/\"field_of_view\": $value/" good.json >bad.json
    refuse 'bad.json:4:'
done
sed 's/"samples": 1/"samples": 1, "samples": 2/' good.json >bad.json
refuse 'bad.json:3:' 'duplicate object key' samples

# ---- wrong types, missing and unknown keys
wrong '.camera.field_of_view = null' 'bad.json: camera.field_of_view is null'
wrong '.image.width = "50"' 'bad.json: image.width is a string, "50"'
wrong '.solids[1].circumradius = {}' 'bad.json: solids[1].circumradius is an object'
wrong '.solids[0].centre = [1,2]' 'bad.json: solids[0].centre is an array of 2 elements'
wrong '.solids[0].centre = [1,2,"3"]' 'bad.json: solids[0].centre[2] is a string, "3"'
wrong '.image = []' 'bad.json: image is an array of 0 elements'
wrong '.solids = {}' 'bad.json: solids is an object'
wrong '[.]' 'bad.json: the scene is an array of 1 element'
wrong 'del(.hedron)' 'bad.json: hedron is missing'
wrong '.hedron = 2' 'bad.json: hedron is 2'
wrong 'del(.camera)' 'bad.json: camera is missing'
wrong 'del(.camera.eye)' 'bad.json: camera.eye is missing'
wrong 'del(.solids[0].kind)' 'bad.json: solids[0].kind is missing'
wrong '.solids[0].kind = "sphere"' 'bad.json: solids[0].kind is a string, "sphere"' '"icosahedron"'
wrong '.solids[0].material = "gold"' 'bad.json: solids[0].material is a string, "gold"'
wrong '.solids[0].radius = 1' 'bad.json: solids[0].radius is an unknown key'
render_says_the_same
wrong '.image.widht = 1' 'bad.json: image.widht is an unknown key; did you mean "width"?'

# ---- values out of range
wrong '.image.width = 0' 'bad.json: image.width is 0'
wrong '.image.height = 1.5' 'bad.json: image.height is 1.5'
wrong '.camera.field_of_view = 179.5' 'bad.json: camera.field_of_view is 179.5'
wrong '.solids[0].circumradius = 1e13' 'bad.json: solids[0].circumradius is 1e13'
wrong '.materials.glass.colour = [1.5,0,0]' 'bad.json: materials.glass.colour[0] is 1.5'
wrong '.materials.glass.index_of_refraction = 0' 'bad.json: materials.glass.index_of_refraction is 0'
wrong '.solids[0].rim.width = -1' 'bad.json: solids[0].rim.width is -1'
wrong '.lights[0].intensity = -1' 'bad.json: lights[0].intensity is -1'
wrong '.lights[0].falloff_distance = 0' 'bad.json: lights[0].falloff_distance is 0'
wrong '.lights = [range(100001) | {"position": [0,0,1]}]' 'bad.json: lights has 100001 elements'
wrong '.solids = [range(257) | {"kind": "cube", "material": "glass", "centre": [(. * 9), 0, 0]}]' \
    'bad.json: solids has 257 elements'
wrong '.output = {"bits": 9}' 'bad.json: output.bits is 9'

# ---- what values must be to each other
wrong '.camera.eye = [0,0,0]' 'bad.json: camera: ' eye target
wrong '.materials.glass.reflection = 0.8' \
    'bad.json: materials.glass: reflection + transmission is 1.3, expected at most 1'
render_says_the_same
wrong '.materials["my glass"] = {"transmission": 0.5, "inner_reflection": 0.75}' \
    'bad.json: materials["my glass"]: inner reflection + transmission is 1.25, expected at most 1'
wrong '.solids[0].rim.material = "glass"' 'bad.json: solids[0].rim: transmission is 0.5'
wrong '.solids[0].edge_lights = {"per_edge": 100000}' \
    'bad.json: solids[0]: edge_lights.per_edge is 100000, which makes 1200000 lights on its 12 edges'
wrong '.floor.corners[1][2] = 3' 'bad.json: floor: its diagonals pass each other'
wrong '.floor.corners[1] = [5,-5,-1] | .floor.corners[2] = [5,5,-1]' 'bad.json: floor: '
wrong '.floor.corners[1] = .floor.corners[0]' 'floor: corner 1 is not a convex corner'
wrong '.materials.glass.index_of_refraction = 1.5 | .materials.plain = {} | .floor.material = "plain" |
    .solids[1].centre = [0.5,0,0]' 'solids[0] (cube): it refracts and overlaps solids[1] (octahedron)'
# Two that merely touch no glass may lie in each other.
jq '.solids[1].centre = [0.5,0,0]' good.json >bad.json
expect_exit 0 "$hedron" check bad.json
# All of it at once.
wrong '.image.width = 0 | .solids[1].circumradius = -1' 'bad.json: 2 problems' '  image.width is 0' \
    '  solids[1].circumradius is -1'
render_says_the_same

# ---- textures
wrong '.floor.texture.file = 7' 'bad.json: floor.texture.file is 7'
wrong '.floor.texture.curve = "gamma"' 'bad.json: floor.texture.curve is a string, "gamma"'
wrong '.floor.texture.file = "missing.png"' 'bad.json: floor.texture.file: cannot read the texture missing.png'
render_says_the_same
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
rm short.data text.png large.data

# ---- one picture for many frames: a rendering may choose one
jq '.output.path = "picture.data"' good.json >bad.json
refuse 'bad.json: output.path is "picture.data", which names one picture, but camera.frames is 3'
expect_exit 0 "$hedron" render --backend c --frames 0 --quiet bad.json
rm picture.data
jq '.output.path = "####.data"' good.json >bad.json
expect_exit 0 "$hedron" check bad.json

# ---- films and what they can say
wrong '.output.path = "film.gif" | .output.curve = "linear"' \
    'output.path: film.gif cannot be linear, for a GIF has no way to say so'
jq '.output.path = "film.mp4" | .output.bits = 16' good.json >bad.json
expect_exit 0 "$hedron" check bad.json
expect_stdout_contains 'bad.json: note: output.bits is 16, but output.path is a film, which has 8 bits a channel'

# ---- what is seldom meant is a note, and no mistake
jq '.camera.field_of_view = 1.2 | .materials.paper = {}' good.json >bad.json
expect_exit 0 "$hedron" check bad.json
expect_silent_stderr
expect_stdout_lines 4 'bad\.json: (fine, .*|note: .*)'
expect_stdout_contains 'bad.json: note: materials.paper is used nowhere'
expect_stdout_contains 'bad.json: note: solids[1] touches the floor'
expect_exit 2 "$hedron" check bad.json missing.json
expect_stdout_lines 4

# ---- one kind of input for the other
cp "$cli_folder/official.in" bad.json
refuse 'bad.json: this looks like a classic input'
expect_refusal 2 "$hedron" convert good.json
expect_stderr_contains 'good.json: this looks like a scene file'
expect_refusal 2 "$hedron" --cpu <good.json
expect_stderr_contains 'standard input: this looks like a scene file'

# ---- a scene on standard input: textures count from the current folder
mkdir folder
jq . good.json >folder/piped.json
expect_exit 0 "$hedron" check - <folder/piped.json
expect_stdout_contains 'standard input: fine, 2 solids'
expect_exit 0 "${render[@]}" --quiet - <folder/piped.json
expect_data picture.data 8 8
rm -r picture.data folder
jq '.image.width = 0' good.json >bad.json
expect_refusal 2 "${render[@]}" - <bad.json
expect_stderr_contains 'hedron: standard input: image.width is 0'
expect_refusal 2 "$hedron" check - </dev/null
expect_stderr_contains 'standard input is empty'

# ---- outputs that do not suit
for path in a.png a_%d_%d.png a_%s.png '###_#.png' film_%d.mp4 a.jpg; do
    jq --arg path "$path" '.output.path = $path' good.json >bad.json
    expect_refusal 2 "$hedron" render --backend c bad.json
    expect_stderr_contains "$path"
done

rm bad.json
expect_files . floor.data good.json
# ---- nothing is told of what is in a file that is no scene
echo 'root:secret:0:0' >secrets
expect_refusal 2 "$hedron" check secrets
expect_stderr_contains 'secrets is no scene: neither has it the ending .json nor does it begin with {'
if grep -q -e root -e secret: "$logs/stderr"; then
    fail 'words of the file are told'
fi
mv secrets secrets.json
expect_refusal 2 "$hedron" check secrets.json
expect_stderr_contains "near 'root'"

finish
