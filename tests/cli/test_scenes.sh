#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Scene files: rendering them, changing values, checking, and converting classic inputs.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
mkdir scenes
make_texture scenes/floor.data
cat >scenes/cube.json <<'JSON'
{
  "hedron": 1,
  "image": {"width": 32, "height": 24, "samples": 1, "depth": 2},
  "camera": {"field_of_view": 50, "frames": 3, "eye": {"r0": 5, "z0": 2, "phi_frequency": 1}},
  "output": {"path": "out/###.png"},
  "materials": {"glass": {"colour": [0.8, 0.9, 1], "diffuse": 0.5, "reflection": 0.3, "transmission": 0.5}},
  "solids": [{"kind": "cube", "circumradius": 1.2, "material": "glass",
              "edge_lights": {"per_edge": 2, "intensity": 0.1, "disc_radius": 0.1, "disc_radiance": 2}}],
  "lights": [{"position": [3, -4, 5]}],
  "floor": {"corners": [[-5, 5, -2], [5, 5, -2], [5, -5, -2], [-5, -5, -2]], "material": "glass",
            "texture": {"file": "floor.data"}}
}
JSON

# render OPTION...
render() {
    expect_exit 0 "$hedron" render --quiet --backend c "$@"
    expect_silent_stderr
}

# ---- the scene names the output; the texture lies beside it, whatever the current folder
render scenes/cube.json
expect_stdout_lines 1 'out/###\.png'
expect_files out 000.png 001.png 002.png
expect_png out/002.png 32 24
expect_different out/000.png out/001.png
cd scenes
render cube.json --frames 1 -o ../here.png
cd ..
expect_same here.png out/001.png
rm -r here.png out

