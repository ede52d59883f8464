#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The classic task's contract: input, keys, standard output, frame files.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
input=$work/official.in
row=$'[0-9]+\t[0-9]+(\\.[0-9]+)?\t[1-9][0-9]*'

# classic FOLDER OPTION...: the example, small, in a new folder; a missing GPU is no failure here.
classic() {
    local folder=$1
    shift
    mkdir "$folder"
    cd "$folder"
    expect_exit 0 "${no_nvidia[@]}" "$hedron" "$@" --size 32x24 --samples 1 <"$input"
    cd ..
}

# The frame number and the rays of each line, which are the same for every run.
numbers() {
    cut -f 1,3 "$logs/stdout"
}

# ---- the three keys
for key in gpu cpu none; do
    option=()
    if [[ $key != none ]]; then
        option=("--$key")
    fi
    classic "$key" "${option[@]}" --frames 0-2
    expect_stdout_lines 3 "$row"
    numbers >"$key.numbers"
    if [[ $(cut -f 1 "$logs/stdout" | tr '\n' ' ') != '0 1 2 ' ]]; then
        fail "the lines are not those of the frames 0, 1 and 2 in order"
    fi
    if [[ $key == cpu ]]; then
        expect_silent_stderr
    elif ! has_other_gpu; then
        expect_sentence
        expect_stderr_contains 'GPU'
    fi
    expect_files "$key" out out/img_0.data out/img_1.data out/img_2.data
    for frame in 0 1 2; do
        expect_data "$key/out/img_$frame.data" 32 24
        expect_same "gpu/out/img_$frame.data" "$key/out/img_$frame.data"
    done
    expect_same gpu.numbers "$key.numbers"
done
expect_different cpu/out/img_0.data cpu/out/img_1.data
expect_different cpu/out/img_1.data cpu/out/img_2.data

# ---- a frame on its own is the frame of the sequence
classic alone --cpu --frames 2
expect_stdout_lines 1 "$row"
expect_files alone out out/img_2.data
expect_same alone/out/img_2.data cpu/out/img_2.data
expect_same <(numbers) <(sed -n 3p cpu.numbers)
classic last --cpu --frames 1023,0
if [[ $(cut -f 1 "$logs/stdout" | sort -n | tr '\n' ' ') != '0 1023 ' ]]; then
    fail "the list 1023,0 did not give these two frames"
fi
expect_files last out out/img_0.data out/img_1023.data
expect_same last/out/img_0.data cpu/out/img_0.data

# ---- no option at all: everything is in the input
mkdir bare
sed -e '1s/.*/3/' -e '3s/.*/32 24 120/' -e '$s/.*/2 1/' "$input" >"$work/bare.in"
cd bare
expect_exit 0 "$hedron" <"$work/bare.in"
cd ..
expect_stdout_lines 3 "$row"
expect_files bare out out/img_0.data out/img_1.data out/img_2.data
expect_data bare/out/img_2.data 32 24

# ---- any white space separates
i=0
for change in 'tr \n \40' 'sed s/$/\r/' 'tr \40 \t' 'tr -s \40 \n'; do
    i=$((i + 1))
    mkdir "space$i"
    cd "space$i"
    # shellcheck disable=SC2086 # the command and its arguments
    expect_exit 0 "$hedron" --cpu < <($change <"$work/bare.in")
    cd ..
    expect_same "space$i/out/img_1.data" bare/out/img_1.data
done
printf '%s' "$(cat "$work/bare.in")" >"$work/unended.in"
mkdir unended
cd unended
expect_exit 0 "$hedron" --cpu <"$work/unended.in"
cd ..
expect_same unended/out/img_1.data bare/out/img_1.data

# ---- rays: those from the eye and those of mirrors and faces, but not those to lights
classic eye --cpu --frames 0 --depth 0
if [[ $(cut -f 3 "$logs/stdout") != 768 ]]; then
    fail "$(cut -f 3 "$logs/stdout") rays at depth 0, expected one for each of the 768 pixels"
