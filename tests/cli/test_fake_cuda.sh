#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The CUDA backend's dealings with its driver, which runs kernels without a device: that wrong ones are
# an error, which are kept, how launches are cut, and what happens where a call fails.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=${2:?the build folder is the second argument}
nvrtc=$build/tests/fake_cuda/libnvrtc.so.12
if [[ ! -e $nvrtc ]]; then
    skip "no compiler of C++ is here that could build the kernels"
fi
export LD_LIBRARY_PATH=$build/tests/fake_cuda${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export HEDRON_CACHE=$work/cache
export HEDRON_NVRTC=$nvrtc
mkdir "$work/no_vendors"
export OCL_ICD_VENDORS=$work/no_vendors
render=("$hedron" render "${small[@]}" --frames 0 -o picture.data)

# expect_build REGEX: what is said of the kernels.
expect_build() {
    if (($(grep -c -x -E -e "build +$1" "$logs/stderr") != 1)); then
        fail "standard error has no line that is $1"
        show_logs
    fi
}

expect_exit 0 "$hedron" devices
expect_stdout_contains 'Fake device 0'
expect_stdout_contains 'sm_61, driver for CUDA 12.8'

# ---- kernels that round wrongly are an error, not a picture that is nearly right
wrong=(env FAKE_NVRTC_WRONG=1)
expect_refusal 3 "${wrong[@]}" "${render[@]}" --backend cuda --quiet
expect_stderr_contains 'cuda: Fake device 0 (sm_61, driver for CUDA 12.8) computes wrongly'
expect_files .
if compgen -G "$work/cache/cuda-*" >"$logs/which"; then
    fail "wrong kernels are kept"
fi

# ---- where any device will do, the next one is taken, and a sentence tells it
"$hedron" render "${small[@]}" --frames 0 --backend c --quiet -o expected.data >"$logs/stdout"
expect_exit 0 "${wrong[@]}" "$hedron" --gpu "${small[@]}" --frames 0 <<<"$("$hedron" --default)"
expect_sentence
expect_stderr_contains 'computes wrongly'
expect_stderr_contains 'tracing with c on'
rm -r out
# A small job wakes no driver.
expect_exit 0 "${render[@]}" --verbose
expect_stderr_contains 'it needs about'
expect_same picture.data expected.data
rm picture.data expected.data

# ---- kernels that need no test are kept; then NVRTC is not loaded
fast=("${render[@]}" --backend cuda --math fast --verbose)
expect_exit 0 "${fast[@]}"
expect_build 'compiled in [0-9]+ ms by NVRTC 12\.[0-9]+; not tested, for the arithmetic is fast; cached'
expect_exit 0 env LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" "${fast[@]}"
expect_build "taken from $work/cache, made by NVRTC 12\.[0-9]+"
if ! grep -q 'libcuda' "$work"/loaded.*; then
    fail "nothing tells which libraries were loaded"
fi
if grep -q 'libnvrtc' "$work"/loaded.*; then
    fail "NVRTC was loaded for kernels that are kept"
fi

# ---- where the driver may end long kernels, deep trees are traced level by level
expect_exit 0 "${fast[@]}"
expect_stderr_contains ' threads, mega,'
expect_exit 0 "${fast[@]}" --max-error 64
expect_stderr_contains ' threads, mega,'
deep=("$hedron" render --size 32x24 --frames 0 -o picture.data --backend cuda --math fast --verbose)
expect_exit 0 "${deep[@]}" --max-error 64
expect_stderr_contains ' threads, wavefront,'

# ---- another NVRTC by name, an entry that is damaged, a driver that refuses it
cp "$nvrtc" "$work/libnvrtc.so.12"
expect_exit 0 env HEDRON_NVRTC="$work/libnvrtc.so.12" "${fast[@]}"
expect_build 'compiled in .*; cached'
rm "$work"/libnvrtc*
for entry in "$work"/cache/cuda-*; do
    printf 'x' | dd of="$entry" bs=1 seek=9000 conv=notrunc status=none
done
expect_exit 0 "${fast[@]}"
expect_build '.* its checksum is wrong; compiled in .*; cached'
expect_exit 0 env FAKE_CUDA_REFUSES=1 "${fast[@]}"
expect_build 'the driver refused the cached kernels; .*; compiled in .*; cached'
expect_refusal 1 env FAKE_CUDA_REFUSES=2 "${render[@]}" --backend cuda --math fast --quiet
expect_stderr_contains 'does not load what NVRTC 12.'
expect_exit 0 "${fast[@]}"
expect_build 'taken from .*'

# ---- frames under way together: the driver carries out what is queued as late as it may
frames=("$hedron" render "${small[@]}" --frames 0-6 --backend cuda --math fast --quiet)
expect_exit 0 env FAKE_CUDA_EAGER=1 "${frames[@]}" -o eager/%d.data
expect_exit 0 "${frames[@]}" -o late/%d.data
expect_silent_stderr
expect_exit 0 "${frames[@]}" -o late/%d.png -o radiance/%d.data -o radiance/%d.pfm
expect_silent_stderr
for i in 0 1 2 3 4 5 6; do
    expect_same "late/$i.data" "eager/$i.data"
    expect_same "late/$i.data" "radiance/$i.data"
    if ((i > 0)); then
        expect_different "late/$i.data" "late/$((i - 1)).data"
    fi
done
rm -r eager late radiance

expect_exit 0 "${frames[@]}" --pipeline wavefront -o waves/%d.data
expect_silent_stderr
rm -r waves

# ---- launches: as long as the frame where that is short; cut where it is long; the bytes are the same
# A scene with little to trace: what counts is how many threads there are.
echo '{"hedron": 1, "camera": {"frames": 40, "eye": {"r0": 9, "z0": 2, "phi_frequency": 1}},
       "materials": {"red": {"colour": [1, 0, 0], "diffuse": 1}},
       "solids": [{"kind": "cube", "circumradius": 1, "material": "red"}], "lights": [{"position": [3, -4, 8]}]}' >"$work/cube.json"
