#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The list of devices, the choice among them, and what is said where one is missing.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
mkdir "$work/no_vendors"
no_opencl=(env OCL_ICD_VENDORS="$work/no_vendors")
nothing=(env CUDA_VISIBLE_DEVICES= OCL_ICD_VENDORS="$work/no_vendors")

# section NAME: what the list says below this backend.
section() {
    awk -v name="$1" '/^[^ ]/ {inside = ($0 == name)} inside && /^ /' "$logs/stdout"
}

# ---- the list
for command in "$hedron" "${no_nvidia[*]} $hedron" "${no_opencl[*]} $hedron" "${nothing[*]} $hedron"; do
    # shellcheck disable=SC2086 # a command and its arguments
    expect_exit 0 $command devices
    expect_silent_stderr
    if [[ $(grep '^[^ ]' "$logs/stdout" | tr '\n' ' ') != 'cuda opencl c ' ]]; then
        fail "the list does not have the three backends"
        show_logs
    fi
    for backend in cuda opencl c; do
        if [[ -z $(section "$backend") ]]; then
            fail "the list says nothing of $backend"
        fi
        if section "$backend" | grep -q -x -E ' *not available:? *'; then
            fail "the list has no reason for $backend"
        fi
    done
    if [[ $(section c) != *'  0  '* || $(section c) != *'strict arithmetic: yes'* ]]; then
        fail "the C backend is not there for strict arithmetic"
        show_logs
    fi
done
expect_exit 0 "${nothing[@]}" "$hedron" devices
for backend in cuda opencl; do
    if [[ $(section "$backend") != *'not available: '?????* ]]; then
        fail "the list has no reason why $backend is missing"
        show_logs
    fi
done

# ---- the list as JSON: the same devices, every field of each
if command -v jq >"$logs/which"; then
    for command in "$hedron" "${nothing[*]} $hedron"; do
        # shellcheck disable=SC2086 # a command and its arguments
        expect_exit 0 $command devices
        listed=$(grep -c '^  [0-9]' "$logs/stdout")
        missing=$(grep -c '^  not available: .' "$logs/stdout" || true)
        # shellcheck disable=SC2086
        expect_exit 0 $command devices --json
        expect_silent_stderr
        cp "$logs/stdout" devices.json
        found=$(jq -c '[([.backends[].name] | join(" ")), ([.backends[].devices[]] | length),
            ([.backends[] | select(.available | not) | .reason | select(length > 0)] | length)]' devices.json)
        if [[ $found != "[\"cuda opencl c\",$listed,$missing]" ]]; then
            fail "the JSON has $found, the list has $listed devices, and $missing backends are missing"
        fi
        if ! jq -e '.kernels | test("^[0-9a-f]{64}$")' devices.json >"$logs/jq"; then
            fail "the JSON has no hash of the kernels"
        fi
        fields=$(jq -c '[.backends[].devices[] | keys_unsorted] | unique' devices.json)
        if [[ $fields != '[["backend","index","name","driver","is_cpu","compute_units","clock_mhz","has_double","unusable","is_measured","not_strict"]]' ]]; then
            fail "the devices have the fields $fields"
        fi
        if [[ $(jq -c '.backends[2].devices[0] | [.backend, .index, .is_cpu, .has_double, .unusable, .is_measured, .not_strict]' \
            devices.json) != '["c",0,true,true,null,true,null]' ]]; then
            fail "the C backend's device is not as expected"
        fi
    done
    rm devices.json
else
    echo "not tested: the list as JSON, for there is no jq"
fi

