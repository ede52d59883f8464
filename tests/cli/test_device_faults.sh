#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Devices, drivers and their compilers that fail or hang during a run (docs/reference/faults.md): the message, the exit code,
# and no incomplete file. The drivers are an OpenCL library with a layer that makes its calls fail or reports no times, and the
# CUDA driver of the tests.
# shellcheck disable=SC2317 # wait_for calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
lost='the device is lost to this program'
film=()
! has_ffmpeg || film=(-o film.mkv)

# expect_orderly_failure CODE WORDS COMMAND...: one sentence, and no file except whole frames, which are removed.
expect_orderly_failure() {
    local file
    expect_exit "$1" timeout "$time_limit" "${@:3}"
    expect_sentence
    expect_stderr_contains "$2"
    expect_stdout_lines 0
    for file in *; do
        case $file in
        '*') ;;
        *.data) expect_data "$file" 32 24 ;;
        *) fail "there stays $file" ;;
        esac
    done
    rm -rf ./*
}

# expect_end_by SIGNAL COMMAND...: that hangs once `reached` exists, whatever is in flight.
expect_end_by() {
    rm -f "$work/reached"
    start env HEDRON_STOP_PATIENCE=0.2 "${@:2}"
    wait_for 'it to hang' test -e "$work/reached"
    send "$1" "$pid"
    expect_end $((128 + $(kill -l "$1")))
    expect_sentence
    expect_stderr_contains 'interrupted; the running work did not end in time'
    ! find . -name '*.tmp-*' -o -name film.mkv | grep . || fail "there stays $(ls)"
    rm -rf ./*
}

# ---- OpenCL
if is_sanitized; then
    echo "not tested: OpenCL that fails, for nothing can be preloaded before a sanitizer"
elif ! has_opencl; then
    echo "not tested: OpenCL that fails, for no device compiles kernels here"
else
    opencl=("${no_nvidia[@]}" LD_PRELOAD="$build/tests/failing/libfailing_opencl.so")
    render=("$hedron" render --quiet --backend opencl "${small[@]}" --frames 0-4 -o '%d.data')
    # failing FUNCTION AT CODE [VARIABLE=VALUE...]: sets `fault`, an environment in which its calls fail from that one on.
    failing() {
        fault=("${opencl[@]}" FAILING_OPENCL="$1" FAILING_OPENCL_AT="$2" FAILING_OPENCL_CODE="$3" "${@:4}")
    }
    # Once without a fault: the kernels are cached, and the layer disturbs nothing.
    expect_exit 0 "${opencl[@]}" "${render[@]}"
    rm ./*

    # A driver whose text contains terminal commands, and one that claims devices that it does not have.
    expect_exit 0 "${opencl[@]}" FAILING_OPENCL_NAME=$'A\e[2J\a card\x9b' "$hedron" devices
    expect_silent_stderr
    expect_stdout_contains 'A\u001b[2J\u0007 card\x9b'
    ! grep -q $'[\x01-\x09\x0b-\x1f\x7f-\x9f]' "$logs/stdout" || fail 'control characters of a driver are printed'
    devices=$(grep -c '^  [0-9]' "$logs/stdout")
    expect_exit 0 "${opencl[@]}" FAILING_OPENCL_NAME='A card' FAILING_OPENCL_LIES=1 "$hedron" devices
    expect_silent_stderr
    [[ $(grep -c '^  [0-9]' "$logs/stdout") == "$devices" ]] || fail "devices are listed that are not there"

    # Memory, at the first buffer and at later ones.
    for fault in '1 -4' '9 -6'; do
        # shellcheck disable=SC2086 # two words
        failing clCreateBuffer $fault
        expect_orderly_failure 1 'has too little free of its' "${fault[@]}" "${render[@]}"
    done

    # A lost device: at the first launches or during a run. After the upload clFinish only cleans up.
    for function in clEnqueueNDRangeKernel clFlush clWaitForEvents clEnqueueReadBuffer clEnqueueWriteBuffer clFinish; do
        failing "$function" 1 -36
        expect_orderly_failure 3 "$lost" "${fault[@]}" "${render[@]}"
        grep -q -F "$function" "$logs/stderr" || fail "the message does not name $function"
        if [[ $function != clFinish ]]; then
            failing "$function" 5 -9999
            expect_orderly_failure 3 "$lost" "${fault[@]}" "${render[@]}" "${film[@]}"
        fi
    done
    failing clWaitForEvents 1 -5 # waiting needs no memory
    expect_orderly_failure 3 "$lost" "${fault[@]}" "${render[@]}"
    for function in clCreateContext clCreateCommandQueue; do
        failing $function 1 -2
        expect_orderly_failure 3 "$lost" "${fault[@]}" "${render[@]}"
        failing $function 1 -6
        expect_orderly_failure 1 "$function failed with CL_OUT_OF_HOST_MEMORY" "${fault[@]}" "${render[@]}"
    done

    # Any other error of any function, at any of its calls: never a crash.
    for function in clSetKernelArg clCreateKernel clEnqueueMapBuffer clEnqueueNDRangeKernel clFlush; do
        failing $function 2 -30
        expect_orderly_failure 1 "$function failed with CL_INVALID_VALUE (-30)" "${fault[@]}" "${render[@]}"
    done

    # A compiler that fails, and one that is missing.
    for error in -11 -3 -6; do
        failing clBuildProgram 1 $error HEDRON_CACHE=off
        expect_exit 1 "${fault[@]}" "${render[@]}"
        expect_stderr_contains 'refused the kernels (clBuildProgram: CL_'
        expect_files .
    done
    # Cached kernels that the compiler no longer accepts are compiled again.
    failing clBuildProgram 1 -11 FAILING_OPENCL_TIMES=1
    expect_exit 0 "${fault[@]}" "$hedron" render --verbose --backend opencl "${small[@]}" --frames 0-4 -o '%d.data'
    expect_stderr_contains 'the driver refused the cached kernels'
    expect_stderr_contains 'compiled in'

    # No platform at all.
    failing clGetPlatformIDs 1 -1001
    expect_orderly_failure 3 opencl "${fault[@]}" "${render[@]}"

    # If any device will do, the next one renders, and a sentence says why.
    if ! has_other_gpu; then
        failing clFinish 1 -36
        expect_exit 0 "${fault[@]}" "$hedron" --gpu "${small[@]}" --frames 0 <<<"$("$hedron" --default)"
        expect_stderr_contains 'tracing with c on'
    fi

    # A GPU that reports no times: launches grow and shrink by the host's clock.
    # expect_launches NS MIN MAX MAX_TOO_LONG [OPTION...]: so many launches, of work items that take so long, and so many of
    # them above 50 ms.
    expect_launches() {
        local launches too_long
        rm -f "$work/report"
        expect_exit 0 "${opencl[@]}" FAILING_OPENCL_NS="$1" FAILING_OPENCL_REPORT="$work/report" "${render[@]}" --size 128x128 \
            --samples 8 --device opencl:0 "${@:5}"
        read -r launches too_long <"$work/report"
        ((launches >= $2 && launches <= $3 && too_long <= $4)) ||
            fail "$launches launches of items of $1 ns, $too_long of them above 50 ms"
        for file in *; do
            expect_same "$file" "$work/untimed/$file"
        done
        rm ./*
    }
    expect_exit 0 "${render[@]}" --size 128x128 --samples 8 --backend c
    mkdir "$work/untimed"
    mv ./* "$work/untimed"
    expect_launches 1 1 9999 0 # its kernels are compiled and tested, with launches of its own
    # A frame has 2^20 samples, a first launch 2^14 of them, and each frame two small launches more.
    expect_launches 1 12 40 0
    # Above 50 ms: the first one, another that learns from it, and the one that makes the 8 bits of each frame.
    expect_launches 12500 1000 4500 7
    expect_launches 2500 12 80 999 --max-launch 4000

    # A driver, or its compiler, that never returns: the first signal ends the program all the same.
    failing clFlush 3 -1 FAILING_OPENCL_HANGS="$work/reached"
    expect_end_by INT "${fault[@]}" "${render[@]}" "${film[@]}"
    failing clBuildProgram 1 -1 FAILING_OPENCL_HANGS="$work/reached" HEDRON_CACHE=off
    expect_end_by TERM "${fault[@]}" "${render[@]}"
fi

# ---- CUDA
nvrtc=$build/tests/fake_cuda/libnvrtc.so.12
if [[ ! -e $nvrtc ]]; then
    echo "not tested: CUDA that fails, for no compiler of C++ is here that could build the kernels"
    finish
fi
cuda=("${no_opencl[@]}" LD_LIBRARY_PATH="$build/tests/fake_cuda" HEDRON_NVRTC="$nvrtc" HEDRON_CACHE="$work/cache")
frames=("$hedron" render "${small[@]}" --frames 0-6 --backend cuda --math fast --quiet -o '%d.data')
expect_exit 0 "${cuda[@]}" "${frames[@]}"
# A device that fell off the bus, an error of its memory, a kernel that took too long, one that crashed.
for fault in 'cuMemcpyHtoDAsync 46' 'cuLaunchKernel 214' 'cuEventSynchronize 702' 'cuLaunchKernel 719'; do
    expect_orderly_failure 3 "$lost" "${cuda[@]}" FAKE_CUDA_FAILS="${fault% *}" FAKE_CUDA_ERROR="${fault#* }" "${frames[@]}" \
        "${film[@]}"
    grep -q -F "${fault% *}" "$logs/stderr" || fail "the message does not name ${fault% *}"
done
# Memory: the requested and the available amount.
expect_orderly_failure 1 'free of its 50.0 MB (cuMemAlloc: ' "${cuda[@]}" FAKE_CUDA_FAILS=cuMemAlloc FAKE_CUDA_MEMORY=50000000 \
    "${frames[@]}"
# A driver that never returns.
for function in cuLaunchKernel cuEventSynchronize; do
    expect_end_by INT "${cuda[@]}" FAKE_CUDA_HANGS="$work/reached" FAKE_CUDA_FAILS=$function "${frames[@]}"
done

expect_files .
finish