large=("$hedron" render "$work/cube.json" --size 128x128 --samples 4 --depth 2 --frames 0-3 --backend cuda --math fast --quiet)
few_units=(env FAKE_CUDA_UNITS=3)
if command -v jq >"$logs/which"; then
    # expect_launches FILTER: what holds of each frame's line but the first, which nothing is known before.
    expect_launches() {
        if ! jq -e -s ".[1:] | all(.[]; $1)" stats.jsonl >"$logs/jq"; then
            fail "not all frames have $1: $(jq -c '[.longest_launch_ms, .seconds.trace]' stats.jsonl | tr '\n' ' ')"
        fi
    }
    expect_exit 0 "${few_units[@]}" "${large[@]}" -o whole/%d.data
    expect_exit 0 "${few_units[@]}" FAKE_CUDA_THREAD_NS=20 "${large[@]}" --frames 0-9 -o short/%d.data --stats stats.jsonl
    sed -i '1,6d' stats.jsonl
    # The sums of the counts, 1024 threads, are a launch of their own.
    expect_launches '.longest_launch_ms > 5 and (.longest_launch_ms + 0.02048 - 1000 * .seconds.trace | fabs) < 0.001'
    expect_exit 0 "${few_units[@]}" FAKE_CUDA_THREAD_NS=10000 "${large[@]}" -o cut/%d.data --stats stats.jsonl
    expect_launches '.longest_launch_ms > 20 and .longest_launch_ms < 50 and .seconds.trace > 2'
    # The first launch, of which nothing is known, is not the last one of its frame.
    expect_exit 0 "${few_units[@]}" FAKE_CUDA_THREAD_NS=50000 "${large[@]}" --frames 0 -o first/%d.data --stats stats.jsonl
    if ! jq -e -s '.[0].longest_launch_ms > 60' stats.jsonl >"$logs/jq"; then
        fail "the longest launch of the first frame takes $(jq -c .longest_launch_ms stats.jsonl | head -n 1) ms, expected more than 60"
    fi
    # As long as is asked for; by default short where a display may be there, though the driver ends nothing.
    expect_exit 0 "${few_units[@]}" FAKE_CUDA_THREAD_NS=10000 "${large[@]}" --max-launch 20 -o asked/%d.data --stats stats.jsonl
    expect_launches '.longest_launch_ms > 8 and .longest_launch_ms < 20'
    free=("${few_units[@]}" FAKE_CUDA_THREAD_NS=10000 FAKE_CUDA_TIMEOUT=0)
    for display in DISPLAY=:0 WAYLAND_DISPLAY=wayland-0; do
        expect_exit 0 "${free[@]}" "$display" "${large[@]}" -o asked/%d.data --again --stats stats.jsonl
        expect_launches '.longest_launch_ms > 20 and .longest_launch_ms < 50'
    done
    expect_exit 0 "${free[@]}" "${large[@]}" --max-launch 400 -o long/%d.data --stats stats.jsonl
    expect_launches '.longest_launch_ms > 160 and .longest_launch_ms < 400'
    for i in 0 1 2 3; do
        expect_same "cut/$i.data" "whole/$i.data"
        expect_same "short/$i.data" "whole/$i.data"
        expect_same "asked/$i.data" "whole/$i.data"
        expect_same "long/$i.data" "whole/$i.data"
    done
    rm -r whole short cut first asked long stats.jsonl
