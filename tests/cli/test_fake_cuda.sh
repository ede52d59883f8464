#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The CUDA backend against its driver, which runs kernels without a device: errors of wrong ones, caching, cutting of launches,
# failing calls. Pictures and films equal those of plain C. The conformance suite checks frames in flight together.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_fake_cuda "${2:?the build folder is the second argument}"
command -v jq >"$logs/which" || skip "there is no jq"
render=("$hedron" render "${small[@]}" --frames 0 -o picture.data --backend cuda)

expect_build() { # REGEX: the report about the kernels
    (($(grep -c -x -E -e "build +$1" "$logs/stderr") == 1)) || fail "standard error has no line that is $1"
}

expect_exit 0 "$hedron" devices
expect_stdout_contains 'Fake device 0'
expect_stdout_contains 'sm_61, driver for CUDA 12.8'

# ---- kernels that round wrongly are an error, not a picture that is nearly right
expect_refusal 3 env FAKE_NVRTC_WRONG=1 "${render[@]}" --quiet
expect_stderr_contains 'cuda: Fake device 0 (sm_61, driver for CUDA 12.8) computes wrongly'
expect_files .
! compgen -G "$work/cache/cuda-*" >"$logs/which" || fail "wrong kernels are kept"
rm -r "$work/cache"

# ---- kernels that need no test are cached; then NVRTC is not loaded
fast=("${render[@]}" --math fast --verbose)
expect_exit 0 "${fast[@]}"
expect_build 'compiled in [0-9]+ ms by NVRTC 12\.[0-9]+; not tested, since the arithmetic is fast; cached'
expect_exit 0 env LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" "${fast[@]}"
expect_build "taken from $work/cache, made by NVRTC 12\.[0-9]+"
grep -q 'libcuda' "$work"/loaded.* || fail 'no log names the loaded libraries'
! grep -q 'libnvrtc' "$work"/loaded.* || fail 'NVRTC was loaded for kernels that are kept'
# Another NVRTC by name, and a driver that refuses the cached kernels.
cp "$nvrtc" "$work/libnvrtc.so.12"
expect_exit 0 env HEDRON_NVRTC="$work/libnvrtc.so.12" "${fast[@]}"
expect_build 'compiled in .*; cached'
expect_exit 0 env FAKE_CUDA_REFUSES=1 "${fast[@]}"
expect_build 'the driver refused the cached kernels; .*; compiled in .*; cached'

# ---- the classic keys are binding: --gpu takes the card, --cpu refuses it
"$hedron" --default >"$work/default.in"
expect_exit 0 "$hedron" --gpu "${small[@]}" --frames 0 --math fast --verbose <"$work/default.in"
expect_stderr_contains 'device    cuda 0, '
expect_refusal 3 "$hedron" --cpu --backend cuda "${small[@]}" --frames 0 <"$work/default.in"
expect_stderr_contains 'it is not a CPU'
rm -r out

# ---- launches: as long as the frame if that is short; cut if it is long; the bytes are the same
# A scene with little to trace: the number of threads decides.
echo '{"hedron": 1, "camera": {"frames": 40, "eye": {"r0": 9, "z0": 2, "phi_frequency": 1}},
       "materials": {"red": {"colour": [1, 0, 0], "diffuse": 1}},
       "solids": [{"kind": "cube", "circumradius": 1, "material": "red"}], "lights": [{"position": [3, -4, 8]}]}' >"$work/cube.json"
large=("$hedron" render "$work/cube.json" --size 128x128 --samples 4 --depth 2 --frames 0-3 --backend cuda --math fast --quiet)
# expect_launches FILTER COMMAND...: true of the last two frames, when speeds are known.
expect_launches() {
    expect_exit 0 "${@:2}" --again -o launches/%d.data --stats stats.jsonl
    jq -e -s ".[-2:] | all(.[]; $1)" stats.jsonl >"$logs/jq" ||
        fail "not all frames have $1: $(jq -c '[.longest_launch_ms, .seconds.trace]' stats.jsonl | tr '\n' ' ')"
}
threads=(env FAKE_CUDA_UNITS=3 FAKE_CUDA_THREAD_NS=10000)
# The sums of the counts, 1024 threads, are a launch of their own.
expect_launches '.longest_launch_ms > 5 and (.longest_launch_ms + 0.02048 - 1000 * .seconds.trace | fabs) < 0.001' \
    "${threads[@]}" FAKE_CUDA_THREAD_NS=20 "${large[@]}" --frames 0-9
mv launches whole
expect_launches '.longest_launch_ms > 20 and .longest_launch_ms < 50 and .seconds.trace > 2' "${threads[@]}" "${large[@]}"
for i in 0 1 2 3; do
    expect_same "launches/$i.data" "whole/$i.data"
done
# As long as requested; short by default if a display may be attached, though the driver ends nothing.
expect_launches '.longest_launch_ms > 8 and .longest_launch_ms < 20' "${threads[@]}" "${large[@]}" --max-launch 20
threads+=(FAKE_CUDA_TIMEOUT=0)
expect_launches '.longest_launch_ms > 20 and .longest_launch_ms < 50' "${threads[@]}" DISPLAY=:0 "${large[@]}"
rm -r whole launches stats.jsonl

