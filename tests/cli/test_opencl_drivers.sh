#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Drivers for OpenCL that ./dev test fetches into the build folder: Intel's for CPUs, which claims less
# than it does, has the bytes of plain C; Mesa's rusticl on llvmpipe is caught by the arithmetic probe.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
intel=$build/../opencl-intel
rusticl=$build/../opencl-rusticl
if is_sanitized; then
    skip "drivers are not built with sanitizers"
elif [[ ! -e $intel/vendors/intel.icd && ! -e $rusticl/vendors/rusticl.icd ]]; then
    skip "neither Intel's OpenCL nor rusticl could be fetched to $(dirname "$build")"
fi
export HEDRON_CACHE=off

if [[ -e $intel/vendors/intel.icd ]]; then
    for choice in 'float --pipeline wavefront' 'double --pipeline mega'; do
        # shellcheck disable=SC2206 # words
        render=("$hedron" render "${small[@]}" --frames 0 --quiet --precision $choice)
        expect_exit 0 "${render[@]}" --backend c -o expected.data
        expect_exit 0 env OCL_ICD_VENDORS="$intel/vendors" "${render[@]}" --backend opencl --lanes 4 -o picture.data
        expect_same picture.data expected.data
    done
    rm -f picture.data expected.data
else
    echo "not tested: Intel's OpenCL, which could not be fetched"
fi

if [[ -e $rusticl/vendors/rusticl.icd ]]; then
    libraries=$(dirname "$(cat "$rusticl/vendors/rusticl.icd")")
    env=(env OCL_ICD_VENDORS="$rusticl/vendors" RUSTICL_ENABLE=llvmpipe LD_LIBRARY_PATH="$libraries")
    cd "$rusticl"
    run "${env[@]}" "$hedron" devices
    if grep -q 'rusticl' "$logs/stdout"; then
        expect_refusal 3 "${env[@]}" "$hedron" render "${small[@]}" --frames 0 --backend opencl --quiet -o "$work/picture.data"
        expect_stderr_contains 'rusticl'
        expect_stderr_contains ' computes wrongly: '
        expect_stderr_contains ' in float is '
    else
        echo "not tested: rusticl, which has no device here"
    fi
    cd "$OLDPWD"
else
    echo "not tested: rusticl, which could not be fetched"
fi

expect_files .
finish
