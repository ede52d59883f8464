#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Several devices that render together: --device all, or a list.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=${2:?the build folder is the second argument}
frames=("$hedron" render "${small[@]}" --frames 0-11)
expect_exit 0 "${frames[@]}" --device c:0 -o alone/%d.png

# expect_frames FOLDER: the same as of one device.
expect_frames() {
    local i
    for i in {0..11}; do
        expect_same "$1/$i.png" "alone/$i.png"
    done
    if (($(find "$1" -type f | wc -l) != 12)); then
        fail "$1 has other files than 12 frames"
    fi
    rm -r "$1"
}

# ---- what cannot be asked for
for list in 'c:0,c:0' 'c:0,0,' ',c:0' 'c:0,all' 'all,c:0'; do
    expect_refusal 2 "${frames[@]}" --device "$list" -o together/%d.png
    expect_stderr_contains "--device is '$list', "
done
expect_refusal 2 "${frames[@]}" --backend opencl --device c:0,opencl:0 -o together/%d.png
expect_refusal 3 "${no_nvidia[@]}" "${frames[@]}" --device c:0,cuda:63 -o together/%d.png
expect_refusal 3 "${frames[@]}" --device 'c:0,no such device' -o together/%d.png
expect_refusal 2 "$hedron" tune "${small[@]}" --device all
expect_stderr_contains "--device is 'all', expected one device"

# ---- one device alone may be all there are
expect_exit 0 "${frames[@]}" --backend c --device all -o together/%d.png --quiet
expect_silent_stderr
expect_frames together

# ---- a CPU by two backends
if has_opencl; then
    pair=("${no_nvidia[@]}" "${frames[@]}" --device 'c:0,opencl:0')
    expect_exit 0 "${pair[@]}" -o together/%d.png --verbose --stats stats.jsonl
    for line in 'device +c 0, .*: named by --device.*' 'device +opencl 0, .*: named by --device.*' \
        'renderer +.* threads?, (mega|wavefront).*' 'renderer +.* compute units?, (mega|wavefront).*'; do
        if (($(grep -c -x -E "$line" "$logs/stderr") != 1)); then
            fail "no line of --verbose is $line"
            show_logs
        fi
    done
    expect_frames together
    if (($(grep -c -E '"backend":"(c|opencl)","index":0' stats.jsonl) != 12)); then
        fail "the statistics do not name the devices"
    fi
    rm stats.jsonl
    expect_exit 0 "${pair[@]}" --aa adaptive -o together/%d.png --quiet
    expect_exit 0 "${frames[@]}" --device c:0 --aa adaptive -o adaptive/%d.png --quiet
    for i in {0..11}; do
        expect_same "together/$i.png" "adaptive/$i.png"
    done
    rm -r together adaptive
    expect_exit 0 "${no_nvidia[@]}" "$hedron" "${small[@]}" --frames 0-3 --backend opencl --device all \
        <<<"$("$hedron" --default)"
    rm -r out
    if command -v ffmpeg >"$logs/which" 2>&1; then
        expect_exit 0 "${frames[@]}" --device c:0 -o alone.mkv --quiet
        expect_exit 0 "${pair[@]}" -o together.mkv --quiet
        for film in alone together; do
            expect_exit 0 ffmpeg -v error -i $film.mkv -f framemd5 $film.md5
        done
        expect_same alone.md5 together.md5
        rm ./*.mkv ./*.md5
    fi
fi

# ---- all: whatever there is
expect_exit 0 "${frames[@]}" --device all -o together/%d.png --verbose
if ! grep -q -E '^device +c 0, .*: one of all, by --device' "$logs/stderr"; then
    fail "plain C is not one of all"
    show_logs
fi
if "${no_nvidia[@]}" "${frames[@]}" --device all -o all/%d.png --verbose 2>&1 | grep -q -E '^device +opencl .* CPU'; then
    fail "the CPU is there twice"
fi
rm -rf all
expect_frames together

# ---- a device that cannot be used, and one that fails: NVIDIA's driver is a fake
if [[ ! -e $build/tests/fake_cuda/libcuda.so.1 ]]; then
    finish
fi
export LD_LIBRARY_PATH=$build/tests/fake_cuda${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export HEDRON_CACHE=$work/cache OCL_ICD_VENDORS=$work/no_vendors
mkdir "$work/no_vendors"
no_compiler=(env HEDRON_NVRTC="$work/nothing.so")
expect_exit 0 "${no_compiler[@]}" "${frames[@]}" --device all -o together/%d.png
expect_stderr_contains 'hedron: cuda:0 (Fake device 0) is left out: '
expect_stderr_contains 'cannot be loaded as an NVRTC library'
expect_frames together
expect_exit 0 "${no_compiler[@]}" "${frames[@]}" --device all -o together/%d.png --quiet
expect_silent_stderr
expect_frames together
expect_refusal 3 "${no_compiler[@]}" "${frames[@]}" --device cuda:0,c:0 -o together/%d.png
expect_refusal 3 "${no_compiler[@]}" "${frames[@]}" --backend cuda --device all -o together/%d.png

nvrtc=$build/tests/fake_cuda/libnvrtc.so.12
if [[ -e $nvrtc ]]; then
    export HEDRON_NVRTC=$nvrtc
    dropped='hedron: cuda:0 (Fake device 0) failed, so other devices trace its frames from here on: cuda: '
    # Kernels that compute wrongly, as the self-test finds; with a cache it would be remembered and left out from the start.
    for devices in cuda:0,c:0 all; do
        expect_exit 0 env HEDRON_CACHE=off FAKE_NVRTC_WRONG=1 "${frames[@]}" --device $devices -o together/%d.png --quiet --stats stats.jsonl
        expect_sentence
        expect_stderr_contains "${dropped}Fake device 0 (sm_61, driver for CUDA 12.8) computes wrongly"
        expect_frames together
        if (($(grep -c '"backend":"c"' stats.jsonl) != 12)); then
            fail "not all frames are of plain C"
        fi
    done
    rm stats.jsonl
    # Fast arithmetic needs no self-test; the device fails as it gets the scene.
    expect_exit 0 "${frames[@]}" --math fast --device c:0 -o fast/%d.png --quiet
    expect_exit 0 env FAKE_CUDA_FAILS=cuMemcpyHtoDAsync "${frames[@]}" --math fast --device cuda:0,c:0 \
        -o together/%d.png --quiet
    expect_sentence
    expect_stderr_contains "${dropped}cuMemcpyHtoDAsync failed"
    for i in {0..11}; do
        expect_same "together/$i.png" "fast/$i.png"
    done
    rm -r together fast
fi

rm -r alone
expect_files .
finish
