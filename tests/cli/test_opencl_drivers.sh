#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Drivers for OpenCL that ./dev test fetches into the build folder: Intel's for CPUs, which claims less
# than it does, is used as it is; Mesa's rusticl on llvmpipe is caught by the arithmetic probe. That Intel's gives the
# bytes of plain C is a matter of the conformance suite.
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
render=("$hedron" render "${small[@]}" --frames 0 --quiet)

if [[ -e $intel/vendors/intel.icd ]]; then
    expect_exit 0 "${render[@]}" --backend c -o expected.data
    expect_exit 0 env OCL_ICD_VENDORS="$intel/vendors" "${render[@]}" --backend opencl --lanes 4 -o picture.data
    expect_same picture.data expected.data
    rm -f picture.data expected.data
else
    echo "not tested: Intel's OpenCL, which could not be fetched"
fi

libraries=$(dirname "$(cat "$rusticl/vendors/rusticl.icd" 2>"$logs/which" || true)")
rusticl=(env -C "$rusticl" OCL_ICD_VENDORS="$rusticl/vendors" RUSTICL_ENABLE=llvmpipe LD_LIBRARY_PATH="$libraries")
if "${rusticl[@]}" "$hedron" devices 2>"$logs/which" | grep -q 'rusticl'; then
    expect_refusal 3 "${rusticl[@]}" "${render[@]}" --backend opencl -o "$work/picture.data"
    expect_stderr_contains 'rusticl'
    expect_stderr_contains ' computes wrongly: '
    expect_stderr_contains ' in float is '
else
    echo "not tested: rusticl, which could not be fetched or has no device here"
fi

expect_files .
finish
