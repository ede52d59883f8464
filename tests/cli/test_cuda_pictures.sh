#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Films and pictures by the CUDA backend, whose kernels a driver of the tests runs without a device: the
# same bytes as by plain C.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=${2:?the build folder is the second argument}
nvrtc=$build/tests/fake_cuda/libnvrtc.so.12
if [[ ! -e $nvrtc ]]; then
    skip "no compiler of C++ is here that could build the kernels"
fi
mkdir "$work/no_vendors"
export LD_LIBRARY_PATH=$build/tests/fake_cuda${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export HEDRON_CACHE=$work/cache HEDRON_NVRTC=$nvrtc OCL_ICD_VENDORS=$work/no_vendors

film=
if command -v ffmpeg >"$logs/which"; then
    film=film.mkv
fi

# expect_same_files: of the folders c and cuda, which are removed.
expect_same_files() {
    local file
    for file in c/*; do
        expect_same "$file" "cuda/${file#c/}"
    done
    rm -r c cuda
}

# expect_as_c OPTION...: of pictures and a film, which the device encodes, and of radiance, which it does
# not.
expect_as_c() {
    local backend
    for backend in c cuda; do
        expect_exit 0 "$hedron" render --backend $backend --frames 0-3 --quiet -o $backend/%d.png \
            ${film:+-o $backend/$film} "$@"
        expect_silent_stderr
        expect_exit 0 "$hedron" render --backend $backend --frames 0-3 --quiet -o $backend/%d.pfm "$@"
        expect_silent_stderr
        if [[ -n $film ]]; then
            expect_exit 0 ffmpeg -v error -i $backend/$film -f framemd5 $backend/film.md5
            rm $backend/$film
        fi
    done
    expect_same_files
}

expect_as_c --size 48x36
expect_as_c --size 48x36 --pipeline wavefront
expect_as_c --size 48x36 --aa adaptive --set output.curve=linear

# ---- more objects than the device's constant memory has room for
jq '.solids = [range(17) | {kind: "tetrahedron", centre: [. % 6 - 2.5, . / 6 - 1, 0], circumradius: 0.6, material: "glass"}]' \
    "$project/bench/scenes/few.json" >many.json
for backend in c cuda; do
    expect_exit 0 "$hedron" render many.json --size 48x36 --samples 1 --frames 0 --backend $backend --quiet -o $backend/%d.pfm
done
expect_same_files
rm many.json

# ---- classic mode
for backend in c cuda; do
    expect_exit 0 "$hedron" --backend $backend "${small[@]}" --frames 0-3 <<<"$("$hedron" --default)"
    mv out $backend
done
expect_same_files

expect_files .
finish
