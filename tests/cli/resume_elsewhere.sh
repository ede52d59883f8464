#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Another processor renders the same bytes, and continues runs, in both directions: pictures count as finished, and films
# consist of the same bytes as if one processor had made them. Arguments: this processor's program, the other's, and an
# emulator for it.
set -euo pipefail
elsewhere=$(realpath "$2")
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

here=("$hedron" render --backend c)
there=("${@:3}" "$elsewhere" render --backend c)
# A mesh, a texture and a refracting solid, so that all kinds of data are in the fingerprint.
cp "$project/scenes/"{knot.json,knot.obj,floor.png} .
picture=(knot.json --size 24x16 --samples 1 --depth 3)

expect_exit 0 "${here[@]}" "${picture[@]}" --frames 0-1 -o 'a/%d.png'
expect_exit 0 "${there[@]}" "${picture[@]}" --frames 0-2 -o 'a/%d.png'
expect_stderr_contains 'hedron: 2 of 3 frames were finished already'
expect_exit 0 "${here[@]}" "${picture[@]}" --frames 0-2 -o 'b/%d.png'
expect_exit 0 diff -r a b

# Scenes of all kinds, in both precisions and pipelines.
frame=(--size 12x8 --samples 1 --depth 4 --frames 0)
for scene in default five glass octahedron tunnel; do
    for kind in '--precision float' '--precision double --pipeline wavefront'; do
        # shellcheck disable=SC2086 # several words
        expect_exit 0 "${here[@]}" "$project/scenes/$scene.json" "${frame[@]}" $kind -o here.pfm
        # shellcheck disable=SC2086
        expect_exit 0 "${there[@]}" "$project/scenes/$scene.json" "${frame[@]}" $kind -o there.pfm
        expect_same here.pfm there.pfm
    done
done

# Formats of binary numbers, which this processor reads.
expect_exit 0 "${here[@]}" "${picture[@]}" --frames 0 --layers depth -o here.pfm -o here.exr
expect_exit 0 "${there[@]}" "${picture[@]}" --frames 0 --layers depth -o there.pfm -o there.exr
expect_same here.pfm there.pfm
expect_exit 0 "$hedron" compare here.exr there.exr
[[ $(grep -c identical "$logs/stdout") == 2 ]] || fail 'the OpenEXR pictures differ'

if has_ffmpeg; then
    film=(--size 16x16 --samples 1 --depth 1 --frames 0-69 -o film.mkv)
    expect_exit 0 "${here[@]}" "${film[@]}"
    mv film.mkv whole.mkv
    for order in 'here there' 'there here'; do
        declare -n first=${order% *} second=${order#* }
        stop_at_third TERM
        expect_exit 143 "${with_tools[@]}" "${first[@]}" "${film[@]}"
        expect_exit 0 "${second[@]}" "${film[@]}"
        expect_stderr_contains 'hedron: 60 of 70 frames were finished already'
        expect_same film.mkv whole.mkv
        rm film.mkv
    done
fi
finish
