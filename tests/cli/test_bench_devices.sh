#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/study devices: its arithmetic on made-up numbers, and a tiny run of two devices.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
bench=("$project/bench/study" devices)

# ---- the arithmetic: one device ends frames at 1, 2, 3 s, the other at 5 and 9 s: 1 and a quarter frames a second
frames='def frame(index, end): return {"backend": "c", "index": index, "began": {"trace": end - 0.5}, "seconds": {"trace": 0.5}}'
expect_python "1.25 0.0 [1] [1, 2] [1, 2, 3] [1, 2, 4, 8]" "$frames" 'from harness.measurements.devices import counts, steady_rate' \
    'two = [frame(0, 1), frame(1, 5), frame(0, 2), frame(0, 3), frame(1, 9)]' \
    'print(steady_rate(two), steady_rate(two[:4]), *map(counts, (1, 2, 3, 8)))'

# ---- for real: plain C alone and with another device, if there is one
devices=(--device c:0)
expected='[[1],true]'
if has_opencl; then
    devices+=(--device opencl:0)
    expected='[[1,2],true]'
fi
tiny=("${bench[@]}" --hedron "$hedron" --out out --frames 4 --repeats 1)
expect_exit 0 "${no_nvidia[@]}" "${tiny[@]}" "${devices[@]}" "$project/scenes/default.json" -- "${small[@]}"
expect_stdout_contains 'Devices that share the frames:'
if [[ $(jq -c '[[.rates[].devices], all(.rates[]; .runs | length == 1)]' out/devices.json) != "$expected" ]]; then
    fail "the result is another: $(jq -c .rates out/devices.json)"
fi

# ---- pictures that differ are no result
cat >"$work/wrong" <<SCRIPT
#!$(command -v bash)
"$hedron" "\$@" || exit
case "\$*" in *0-7*) printf x >>0000000.data ;; esac
SCRIPT
chmod +x "$work/wrong"
if has_opencl; then
    expect_exit 1 "${no_nvidia[@]}" "${tiny[@]}" --hedron "$work/wrong" "${devices[@]}" "$project/scenes/default.json" -- "${small[@]}"
    expect_stderr_contains 'frame 0 of 2 devices is another picture than before'
fi

# ---- wrong usage
expect_exit 2 "${tiny[@]}" --frames 2
expect_exit 2 "${tiny[@]}" none.json
expect_exit 2 "${tiny[@]}" --device none
expect_exit 2 "${tiny[@]}" --device c:0 -- --samples 0
expect_exit 3 "${tiny[@]}" --device c:7
finish
