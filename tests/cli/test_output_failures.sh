#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Output that cannot be written: a full or closed standard output, folders that cannot be made, full
# disks. What was finished before stays; no temporary file does.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
sed -e '1s/.*/9/' -e '3s/.*/32 24 120/' -e '$s/.*/1 1/' "$work/official.in" >"$work/good.in"

# ---- standard output
# to_full COMMAND...: exit code 1 and a sentence where standard output takes nothing.
to_full() {
    last_command="$* > /dev/full"
    code=0
    : >"$logs/stdout"
    "$@" <"$work/good.in" >/dev/full 2>"$logs/stderr" || code=$?
    if ((code != 1)); then
        fail "exit code $code, expected 1"
        show_logs
    fi
    expect_sentence
    code=0
    last_command="$* >&-"
    "$@" <"$work/good.in" >&- 2>"$logs/stderr" || code=$?
    if ((code != 1)); then
        fail "exit code $code, expected 1"
        show_logs
    fi
    expect_sentence
}
to_full "$hedron" --cpu
# The frame was there before its line; those after it may be as well.
expect_data out/img_0.data 32 24
rm -r out
to_full "$hedron" --default
to_full "$hedron" --help
to_full "$hedron" --version
to_full "$hedron" render --help
to_full "$hedron" render --quiet --backend c "${small[@]}" --frames 0 -o picture.data --stats -
to_full "$hedron" devices
to_full "$hedron" devices --json
to_full env HEDRON_CACHE=off "$hedron" tune --backend c "${small[@]}"
to_full env HEDRON_CACHE=off "$hedron" tune --backend c "${small[@]}" --json
to_full "$hedron" help man
to_full "$hedron" help completion
to_full "$hedron" convert
to_full "$hedron" render --quiet --backend c "${small[@]}" --frames 0 -o picture.data
expect_data picture.data 32 24
rm picture.data
expect_files .