fi

# ---- passes of many sizes use the same memory
passes=("${large[@]}" --size 200x150 --samples 4 --aa adaptive -o passes/%d.data)
expect_exit 0 env FAKE_CUDA_FAILS=cuMemHostAlloc FAKE_CUDA_FAILS_AT=9 "${passes[@]}"
expect_exit 0 env FAKE_CUDA_FAILS=cuMemAlloc FAKE_CUDA_FAILS_AT=50 "${passes[@]}"
rm -r passes

# ---- a device that refuses memory: the wavefront gets along with less, and says so
waves=("$hedron" render "$work/cube.json" --size 512x512 --samples 4 --frames 0 --backend cuda --math fast --pipeline wavefront -o waves/%d.data)
# What is told of it needs no kernel to run.
expect_exit 0 env FAKE_CUDA_SKIPS=1 FAKE_CUDA_MEMORY=9000000000 "${waves[@]}" --verbose
if grep -q 'the queue cut' "$logs/stderr"; then
    fail 'the queue was cut, though nothing was refused'
fi
expect_exit 0 env FAKE_CUDA_MEMORY=9000000000 FAKE_CUDA_LARGEST=30000000 "${waves[@]}" --verbose
expect_stderr_contains 'the queue cut to 33.6 MB, for more memory was refused'
expect_exit 0 env FAKE_CUDA_SKIPS=1 FAKE_CUDA_MEMORY=9000000000 FAKE_CUDA_LARGEST=30000000 "${waves[@]}" --quiet
expect_silent_stderr
rm -r waves

# ---- a device that is lost
expect_refusal 3 env FAKE_CUDA_FAILS=cuEventSynchronize FAKE_CUDA_ERROR=719 "${frames[@]}" -o failed/%d.data
expect_stderr_contains 'cuEventSynchronize failed with CUDA_ERROR_LAUNCH_FAILED (719: unspecified launch failure): the device is lost to this program'
rm -rf failed

# ---- whatever fails, nothing is left behind
for function in cuMemAlloc cuMemHostAlloc cuMemcpyHtoDAsync cuMemcpyDtoHAsync cuLaunchKernel cuStreamWaitEvent cuEventSynchronize; do
    expect_refusal 1 env FAKE_CUDA_FAILS=$function "${frames[@]}" -o failed/%d.data
    expect_stderr_contains "$function"
    rm -rf failed
done

