#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Devices, drivers and their compilers that fail or hang in the midst of a run (docs/faults.md): what is
# said, the exit code, and that nothing half-done stays. The drivers are an OpenCL library with a layer
# that makes its calls fail, and the CUDA driver of the tests.
# shellcheck disable=SC2317 # wait_for calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
layer=$build/tests/failing/libfailing_opencl.so
lost='the device is lost to this program'

wait_for() {
    local what=$1
    shift
    if ! wait_until 200 "$@"; then
        fail "waited in vain for $what"
        show_logs
    fi
}

# expect_orderly_failure CODE COMMAND...: one sentence, and no file but whole frames, which are removed.
expect_orderly_failure() {
    local expected=$1 file
    shift
    rm -rf ./*
    expect_exit "$expected" timeout 200 "$@"
    expect_sentence
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

# expect_end_by_signals COMMAND...: that hangs once there is `reached`, whatever it has under way.
expect_end_by_signals() {
    local signal
    for signal in INT TERM; do
        rm -rf ./* "$work/reached"
        start env -u HEDRON_STOP_PATIENCE "$@"
        wait_for 'it to hang' test -e "$work/reached"
        kill "-$signal" "$pid" || fail 'it was over before the signal'
        expect_end $((128 + $(kill -l "$signal")))
        expect_sentence
        expect_stderr_contains 'interrupted; what was at work did not end in time'
        if [[ -n $(find . -name '*.tmp-*') || -e film.mkv ]]; then
            fail "there stays $(ls)"
        fi
    done
    rm -rf ./*
}

film=()
if command -v ffmpeg >"$logs/which" && command -v ffprobe >"$logs/which"; then
    film=(-o film.mkv)
fi

# ---- OpenCL
if is_sanitized; then
    echo "not tested: OpenCL that fails, for nothing can be preloaded before a sanitizer"
elif ! has_opencl; then
    echo "not tested: OpenCL that fails, for no device compiles kernels here"
else
    opencl=("${no_nvidia[@]}" LD_PRELOAD="$layer")
    render=("$hedron" render --quiet --backend opencl "${small[@]}" --frames 0-4 -o '%d.data' "${film[@]}")
    # Once without a fault: the kernels are kept, and the layer disturbs nothing.
    expect_exit 0 "${opencl[@]}" "${render[@]}"
    rm -rf ./*

    # A driver whose words would command the terminal, and one that claims what it has not.
    expect_exit 0 "${opencl[@]}" FAILING_OPENCL_NAME=$'A\e[2J\a card\x9b' "$hedron" devices
    expect_silent_stderr
    expect_stdout_contains 'A\u001b[2J\u0007 card\x9b'
    if LC_ALL=C grep -q $'[\x01-\x09\x0b-\x1f\x7f-\x9f]' "$logs/stdout"; then
        fail "control characters of a driver are printed as they are"
    fi
    devices=$(grep -c '^  [0-9]' "$logs/stdout")
    expect_exit 0 "${opencl[@]}" FAILING_OPENCL_NAME='A card' FAILING_OPENCL_LIES=1 "$hedron" devices
    expect_silent_stderr
    if [[ $(grep -c '^  [0-9]' "$logs/stdout") != "$devices" ]]; then
        fail "devices are listed that are not there"
        show_logs
    fi

    # Memory, at the first buffer and at later ones.
    for at in 1 3 9 20; do
        for error in -4 -5 -6; do
            expect_orderly_failure 1 "${opencl[@]}" FAILING_OPENCL=clCreateBuffer FAILING_OPENCL_CODE=$error \
                FAILING_OPENCL_AT=$at "${render[@]}"
            expect_stderr_contains 'has too little free of its'
        done
    done

    # A device that is lost: at the first launches or in the midst of a run.
    for function in clEnqueueNDRangeKernel clFlush clFinish clWaitForEvents clEnqueueReadBuffer clEnqueueWriteBuffer; do
        for at in 1 2 5; do
            if [[ $function == clFinish ]] && ((at > 1)); then
                continue # after the upload it only cleans up
            fi
            for error in -36 -9999; do
                expect_orderly_failure 3 "${opencl[@]}" FAILING_OPENCL=$function FAILING_OPENCL_AT=$at \
                    FAILING_OPENCL_CODE=$error "${render[@]}"
                expect_stderr_contains "$lost"
                expect_stderr_contains "$function"
            done
        done
    done
    # To wait needs no memory.
    expect_orderly_failure 3 "${opencl[@]}" FAILING_OPENCL=clWaitForEvents FAILING_OPENCL_CODE=-5 "${render[@]}"
    expect_stderr_contains "$lost"
    for function in clCreateContext clCreateCommandQueue; do
        expect_orderly_failure 3 "${opencl[@]}" FAILING_OPENCL=$function FAILING_OPENCL_CODE=-2 "${render[@]}"
        expect_stderr_contains "$lost"
        expect_orderly_failure 1 "${opencl[@]}" FAILING_OPENCL=$function FAILING_OPENCL_CODE=-6 "${render[@]}"
        expect_stderr_contains "$function failed with CL_OUT_OF_HOST_MEMORY"
    done

    # Any other error of any function, at any of its calls: never a crash.
    for function in clSetKernelArg clCreateKernel clEnqueueMapBuffer clEnqueueNDRangeKernel clFlush; do
        for at in 1 2 3; do
            run timeout 200 "${opencl[@]}" FAILING_OPENCL=$function FAILING_OPENCL_AT=$at FAILING_OPENCL_CODE=-30 \
                "${render[@]}"
            if ((code != 0 && code != 1)); then
                fail "exit code $code where call $at of $function fails"
                show_logs
            elif ((code == 1)); then
                expect_stderr_contains "$function failed with CL_INVALID_VALUE (-30)"
            fi
            rm -rf ./*
        done
    done

    # A compiler that fails, and one that is not there.
    for error in -11 -3 -6; do
        rm -rf ./*
        expect_exit 1 env HEDRON_CACHE=off "${opencl[@]}" FAILING_OPENCL=clBuildProgram FAILING_OPENCL_CODE=$error \
            "${render[@]}"
        expect_stderr_contains 'refused the kernels (clBuildProgram: CL_'
        expect_files .
    done
    # Kernels that are kept, but that the compiler no longer turns into a program, are compiled anew.
    expect_exit 0 "${opencl[@]}" FAILING_OPENCL=clBuildProgram FAILING_OPENCL_TIMES=1 FAILING_OPENCL_CODE=-11 \
        "$hedron" render --verbose --backend opencl "${small[@]}" --frames 0-4 -o '%d.data'
    expect_stderr_contains 'the driver refused the cached kernels'
    expect_stderr_contains 'compiled in'
    rm -rf ./*

    # No platform at all.
    expect_orderly_failure 3 "${opencl[@]}" FAILING_OPENCL=clGetPlatformIDs FAILING_OPENCL_CODE=-1001 "${render[@]}"

    # Where any device will do, the next one does it, and a sentence tells why.
    if ! has_other_gpu; then
        expect_exit 0 "${opencl[@]}" FAILING_OPENCL=clFinish FAILING_OPENCL_CODE=-36 "$hedron" --gpu "${small[@]}" \
            --frames 0 <<<"$("$hedron" --default)"
        expect_stderr_contains 'tracing with c on'
        rm -rf ./*
    fi

    # A driver, or its compiler, that never returns: the first signal ends the program all the same.
    expect_end_by_signals "${opencl[@]}" FAILING_OPENCL_HANGS="$work/reached" FAILING_OPENCL=clFlush FAILING_OPENCL_AT=3 \
        "${render[@]}"
    expect_end_by_signals HEDRON_CACHE=off "${opencl[@]}" FAILING_OPENCL_HANGS="$work/reached" \
        FAILING_OPENCL=clBuildProgram "${render[@]}"
fi

# ---- CUDA
nvrtc=$build/tests/fake_cuda/libnvrtc.so.12
if [[ ! -e $nvrtc ]]; then
    echo "not tested: CUDA that fails, for no compiler of C++ is here that could build the kernels"
    expect_files .
    finish
fi
mkdir "$work/no_vendors"
cuda=(env LD_LIBRARY_PATH="$build/tests/fake_cuda" HEDRON_NVRTC="$nvrtc" HEDRON_CACHE="$work/cache"
    OCL_ICD_VENDORS="$work/no_vendors")
frames=("$hedron" render "${small[@]}" --frames 0-6 --backend cuda --math fast --quiet -o '%d.data' "${film[@]}")
expect_exit 0 "${cuda[@]}" "${frames[@]}"
rm -rf ./*
# A device that fell off the bus, an error of its memory, a kernel that took too long, one that crashed.
for error in 46 214 700 702 719; do
    for function in cuMemcpyHtoDAsync cuLaunchKernel cuEventSynchronize; do
        expect_orderly_failure 3 "${cuda[@]}" FAKE_CUDA_FAILS=$function FAKE_CUDA_ERROR=$error "${frames[@]}"
        expect_stderr_contains "$lost"
        expect_stderr_contains "$function"
    done
done
# Memory: what was asked for, and what there is.
expect_orderly_failure 1 "${cuda[@]}" FAKE_CUDA_FAILS=cuMemAlloc FAKE_CUDA_MEMORY=50000000 "${frames[@]}"
expect_stderr_contains 'free of its 50.0 MB (cuMemAlloc: '
# A driver that never returns.
for function in cuLaunchKernel cuEventSynchronize; do
    expect_end_by_signals "${cuda[@]}" FAKE_CUDA_HANGS="$work/reached" FAKE_CUDA_FAILS=$function "${frames[@]}"
done

expect_files .
finish
