#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Output that cannot be written: a full or closed standard output, folders that cannot be made, full disks, an FFmpeg that is
# missing or fails. Finished files stay; no temporary file does.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
sed -e '1s/.*/9/' -e '3s/.*/32 24 120/' -e '$s/.*/1 1/' "$work/official.in" >"$work/good.in"
render=("$hedron" render --backend c "${small[@]}")

# ---- standard output
# expect_failure CODE...: the last command ended with one of these and a sentence.
expect_failure() {
    [[ " $* " == *" $code "* ]] || fail "exit code $code, expected $*"
    expect_sentence
}

# to_full COMMAND...: exit code 1 and a sentence if standard output accepts nothing, or is closed.
to_full() {
    local full
    : >"$logs/stdout"
    for full in '>/dev/full' '>&-'; do
        last_command="$* $full"
        code=0
        eval '"$@" <"$work/good.in" 2>"$logs/stderr"' "$full" || code=$?
        expect_failure 1
    done
}
to_full "$hedron" --cpu
# The frame exists before its line; those after it may as well.
expect_data out/img_0.data 32 24
rm -r out
for arguments in --default --help --version 'devices --json' 'help man' 'help completion' convert; do
    # shellcheck disable=SC2086 # several words
    to_full "${no_nvidia[@]}" "$hedron" $arguments
done
to_full env HEDRON_CACHE=off "$hedron" tune --backend c "${small[@]}"
to_full "${render[@]}" --quiet --frames 0 -o picture.data --stats -
to_full "${render[@]}" --quiet --frames 0 -o picture.data
expect_data picture.data 32 24
rm picture.data
expect_files .