# ---- passes of many sizes use the same memory
passes=("${large[@]}" --size 200x150 --max-error 1 -o passes/%d.data)
expect_exit 0 env FAKE_CUDA_FAILS=cuMemHostAlloc FAKE_CUDA_FAILS_AT=9 "${passes[@]}"
expect_exit 0 env FAKE_CUDA_FAILS=cuMemAlloc FAKE_CUDA_FAILS_AT=50 "${passes[@]}"
rm -r passes

# ---- a device that refuses memory: the wavefront works with less, and says so; the report needs no kernel to run
waves=(env FAKE_CUDA_SKIPS=1 FAKE_CUDA_MEMORY=9000000000 FAKE_CUDA_LARGEST=30000000 "$hedron" render "$work/cube.json"
    --size 512x512 --samples 4 --frames 0 --backend cuda --math fast --pipeline wavefront -o wave.data)
expect_exit 0 "${waves[@]}" --verbose
expect_stderr_contains 'the queue cut to 33.6 MB, since more memory was refused'
rm wave.data

# ---- no failure leaves anything behind
for function in cuMemAlloc cuMemHostAlloc cuMemcpyHtoDAsync cuMemcpyDtoHAsync cuStreamWaitEvent cuEventSynchronize; do
    expect_refusal 1 env FAKE_CUDA_FAILS=$function "$hedron" render "${small[@]}" --frames 0-6 --backend cuda --math fast --quiet \
        -o failed/%d.data
    expect_stderr_contains "$function"
    rm -rf failed
done

# ---- a scene that the device can never hold: no kernels are compiled for it
printf 'v 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 -1 0\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n' >"$work/pyramid.obj"
echo '{"hedron": 1, "camera": {"eye": [3, -4, 2]}, "meshes": [{"file": "pyramid.obj"}], "lights": [{"position": [3, -4, 8]}]}' \
    >"$work/pyramid.json"
mesh=(HEDRON_CACHE=off "$hedron" render "$work/pyramid.json" "${small[@]}" --math fast --quiet -o mesh.data --backend cuda)
expect_refusal 3 env FAKE_CUDA_MEMORY=500 "${mesh[@]}"
expect_stderr_contains "the scene's tables need 1.06 kB, 192 bytes of them for its triangles; Fake device 0"
expect_stderr_contains 'has 500 bytes; try fewer triangles, a device with more memory, or --backend c'
expect_exit 0 env FAKE_CUDA_MEMORY=1100 "${mesh[@]}"
expect_silent_stderr
rm mesh.data

# ---- the same pictures as plain C's, of 8 bits and a film, which the device encodes, and of radiance, which it does not
film=()
! has_ffmpeg || film=(-o film.mkv)
expect_as_c() { # OPTION...
    local backend file
    for backend in c cuda; do
        mkdir $backend
        cd $backend
        expect_exit 0 "$hedron" render --backend $backend --frames 0-3 --quiet --stats "$work/$backend.jsonl" \
            -o %d.png "${film[@]}" "$@"
        expect_silent_stderr
        jq -c '[.frame, .rays, .shadow_tests, .clamps]' "$work/$backend.jsonl" >counts
        rm "$work/$backend.jsonl"
        expect_exit 0 "$hedron" render --backend $backend --frames 0-3 --quiet -o %d.pfm "$@"
        if [[ -e film.mkv ]]; then
            expect_exit 0 ffmpeg -v error -i film.mkv -f framemd5 film.md5
            rm film.mkv
        fi
        cd ..
    done
    for file in c/*; do
        expect_same "$file" "cuda/${file#c/}"
    done
    rm -r c cuda
}
expect_as_c --size 32x24 --samples 2
expect_as_c --size 32x24 --max-error 2 --set output.curve=linear
# More objects than fit into the device's constant memory.
jq '.solids = [range(17) | {kind: "tetrahedron", centre: [. % 6 - 2.5, . / 6 - 1, 0], circumradius: 0.6, material: "glass"}]' \
    "$project/bench/scenes/few.json" >"$work/many.json"
expect_as_c "$work/many.json" --size 32x24 --samples 1 --frames 0

# ---- the fastest of several devices on the scene; that is remembered, for similar scenes
export FAKE_CUDA_SKIPS=1 # the device that renders here could not be the fastest
for when in '' ', measured earlier'; do
    expect_exit 0 "$hedron" render --size 1920x1080 --samples 9 --threads 1 --frames 0 --math fast --verbose -o picture.data
    grep -q -x -E "device +cuda 0, .*: the fastest of 2 on this kind of scene$when, [0-9.e-]+ ms against [0-9.e+-]+ ms \(c 0\); not used: opencl: .*" \
        "$logs/stderr" || fail "standard error does not say that the fastest was chosen$when"
done

# ---- 'hedron tune': compiles every register limit, and uses the best from then on
tune=("$hedron" tune --backend cuda "${small[@]}" --pipeline mega)
expect_exit 0 "${tune[@]}" --math fast
(($(grep -c -x -E 'mega(, (at most [0-9]+ (registers|groups)|groups of [0-9]+))? +1\.000 +1\.000' "$logs/stdout") == 11)) ||
    fail "there are not all candidates"
expect_stdout_contains 'the best: mega; remembered for scenes of this kind'
for registers in 64 168; do
    grep -q -a -e "--maxrregcount=$registers " "$HEDRON_CACHE"/cuda-* || fail "no kernels are for $registers registers"
done
expect_exit 0 "${fast[@]}" --pipeline mega
expect_stderr_contains "launch    mega: the best for this kind of scene, by 'hedron tune'"
finish
