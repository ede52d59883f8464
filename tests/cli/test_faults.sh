#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What goes wrong around a run (docs/faults.md): folders that go away, an FFmpeg that hangs, memory and
# threads that there are not, a signal while everything hangs. A clear sentence, the right exit code, and
# nothing half-done; or less than was wanted, and a sentence that tells it. What the disk, the device and
# the cache can do is in test_output_failures.sh, test_device_faults.sh and test_cache.sh.
# shellcheck disable=SC2317 # wait_for calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
failing=$build/tests/failing # libraries that are preloaded
bash_path=$(command -v bash)
tools=$work/tools
mkdir "$tools"

is_sanitized() {
    grep -q -a -E '__(asan|tsan)_init' "$hedron"
}

wait_for() {
    local what=$1
    shift
    if ! wait_until 100 "$@"; then
        fail "waited in vain for $what"
        show_logs
    fi
}

# fake NAME BODY: a program of that name in the tools folder.
fake() {
    printf '#!%s\n%s\n' "$bash_path" "$2" >"$tools/$1"
    chmod +x "$tools/$1"
    rm -f "$work/reached"
}

# ---- an output folder that goes away in the midst of a run: its name, and what is elsewhere stays
# The statistics are a pipe that nobody reads at first, so that the run cannot come to its end.
mkfifo "$work/pipe"
# remove_folder FILE ARGUMENTS...: takes the folder `gone` away once there is a file of that pattern.
remove_folder() {
    local file=$1 reader
    shift
    exec 9<>"$work/pipe"
    start "$hedron" render --quiet --backend c --threads 1 "${small[@]}" --frames 0-239 --stats "$work/pipe" "$@" 9>&-
    wait_for "$file" compgen -G "$file" >"$logs/which"
    mv gone "$work/taken_away"
    cat <&9 >"$work/lines" &
    reader=$!
    expect_end 1 100
    kill "$reader"
    exec 9>&-
    rm -r "$work/taken_away"
    expect_sentence
    expect_stdout_lines 0
    expect_stderr_contains 'its folder gone/ is gone'
}
remove_folder gone/3.data -o 'gone/%d.data'
expect_files .
remove_folder gone/3.data -o 'gone/%d.data' -o 'stays/%d.data'
expect_data stays/0.data 32 24
for file in stays/*; do
    expect_data "$file" 32 24
done
if compgen -G '*/*.tmp-*' >"$logs/which" || [[ -e gone ]]; then
    fail "temporary files or the folder that went are there: $(find .)"
fi
rm -rf stays
if command -v ffmpeg >"$logs/which" && command -v ffprobe >"$logs/which"; then
    for name in film.mkv film.mp4; do
        remove_folder "gone/$name.tmp-*" -o "gone/$name"
        expect_files .
    done
fi
# A folder of each frame's own is made when its turn comes.
expect_exit 0 "$hedron" render --quiet --backend c "${small[@]}" --frames 0-40 -o 'frames/%d/picture.data'
expect_data frames/40/picture.data 32 24
rm -r frames

# ---- an FFmpeg, or an ffprobe, that stands still
stuck=(env PATH="$tools:$PATH" HEDRON_FFMPEG_PATIENCE=1 "$hedron" render --quiet --backend c --samples 1 --depth 0)
# expect_stuck PROGRAM: with few bytes, and with more than the buffers on the way hold.
expect_stuck() {
    local size
    for size in 32x24 400x300; do
        rm -f "$work/leader"
        expect_exit 1 timeout 100 "${stuck[@]}" --size "$size" --frames 0-2 -o film.mkv
        expect_sentence
        expect_stderr_contains "$1 stood still for 1 s"
        expect_stderr_contains 'HEDRON_FFMPEG_PATIENCE'
        expect_files .
        wait_for "$1 to be gone" is_gone "$(<"$work/leader")"
    done
}
if command -v ffmpeg >"$logs/which" && command -v ffprobe >"$logs/which"; then
    true_ffmpeg=$(command -v ffmpeg)
    # It takes nothing, or all and then does not end, with or without closing its channels.
    fake ffmpeg "echo \$\$ >'$work/leader'; exec sleep 1000"
    expect_stuck FFmpeg
    fake ffmpeg "echo \$\$ >'$work/leader'; cat >/dev/null; exec sleep 1000"
    expect_stuck FFmpeg
    fake ffmpeg "echo \$\$ >'$work/leader'; cat >/dev/null; echo 'last words'; exec sleep 1000 >/dev/null 2>&1"
    expect_stuck FFmpeg
    expect_stderr_contains 'last words'
    fake ffmpeg "echo \$\$ >'$work/leader'; head -c 1000 >/dev/null; exec sleep 1000"
    expect_stuck FFmpeg
    rm "$tools/ffmpeg"
    fake ffprobe "echo \$\$ >'$work/leader'; exec sleep 1000"
    expect_stuck ffprobe
    rm "$tools/ffprobe"
    # Pictures that were finished stay, and a film of an earlier run.
    printf 'old' >film.mkv
    fake ffmpeg "exec sleep 1000"
    expect_exit 1 timeout 100 "${stuck[@]}" --size 32x24 --frames 0-2 -o film.mkv -o '%d.data'
    expect_stderr_contains 'stood still'
    for i in 0 1 2; do
        if [[ -e $i.data ]]; then
            expect_data "$i.data" 32 24
        fi
    done
    if [[ $(<film.mkv) != old ]] || compgen -G '*.tmp-*' >"$logs/which"; then
        fail "the old film changed, or something temporary stayed: $(ls)"
    fi
    rm -f ./*
    # One that is slow is not stuck: it writes, says something, or computes.
    for work_of_its in "echo >>'$work/log'; touch \"\$file\"" 'echo busy' 'for ((j = 0; j < 100000; j++)); do :; done'; do
        fake ffmpeg "for last; do :; done; file=\${last#file:}
            for ((i = 0; i < 8; i++)); do $work_of_its; sleep 0.3; done; exec '$true_ffmpeg' \"\$@\""
        expect_exit 0 env HEDRON_FFMPEG_PATIENCE=60 timeout 100 "${stuck[@]:0:2}" "${stuck[@]:3}" --size 32x24 --frames 0-2 -o film.mkv
        rm -f film.mkv
    done
    rm "$tools/ffmpeg"
    for patience in x 0 -1 1.5 1e9; do
        expect_refusal 2 env HEDRON_FFMPEG_PATIENCE=$patience "$hedron" render --backend c "${small[@]}" --frames 0 \
            -o film.mkv
        expect_stderr_contains 'HEDRON_FFMPEG_PATIENCE'
        expect_files .
    done
else
    echo "not tested: films, for there is no FFmpeg"
fi

expect_files .
finish
