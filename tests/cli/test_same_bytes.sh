#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every backend, pipeline, number of lanes and number of threads gives the same bytes.
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

# ---- the C backend
for precision in float double; do
    picture "$precision" --backend c --lanes 1 --threads 1 --precision "$precision"
    for lanes in $(lanes_there "$precision"); do
        for threads in 1 2 3; do
            picture other --backend c --lanes "$lanes" --threads "$threads" --precision "$precision"
            expect_same other.data "$precision.data"
            rm -f other.data
        done
    done
    picture other --backend c --precision "$precision"
    expect_same other.data "$precision.data"
    for pipeline in mega wavefront wavefront-uncompacted; do
        picture other --backend c --precision "$precision" --pipeline "$pipeline"
        expect_same other.data "$precision.data"
    done
done
picture other
expect_same other.data float.data
picture other --math strict --precision float
expect_same other.data float.data

# ---- it is a picture: not of one colour, and another one for another frame
if (($(tail -c +9 float.data | od -A n -v -t x4 -w4 | sort -u | wc -l) < 50)); then
    fail "the picture has fewer than 50 colours"
fi
expect_exit 0 "$hedron" render --backend c "${scene[@]}" --frames 41 -o next.data
expect_different next.data float.data

# expect_close FILE FILE: hardly any byte differs by more than a few steps.
expect_close() {
    local far
    far=$(paste <(od -A n -v -t u1 -w1 "$1") <(od -A n -v -t u1 -w1 "$2") |
        awk '{d = $1 - $2; if (d > 8 || d < -8) far++} END {print far + 0}')
    if ((far > 33 * 25 * 4 / 50)); then
        fail "$1 and $2 differ by more than 8 in $far bytes"
    fi
}
expect_close float.data double.data
# Few pixels are so close to a step that the precision shows in a byte: a larger picture has some.
for precision in float double; do
    expect_exit 0 "$hedron" render --backend c --size 320x240 --samples 1 --depth 8 --frames 0 \
        --precision "$precision" -o "large_$precision.data"
done
expect_different large_float.data large_double.data
picture fast --backend c --math fast
expect_same float.data fast.data
expect_exit 0 "$hedron" render "${scene[@]:1}" --backend c --math fast -o fast.data
expect_stderr_contains 'plain C has strict arithmetic alone, so --math fast changes nothing there'

# ---- OpenCL, on whatever it has
if has_opencl; then
    for lanes in '' 1 4 8 16; do
        picture other --backend opencl ${lanes:+--lanes "$lanes"}
        expect_same other.data float.data
    done
    picture other --backend opencl --threads 1
    expect_same other.data float.data
    picture other --backend opencl --pipeline wavefront
    expect_same other.data float.data
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
    for precision in float double; do
        expect_exit 0 "$hedron" render "${scene[@]}" --backend cuda --precision "$precision" -o other.data
        expect_same other.data "$precision.data"
    done
    for options in '--block 96 --grid 2' '--pipeline wavefront' '--pipeline wavefront --block 256 --grid 1'; do
        # shellcheck disable=SC2086 # options and their values
        expect_exit 0 "$hedron" render "${scene[@]}" --backend cuda $options -o other.data
        expect_same other.data float.data
    done
    expect_exit 0 "$hedron" render "${scene[@]}" --backend cuda --math fast -o fast.data
    expect_close float.data fast.data
fi

finish
