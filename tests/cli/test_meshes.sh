#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Meshes of scene files: their files, materials and textures, and the same bytes whichever way.
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
# A hilly sheet of 1800 triangles.
awk 'BEGIN {
    n = 30
    for (y = 0; y <= n; y++)
        for (x = 0; x <= n; x++)
            printf "v %g %g %g\n", x / 5 - 3, y / 5 - 3, 0.3 * sin(x / 2) * cos(y / 3)
    for (y = 0; y < n; y++)
        for (x = 1; x <= n; x++) {
            a = y * (n + 1) + x
            printf "f %d %d %d %d\n", a, a + 1, a + n + 2, a + n + 1
        }
}' >models/hills.obj
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
     "crease": 100},
    {"file": "models/hills.obj", "position": [0, 0, -1.5], "material": "clay", "normals": "smooth"}
  ],
  "lights": [{"position": [3, -6, 8]}]
}
JSON

# render FILE OPTION...: one picture.
render() {
    local out=$1
    shift
    expect_exit 0 "$hedron" render --quiet --backend c -o "$out" "$@"
    expect_silent_stderr
    expect_data "$out" 32 24
}

# ---- what is there
expect_exit 0 "$hedron" check cubes.json
expect_silent_stderr
expect_stdout_lines 1 \
    'cubes\.json: fine, 0 solids, 3 meshes of 1824 triangles in 4 places, 1 light, 1 frame'
expect_exit 0 "$hedron" render --verbose --backend c cubes.json -o all.data
expect_stderr_contains \
    'meshes    3 with 1824 triangles, and 2 without an area left out; in 4 places, 1 texture'

# ---- the same bytes for every number of lanes, and for entries that share a mesh or have copies of their own
cp models/cube.obj models/copy.obj
for options in --lanes=1 "--lanes=$(lanes_there float | tail -n 1)" --set=meshes[1].file=models/copy.obj; do
    render other.data cubes.json "$options"
    expect_same other.data all.data
done
# Files count from the folder of the scene, wherever one stands.
cd models
render ../other.data ../cubes.json
cd ..
expect_same other.data all.data

# ---- every key is seen
for change in 'meshes[1].position=[-2, 0, 1]' 'meshes[1].rotation=[0, 0, 0]' 'meshes[1].scale=0.5' \
    'meshes[2].normals=flat' 'meshes[2].crease=10' 'meshes[0].material=clay' 'meshes[3].file=models/cube.obj'; do
    render changed.data cubes.json --set "$change"
    expect_different changed.data all.data
done

# ---- without the texture the colour stays, and it is told
mv models/picture.png picture.png
expect_exit 0 "$hedron" render --backend c cubes.json -o plain.data
expect_stderr_contains 'hedron: cannot read the texture models/picture.png'
expect_different plain.data all.data
render plain.data cubes.json
expect_exit 0 "$hedron" check cubes.json
expect_stdout_lines 2
expect_stdout_contains 'cubes.json: note: cannot read the texture models/picture.png'

# ---- what is wrong
refuse() {
    expect_refusal 2 "$hedron" render --backend c cubes.json -o wrong.data --set "$1"
    expect_stderr_contains "$2"
}
refuse meshes[0].file=no.obj 'cubes.json: meshes[0].file: cannot read the mesh no.obj: No such file'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >models/wrong.obj
refuse meshes[3].file=models/wrong.obj 'meshes[3].file: models/wrong.obj: line 4: '

rm ./*.data ./*.png
expect_files . cubes.json models models/copy.obj models/cube.mtl models/cube.obj models/hills.obj models/wrong.obj
finish
