#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Drivers that compute wrongly, an OpenCL whose compiler takes some text for other text: what the
# arithmetic probe says of each, and that division which is wrong is made of fma with equal bytes.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
if is_sanitized; then
    skip "nothing can be preloaded before a sanitizer"
elif ! has_opencl; then
    skip "no OpenCL device compiles kernels here"
fi
export HEDRON_CACHE=$work/cache
# take TEXT FOR: from here on ${driver[@]} runs a command with a driver that takes one for the other.
take() {
    driver=("${no_nvidia[@]}" LD_PRELOAD="$build/tests/failing/libfailing_opencl.so" FAILING_OPENCL_TEXT="$1"
        FAILING_OPENCL_FOR="$2")
}
render=("$hedron" render "${small[@]}" --frames 0 --backend opencl --lanes 1 -o picture.data)
"$hedron" render "${small[@]}" --frames 0 --backend c --quiet -o expected.data >"$logs/stdout"

# ---- division or roots that are one unit off in the last place: made of fma, and that is remembered
take 'return a / b;' 'return nextafter(a / b, INFINITY);'
for _ in cold warm; do
    expect_exit 0 "${driver[@]}" "${render[@]}" --verbose
    expect_stderr_contains ', division by fma'
    expect_same picture.data expected.data
done
expect_stderr_contains "taken from $work/cache"
rm -r "$work/cache"
take 'return sqrt(a);' 'return nextafter(sqrt(a), 0.0f);'
expect_exit 0 "${driver[@]}" "${render[@]}" --verbose
expect_stderr_contains ', division by fma'
expect_same picture.data expected.data
rm -r "$work/cache" picture.data
expect_exit 0 "${no_nvidia[@]}" "${render[@]}" --verbose
if grep -q 'division by fma' "$logs/stderr"; then
    fail 'a device that divides rightly divides by fma'
fi
rm -r "$work/cache" picture.data

# ---- what nothing mends: each has its sentence, before kernels are compiled; then it is remembered
# expect_refused TEXT FOR WORD...: a device that computes so.
expect_refused() {
    local word
    take "$1" "$2"
    expect_refusal 3 "${driver[@]}" "${render[@]}" --quiet
    for word in ' computes wrongly: ' ' in float is ' "${@:3}"; do
        expect_stderr_contains "$word"
    done
    expect_exit 0 "${no_nvidia[@]}" "$hedron" devices
    expect_stdout_contains 'strict arithmetic: no, it computes wrongly: '
    expect_refusal 3 "${no_nvidia[@]}" "${render[@]}" --quiet
    expect_stderr_contains ': it computes wrongly: '
    if compgen -G "$work/cache/opencl-*" >"$logs/which"; then
        fail "kernels of a device that computes wrongly are kept"
    fi
    rm -r "$work/cache"
}
expect_refused 'return fma(a, b, c);' \
    'vreal r = fma(a, b, c); return fabs(r) < 0x1p-126f ? copysign(0.0f, r) : r;' \
    ': fma(a, b, c) of a = ' '(denormal numbers are flushed to 0)'
expect_refused 'return fma(a, b, c);' 'return a * b + c;' ': fma(a, b, c) of a = ' '(it is rounded twice)'
expect_refused 'FP_CONTRACT OFF' 'FP_CONTRACT ON' ': a * b + c, rounded twice, of a = ' \
    '(a product and a sum are contracted into one operation)'
expect_refused 'return (vfix)a;' 'return (vfix)(int)a;' ': (64-bit integer) of a'
expect_refused 'return a < b ? -1 : 0;' 'return a <= b ? -1 : 0;' ': the lesser of a and b of a = '

# ---- kernels that render wrongly in the megakernel alone: the wavefront takes over
take '1.5259021896696422e-5' $'\n#if HD_WAVEFRONT\n1.5259021896696422e-5\n#else\n1.6e-5\n#endif\n'
expect_exit 0 "${driver[@]}" "${render[@]}" --pipeline mega --verbose
expect_stderr_contains 'the wavefront takes over: '
expect_stderr_contains 'passed the self-test ('
expect_same picture.data expected.data
rm -r "$work/cache" picture.data

# ---- fast arithmetic does without
take 'return fma(a, b, c);' 'return a * b + c;'
expect_exit 0 "${driver[@]}" "${render[@]}" --quiet --math fast
rm -f picture.data expected.data

expect_files .
finish
