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
expect_stdout_lines 1 'cubes\.json: fine, 0 solids, 2 meshes of 24 triangles in 3 places, 1 light, 1 frame'
expect_exit 0 "$hedron" render --verbose --backend c cubes.json -o all.data
expect_stderr_contains 'meshes    2 with 24 triangles, and 2 without an area left out; in 3 places, 1 texture'

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

# ---- without the texture the colour stays, with a message
rm models/picture.png
expect_exit 0 "$hedron" render --backend c cubes.json -o plain.data
expect_stderr_contains 'hedron: cannot read the texture models/picture.png'
expect_different plain.data all.data
expect_exit 0 "$hedron" check cubes.json
expect_stdout_lines 2
expect_stdout_contains 'cubes.json: note: cannot read the texture models/picture.png'

# ---- notes of what coincides or lies within glass
echo '{"hedron": 1, "camera": {"eye": [0, -9, 0]}, "materials": {"m": {"transmission": 1, "index_of_refraction": 1.5}},
    "solids": [{"kind": "cube", "circumradius": 4, "material": "m"}, {"kind": "cube", "material": "m"}], "meshes": [{"file": "models/copy.obj", "material": "m"}, {"file": "models/copy.obj"}]}' >glass.json
expect_exit 0 "$hedron" check glass.json
for words in 'meshes: 1 of them is in the place' 'solids[1] lies within a solid' 'meshes[0] refracts and may be within solids[0]'; do
    expect_stdout_contains "glass.json: note: $words"
done

# ---- errors
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >models/wrong.obj
for words in 'no.obj: cannot read the mesh no.obj: No such file' 'models/wrong.obj: models/wrong.obj: line 4: '; do
    expect_refusal 2 "$hedron" render --backend c cubes.json -o wrong.data --set "meshes[1].file=${words%%:*}"
    expect_stderr_contains "meshes[1].file: ${words#*: }"
done
finish
