#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# OpenCL that computes wrongly, as Mesa's rusticl does, or because its compiler mistakes some text. The probe refuses it and
# its finding is remembered; wrong division is replaced by fma with equal bytes.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
! is_sanitized || skip "nothing can be preloaded before a sanitizer"
export HEDRON_CACHE=$work/cache

# ---- Mesa's rusticl on llvmpipe, which ./dev test --all fetches into the build folder
rusticl=$build/../opencl-rusticl
libraries=$(dirname "$(cat "$rusticl/vendors/rusticl.icd" 2>"$logs/which" || true)")
rusticl=(env -C "$rusticl" OCL_ICD_VENDORS="$rusticl/vendors" RUSTICL_ENABLE=llvmpipe LD_LIBRARY_PATH="$libraries")
if "${rusticl[@]}" "$hedron" devices 2>"$logs/which" | grep -q 'rusticl'; then
    expect_refusal 3 "${rusticl[@]}" "$hedron" render "${small[@]}" --frames 0 --backend opencl --quiet -o "$work/picture.data"
    expect_stderr_contains 'rusticl'
    expect_stderr_contains ' computes wrongly: '
    expect_stderr_contains ' in float is '
    rm -r "$work/cache"
else
    echo "not tested: rusticl, which could not be fetched or has no device here"
fi

if ! has_opencl; then
    ((failures == 0)) || finish
    skip "no OpenCL device compiles kernels here"
fi
render=("$hedron" render "${small[@]}" --frames 0 --backend opencl --lanes 1 -o picture.data)
"$hedron" render "${small[@]}" --frames 0 --backend c --quiet -o expected.data >"$logs/stdout"

# expect_healed TEXT FOR: with this fault the picture is correct, by fma.
expect_healed() {
    take "$build" "$1" "$2"
    expect_exit 0 "${driver[@]}" "${render[@]}" --verbose
    expect_stderr_contains ', division by fma'
    expect_same picture.data expected.data
}

# ---- division or roots that are one unit off in the last place are replaced by fma, and that is remembered
for _ in cold warm; do
    expect_healed 'return a / b;' 'return nextafter(a / b, INFINITY);'
done
expect_stderr_contains "taken from $work/cache"
rm -r "$work/cache"
expect_exit 0 "${no_nvidia[@]}" "${render[@]}" --verbose
! grep -q 'division by fma' "$logs/stderr" || fail 'a device that divides correctly divides by fma'
rm -r "$work/cache" picture.data

# ---- faults without a remedy are refused before kernels are compiled; then that is remembered
# expect_refused TEXT FOR WORDS
expect_refused() {
    take "$build" "$1" "$2"
    expect_refusal 3 "${driver[@]}" "${render[@]}" --quiet
    expect_stderr_contains "$3"
    ! compgen -G "$work/cache/opencl-*" >"$logs/which" || fail "kernels of a device that computes wrongly are kept"
    expect_refusal 3 "${no_nvidia[@]}" "${render[@]}" --quiet
    expect_stderr_contains ': it computes wrongly: '
    rm -r "$work/cache"
}
expect_refused 'return fma(a, b, c);' 'vreal r = fma(a, b, c); return fabs(r) < 0x1p-126f ? copysign(0.0f, r) : r;' \
    '(denormal numbers are flushed to 0)'
expect_refused 'FP_CONTRACT OFF' 'FP_CONTRACT ON' ': a * b + c, rounded twice, of a = '

# ---- kernels that render wrongly in the megakernel alone: the wavefront takes over
take "$build" '1.5259021896696422e-5' $'\n#if HD_WAVEFRONT\n1.5259021896696422e-5\n#else\n1.6e-5\n#endif\n'
expect_exit 0 "${driver[@]}" "${render[@]}" --pipeline mega --verbose
expect_stderr_contains 'the wavefront takes over: '
expect_stderr_contains 'passed the self-test; '
expect_same picture.data expected.data
finish