# A reader that goes away ends the program; frames stay whole.
code=0
"$hedron" --cpu <"$work/good.in" 2>"$logs/stderr" | head -c 0 || code=$?
for file in out/*; do
    expect_data "$file" 32 24
done
rm -rf out

# ---- folders and files in the way
: >out
expect_refusal 1 "$hedron" --cpu <"$work/good.in"
expect_stderr_contains 'out'
expect_files . out
for name in out/picture.png out/deep/picture.png out/film.mp4 /dev/null/x.png /proc/none/x.png; do
    expect_refusal 1 "$hedron" render --backend c "${small[@]}" --frames 0 -o "$name"
    expect_stderr_contains "${name%/*}"
done
expect_files . out
rm out
mkdir folder
for name in folder folder/ /dev/null; do
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0 -o "$name"
    expect_stderr_contains "$name"
done
mkdir folder.png folder.mp4
for name in folder.png folder.mp4; do
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0 -o "$name"
    expect_stderr_contains "$name"
done
expect_files . folder folder.png folder.mp4
rmdir folder folder.png folder.mp4
long=$(printf '%0300d' 0).png
expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0 -o "$long"
long=$(printf '%05000d' 0).png
expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0 -o "$long"

# ---- what cannot be written is found before a frame of many minutes, and nothing of it stays
long=$(printf '%0252d' 0)
: >blocked
for name in "$long.png" "$long.mkv" "$long%d.pfm" blocked/picture.png; do
    if [[ $name != *.mkv ]] || { command -v ffmpeg && command -v ffprobe; } >"$logs/which"; then
        run timeout "$patience" "$hedron" render --quiet --backend c --size 1600x1200 --samples 16 --depth 12 --frames 0 \
            -o "$name"
        if ((code != 1 && code != 2)); then
            fail "exit code $code, expected 1 or 2"
        fi
        expect_sentence
    fi
done
rm blocked
expect_files .

# ---- a picture that is too large for any memory
expect_memory() {
    run "$hedron" render --backend c --samples 1 --depth 0 --size 65535x65535 --frames 0 -o big.png
    if ((code != 1 && code != 2)); then
        fail "exit code $code, expected 1 or 2"
        show_logs
    fi
    expect_sentence
}
if grep -q -a -F __asan_init "$hedron"; then
    echo "not tested: little memory, for the address sanitizer takes much"
else
    (
        ulimit -v 4000000
        expect_memory
        exit "$failures"
    ) || failures=$((failures + $?))
fi
expect_files .

# ---- a limit on the size of files: an error like any other, not a deadly signal
# limited BLOCKS COMMAND...: with files of so many KiB at most. Not through `run`, whose files count.
limited() {
    local blocks=$1
    shift
    last_command="$* (ulimit -f $blocks)"
    code=0
    (
        ulimit -c 0
        ulimit -f "$blocks"
        exec "$@"
    ) <"$work/good.in" >"$logs/stdout" 2>"$logs/stderr" || code=$?
    if ((code != 1)); then
        fail "exit code $code, expected 1"
        show_logs
    else
        expect_sentence
    fi
}
limited 2 "$hedron" --cpu
expect_files . out
rm -rf out
limited 1 "$hedron" render --backend c --size 64x64 --samples 1 --depth 1 --frames 0 -o x.png
limited 1 "$hedron" render --backend c --size 64x64 --samples 1 --depth 1 --frames 0 -o x.data
expect_files .
limited 1 "$hedron" render --backend c --quiet --size 8x8 --samples 1 --depth 0 --frames 0-9 -o '%d.data' \
    --stats stats.jsonl
grep -q -F 'statistics to stats.jsonl' "$logs/stderr" || fail "the message does not name the statistics"
rm -rf ./*

# ---- a full disk, where this user may mount one
full_disk() {
    # shellcheck disable=SC2016 # for the inner shell
    unshare --mount --map-root-user bash -c '
        set -euo pipefail
        mount -t tmpfs -o size=20k none "$1"
        touch "$1/mounted" && rm "$1/mounted"
        shift
        code=0
        "$@" || code=$?
        cp -r disk disk_copy
        exit "$code"' full_disk "$work/here/disk" "$@"
}
mkdir disk
if full_disk true 2>"$logs/unshare"; then
    rm -r disk_copy
    sed '2s|.*|disk/%d.data|' "$work/good.in" >"$work/disk.in"
    expect_exit 1 full_disk "$hedron" --cpu <"$work/disk.in"
    expect_sentence
    expect_stderr_contains 'No space left'
    frames=$(find disk_copy -type f | wc -l)
    if ((frames < 1 || frames > 8)); then
        fail "$frames frames were written to a disk with room for some of nine"
    fi
    expect_stdout_lines "$frames"
    for ((i = 0; i < frames; i++)); do
        expect_data "disk_copy/$i.data" 32 24
    done
    rm -r disk_copy
    for name in x.png x.data; do
        expect_exit 1 full_disk "$hedron" render --backend c --size 320x240 --samples 1 --depth 3 \
            --frames 0 -o "disk/$name"
        expect_sentence
        expect_files disk_copy
        rm -r disk_copy
    done
    if command -v ffmpeg >"$logs/which"; then
        # The disk is full at once, or once the film is finished.
        for film in '--size 160x120 x.mkv' '--size 160x120 x.mp4' '--size 96x72 x.mp4' '--size 64x48 x.gif'; do
            # shellcheck disable=SC2086 # several words
            expect_exit 1 full_disk "$hedron" render --backend c ${film% *} --samples 1 --depth 3 \
                --frames 0-39 -o "disk/${film##* }"
            expect_stderr_contains 'hedron: '
            expect_stderr_contains 'No space left on device'
            expect_stdout_lines 0
            expect_files disk_copy
            rm -r disk_copy
        done
    fi
    expect_files . disk
else
    echo "not tested: a full disk, for this user may not mount one"
fi

finish
