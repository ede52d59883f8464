#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Meshes of scene files: the reports on them, their files, materials and textures. The conformance suite and tests/reference
# check their pixels.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

mkdir models
{
    echo 'mtllib cube.mtl'
    printf 'v %s %s %s\n' -1 -1 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 1 1 -1 1 1 1 1 -1 1 1
    printf 'vt %s %s\n' 0 0 1 0 1 1 0 1
    printf 'usemtl picture\nf 5/1 6/2 7/3 8/4\nf 1/1 2/2 6/3 5/4\nf 2/1 3/2 7/3 6/4\n'
    printf 'usemtl red\nf 4 3 2 1\nf 3 4 8 7\nf 4 1 5 8\nf 1 1 2\n'
} >models/cube.obj
printf 'newmtl picture\nKd 1 1 1\nmap_Kd picture.png\nnewmtl red\nKd 1 0.2 0.2\nKs 0.4 0.4 0.4\nillum 3\n' >models/cube.mtl
expect_exit 0 "$hedron" render --backend c "${small[@]}" --frames 0 -o models/picture.png
cat >cubes.json <<'JSON'
{
  "hedron": 1,
  "image": {"width": 32, "height": 24, "samples": 2, "depth": 3},
  "camera": {"eye": [4, -7, 4]},
  "background": [0.1, 0.1, 0.2],
  "materials": {"clay": {"colour": [0.6, 0.5, 0.4], "diffuse": 0.9}},
  "meshes": [
    {"file": "models/cube.obj", "rotation": [0, 0, 20]},
    {"file": "models/cube.obj", "position": [-2.5, 0, 0.5], "rotation": [10, 0, 40], "scale": [0.5, 1, 0.75]},
    {"file": "models/cube.obj", "position": [2.5, 0, 0], "scale": 0.6, "material": "clay", "normals": "smooth",
     "crease": 100}
  ],
  "lights": [{"position": [3, -6, 8]}]
}
JSON

render() { # FILE SCENE OPTION...
    expect_exit 0 "$hedron" render --quiet --backend c -o "$@"
    expect_silent_stderr
    expect_data "$1" 32 24
}

# ---- the report on a mesh
expect_exit 0 "$hedron" check cubes.json
expect_silent_stderr
expect_stdout_lines 4
expect_stdout_contains 'cubes.json: fine, 0 solids, 2 meshes of 24 triangles in 3 places, 1 light, 1 frame'
expect_stdout_contains 'cubes.json: meshes[0], models/cube.obj: 12 triangles from [-1.281713, -1.281713, -1] to'\
' [1.281713, 1.281713, 1], 2 materials (picture, red), 1 texture; wholly in view in frame 0'
expect_stdout_contains 'meshes[2], models/cube.obj: 12 triangles from [1.9, -0.6, -0.6] to [3.1, 0.6, 0.6], 2 materials'\
' (picture, red), replaced by one of the scene, 1 texture; wholly in view in frame 0'
if command -v jq >"$logs/which"; then
    expect_exit 0 "$hedron" check --json cubes.json --set 'camera.target=[4,-9,4]'
    jq -e '.scenes[0].places | length == 3 and (.[2] == {"file": "models/cube.obj", "triangles": 12,
        "lower": [1.9, -0.6, -0.6], "upper": [3.1, 0.6, 0.6], "materials": ["picture", "red"], "replaced": true,
        "textures": 1, "view": "none"})' "$logs/stdout" >"$logs/jq" || fail "check --json tells other places"
fi
expect_exit 0 "$hedron" render --verbose --backend c cubes.json -o all.data
expect_stderr_contains 'meshes    2 with 24 triangles, and 2 without an area left out; in 3 places, 1 texture'
expect_stderr_contains 'mesh      meshes[0], models/cube.obj: 12 triangles from'

