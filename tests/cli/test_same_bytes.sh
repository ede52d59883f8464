#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Backends, pipelines, lanes and threads give the same bytes, as they are asked for by options. That all scenes do is a
# matter of the conformance suite.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# Sides that are no multiple of anything.
scene=(--quiet --size 33x25 --samples 2 --depth 3 --frames 40)

# picture NAME OPTION...
picture() {
    local name=$1
    shift
    expect_exit 0 "${no_nvidia[@]}" "$hedron" render "${scene[@]}" -o "$name.data" "$@"
    expect_silent_stderr
    expect_data "$name.data" 33 25
}

# expect_float OPTION...: the same bytes as of plain C in float, alone.
expect_float() {
    picture other "$@"
    expect_same other.data float.data
    rm -f other.data
}

# expect_close FILE FILE: hardly any byte differs by more than a few steps.
expect_close() {
    local far
    far=$(paste <(od -A n -v -t u1 -w1 "$1") <(od -A n -v -t u1 -w1 "$2") |
        awk '{d = $1 - $2; if (d > 8 || d < -8) far++} END {print far + 0}')
    ((far <= 33 * 25 * 4 / 50)) || fail "$1 and $2 differ by more than 8 in $far bytes"
}

# ---- the C backend
picture float --backend c --lanes 1 --threads 1
picture double --backend c --lanes 1 --threads 1 --precision double
expect_close float.data double.data
most=$(lanes_there float | tail -n 1)
for options in '' '--math strict --precision float' '--backend c --math fast' "--backend c --lanes $most --threads 2" \
    '--backend c --pipeline wavefront --threads 3' '--backend c --pipeline wavefront-uncompacted'; do
    # shellcheck disable=SC2086 # options and their values
    expect_float $options
done
expect_exit 0 "$hedron" render "${scene[@]:1}" --backend c --math fast -o fast.data
expect_stderr_contains 'plain C has strict arithmetic alone, so --math fast changes nothing there'

# ---- it is a picture: not of one colour, and another one for another frame
(($(tail -c +9 float.data | od -A n -v -t x4 -w4 | sort -u | wc -l) >= 50)) || fail "the picture has fewer than 50 colours"
picture next --backend c --frames 41
expect_different next.data float.data

# ---- OpenCL, on whatever it has
if has_opencl; then
    expect_float --backend opencl
    expect_float --backend opencl --threads 1 --pipeline wavefront
    picture other --backend opencl --precision double
    expect_same other.data double.data
    picture fast --backend opencl --math fast
    expect_close float.data fast.data
else
    echo "not tested: OpenCL, for there is no device with strict arithmetic"
fi

# ---- CUDA, where there is one
run "$hedron" devices
if ! sed -n '/^cuda$/,/^opencl$/p' "$logs/stdout" | grep -q -E 'strict arithmetic: (yes|not measured)'; then
    echo "not tested: CUDA, for there is no device"
else
    no_nvidia=(env)
    for options in '' '--block 96 --grid 2' '--pipeline wavefront --block 256 --grid 1'; do
        # shellcheck disable=SC2086
        expect_float --backend cuda $options
    done
    picture other --backend cuda --precision double
    expect_same other.data double.data
    picture fast --backend cuda --math fast
    expect_close float.data fast.data
fi

finish