# ---- a backend that is missing
render=("$hedron" render "${small[@]}" --frames 0 -o picture.data)
# once WORD: the sentence says it, but not over and over.
once() {
    expect_stderr_contains "$1"
    if (($(grep -o -F -e "$1" "$logs/stderr" | wc -l) > 1)); then
        fail "the sentence says '$1' more than once"
        show_logs
    fi
}
expect_refusal 3 "${nothing[@]}" "${render[@]}" --backend opencl
once 'no OpenCL platform'
once 'opencl: '
expect_refusal 3 "${nothing[@]}" "${render[@]}" --backend cuda
once 'cuda: '
expect_refusal 3 "${nothing[@]}" "$hedron" --backend opencl "${small[@]}" --frames 0 <"$work/official.in"
expect_refusal 3 "${nothing[@]}" "$hedron" --backend cuda "${small[@]}" --frames 0 <"$work/official.in"

# ---- a device that is missing
expect_refusal 3 "${nothing[@]}" "${render[@]}" --device nonsense
once 'no OpenCL platform'
for device in nonsense 99 -1 0x0 '0 ' 99999999999999999999 4294967296; do
    expect_refusal 3 "${nothing[@]}" "${render[@]}" --device "$device"
    expect_stderr_contains "'$device'"
    expect_refusal 3 "${render[@]}" --backend c --device "$device"
    expect_stderr_contains "'$device'"
    expect_refusal 3 "${nothing[@]}" "$hedron" --gpu "${small[@]}" --frames 0 --device "$device" \
        <"$work/official.in"
    expect_refusal 3 "$hedron" --cpu "${small[@]}" --frames 0 --device "$device" <"$work/official.in"
done
expect_refusal 3 "${render[@]}" --backend c --device 1
# An empty name is the mistake of a script, not a wish for any device.
expect_refusal 2 "${render[@]}" --backend c --device ''
expect_files .

# ---- a device whose memory is too small
expect_exit 0 "$hedron" devices
if section opencl | grep -q 'Portable Computing Language'; then
    expect_refusal 3 env POCL_MEMORY_LIMIT=1 "$hedron" render --backend opencl --frames 0 --samples 1 \
        --depth 0 --size 8192x4096 -o large.pfm
    once 'the pixels need 403 MB in one buffer; '
    expect_files .
else
    echo "not tested: too little device memory, for there is no PoCL"
fi

# ---- a device by number and by part of its name, in any case
expect_exit 0 "$hedron" devices
name=$(section c | sed -n 's/^  0  //p')
for device in 0 "$name" "${name:1:4}" "${name,,}" "${name^^}"; do
    expect_exit 0 "${render[@]}" --backend c --device "$device"
    rm picture.data
    expect_exit 0 "${nothing[@]}" "${render[@]}" --device "$device"
    rm picture.data
done

# ---- without any GPU: a sentence, and the same picture from the C backend
expect_exit 0 "$hedron" --cpu "${small[@]}" --frames 0 <"$work/official.in"
expect_silent_stderr
mv out/img_0.data cpu.data
rmdir out
for key in --gpu ''; do
    # shellcheck disable=SC2086 # an option or none
    expect_exit 0 "${nothing[@]}" "$hedron" $key "${small[@]}" --frames 0 <"$work/official.in"
    expect_sentence
    expect_stderr_contains 'no suitable GPU was found'
    expect_stdout_lines 1 $'0\t[0-9.]+\t[0-9]+'
    expect_same out/img_0.data cpu.data
    rm -r out
done
expect_exit 0 "${nothing[@]}" "$hedron" --quiet "${small[@]}" --frames 0 <"$work/official.in"
expect_silent_stderr
rm -r out
# 'render' takes what there is, without a word.
expect_exit 0 "${nothing[@]}" "${render[@]}" --quiet
expect_silent_stderr
rm picture.data

# ---- the key --cpu means it, whatever the backend
expect_refusal 3 "${nothing[@]}" "$hedron" --cpu --backend cuda "${small[@]}" --frames 0 <"$work/official.in"
if has_opencl; then
    expect_exit 0 "${no_nvidia[@]}" "$hedron" --cpu --backend opencl "${small[@]}" --frames 0 \
        <"$work/official.in"
    expect_same out/img_0.data cpu.data
    rm -r out
fi

rm cpu.data
expect_files .
finish
