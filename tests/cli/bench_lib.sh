# SPDX-License-Identifier: MIT
# shellcheck shell=bash
#
# Functions for the tests of the programs under bench/. A script sources this file in place of lib.sh.
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need_python
bench=$project/bench/study

# The line of the script that led here, through any helper.
script_line() {
    echo "$(basename "$0"):${BASH_LINENO[-2]}"
}

# expect_python EXPECTED STATEMENTS...: the output of Python.
expect_python() {
    local found
    found=$(PYTHONPATH=$project/bench python3 -B -c "$(printf '%s\n' "${@:2}")" 2>&1) || true
    [[ $found == "$1" ]] || fail "${*:2} prints $found, expected $1"
}

# expect_value FILE EXPRESSION EXPECTED: the value in Python of the result `r`, its rows by key and device, and its
# measurements by part, series, x and device.
expect_value() {
    expect_python "$3" 'import json, os, re' "def read(name): return open(name, encoding='utf-8').read()" "r = json.loads(read('$1'))" \
        'rows = {row["key"] + " " + (row["device"] or "nowhere"): row for row in reversed(r.get("rows") or [])}' \
        'm = {(e.get("part"), e.get("series"), e.get("x"), e["device"]): e for e in r["measurements"]}' \
        'def ms(*key, what="trace_ms"): return round(m[key]["summary"][what]["median"], 6)' "print(json.dumps($2))"
}

# expect_svg FILE...: pictures with text, and no bars.
expect_svg() {
    local file found
    for file in "$@"; do
        found=$(python3 -c 'import sys, xml.dom.minidom as xml
svg = xml.parse(sys.argv[1]).documentElement
print(svg.tagName, len(svg.getElementsByTagName("text")) > 0, len(svg.getElementsByTagName("rect")))' "$file" 2>&1) || true
        if [[ $found != 'svg True 1' ]]; then # the paper
            fail "$file is no chart: $found"
        fi
    done
}

# expect_bench_refusal CODE TEXT OPTIONS...: of the program `bench`.
expect_bench_refusal() {
    expect_exit "$1" timeout "$time_limit" "$bench" "${@:3}"
    expect_stderr_contains "$2"
    expect_stdout_lines 0
}
