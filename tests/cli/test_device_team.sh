#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Several devices that render together: --device all, or a list. The unit tests cover the meaning of a list and the division of
# frames (choice, render).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=${2:?the build folder is the second argument}
frames=("$hedron" render "${small[@]}" --frames 0-11)
films=()
! has_ffmpeg || films=(-o alone.mkv)
expect_exit 0 "${frames[@]}" --device c:0 -o alone/%d.data "${films[@]}"

expect_frames() { # the frames in the folder `together`, which is removed, equal those of one device
    expect_files together {0..11}.data
    for i in {0..11}; do
        expect_same "together/$i.data" "alone/$i.data"
    done
    rm -r together
}

# ---- invalid requests
expect_refusal 2 "${frames[@]}" --device c:0,c:0 -o together/%d.data
expect_stderr_contains "--device is 'c:0,c:0', "
expect_refusal 2 "$hedron" tune "${small[@]}" --device all
expect_stderr_contains "--device is 'all', expected one device"

# ---- a CPU by two backends
if has_opencl; then
    expect_exit 0 "${no_nvidia[@]}" "${frames[@]}" --device 'c:0,opencl:0' -o together/%d.data "${films[@]/alone/pair}" --verbose \
        --stats stats.jsonl
    for line in 'device +opencl 0, .*: named by --device.*' 'renderer +.* threads?, (mega|wavefront).*'; do
        (($(grep -c -x -E "$line" "$logs/stderr") == 1)) || fail "no line of --verbose is $line"
    done
    expect_frames
    (($(grep -c -E '"backend":"(c|opencl)","index":0' stats.jsonl) == 12)) || fail "the statistics do not name the devices"
    rm stats.jsonl
    if [[ -e alone.mkv ]]; then
        for film in alone pair; do
            expect_exit 0 ffmpeg -v error -i $film.mkv -f framemd5 $film.md5
        done
        expect_same alone.md5 pair.md5
        rm ./*.md5 pair.mkv
    fi
fi
rm -f alone.mkv

# ---- all: every device
expect_exit 0 "${frames[@]}" --device all -o together/%d.data --verbose
grep -q -E '^device +c 0, .*: one of all, by --device' "$logs/stderr" || fail 'plain C is not one of all'
! grep -q -E '^device +opencl .* CPU' "$logs/stderr" || fail 'the CPU is there twice'
expect_frames

# ---- a device that cannot be used, and one that fails: NVIDIA's driver is a fake
((failures == 0)) || finish
use_fake_cuda "$build"
no_compiler=(env HEDRON_NVRTC="$work/nothing.so")
expect_exit 0 "${no_compiler[@]}" "${frames[@]}" --device all -o together/%d.data
expect_stderr_contains 'hedron: cuda:0 (Fake device 0) is left out: '
expect_stderr_contains 'cannot be loaded as an NVRTC library'
expect_frames
expect_refusal 3 "${no_compiler[@]}" "${frames[@]}" --device cuda:0,c:0 -o together/%d.data

dropped='hedron: cuda:0 (Fake device 0) failed, so other devices trace its frames from here on: cuda: '
# Kernels that compute wrongly, as the self-test finds; with a cache this would be remembered and the device left out from the
# start.
expect_exit 0 env HEDRON_CACHE=off FAKE_NVRTC_WRONG=1 "${frames[@]}" --device cuda:0,c:0 -o together/%d.data --quiet --stats stats.jsonl
expect_sentence
expect_stderr_contains "${dropped}Fake device 0 (sm_61, driver for CUDA 12.8) computes wrongly"
expect_frames
(($(grep -c '"backend":"c"' stats.jsonl) == 12)) || fail "not all frames are of plain C"
# The device fails while it gets the scene.
expect_exit 0 env FAKE_CUDA_FAILS=cuMemcpyHtoDAsync "${frames[@]}" --math fast --device all -o together/%d.data --quiet
expect_sentence
expect_stderr_contains "${dropped}cuMemcpyHtoDAsync failed"
expect_frames
finish
