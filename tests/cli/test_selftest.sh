#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# 'hedron selftest': reports on devices that compute correctly and on some that do not, as text and as JSON, the exit codes,
# and remembered results.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
export HEDRON_CACHE=$work/cache
nothing+=("$hedron" selftest)

validate() { # FILE: by the schema that is installed with the scenes
    python3 -c 'import json, sys, jsonschema
load = lambda path: json.load(open(path, encoding="utf-8"))
jsonschema.Draft202012Validator.check_schema(load(sys.argv[1]))
jsonschema.Draft202012Validator(load(sys.argv[1])).validate(load(sys.argv[2]))' \
        "$project/scenes/schema/hedron-certificate.schema.json" "$1" >"$logs/validate" 2>&1
}
has_schemas=true
python3 -c 'from jsonschema import Draft202012Validator' 2>"$logs/validate" || has_schemas=false
$has_schemas || echo "not tested: the certificate's schema, for Python has no jsonschema 4"

# expect_certificate RESULT COUNT: of one device and so many tests, with the keys in the documented order.
expect_certificate() {
    if command -v jq >"$logs/which" && ! jq -e --argjson count "$2" --arg verdict "$1" '.certificates | length == 1 and (.[0] |
        keys_unsorted == ["hedron", "backend", "index", "name", "driver", "compiler", "verdict", "tests", "time", "seconds"]
        and .verdict == $verdict and (.tests | length == $count and all(.[]; keys_unsorted == ["name", "verdict", "reason",
        "tuples", "frames", "division_by_fma", "hash", "seconds"]) and (all(.[]; .verdict == "right") == ($verdict == "right"))))' \
        "$logs/stdout" >"$logs/jq"; then
        fail 'the certificate as JSON is not as expected'
    fi
    ! $has_schemas || validate "$logs/stdout" || fail "it is not as its schema: $(tail -n 20 "$logs/validate")"
}

# ---- plain C: small golden frames in both precisions
expect_exit 0 "${nothing[@]}" --device c:0 --quick
expect_silent_stderr
expect_stdout_contains 'right    golden frames in float by mega, '
(($(grep -c '^  right    ' "$logs/stdout") == 2)) || fail 'a quick test has another number of parts'
expect_exit 0 "${nothing[@]}" --device c:0 --quick --json
expect_certificate right 2
expect_refusal 3 "$hedron" selftest --device nonsense
expect_stderr_contains "there is no such device ('nonsense')"
expect_refusal 2 "$hedron" selftest --device c:0 --backend opencl

# ---- OpenCL, wrong and right
if is_sanitized || ! has_opencl; then
    echo "not tested: OpenCL and all of plain C, because there is no device, or preloading fails"
    finish
fi
quick=("$hedron" selftest --quick --device opencl:0)
take "$build" 'return fma(a, b, c);' 'return a * b + c;'
expect_exit 1 "${driver[@]}" "${quick[@]}" --json
expect_stderr_contains '1 of 1 device computes wrongly'
expect_stdout_contains 'fma(a, b, c) of a = '
expect_stdout_contains '(it is rounded twice)'
expect_certificate wrong 2
expect_exit 0 "${no_nvidia[@]}" "$hedron" devices
expect_stdout_contains 'strict arithmetic: no, it computes wrongly: fma(a, b, c) of a = '
# A remembered result is tested again, and is then correct.
expect_exit 0 "${no_nvidia[@]}" "${quick[@]}"
expect_stdout_contains 'right    arithmetic in double, 8192 tuples of operands ('
expect_exit 0 "${no_nvidia[@]}" "$hedron" devices
! grep -q 'computes wrongly' "$logs/stdout" || fail "a device that computes correctly is still reported as wrong"
# Frames that are wrong although the arithmetic is correct.
take "$build" '1.5259021896696422e-5' '1.6e-5'
expect_exit 1 env HEDRON_CACHE=off "${driver[@]:1}" "${quick[@]}"
expect_stdout_contains 'right    arithmetic in float, 8192 tuples of operands ('
expect_stdout_contains 'wrong    golden frames in float by mega, '
expect_stdout_contains ', depth 1 of the ray: '
# The rays that end too early are deeper than those of most frames.
take "$build" 'if (level == view->depth)' 'if (level == view->depth || level == 8)'
expect_exit 1 env HEDRON_CACHE=off "${driver[@]:1}" "${quick[@]}"
expect_stdout_contains 'wrong    golden frames in float by mega, '
expect_stdout_contains ', depth 9 of the ray: '

# ---- all of plain C: the golden frames by both pipelines, in both precisions
expect_exit 0 "${nothing[@]}" --device c:0
frames=$(wc -l <"$cli_folder/../golden/frames.txt")
for kernels in 'float by mega' 'double by wavefront'; do
    expect_stdout_contains "right    golden frames in $kernels, $frames of them ("
done
(($(grep -c '^  right    ' "$logs/stdout") == 4)) || fail 'the whole test has another number of parts'
finish