# ---- a scene that the device can never hold: no kernels are compiled for it
cat >"$work/pyramid.obj" <<'END'
v 0 0 1
v 1 0 0
v 0 1 0
v -1 -1 0
f 1 2 3
f 1 3 4
f 1 4 2
f 2 4 3
END
echo '{"hedron": 1, "camera": {"eye": [3, -4, 2]}, "meshes": [{"file": "pyramid.obj"}], "lights": [{"position": [3, -4, 8]}]}' \
    >"$work/pyramid.json"
mesh=("$hedron" render "$work/pyramid.json" "${small[@]}" --math fast --quiet -o mesh.data)
expect_refusal 3 env FAKE_CUDA_MEMORY=500 HEDRON_CACHE=off "${mesh[@]}" --backend cuda
expect_stderr_contains "the scene's tables need 1.04 kB, 192 bytes of them for its triangles; Fake device 0"
expect_stderr_contains 'has 500 bytes; fewer triangles, a device with more memory or --backend c may do'
expect_exit 0 env FAKE_CUDA_MEMORY=1100 HEDRON_CACHE=off "${mesh[@]}" --backend cuda
expect_silent_stderr
rm mesh.data

# ---- less memory than the least that the wavefront asks for
expect_refusal 1 env FAKE_CUDA_MEMORY=9000000000 FAKE_CUDA_LARGEST=500000 "${mesh[@]}" --backend cuda \
    --pipeline wavefront --samples 8 --depth 10
expect_stderr_contains 'the rays of the queue need 1.0'
expect_stderr_contains 'Fake device 0 has 9.00 GB free of its 9.00 GB (cuMemAlloc: CUDA_ERROR'

# ---- among several devices the fastest on the scene; that is remembered, for scenes of its kind
export FAKE_CUDA_SKIPS=1 # it could not be the fastest that renders here
long=("$hedron" render --size 1920x1080 --samples 9 --threads 1 --frames 0 --math fast --verbose -o picture.data)
fastest='device +cuda 0, .*: the fastest of 2 on this kind of scene'
for when in '' ', measured earlier'; do
    expect_exit 0 "${long[@]}"
    if ! grep -q -x -E "$fastest$when, [0-9.e-]+ ms against [0-9.e+-]+ ms \(c 0\); passed over: opencl: .*" "$logs/stderr"; then
        fail "it is not told that the fastest was taken$when"
        show_logs
    fi
done
expect_exit 0 env HEDRON_CACHE=off "${long[@]}"
expect_stderr_contains 'the fastest of 2 on this kind of scene, '

# ---- 'hedron tune': every limit of registers is compiled; with strict arithmetic the device cannot be used at all
tune=("$hedron" tune --backend cuda "${small[@]}" --pipeline mega)
expect_exit 0 "${tune[@]}" --math fast
for candidate in mega 'mega, at most 64 registers' 'mega, at most 96 registers' 'mega, at most 128 registers' \
    'mega, at most 168 registers' 'mega, groups of 64' 'mega, groups of 128' 'mega, groups of 256' \
    'mega, at most 1600 groups' 'mega, at most 6400 groups'; do
    if ! grep -q -x -E "$candidate +1\.000 +1\.000" "$logs/stdout"; then
        fail "there is no candidate $candidate"
        show_logs
    fi
done
expect_stdout_contains 'the best: mega; remembered for scenes of this kind'
for registers in 64 96 128 168; do
    if ! grep -q -a -e "--maxrregcount=$registers " "$HEDRON_CACHE"/cuda-*; then
        fail "no kernels were compiled for $registers registers"
    fi
done
expect_exit 0 "${fast[@]}" --pipeline mega
expect_stderr_contains "launch    mega: the best for this kind of scene, by 'hedron tune'"
expect_refusal 3 "${wrong[@]}" "${tune[@]}"
expect_stderr_contains 'computes wrongly'

# ---- a library that is gone is missed, though kernels are kept
expect_refusal 3 env HEDRON_NVRTC="$work/libnvrtc.so.12" "${render[@]}" --backend cuda --math fast --quiet
expect_stderr_contains 'cannot be loaded as an NVRTC library'

rm -f picture.data
expect_files .
finish