# ---- entries that share a mesh equal those with copies; files count from the scene's folder, not the current one
cp models/cube.obj models/copy.obj
render other.data cubes.json --set meshes[1].file=models/copy.obj
expect_same other.data all.data
cd models
render ../other.data ../cubes.json
cd ..
expect_same other.data all.data
render other.data cubes.json --set meshes[2].crease=10
expect_different other.data all.data

# ---- a scene for a mesh wherever it is: up is guessed, the camera on all of it, the name relative to the scene
mkdir scenes
expect_new() { # UP X Y Z: the scene of the cube, moved, with that axis up
    awk -v x="$2" -v y="$3" -v z="$4" '$1 == "v" { $2 += x; $3 += y; $4 += z } { print }' models/cube.obj >models/moved.obj
    expect_exit 0 "$hedron" new --mesh models/moved.obj scenes/moved
    expect_stdout_lines 1 'scenes/moved\.json'
    grep -q -F '"up": "'"$1"'"' scenes/moved.json || fail "up is not $1"
    expect_exit 0 "$hedron" check scenes/moved.json
    expect_stdout_contains "$PWD/models/moved.obj: 12 triangles from [-1, -1, 0] to [1, 1, 2], 2 materials (picture, red)"
    expect_stdout_contains 'wholly in view in frame 0'
    rm scenes/moved.json models/moved.obj
}
expect_new y 0 0 0
expect_new y -300 1 1
expect_new z 5 0 1
expect_new z 620000 5400000 300
expect_exit 0 "$hedron" new --mesh models/cube.obj --up z models/new
grep -q -F '"file": "cube.obj"' models/new.json || fail "the file is not that beside the scene"
grep -q -F '"up": "z"' models/new.json || fail "--up has no effect"
expect_refusal 2 "$hedron" new --mesh no.obj new
expect_stderr_contains 'hedron: cannot read the mesh no.obj'
expect_refusal 2 "$hedron" new --up z new
[[ ! -e new.json ]] || fail "'hedron new' left a file"
rm -r scenes models/new.json
# ---- holes everywhere: as if the mesh were not there, also for shadows; nowhere: as without them. Colours of vertices.
variant() { # NAME STATEMENT OPTION...: the second mesh with a material of this statement, changed by sed
    printf 'newmtl picture\n%s\n' "$2" >"models/$1.mtl"
    sed -e "s/cube.mtl/$1.mtl/" -e '/^usemtl red/d' -e '/^f . . . .$/d' "${@:3}" models/cube.obj >"models/$1.obj"
    render "$1.data" cubes.json --set "meshes[1].file=models/$1.obj"
}
render none.data cubes.json --set 'meshes[1].scale=1e-6'
variant opaque ''
for grey in 000 177 200 377; do
    printf '%b' "\\1\\0\\0\\0\\1\\0\\0\\0\\0$grey\\0$grey\\0$grey\\0377" >"models/mask$grey.data"
    variant "$grey" "map_d mask$grey.data"
    expect_same "$grey.data" "$([[ $grey == [01]* ]] && echo none.data || echo opaque.data)"
done
variant red 'Kd 1 0 0'
variant coloured '' -e 's/^v .*/& 1 0 0/'
expect_same coloured.data red.data
expect_different none.data opaque.data

# ---- without the texture the colour stays, with a message
rm models/picture.png
expect_exit 0 "$hedron" render --backend c cubes.json -o plain.data
expect_stderr_contains 'hedron: cannot read the texture models/picture.png'
expect_different plain.data all.data
expect_exit 0 "$hedron" check cubes.json
expect_stdout_lines 5
expect_stdout_contains 'cubes.json: note: cannot read the texture models/picture.png'

# ---- the same as an error
for command in check render; do
    expect_refusal 2 "$hedron" $command --strict-files cubes.json
    expect_stderr_contains 'cubes.json: meshes: cannot read the texture models/picture.png'
done

