#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Wrong input of the classic mode: exit code 2, one sentence that says what is wrong, no file.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
sed -e '1s/.*/3/' -e '3s/.*/8 8 120/' -e '$s/.*/1 1/' "$work/official.in" >"$work/good.in"
mapfile -t tokens < <(xargs -n 1 <"$work/good.in")
count=${#tokens[@]}
if ((count != 87)); then
    fail "the example has $count tokens, expected 87"
fi

# refuse WHAT: the input in $work/bad.in is refused with a sentence that has WHAT.
refuse() {
    expect_refusal 2 "$hedron" --cpu <"$work/bad.in"
    expect_stderr_contains "$1"
    if ((failures > 40)); then
        fail "too many failures, the rest is left out"
        finish
    fi
}

# replaced NUMBER TEXT...: the input with the token of that number (from 1), and those after it, replaced.
replaced() {
    local number=$1 changed=("${tokens[@]}")
    shift
    while (($# > 0)); do
        changed[number - 1]=$1
        number=$((number + 1))
        shift
    done
    printf '%s\n' "${changed[@]}" >"$work/bad.in"
}

# The input that all of them are made from is right.
expect_exit 0 "$hedron" --cpu <"$work/good.in"
expect_stdout_lines 3
rm -r out

# ---- nothing, or nothing but white space
: >"$work/bad.in"
refuse 'number of frames'
expect_refusal 2 "$hedron" </dev/null
printf ' \n\t\r\n' >"$work/bad.in"
refuse 'number of frames'
expect_refusal 2 "$hedron" <"$work/bad.in"

# ---- cut off after each token
for ((i = 1; i < count; i++)); do
    printf '%s\n' "${tokens[@]:0:i}" >"$work/bad.in"
    refuse 'missing'
done

# ---- cut off within the text, which may or may not end within a number
for bytes in 1 10 100 250 400 500; do
    head -c "$bytes" "$work/good.in" >"$work/bad.in"
    refuse 'standard input'
done

# ---- a word in the place of each token, the two paths included
for word in word nan -inf 0x1p3 1,5 1e999; do
    for ((i = 1; i <= count; i++)); do
        # The other words need not take every place.
        if [[ $word == word || $((i % 9)) == 0 ]]; then
            replaced "$i" "$word"
            if [[ $i == 1 && $word == [wn]* ]]; then
                refuse "'...'" # so no classic input begins, and other files are not quoted
            else
                refuse "$word"
            fi
        fi
    done
done

# ---- something behind the end
{
    cat "$work/good.in"
    echo 1
} >"$work/bad.in"
refuse 'end of the input'

# ---- no text at all
head -c 3000 /dev/urandom >"$work/bad.in"
expect_refusal 2 "$hedron" --cpu <"$work/bad.in"
head -c 3000 /dev/zero >"$work/bad.in"
refuse 'zero byte'
head -c 2000000 /dev/zero | tr '\0' ' ' >"$work/bad.in"
expect_refusal 2 "$hedron" --cpu <"$work/bad.in"
head -c 2000000 /dev/zero | tr '\0' '1' >"$work/bad.in"
expect_refusal 2 "$hedron" --cpu <"$work/bad.in"

# ---- values out of range
# wrong NUMBER TEXT WHAT
wrong() {
    replaced "$1" "$2"
    refuse "$3"
}
wrong 1 0 'number of frames'
wrong 1 -3 'number of frames'
wrong 1 2.5 'number of frames'
wrong 1 99999999999999999999 'number of frames'
wrong 3 0 'width'
wrong 3 65536 'width'
wrong 4 -1 'height'
wrong 4 65536 'height'
wrong 5 0 'field of view'
wrong 5 180 'field of view'
wrong 5 -120 'field of view'
wrong 29 1.5 'colour'
wrong 29 -0.1 'colour'
wrong 32 -1.0 'radius'
wrong 32 0 'radius'
wrong 33 1.1 'reflection'
wrong 33 -0.1 'reflection'
wrong 34 1.5 'transparency'
wrong 35 -1 'lights per edge'
wrong 35 2.5 'lights per edge'
wrong 35 1000000 'lights'
wrong 70 2 "tint"
wrong 72 -0.5 'reflection'
wrong 73 5 'number of lights'
wrong 73 -1 'number of lights'
wrong 77 -1 'light 1'
wrong 86 -1 'depth'
wrong 86 100000 'depth'
wrong 87 0 'rays per pixel'
wrong 87 -2 'rays per pixel'

# Reflection and transparency together.
replaced 33 0.8 0.3
refuse 'reflection'
# Five lights, with all of their numbers.
{
    printf '%s\n' "${tokens[@]:0:72}"
    echo 5
    for i in 1 2 3 4 5; do
        echo "$i 0 10 1 1 1"
    done
    echo 1 1
} >"$work/bad.in"
refuse 'number of lights'
# Floors without an area, with a bent corner, with crossing sides.
replaced 56 0 0 0 0 0 0 0 0 0 0 0 0
refuse 'floor'
replaced 58 3.0
refuse 'floor'
replaced 59 5.0 5.0 -1.0 -5.0 5.0 -1.0
refuse 'floor'
# An eye in the place that it looks at.
replaced 6 0 0 0 0 0 1 1 1 0 0 0 0 0 0 0 1 1 1 0 0
refuse 'eye'

# ---- output paths: one number, and nothing that a format string could do
for pattern in out/img.data 'out/%d_%d.data' 'out/%s.data' 'out/%n%d.data' 'out/%x.data' 'out/%5d.data' \
    'out/%1000000d.data' 'out/%-d.data' 'out/%ld.data' 'out/%d.data%' 'out/%%d.data' '%'; do
    wrong 2 "$pattern" "$pattern"
done
wrong 2 "$(printf '%05000d' 0)%d" 'output path'
# A film is no frame file.
replaced 2 'out/%d.mp4'
expect_refusal 2 "$hedron" --cpu <"$work/bad.in"
# Names that are folders.
expect_refusal 2 "$hedron" --cpu --frames 0 < <(sed '2s|.*|out/%d/|' "$work/good.in")
rm -rf out

# ---- the options meet the input
expect_refusal 2 "$hedron" --cpu --frames 3 <"$work/good.in"
expect_stderr_contains '3'
# A folder, and nothing, as standard input.
expect_refusal 1 "$hedron" --cpu </
expect_refusal 1 "$hedron" --cpu <&-

expect_files .
finish