# ---- options come before the scene or after it, and over its values, which --set changes, too
render --size 33x25 scenes/cube.json --frames 0 -o a.data
expect_data a.data 33 25
render scenes/cube.json --frames 0 -o b.data --set image.width=99 --size 33x25 --set image.height=99
expect_same a.data b.data
render scenes/cube.json --set output.path=set.pfm --set camera.frames=1
expect_stdout_lines 1 'set\.pfm'
rm ./*.*
expect_exit 2 "$hedron" render scenes/cube.json --frames 0 -o a.png --set camera.feild_of_view=40
expect_stderr_contains scenes/cube.json
expect_stderr_contains '"field_of_view"'
expect_stdout_lines 0
expect_files . scenes scenes/cube.json scenes/floor.data

# ---- 'check'
expect_exit 0 "$hedron" check scenes/cube.json
expect_silent_stderr
expect_stdout_lines 1 'scenes/cube\.json: fine, 1 solid, 25 lights, 3 frames'
sed 's/1.2/-1.2/; s/: 50/: 500/' scenes/cube.json >scenes/both.json
# Each of several is checked.
expect_exit 2 "$hedron" check scenes/both.json scenes/cube.json missing.json
expect_stdout_lines 1 'scenes/cube\.json: fine, .*'
for words in 'scenes/both.json: 2 problems' 'circumradius is -1.2' 'field_of_view is 500' missing.json '2 of 3 scenes are wrong'; do
    expect_stderr_contains "$words"
done
if command -v jq >"$logs/which"; then
    expect_exit 2 "$hedron" check --json scenes/cube.json scenes/both.json missing.json
    jq -e '.scenes | map(.scene) == ["scenes/cube.json", "scenes/both.json", "missing.json"]
        and map(.fine) == [true, false, false] and .[0].lights == 25 and .[0].frames == 3
        and .[0].problems == [] and (.[1].problems | length == 2 and any(startswith("camera.field_of_view")))
        and (.[2].problems | length == 1)' "$logs/stdout" >"$logs/jq" || fail 'check --json says otherwise'
else
    echo "not tested: the output of 'check --json', because jq is missing"
fi
sed 's/"depth"/"exposure": 1e-6, "depth"/' scenes/cube.json >scenes/both.json
expect_exit 0 "$hedron" check scenes/both.json
expect_stdout_lines 2 '.*/both\.json: (fine, .*|note: all that is in view in frame 0 is nearly black: image\.exposure is 1e-06, .*)'
rm scenes/both.json
# Complete scenes in the documents, which give no note either, and the supplied ones.
awk -v folder="$PWD" '/^```json/ { text = "\n"; next }
    /^```/ { if (text ~ /"hedron": 1/) printf "%s", text >(folder "/manual" ++count ".json"); text = "" }
    text != "" { text = text $0 "\n" }' "$cli_folder"/../../docs/*.md "$cli_folder"/../../docs/reference/*.md
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >teapot.obj # stands for one
cp scenes/floor.data .
manuals=(manual*.json)
expect_exit 0 "$hedron" check "${manuals[@]}"
expect_stdout_lines ${#manuals[@]} 'manual.*\.json: fine, .*'
rm ./*.*
ours=("$cli_folder"/../../scenes/*.json)
expect_exit 0 "$hedron" check "${ours[@]}"
expect_silent_stderr
expect_stdout_lines $((${#ours[@]} + 1)) '.*\.json: fine, .*|.*knot\.json: meshes\[0\], .*'
expect_exit 0 "$hedron" check --schema
expect_silent_stderr
expect_stdout_contains 'https://json-schema.org/draft/2020-12/schema'

# ---- 'convert': the same bytes as the classic mode, texture and all
classic=(--size 33x25 --samples 1 --depth 3 --frames 5)
# expect_converted INPUT FILE SCENE [OPTION...]: of the file that the classic mode writes.
expect_converted() {
    local input=$1 file=$2 scene=$3
    shift 3
    expect_exit 0 "$hedron" --cpu "${classic[@]}" "$@" <"$input"
    mv "$file" classic.data
    expect_exit 0 "$hedron" convert "$input" -o "$scene" "$@"
    expect_stdout_lines 0
    expect_silent_stderr
    render "$scene" "${classic[@]}" -o scene.data
    expect_same scene.data classic.data
    rm -r classic.data out
}
expect_converted "$work/official.in" out/img_5.data new/converted.json --variant 10
expect_exit 0 "$hedron" convert --variant 10 <"$work/official.in"
expect_silent_stderr
expect_same "$logs/stdout" new/converted.json
# Of the output and of the texture: the classic mode knows no other curve.
(($(grep -c '"curve": "linear"' new/converted.json) == 2)) || fail 'the curves are not linear'
# Output without an extension, which the classic mode writes in the data format, has one in the scene.
sed "s|out/img_%d.data|out/img_%d.mp4|" "$work/official.in" >bare.in
expect_exit 0 "$hedron" convert bare.in -o bare.json
render bare.json "${classic[@]}"
expect_files out img_5.mp4.data
rm -r out
# A texture keeps its place when the scene moves to another folder; a name that begins with ~ is no home folder.
mkdir '~near'
cp scenes/floor.data '~near'
for name in scenes/floor.data '~near/floor.data'; do
    sed "s|~/floor.data|$name|" "$work/official.in" >near.in
    expect_converted near.in out/img_5.data far/near.json
done
# The built-in configuration, with the built-in texture.
"$hedron" --default >default.in
expect_exit 0 "$hedron" --cpu "${classic[@]}" <default.in
expect_exit 0 "$hedron" convert default.in -o default.json
render default.json "${classic[@]}" -o json.png
expect_exit 0 "$hedron" compare --json json.png out/frame_5.png
expect_stdout_contains '"identical": true'
rm -r out far new '~near' ./*.*

# A failure makes no file, and leaves an old one.
printf 'old' >old.json
head -c 300 "$work/official.in" >short.in
expect_refusal 2 "$hedron" convert short.in -o old.json
expect_stderr_contains short.in
expect_refusal 2 "$hedron" convert missing.in -o new.json
expect_stderr_contains missing.in
expect_refusal 2 "$hedron" convert </dev/null
expect_refusal 1 "$hedron" convert "$work/official.in" -o old.json/new.json
expect_stderr_contains old.json
expect_refusal 2 "$hedron" convert "$work/official.in" -o scenes
expect_stderr_contains scenes
[[ $(cat old.json) == old ]] || fail "'hedron convert' wrote over a file"
rm old.json short.in

# ---- a scene to start from, which is never written over another
expect_exit 0 "$hedron" new first
expect_stdout_lines 1 'first\.json'
expect_same first.json "$project/scenes/starter.json"
printf 'mine' >first.json
expect_refusal 2 "$hedron" new first.json
expect_stderr_contains 'first.json exists already'
[[ $(cat first.json) == mine ]] || fail "'hedron new' wrote over a file"
expect_refusal 1 "$hedron" new missing/first
rm first.json

expect_files . scenes scenes/cube.json scenes/floor.data
finish