# ---- notes of what coincides or lies within glass
echo '{"hedron": 1, "camera": {"eye": [0, -9, 0]}, "materials": {"m": {"transmission": 1, "index_of_refraction": 1.5}},
    "solids": [{"kind": "cube", "circumradius": 4, "material": "m"}, {"kind": "cube", "material": "m"}], "meshes": [{"file": "models/cube.obj"}, {"file": "models/cube.obj"}, {"file": "models/copy.obj", "material": "m"}]}' >glass.json
expect_exit 0 "$hedron" check glass.json
for words in 'meshes: 1 of them is in the place' 'solids[1] lies in meshes[2] of index 1.5, the first of 2 such pairs: its own'; do
    expect_stdout_contains "glass.json: note: $words"
done
expect_stdout_contains 'meshes[0], models/cube.obj'
expect_stdout_contains 'meshes[2], models/copy.obj'
expect_exit 0 "$hedron" check glass.json --set 'meshes=[]'
expect_stdout_contains 'solids[1] lies in solids[0] of index 1.5: its own'

# ---- indices count against those around; a tiny stray triangle opens a mesh, so that they do not; two files are as one
part() { # MATERIAL SCALE FIRST: a cube of this material; its vertices count on from FIRST
    awk -v material="$1" -v scale="$2" -v first="$3" '/^v / { $2 *= scale; $3 *= scale; $4 *= scale; print }
        /^mtllib/ { print "mtllib glass.mtl\nusemtl " material }
        /^f . . . ./ { for (i = 2; i <= 5; i++) $i += first; print }' <(sed 's=/.==g' models/cube.obj)
}
printf 'newmtl %s\nd 0.1\nNi %s\n' outer 1.5 inner 1.125 divided 0.75 >models/glass.mtl
part outer 1 0 >models/outer.obj
part inner 0.5 0 >models/inner.obj
{ part divided 0.5 0; printf 'v %s .5 %s\n' .5 .499999 .499999 .5; echo f 7 9 10; } >models/divided.obj
{ part outer 1 0; part inner 0.5 8; } >models/both.obj
for name in inner divided both; do
    files=("{\"file\": \"models/$name.obj\"}" '{"file": "models/outer.obj"}')
    [[ $name == both ]] && unset 'files[1]'
    render "$name.data" cubes.json --set "meshes=[$(IFS=, && echo "${files[*]}")]" \
        --set 'solids=[{"kind": "cube", "centre": [-2, 4, -1], "circumradius": 2, "material": "clay"}]'
done
expect_same inner.data divided.data
expect_same inner.data both.data
sed -e '11iusemtl inner' -e '12iusemtl outer' models/outer.obj >models/mixed.obj
sed 's/^f \(.*\) \(.*\) \(.*\) \(.*\)/f \4 \3 \2 \1/' models/inner.obj >models/inverted.obj
for row in 'divided outer 0 lies in meshes[1], but meshes[0] is not closed, because' \
    'inner outer 0.6 and meshes[1] intersect or nearly touch' \
    'inverted outer 9 refracts, but is inside out, so it counts as a cavity' \
    'inner mixed 0 lies in meshes[1], which has several indices of refraction'; do
    read -r inner outer z words <<<"$row"
    expect_exit 0 "$hedron" check cubes.json --set \
        "meshes=[{\"file\": \"models/$inner.obj\", \"position\": [0, 0, $z]}, {\"file\": \"models/$outer.obj\"}]"
    expect_stdout_contains "cubes.json: note: meshes[0] $words"
done

# ---- errors
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >models/wrong.obj
for words in 'no.obj: cannot read the mesh no.obj: No such file' 'models/wrong.obj: models/wrong.obj: line 4: '; do
    expect_refusal 2 "$hedron" render --backend c cubes.json -o wrong.data --set "meshes[1].file=${words%%:*}"
    expect_stderr_contains "meshes[1].file: ${words#*: }"
done
finish
