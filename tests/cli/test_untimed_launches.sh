#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# An OpenCL GPU whose queues have no profiling: launches grow and shrink by the host's clock. The GPU is a
# CPU's driver behind a layer that says so and keeps a clock of its own, so that nothing depends on time.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
if ! has_opencl; then
    skip "there is no OpenCL device for strict arithmetic"
elif is_sanitized; then
    skip "sanitizers bring a clock of their own"
fi
echo '{"hedron": 1, "camera": {"frames": 40, "eye": {"r0": 9, "z0": 2, "phi_frequency": 1}},
       "materials": {"red": {"colour": [1, 0, 0], "diffuse": 1}},
       "solids": [{"kind": "cube", "circumradius": 1, "material": "red"}], "lights": [{"position": [3, -4, 8]}]}' >"$work/cube.json"
frames=("$hedron" render "$work/cube.json" --size 128x128 --samples 8 --depth 2 --frames 0-3 --quiet)
expect_exit 0 "${frames[@]}" --backend c -o expected/%d.data

# expect_launches NS LEAST MOST MOST_TOO_LONG [OPTION...]: so many launches, of work items that take so long, and so
# many of them above 50 ms.
expect_launches() {
    local ns=$1 least=$2 most=$3 most_too_long=$4 launches too_long
    shift 4
    rm -f "$work/report"
    expect_exit 0 env LD_PRELOAD="$build/tests/failing/libfailing_untimed.so" UNTIMED_NS="$ns" UNTIMED_LONGEST=50 \
        UNTIMED_REPORT="$work/report" "${frames[@]}" --device opencl:0 -o picture/%d.data "$@"
    read -r launches too_long <"$work/report"
    if ((launches < least || launches > most || too_long > most_too_long)); then
        fail "$launches launches of items of $ns ns, $too_long of them above 50 ms"
    fi
    diff -r picture expected || fail "the pictures are others"
    rm -r picture
}
# A first run has the kernels compiled and tested, with launches of its own.
expect_launches 1 1 9999 0
# A frame has 2^20 samples, a first launch 2^14 of them, and each frame two small launches more.
expect_launches 1 12 30 0
# Above 50 ms: the first one, another that learns from it, and what makes the 8 bits of each frame.
expect_launches 12500 1000 2500 6
expect_launches 2500 12 60 999 --max-launch 4000

rm -r expected
expect_files .
finish