fi
mkdir lit unlit
# The example without its lights, those on the edges included.
sed -e '6,8s/[0-9]*$/0/' -e '10s/.*/0/' -e '11,12d' "$input" >"$work/unlit.in"
for folder in lit unlit; do
    source_file=$input
    if [[ $folder == unlit ]]; then
        source_file=$work/unlit.in
    fi
    cd $folder
    expect_exit 0 "$hedron" --cpu --size 32x24 --samples 1 --frames 0 <"$source_file"
    cd ..
    numbers >"$folder.numbers"
done
expect_same lit.numbers unlit.numbers
expect_different lit/out/img_0.data unlit/out/img_0.data

# ---- the variants
for variant in 1 2 3 4 5 6 7 8 9 10; do
    classic "variant$variant" --cpu --frames 0 --depth 3 --variant "$variant"
    expect_data "variant$variant/out/img_0.data" 32 24
done
different=$(md5sum variant*/out/img_0.data | cut -d ' ' -f 1 | sort -u | wc -l)
if ((different != 10)); then
    fail "the ten variants give $different different pictures"
fi
classic standard --cpu --frames 0 --depth 3
expect_same standard/out/img_0.data variant4/out/img_0.data

# ---- output paths
# output_case PATTERN FILE: frame 7 goes to this file.
output_case() {
    rm -rf pattern
    mkdir pattern
    cd pattern
    sed "2s|.*|$1|" "$work/bare.in" >"$work/pattern.in"
    expect_exit 0 "$hedron" --cpu --frames 1 <"$work/pattern.in"
    expect_data "$2" 32 24
    cd ..
}
output_case 'img_%d.data' img_1.data
output_case '%d' 1
output_case 'a/b/c/%d.data' a/b/c/1.data
output_case "$work/here/absolute/%d.data" "$work/here/absolute/1.data"
# shellcheck disable=SC2088 # the program itself is to replace the tilde
output_case '~/frames/%d.data' "$HOME/frames/1.data"
output_case 'x_%04d.data' x_0001.data
output_case '50%%_%d.data' 50%_1.data
# The home folder's name is no pattern.
mkdir "$work/50%off"
HOME_BEFORE=$HOME
HOME=$work/50%off
cp "$HOME_BEFORE/floor.data" "$HOME"
# shellcheck disable=SC2088
output_case '~/frames/%d.data' "$HOME/frames/1.data"
HOME=$HOME_BEFORE
# A picture in PNG, because the name says so.
mkdir png
cd png
sed '2s|.*|out/%d.png|' "$work/bare.in" >"$work/png.in"
expect_exit 0 "$hedron" --cpu --frames 1 <"$work/png.in"
cd ..
expect_png png/out/1.png 32 24

# ---- frames that are there already are replaced
cd bare
printf 'old' >out/img_0.data
expect_exit 0 "$hedron" --cpu <"$work/bare.in"
cd ..
expect_files bare out out/img_0.data out/img_1.data out/img_2.data
expect_data bare/out/img_0.data 32 24

# ---- the default configuration: without a texture file and in an empty folder
rm "$HOME/floor.data"
mkdir default
cd default
expect_exit 0 "$hedron" --default </dev/null
expect_silent_stderr
expect_files .
cp "$logs/stdout" "$work/default.in"
expect_exit 0 "$hedron" --size 32x24 --samples 1 --frames 0 <"$work/default.in"
expect_stdout_lines 1 "$row"
cd ..
if (($(find default -type f | wc -l) != 1)); then
    fail "the default configuration did not give one file"
fi
# Its tokens: the 73rd is the number of lights, each has six more, and two follow.
tokens=$(wc -w <"$work/default.in")
lights=$(xargs -n 1 <"$work/default.in" | sed -n 73p)
if ((tokens != 73 + 6 * lights + 2)); then
    fail "the default configuration has $tokens tokens, expected $((73 + 6 * lights + 2))"
fi

finish
