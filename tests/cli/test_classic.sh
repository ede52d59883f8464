#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The classic task's contract: input, keys, standard output, frame files; wrong input gives exit code 2, a sentence, no file.
# The unit tests cover every kind of mistake (tests/unit/input/test_classic.c).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
sed -e '1s/.*/3/' -e '3s/.*/32 24 120/' -e '$s/.*/2 1/' "$work/official.in" >"$work/bare.in"
row=$'[0-9]+\t[0-9]+(\\.[0-9]+)?\t[1-9][0-9]*'

# classic FOLDER INPUT OPTION...: in a new folder; a missing GPU is no failure here.
classic() {
    rm -rf "$1"
    mkdir "$1"
    cd "$1"
    expect_exit 0 "${no_nvidia[@]}" "$hedron" "${@:3}" <"$2"
    cd ..
}
small_one=(--size 32x24 --samples 1)

numbers() { # of frame and rays in each line, the same for every run
    cut -f 1,3 "$logs/stdout"
}

# ---- the three keys
for key in gpu cpu none; do
    option=()
    if [[ $key != none ]]; then
        option=("--$key")
    fi
    classic "$key" "$work/official.in" "${option[@]}" "${small_one[@]}" --frames 0-2
    expect_stdout_lines 3 "$row"
    numbers >"$key.numbers"
    [[ $(cut -f 1 "$logs/stdout") == $'0\n1\n2' ]] || fail 'the lines are in another order'
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
expect_different cpu/out/img_1.data cpu/out/img_2.data

# ---- frames on their own are those of the sequence
classic last "$work/official.in" --cpu "${small_one[@]}" --frames 1023,2
expect_files last out out/img_2.data out/img_1023.data
expect_same last/out/img_2.data cpu/out/img_2.data
expect_same <(numbers | grep '^2') <(sed -n 3p cpu.numbers)

# ---- no option at all: everything is in the input; existing frames are replaced
classic bare "$work/bare.in"
expect_stdout_lines 3 "$row"
expect_data bare/out/img_2.data 32 24
cd bare
printf 'old' >out/img_0.data
expect_exit 0 "$hedron" --cpu <"$work/bare.in"
cd ..
expect_files bare out out/img_0.data out/img_1.data out/img_2.data
expect_data bare/out/img_0.data 32 24
# Any white space separates.
tr '\n ' '\t\n' <"$work/bare.in" | sed 's/$/\r/' >"$work/space.in"
classic space "$work/space.in" --cpu
expect_same space/out/img_1.data bare/out/img_1.data

# ---- rays: those from the eye and those of mirrors and faces, but not those to lights
classic eye "$work/official.in" --cpu "${small_one[@]}" --frames 0 --depth 0
[[ $(cut -f 3 "$logs/stdout") == 768 ]] || fail 'there is more or less than a ray for each of 768 pixels'
# The example without its lights, those on the edges included.
sed -e '6,8s/[0-9]*$/0/' -e '10s/.*/0/' -e '11,12d' "$work/official.in" >"$work/unlit.in"
classic unlit "$work/unlit.in" --cpu "${small_one[@]}" --frames 0
expect_same <(numbers) <(sed -n 1p cpu.numbers)
expect_different cpu/out/img_0.data unlit/out/img_0.data

# ---- the variants
for variant in {1..10}; do
    classic "variant$variant" "$work/official.in" --cpu "${small_one[@]}" --frames 0 --variant "$variant"
done
different=$(md5sum variant?*/out/img_0.data | cut -d ' ' -f 1 | sort -u | wc -l)
((different == 10)) || fail "the ten variants give $different different pictures"
expect_same cpu/out/img_0.data variant4/out/img_0.data

# ---- output paths
# output_case PATTERN FILE: frame 1 goes to this file.
output_case() {
    sed "2s|.*|$1|" "$work/bare.in" >"$work/pattern.in"
    classic pattern "$work/pattern.in" --cpu --frames 1
    cd pattern
    "expect_${2##*.}" "$2" 32 24
    cd ..
}
output_case 'a/b/c/50%%_%04d.data' a/b/c/50%_0001.data
# The home folder's name is no pattern.
mkdir "$work/50%off"
mv "$HOME/floor.data" "$work/50%off"
HOME=$work/50%off
# shellcheck disable=SC2088 # the program itself is to replace the tilde
output_case '~/frames/%d.png' "$HOME/frames/1.png"

# ---- wrong input
mkdir empty
cd empty
mapfile -t tokens < <(xargs -n 1 <"$work/bare.in")
refuse() { # WHAT: standard input is refused with a sentence that contains this
    expect_refusal 2 "$hedron" --cpu
    expect_stderr_contains "$1"
}
# wrong NUMBER TEXT... WHAT: the input is refused after replacing the tokens from that number (from 1) on.
wrong() {
    local changed=("${tokens[@]}") i=$(($1 - 1)) text
    for text in "${@:2:$#-2}"; do
        changed[i++]=$text
    done
    refuse "${@: -1}" < <(printf '%s\n' "${changed[@]}")
}
refuse 'number of frames' < <(printf ' \n\t\r\n')
wrong 1 word "'...'" # so no classic input begins, and other files are not quoted
refuse 'zero byte' < <(head -c 3000 /dev/zero)
refuse 'standard input is longer than 1048576 bytes' < <(head -c 2000000 /dev/zero | tr '\0' '1')
wrong 33 0.8 0.3 'reflection'
wrong 59 5.0 5.0 -1.0 -5.0 5.0 -1.0 'floor' # its sides cross
# Output paths: one number, and no other format directive; neither films nor folders.
for pattern in out/img.data 'out/%n%d.data' 'out/%1000000d.data' 'out/%%d.data' 'out/%d.mp4'; do
    wrong 2 "$pattern" "$pattern"
done
wrong 2 'out/%d/' 'out/0/'
expect_refusal 2 "$hedron" --cpu --frames 3 <"$work/bare.in"
expect_stderr_contains '3'
expect_refusal 1 "$hedron" --cpu </
expect_refusal 1 "$hedron" --cpu <&-
expect_files .
cd ..

# ---- the default configuration: without a texture file and in an empty folder
rm "$HOME/floor.data"
classic default /dev/null --default
expect_silent_stderr
expect_files default
cp "$logs/stdout" "$work/default.in"
classic default "$work/default.in" "${small_one[@]}" --frames 0
expect_stdout_lines 1 "$row"
expect_files default out out/frame_0.png
expect_png default/out/frame_0.png 32 24

finish
