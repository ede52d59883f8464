#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The list of devices, the choice among them, and the message if one is missing. The unit tests cover device names
# (choice/test_devices).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input

section() { # NAME: the list below this backend
    awk -v name="$1" '/^[^ ]/ {inside = ($0 == name)} inside && /^ /' "$logs/stdout"
}

# ---- the list, as text and as JSON: the same devices, every field of each
for command in "$hedron" "${nothing[*]} $hedron"; do
    # shellcheck disable=SC2086 # a command and its arguments
    expect_exit 0 $command devices
    expect_silent_stderr
    if [[ $(grep '^[^ ]' "$logs/stdout" | tr '\n' ' ') != 'cuda opencl c ' || -z $(section cuda) || -z $(section opencl) ||
        $(section c) != *'  0  '* || $(section c) != *'strict arithmetic: yes'* ]] ||
        grep -q -x -E ' *not available:? *' "$logs/stdout"; then
        fail "the list lacks a backend, plain C's strict arithmetic, or the reason for a missing one"
    fi
    listed=$(grep -c '^  [0-9]' "$logs/stdout")
    missing=$(grep -c '^  not available: .' "$logs/stdout" || true)
    if ! command -v jq >"$logs/which"; then
        echo "not tested: the list as JSON, because jq is missing"
        continue
    fi
    # shellcheck disable=SC2086
    expect_exit 0 $command devices --json
    expect_silent_stderr
    found=$(jq -c '[([.backends[].name] | join(" ")), ([.backends[].devices[]] | length),
        ([.backends[] | select(.available | not) | .reason | select(length > 0)] | length),
        (.kernels | test("^[0-9a-f]{64}$")), ([.backends[].devices[] | keys_unsorted | join(" ")] | unique),
        (.backends[2].devices[0] | [.backend, .index, .is_cpu, .has_double, .unusable, .is_measured, .not_strict])]' "$logs/stdout")
    expected="[\"cuda opencl c\",$listed,$missing,true,[\"backend index name driver is_cpu compute_units clock_mhz has_double unusable is_measured not_strict\"],[\"c\",0,true,true,null,true,null]]"
    [[ $found == "$expected" ]] || fail "the JSON has $found, expected $expected"
done

# ---- a backend or a device that is missing
render=("$hedron" render "${small[@]}" --frames 0 -o picture.data)
classic=("$hedron" "${small[@]}" --frames 0)
once() { # WORDS: the sentence has them, but not repeatedly
    expect_stderr_contains "$1"
    (($(grep -o -F -e "$1" "$logs/stderr" | wc -l) <= 1)) || fail "the sentence says '$1' more than once"
}
expect_refusal 3 "${nothing[@]}" "${render[@]}" --backend opencl
once 'no OpenCL platform'
once 'opencl: '
mkdir "$work/loader" # OpenCL's library is loaded at run time: first it is no library, then one without OpenCL's functions
: >"$work/loader/libOpenCL.so.1"
without=(env LD_LIBRARY_PATH="$work/loader${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}")
expect_refusal 3 "${without[@]}" "${render[@]}" --backend opencl
once "OpenCL's loader (libOpenCL.so.1) is not installed"
ln -sf "$(ldd "$hedron" | sed -n 's/.*libm.* => \([^ ]*\).*/\1/p')" "$work/loader/libOpenCL.so.1"
expect_refusal 3 "${without[@]}" "${render[@]}" --backend opencl
once 'libOpenCL.so.1 is older than OpenCL 1.2: it has no function clBuildProgram'
expect_refusal 3 "${nothing[@]}" "${classic[@]}" --backend cuda <"$work/official.in"
once 'cuda: '
expect_refusal 3 "${nothing[@]}" "${classic[@]}" --backend cuda --cpu <"$work/official.in" # --cpu is binding
expect_refusal 3 "${nothing[@]}" "${render[@]}" --device nonsense
once 'no OpenCL platform'
expect_files .

# ---- a device whose memory is too small
expect_exit 0 "$hedron" devices
if section opencl | grep -q 'Portable Computing Language'; then
    expect_refusal 3 env POCL_MEMORY_LIMIT=1 "$hedron" render --backend opencl --frames 0 --samples 1 \
        --depth 0 --size 8192x4096 -o large.pfm
    once 'the pixels need 403 MB in one buffer; '
else
    echo "not tested: too little device memory, because PoCL is missing"
fi

# ---- a device by the name in the list, in any case
expect_exit 0 "$hedron" devices
name=$(section c | sed -n 's/^  0  //p')
expect_exit 0 "${nothing[@]}" "${render[@]}" --device "${name^^}"
rm picture.data

# ---- without any GPU: a sentence, and the same picture from the C backend
expect_exit 0 "${classic[@]}" --cpu <"$work/official.in"
expect_silent_stderr
mv out/img_0.data cpu.data
expect_exit 0 "${nothing[@]}" "${classic[@]}" <"$work/official.in"
expect_sentence
expect_stderr_contains 'no suitable GPU was found'
expect_stdout_lines 1 $'0\t[0-9.]+\t[0-9]+'
expect_same out/img_0.data cpu.data
expect_exit 0 "${nothing[@]}" "${classic[@]}" --gpu --quiet <"$work/official.in"
expect_silent_stderr
if has_opencl; then
    expect_exit 0 "${no_nvidia[@]}" "${classic[@]}" --cpu --backend opencl <"$work/official.in"
    expect_same out/img_0.data cpu.data
fi
finish
