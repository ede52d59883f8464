#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Problems of a first setup of an NVIDIA card: drivers that dropped it or do not start, an NVRTC that is missing or too new.
# Each is reported with a remedy; the unit tests cover the words and packages (device/cuda).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=${2:?the build folder is the second argument}
use_fake_cuda "$build"
export HEDRON_CACHE=off
unset VIRTUAL_ENV CONDA_PREFIX
render=("$hedron" render "${small[@]}" --frames 0 --backend cuda --quiet -o picture.data)

# ---- a driver that does not start
cannot_start=(env FAKE_CUDA_FAILS=cuInit FAKE_CUDA_FAILS_AT=1)
expect_refusal 3 "${cannot_start[@]}" FAKE_CUDA_ERROR=999 "${render[@]}"
expect_stderr_contains 'cuInit failed with CUDA_ERROR_UNKNOWN (999); after suspend, run: '

# ---- if any device will do, a skipped GPU is reported in one line, with a remedy
any=("$hedron" render --size 320x240 --samples 2 --frames 0-1 --threads 1 --lanes 1 -o any/%d.data)
too_new=(env FAKE_NVRTC_MAJOR=13)
expect_exit 0 "${too_new[@]}" "${any[@]}"
expect_stderr_contains 'hedron: cuda:0 (Fake device 0) is not used: no NVRTC library here compiles for Fake device 0 (sm_61); to install one that does: '
expect_stderr_contains '; tracing with c on '
expect_exit 0 "${cannot_start[@]}" FAKE_CUDA_ERROR=100 "${any[@]}" # there is no card
! grep -q '^hedron: ' "$logs/stderr" || fail "a missing card is reported as skipped"
rm -r any

# ---- an NVRTC without support for the card, and a driver that does not load its output: the package to install
expect_refusal 3 "${too_new[@]}" FAKE_CUDA_DRIVER=12020 "${render[@]}"
expect_stderr_contains "no NVRTC library here compiles for Fake device 0 (sm_61); to install one that does: python3 -m venv ~/.local/share/hedron && ~/.local/share/hedron/bin/pip install nvidia-cuda-nvrtc-cu12, or name a libnvrtc.so in HEDRON_NVRTC; the driver's branch 580 is the last for this card; found: NVRTC 13.0 for sm_75 to sm_90"
expect_refusal 3 "${too_new[@]}" FAKE_CUDA_CAPABILITY=120 FAKE_CUDA_DRIVER=13000 "${render[@]}"
expect_stderr_contains 'pip install nvidia-cuda-nvrtc, or name a libnvrtc.so in HEDRON_NVRTC; found: NVRTC 13.0 for sm_75 to sm_90'
expect_refusal 1 env FAKE_CUDA_DRIVER=11040 FAKE_CUDA_REFUSES=1 "${render[@]}" --math fast
expect_stderr_contains "the driver, of CUDA 11, does not load what NVRTC 12.8 compiled for sm_61 (cuModuleLoadDataEx: CUDA_ERROR_OUT_OF_MEMORY); Python's package nvidia-cuda-nvrtc-cu11 suits both"

# ---- NVRTC beside the program, fetched there by ./dev
mkdir -p "$work/build/release" "$work/build/nvrtc12/nvidia/cuda_nvrtc/lib"
cp "$hedron" "$work/build/release/hedron"
cp "$nvrtc" "$work/build/nvrtc12/nvidia/cuda_nvrtc/lib"
expect_exit 0 env -u HEDRON_NVRTC LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" "$work/build/release/hedron" devices
grep -q '/nvrtc12/nvidia/cuda_nvrtc/lib/libnvrtc\.so\.12$' "$work"/loaded.* || fail "that of ./dev was not loaded"

# ---- of 2 GB of memory 700 MB are enough for 3840 x 2160 and both pipelines; less is reported
large=(FAKE_CUDA_MEMORY=2000000000 FAKE_CUDA_SKIPS=1 "$hedron" render --size 3840x2160 --samples 1
    --frames 0-1 --backend cuda --math fast --quiet -o large/%d.data)
for pipeline in mega wavefront; do
    expect_exit 0 env FAKE_CUDA_FREE=700000000 "${large[@]}" --pipeline $pipeline
    expect_silent_stderr
    rm -r large
done
expect_refusal 1 env FAKE_CUDA_FREE=100000000 "${large[@]}"
expect_stderr_contains 'the pixels need 99.5 MB; Fake device 0 has 91.5 MB free of its 2.00 GB (cuMemAlloc: CUDA_ERROR_OUT_OF_MEMORY)'
rm -rf large

# ---- without any NVRTC: the program's own PTX, if it is strict and the options allow it
with_ptx=$build/tests/fake_cuda/hedron_with_fake_ptx
if [[ -e $with_ptx ]]; then
    ptx=("$with_ptx" render "${small[@]}" --frames 0 --backend cuda -o)
    off=(env HEDRON_NVRTC=off)
    "$hedron" render "${small[@]}" --frames 0 --backend c --quiet -o expected.data >"$logs/stdout" 2>&1
    expect_exit 0 "${off[@]}" "${ptx[@]}" picture.data --quiet
    expect_same picture.data expected.data
    for card in '61 64' '90 80'; do
        expect_exit 0 "${off[@]}" FAKE_CUDA_CAPABILITY="${card% *}" "${ptx[@]}" picture.data --verbose
        expect_stderr_contains ' by the driver from PTX of NVRTC 12.8; passed the self-test; '
        expect_stderr_contains ", ${card#* } registers and "
    done
    expect_exit 0 "${ptx[@]}" picture.data --verbose # an NVRTC comes first
    expect_stderr_contains ' ms by NVRTC 12.8; passed the self-test; '
    rm ./*.*
    ptx+=(picture.data --quiet)
    expect_refusal 3 "${off[@]}" "${ptx[@]}" --math fast
    expect_stderr_contains 'no NVRTC library here compiles for Fake device 0 (sm_61)'
    expect_stderr_contains 'found: none; the PTX in this program is for strict arithmetic, at most 128 planes, depth 64, and blocks of 128 threads'
    expect_refusal 3 "${off[@]}" FAKE_CUDA_REFUSES=1 "${ptx[@]}"
    expect_stderr_contains 'does not load what the driver from PTX of NVRTC 12.8 compiled for sm_61 (cuModuleLoadDataEx: CUDA_ERROR_OUT_OF_MEMORY); Python'
    expect_refusal 3 "${off[@]}" FAKE_CUDA_CAPABILITY=60 "${ptx[@]}"
    expect_stderr_contains 'no NVRTC library here compiles for Fake device 0 (sm_60)'
    # A named file is the only candidate.
    expect_refusal 3 env HEDRON_NVRTC="$work/nothing.so" "${ptx[@]}"
    expect_stderr_contains 'nothing.so cannot be loaded as an NVRTC library'
fi

expect_files .
finish
