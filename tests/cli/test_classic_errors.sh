#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Wrong input of the classic mode: exit code 2, one sentence that says what is wrong, no file. Every kind of mistake is a
# matter of the unit tests (input/test_classic_errors).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
sed -e '1s/.*/3/' -e '3s/.*/8 8 120/' -e '$s/.*/1 1/' "$work/official.in" >"$work/good.in"
mapfile -t tokens < <(xargs -n 1 <"$work/good.in")

# refuse WHAT: standard input is refused with a sentence that has WHAT.
refuse() {
    expect_refusal 2 "$hedron" --cpu
    expect_stderr_contains "$1"
}

# wrong NUMBER TEXT... WHAT: so is the input with the token of that number (from 1), and those after it, replaced.
wrong() {
    local changed=("${tokens[@]}") i=$(($1 - 1)) text
    for text in "${@:2:$#-2}"; do
        changed[i++]=$text
    done
    refuse "${@: -1}" < <(printf '%s\n' "${changed[@]}")
}

# The input that all of them are made from is right.
expect_exit 0 "$hedron" --cpu <"$work/good.in"
expect_stdout_lines 3
rm -r out

# ---- nothing but white space, cut off, a word in the place of a number or more behind the end, no text at all
refuse 'number of frames' < <(printf ' \n\t\r\n')
refuse 'missing' < <(printf '%s\n' "${tokens[@]:0:40}")
wrong 1 word "'...'" # so no classic input begins, and other files are not quoted
wrong 40 nan nan
refuse 'end of the input' < <(cat "$work/good.in" && echo 1)
refuse 'zero byte' < <(head -c 3000 /dev/zero)
head -c 2000000 /dev/zero | tr '\0' '1' >"$work/long.in"
refuse 'standard input is longer than 1048576 bytes' <"$work/long.in"

# ---- values out of range, values that do not go together
wrong 1 0 'number of frames'
wrong 35 1000000 'lights'
wrong 70 2 'tint'
wrong 77 -1 'light 1'
wrong 33 0.8 0.3 'reflection'
# Floors without an area, and with crossing sides; an eye in the place that it looks at.
wrong 56 0 0 0 0 0 0 0 0 0 0 0 0 'floor'
wrong 59 5.0 5.0 -1.0 -5.0 5.0 -1.0 'floor'
wrong 6 0 0 0 0 0 1 1 1 0 0 0 0 0 0 0 1 1 1 0 0 'eye'

# ---- output paths: one number, and nothing that a format string could do
for pattern in out/img.data 'out/%d_%d.data' 'out/%n%d.data' 'out/%1000000d.data' 'out/%d.data%' 'out/%%d.data'; do
    wrong 2 "$pattern" "$pattern"
done
wrong 2 'out/%d.mp4' mp4 # a film is no frame file
wrong 2 'out/%d/' 'out/' # nor is a folder

# ---- the options meet the input; a folder, and nothing, as standard input
expect_refusal 2 "$hedron" --cpu --frames 3 <"$work/good.in"
expect_stderr_contains '3'
expect_refusal 1 "$hedron" --cpu </
expect_refusal 1 "$hedron" --cpu <&-

expect_files .
finish