# A reader that goes away ends the program; frames stay whole.
"$hedron" --cpu <"$work/good.in" 2>"$logs/stderr" | head -c 0 || true
for file in out/*; do
    expect_data "$file" 32 24
done
rm -rf out

# ---- folders and files in the way
: >out
expect_refusal 1 "$hedron" --cpu <"$work/good.in"
expect_stderr_contains 'out'
for name in out/picture.png out/deep/picture.png out/film.mp4 /dev/null/x.png /proc/none/x.png; do
    expect_refusal 1 "${render[@]}" --frames 0 -o "$name"
    expect_stderr_contains "${name%/*}"
done
expect_files . out
rm out
mkdir folder folder.png folder.mp4
for name in folder/ /dev/null folder.png folder.mp4; do
    expect_refusal 2 "${render[@]}" --frames 0 -o "$name"
    expect_stderr_contains "$name"
done
expect_files . folder folder.png folder.mp4
rmdir folder*
expect_refusal 2 "${render[@]}" --frames 0 -o "$(printf '%05000d' 0).png"

# ---- an unwritable output is found before a frame of many minutes, and leaves nothing
long=$(printf '%0252d' 0)
: >blocked
for name in "$long.png" "$long%d.pfm" blocked/picture.png; do
    run timeout "$time_limit" "$hedron" render --quiet --backend c --size 1600x1200 --samples 16 --depth 12 --frames 0 -o "$name"
    expect_failure 1 2
done
rm blocked

# ---- a picture that is too large for any memory
if grep -q -a -F __asan_init "$hedron"; then
    echo "not tested: little memory, for the address sanitizer takes much"
else
    (
        ulimit -v 4000000
        run "$hedron" render --backend c --samples 1 --depth 0 --size 65535x65535 --frames 0 -o big.png
        expect_failure 1 2
        exit "$failures"
    ) || failures=$((failures + $?))
fi
expect_files .

# ---- a limit on the size of files: an error like any other, not a deadly signal
# limited BLOCKS COMMAND...: with files of so many KiB at most. Not through `run`, whose files count.
limited() {
    last_command="$* (ulimit -f)"
    code=0
    (
        ulimit -c 0
        ulimit -f "$1"
        exec "${@:2}"
    ) <"$work/good.in" >"$logs/stdout" 2>"$logs/stderr" || code=$?
    expect_failure 1
}
limited 2 "$hedron" --cpu
expect_files . out
rm -rf out
limited 1 "${render[@]}" --quiet --size 8x8 --frames 0-9 -o '%d.data' --stats stats.jsonl
expect_stderr_contains 'statistics to stats.jsonl'
rm -rf ./*

# ---- a full disk, if this user may mount one
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
if full_disk true 2>"$logs/which"; then
    rm -r disk_copy
    sed '2s|.*|disk/%d.data|' "$work/good.in" >"$work/disk.in"
    expect_exit 1 full_disk "$hedron" --cpu <"$work/disk.in"
    expect_sentence
    expect_stderr_contains 'No space left'
    frames=$(find disk_copy -type f | wc -l)
    ((frames >= 1 && frames <= 8)) || fail "$frames frames were written"
    expect_stdout_lines "$frames"
    for ((i = 0; i < frames; i++)); do
        expect_data "disk_copy/$i.data" 32 24
    done
    rm -r disk_copy
    # A film finds the disk full at once, or once it is finished.
    outputs=('0 320x240 x.png')
    ! has_ffmpeg || outputs+=('0-39 160x120 x.mkv' '0-39 96x72 x.mp4')
    for output in "${outputs[@]}"; do
        read -r frames size name <<<"$output"
        expect_exit 1 full_disk "$hedron" render --quiet --backend c --size "$size" --samples 1 --depth 3 --frames "$frames" \
            -o "disk/$name"
        expect_stderr_contains 'hedron: '
        expect_stderr_contains 'No space left on device'
        expect_stdout_lines 0
        expect_files disk_copy
        rm -r disk_copy
    done
    expect_files . disk
else
    echo "not tested: a full disk, for this user may not mount one"
fi
rmdir disk

# ---- no FFmpeg: films are impossible, and pictures need none. tests/unit/output/test_video.c covers its failures.
mkdir "$work/tools"
expect_refusal 3 env PATH="$work/tools" "${render[@]}" --frames 0-2 -o '%d.data' -o film.mp4
expect_stderr_contains ffmpeg
expect_files .
if ! has_ffmpeg; then
    echo "not tested: films that fail, because FFmpeg is missing"
    finish
fi
ffmpeg=$(command -v ffmpeg)

# ---- FFmpeg fails, with more bytes than the buffers on the way hold; output/test_video covers other failures
fake ffmpeg 'read -r -N 1000 -t 5 || true; echo "had enough" >&2; kill -9 $$'
expect_exit 1 timeout "$time_limit" "${with_tools[@]}" "${render[@]}" --quiet --size 400x300 --frames 0-2 -o film.mp4
expect_stderr_contains 'signal 9'
expect_stdout_lines 0
expect_files .

# One film of two fails: neither stays, but the pictures and an old film do.
printf 'old' >film.mkv
# shellcheck disable=SC2016 # for the script that is written
fake ffmpeg 'if [[ $* == *film.gif* ]]; then exit 1; fi; exec '"'$ffmpeg'"' "$@"'
expect_exit 1 "${with_tools[@]}" "${render[@]}" --quiet --frames 0-2 -o film.gif -o film.mkv -o '%d.data'
expect_stderr_contains 'exit code 1'
expect_stdout_lines 0
[[ ! -e film.gif && $(<film.mkv) == old && -z $(find . -name '*tmp*') ]] || fail "a film stayed, or the old one went: $(ls)"
# A talkative FFmpeg does not block the run; the new film replaces the old one.
fake ffmpeg "head -c 1000000 /dev/zero | tr '\\0' x >&2; exec '$ffmpeg' \"\$@\""
rm -f ./*.data
expect_exit 0 timeout "$time_limit" "${with_tools[@]}" "${render[@]}" --size 400x300 --frames 0-2 -o film.mkv
expect_files . film.mkv
[[ $(head -c 3 film.mkv) != old ]] || fail 'the old film is still there'

finish
