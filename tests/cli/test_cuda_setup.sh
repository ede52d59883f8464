#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What keeps a card of NVIDIA's from being used on the first evening: drivers that know it no more or do
# not start, an NVRTC that is missing, too new, or in a folder of the user's. Each is told with what helps.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=${2:?the build folder is the second argument}
nvrtc=$build/tests/fake_cuda/libnvrtc.so.12
if [[ ! -e $nvrtc ]]; then
    skip "no compiler of C++ is here that could build the kernels"
fi
export LD_LIBRARY_PATH=$build/tests/fake_cuda${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export HEDRON_CACHE=off
unset HEDRON_NVRTC VIRTUAL_ENV CONDA_PREFIX
mkdir "$work/no_vendors"
export OCL_ICD_VENDORS=$work/no_vendors
render=("$hedron" render "${small[@]}" --frames 0 --backend cuda --math fast --quiet -o picture.data)

# ---- a driver that does not start
cannot_start=(env FAKE_CUDA_FAILS=cuInit FAKE_CUDA_FAILS_AT=1)
expect_refusal 3 "${cannot_start[@]}" FAKE_CUDA_ERROR=999 "${render[@]}"
expect_stderr_contains 'cuInit failed with CUDA_ERROR_UNKNOWN (999); after the machine slept, this helps: sudo rmmod nvidia_uvm && sudo modprobe nvidia_uvm, or a restart'
expect_refusal 3 "${cannot_start[@]}" FAKE_CUDA_ERROR=100 FAKE_CUDA_DRIVER=13010 "${render[@]}"
expect_stderr_contains 'CUDA_ERROR_NO_DEVICE (100); it is of branch 590 or newer, which drives no card before sm_75: the branch 580 is the last for older ones, such as a GTX 1050'
expect_refusal 3 "${cannot_start[@]}" FAKE_CUDA_ERROR=100 FAKE_CUDA_DRIVER=13000 "${render[@]}"
expect_stderr_contains 'CUDA_ERROR_NO_DEVICE (100); no card is there that it drives, or CUDA_VISIBLE_DEVICES hides it'

# ---- where any device will do, a GPU that is passed over is told in one line, with what would help
any=("$hedron" render --size 320x240 --samples 2 --frames 0-1 --threads 1 --lanes 1 -o any/%d.data)
# expect_notes NUMBER [TEXT]: besides the progress of a slow machine.
expect_notes() {
    if (($(grep -c '^hedron: ' "$logs/stderr") != $1)); then
        fail "standard error has not $1 notes"
        show_logs
    fi
    if (($# > 1)); then
        expect_stderr_contains "hedron: $2"
        expect_stderr_contains '; tracing with c on '
    fi
    rm -r any
}
expect_exit 0 "${cannot_start[@]}" FAKE_CUDA_ERROR=999 "${any[@]}"
expect_notes 1 'cuda is passed over: the NVIDIA driver does not start: cuInit failed with CUDA_ERROR_UNKNOWN (999); after the machine slept, '
unfit=(env HEDRON_NVRTC="$nvrtc" FAKE_NVRTC_MAJOR=13)
expect_exit 0 "${unfit[@]}" "${any[@]}"
expect_notes 1 'cuda:0 (Fake device 0) is passed over: no NVRTC library here compiles for Fake device 0 (sm_61); to install one that does: '
expect_exit 0 "${unfit[@]}" "${any[@]}" --quiet
expect_notes 0
# None is there, and one that nobody asked for.
for no_gpu in FAKE_CUDA_ERROR=100 LD_LIBRARY_PATH=/nothing; do
    expect_exit 0 "${cannot_start[@]}" "$no_gpu" "${any[@]}"
    expect_notes 0
done
expect_exit 0 "${unfit[@]}" "${any[@]}" --backend c
expect_notes 0

# ---- an NVRTC that does not know the card: which one to install, by card and driver
# expect_package CAPABILITY DRIVER PACKAGE [MORE]
too_new=(env HEDRON_NVRTC="$nvrtc" FAKE_NVRTC_MAJOR=13)
expect_package() {
    expect_refusal 3 "${too_new[@]}" FAKE_CUDA_CAPABILITY="$1" FAKE_CUDA_DRIVER="$2" "${render[@]}"
    expect_stderr_contains "no NVRTC library here compiles for Fake device 0 (sm_$1); to install one that does: python3 -m venv ~/.local/share/hedron && ~/.local/share/hedron/bin/pip install $3, or name a libnvrtc.so in HEDRON_NVRTC${4:-}; found: NVRTC 13.0 for sm_75 to sm_90"
}
expect_package 61 13000 nvidia-cuda-nvrtc-cu12 "; the driver's branch 580 is the last for this card"
expect_package 61 12020 nvidia-cuda-nvrtc-cu12 "; the driver's branch 580 is the last for this card"
expect_package 61 11040 nvidia-cuda-nvrtc-cu11 "; the driver's branch 580 is the last for this card"
expect_package 37 11040 nvidia-cuda-nvrtc-cu11 "; the driver's branch 470 is the last for this card"
expect_package 120 13000 nvidia-cuda-nvrtc
expect_package 120 12080 nvidia-cuda-nvrtc-cu12

# ---- what the driver does not load: which package suits it
expect_refusal 1 env HEDRON_NVRTC="$nvrtc" FAKE_CUDA_DRIVER=11040 FAKE_CUDA_REFUSES=1 "${render[@]}"
expect_stderr_contains "the driver, of CUDA 11, does not load what NVRTC 12.8 compiled for sm_61 (cuModuleLoadDataEx: CUDA_ERROR_OUT_OF_MEMORY); what suits both is in Python's package nvidia-cuda-nvrtc-cu11"

# ---- where it is looked for: in what pip and conda make, and where ./dev fetches one to
# expect_found_in FOLDER [ASSIGNMENT...]: the library there is loaded, with these variables.
expect_found_in() {
    local folder=$1
    shift
    mkdir -p "$folder"
    cp "$nvrtc" "$folder/libnvrtc.so.12"
    expect_exit 0 env LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" "$@" "$program" devices
    if ! grep -h -o '/[^ ]*/libnvrtc\.so\.12$' "$work"/loaded.* | xargs realpath | grep -q -x -F "$(realpath "$folder")/libnvrtc.so.12"; then
        fail "the library in $folder was not loaded"
    fi
    rm -r "$work"/loaded.* "$folder"
}
program=$hedron
packages=lib/python3.11/site-packages/nvidia/cuda_nvrtc/lib
expect_found_in "$HOME/.local/share/hedron/$packages"
expect_found_in "$HOME/.local/$packages"
expect_found_in "$work/venv/$packages" VIRTUAL_ENV="$work/venv"
expect_found_in "$work/conda/lib" CONDA_PREFIX="$work/conda"
expect_found_in "$work/conda/$packages" CONDA_PREFIX="$work/conda"
mkdir -p "$work/build/release"
cp "$hedron" "$work/build/release/hedron"
program=$work/build/release/hedron
expect_found_in "$work/build/nvrtc12/nvidia/cuda_nvrtc/lib"

# ---- of 2 GB of memory 700 MB are enough for 3840 x 2160 and both pipelines; less is told
large=(FAKE_CUDA_MEMORY=2000000000 FAKE_CUDA_SKIPS=1 HEDRON_NVRTC="$nvrtc" "$hedron" render --size 3840x2160 --samples 1
    --frames 0-1 --backend cuda --math fast --quiet -o large/%d.data)
for pipeline in mega wavefront; do
    expect_exit 0 env FAKE_CUDA_FREE=700000000 "${large[@]}" --pipeline $pipeline
    expect_silent_stderr
    rm -r large
done
expect_refusal 1 env FAKE_CUDA_FREE=100000000 "${large[@]}"
expect_stderr_contains 'the pixels need 99.5 MB; Fake device 0 has 91.5 MB free of its 2.00 GB (cuMemAlloc: CUDA_ERROR_OUT_OF_MEMORY)'
rm -rf large

# ---- without any NVRTC: what the program brings, where it is strict and not too much is asked
export HEDRON_NVRTC=off
strict=(--size 32x24 --samples 1 --depth 2 --frames 0)
expect_refusal 3 env FAKE_CUDA_CAPABILITY=60 "$hedron" render "${strict[@]}" --backend cuda --quiet -o picture.data
expect_stderr_contains 'no NVRTC library here compiles for Fake device 0 (sm_60)'
with_ptx=$build/tests/fake_cuda/hedron_with_fake_ptx
if [[ -e $with_ptx ]]; then
    "$hedron" render "${strict[@]}" --backend c --quiet -o expected.data >"$logs/stdout"
    "$hedron" render "${strict[@]}" --backend c --quiet -o expected.exr >"$logs/stdout" 2>&1 || true
    for card in '61 64' '90 96'; do
        expect_exit 0 env FAKE_CUDA_CAPABILITY="${card% *}" "$with_ptx" render "${strict[@]}" --backend cuda --verbose -o picture.data
        expect_stderr_contains ' by the driver from PTX of NVRTC 12.8; passed the self-test ('
        expect_stderr_contains ", ${card#* } registers and "
        expect_same picture.data expected.data
        rm picture.data
    done
    if [[ -e expected.exr ]]; then # else this build has no OpenEXR
        expect_exit 0 "$with_ptx" render "${strict[@]}" --backend cuda --quiet -o picture.exr
        expect_same picture.exr expected.exr
        rm picture.exr expected.exr
    fi
    for more in '--math fast' '--precision double' '--depth 100' '--block 256'; do
        # shellcheck disable=SC2086
        expect_refusal 3 "$with_ptx" render "${strict[@]}" --backend cuda --quiet $more -o picture.data
        expect_stderr_contains 'no NVRTC library here compiles for Fake device 0 (sm_61)'
        expect_stderr_contains 'found: none; the PTX in this program is for strict arithmetic, at most 128 planes, depth 64, and blocks of 128 threads'
    done
    expect_refusal 3 env FAKE_CUDA_REFUSES=1 "$with_ptx" render "${strict[@]}" --backend cuda --quiet -o picture.data
    expect_stderr_contains 'does not load what the driver from PTX of NVRTC 12.8 compiled for sm_61 (cuModuleLoadDataEx: CUDA_ERROR_OUT_OF_MEMORY); what suits both is in'
    expect_refusal 3 env FAKE_CUDA_CAPABILITY=60 "$with_ptx" render "${strict[@]}" --backend cuda --quiet -o picture.data
    expect_stderr_contains 'no NVRTC library here compiles for Fake device 0 (sm_60)'
    # A file that is named is that one or none.
    expect_refusal 3 env HEDRON_NVRTC="$work/nothing.so" "$with_ptx" render "${strict[@]}" --backend cuda --quiet -o picture.data
    expect_stderr_contains 'nothing.so cannot be loaded as an NVRTC library'
    # NVRTC comes first where it is there.
    expect_exit 0 env HEDRON_NVRTC="$nvrtc" "$with_ptx" render "${strict[@]}" --backend cuda --verbose -o picture.data
    expect_stderr_contains ' ms by NVRTC 12.8; passed the self-test ('
    rm -f picture.data expected.data
fi

expect_files .
finish
