#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# SIGINT and SIGTERM: what is finished stays whole, nothing half-done stays, the exit code is 128 + signal.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# A hundred frames that take many seconds together, so that a signal comes in their midst.
slow=(--size 240x180 --samples 1 --depth 4 --threads 1 --frames 0-99)
use_official_input

# expect_first_frames FOLDER: the files are those of the first frames, whole, and no others. Sets `frames`.
expect_first_frames() {
    local i names=()
    frames=$(find "$1" -type f | wc -l)
    for ((i = 0; i < frames; i++)); do
        names+=("$i.data")
        expect_data "$1/$i.data" 240 180
    done
    expect_files "$1" "${names[@]}"
    if ((frames < 3 || frames >= 100)); then
        fail "$frames frames were written, expected the first few of 100"
    fi
}

# ---- sequences
for signal in INT TERM; do
    number=$(kill -l "$signal")
    start "$hedron" render --backend c "${slow[@]}" -o 'out/%d.data'
    if ! wait_until 20 test -e out/2.data; then
        fail 'no third frame after 20 s'
    fi
    kill "-$signal" "$pid" || fail 'it was over before the signal'
    expect_end $((128 + number)) 10
    expect_sentence
    expect_stdout_lines 0
    expect_first_frames out
    expect_stderr_contains "after $frames of 100"
    rm -r out

    # The classic mode has a line for each frame that is there.
    sed '2s|.*|out/%d.data|' "$work/official.in" >"$work/sequence.in"
    start "$hedron" --cpu "${slow[@]}" <"$work/sequence.in"
    if ! wait_until 20 test -e out/2.data; then
        fail 'no third frame after 20 s'
    fi
    # As a terminal does it: to the whole group.
    kill "-$signal" -- "-$pid" || fail 'it was over before the signal'
    expect_end $((128 + number)) 10
    expect_sentence
    expect_first_frames out
    expect_stdout_lines "$frames" $'[0-9]+\t[0-9.]+\t[0-9]+'
    rm -r out
done

# ---- films
if command -v ffmpeg >"$logs/which" && command -v ffprobe >"$logs/which"; then
    for signal in INT TERM; do
        number=$(kill -l "$signal")
        for delay in 0.05 0.5; do
            start "$hedron" render --backend c "${slow[@]}" -o new/film.mp4
            if ! wait_until 20 test -d new; then
                fail 'no folder for the film after 20 s'
            fi
            sleep "$delay"
            kill "-$signal" -- "-$pid"
            expect_end $((128 + number)) 10
            expect_sentence
            expect_stdout_lines 0
            expect_files . new
            rmdir new
        done
    done

    # An FFmpeg that stopped reading, or that does not come to its end, must not stop us from ending.
    mkdir "$work/tools"
    for body in 'exec sleep 20' 'cat >/dev/null; exec sleep 20'; do
        printf '#!%s\n%s\n' "$(command -v bash)" "$body" >"$work/tools/ffmpeg"
        chmod +x "$work/tools/ffmpeg"
        start env PATH="$work/tools:$PATH" "$hedron" render --backend c --size 400x300 --samples 1 --depth 0 \
            --frames 0-3 -o film.mp4
        sleep 0.7
        kill -TERM "$pid"
        expect_end 143 5
        expect_files .
        rm -rf ./*
    done
else
    echo "not tested: films, for there is no FFmpeg"
fi

# ---- before the first frame: while it waits for its input
mkfifo "$work/pipe"
exec 9<>"$work/pipe"
for signal in INT TERM; do
    start "$hedron" --cpu <"$work/pipe" 9>&-
    sleep 0.3
    kill "-$signal" "$pid"
    expect_end $((128 + $(kill -l "$signal"))) 3
done
exec 9>&-

# ---- a second signal ends it at once, whatever it is at
start "$hedron" render --backend c --size 1600x1200 --samples 16 --depth 12 --frames 0 -o picture.data
sleep 0.3
kill -INT "$pid"
sleep 0.3
kill -INT "$pid" 2>/dev/null || true
expect_end 130 3

expect_files .
finish
