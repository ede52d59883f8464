#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# SIGINT and SIGTERM: what is finished stays whole, nothing half-done stays, the exit code is 128 + signal.
# shellcheck disable=SC2317 # wait_for calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# Frames that take a minute together, so that a signal comes in their midst.
slow=(--quiet --size 240x180 --samples 2 --depth 4 --threads 1 --frames 0-239)
use_official_input

# Signals come when something shows that it is time for them, never after a fixed while.

# wait_for WHAT COMMAND...: until the command succeeds, and no longer than the patience lasts.
wait_for() {
    local what=$1
    shift
    if ! wait_until "$patience" "$@"; then
        fail "waited in vain for $what"
        show_logs
    fi
}

# send SIGNAL TARGET: where the target is gone already, the test would show nothing.
send() {
    kill "-$1" -- "$2" 2>/dev/null || fail 'it was over before the signal'
}

ends_by_signals() {
    sleep 0.6
    kill -INT "$pid" 2>/dev/null || true
    is_gone "$pid"
}

# The state of the program's main thread, as a letter, and the hundredths of a second it has computed.
# Nothing before it has taken the place of the shell that started it.
look_at() {
    local all stat
    state='' ticks=0
    { read -r all <"/proc/$pid/stat"; } 2>/dev/null || return 1
    [[ $all == "$pid (hedron) "* ]] || return 1
    read -r -a stat <<<"${all#*) }"
    state=${stat[0]}
    ticks=$((stat[11] + stat[12]))
}

sleeps_for_signals() {
    local mask
    look_at || return 1
    mask=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$pid/status") || return 1
    switches=$(sed -n 's/^voluntary_ctxt_switches:[[:space:]]*//p' "/proc/$pid/status") || return 1
    [[ -n $mask && $state == S ]] && (((16#$mask >> ($(kill -l INT) - 1)) & 1))
}

# It has nothing but its input or a pipe to wait for then. On its way there it may sleep for a moment: it waits
# where it still sleeps the same sleep at a second look.
waits() {
    local switches before
    sleeps_for_signals || return 1
    before=$switches
    sleep 0.05
    sleeps_for_signals && [[ $switches == "$before" ]]
}

has_computed() {
    look_at && ((ticks >= $1))
}

# expect_first_frames FOLDER: the files are those of the first frames, whole, and no others. Sets `frames`.
expect_first_frames() {
    local i names=()
    frames=$(find "$1" -type f | wc -l)
    for ((i = 0; i < frames; i++)); do
        names+=("$i.data")
        expect_data "$1/$i.data" 240 180
    done
    expect_files "$1" "${names[@]}"
    if ((frames < 3 || frames >= 240)); then
        fail "$frames frames were written, expected the first few of 240"
    fi
}

# ---- sequences
for signal in INT TERM; do
    number=$(kill -l "$signal")
    start "$hedron" render --backend c "${slow[@]}" -o 'out/%d.data'
    wait_for 'the third frame' test -e out/2.data
    send "$signal" "$pid"
    expect_end $((128 + number))
    expect_sentence
    expect_stdout_lines 0
    expect_first_frames out
    expect_stderr_contains "after $frames of 240"
    rm -r out

    # The classic mode has a line for each frame that is there.
    sed '2s|.*|out/%d.data|' "$work/official.in" >"$work/sequence.in"
    start "$hedron" --cpu "${slow[@]}" <"$work/sequence.in"
    wait_for 'the third frame' test -e out/2.data
    # As a terminal does it: to the whole group.
    send "$signal" "-$pid"
    expect_end $((128 + number))
    expect_sentence
    expect_first_frames out
    expect_stdout_lines "$frames" $'[0-9]+\t[0-9.]+\t[0-9]+'
    rm -r out
done

# ---- nohup: what whoever started it ignores, it ignores too
start bash -c 'trap "" HUP; exec "$@"' - "$hedron" render --backend c "${slow[@]}" --frames 0-9 -o 'out/%d.data'
wait_for 'the first frame' test -e out/0.data
send HUP "$pid"
expect_end 0
expect_silent_stderr
expect_files out {0..9}.data
rm -r out

# ---- films
# fake_ffmpeg BODY: a program that is found in $work/tools instead of FFmpeg.
fake_ffmpeg() {
    mkdir -p "$work/tools"
    printf '#!%s\n%s\n' "$(command -v bash)" "$1" >"$work/tools/ffmpeg"
    chmod +x "$work/tools/ffmpeg"
    rm -f "$work/reached"
}

if ffmpeg=$(command -v ffmpeg) && command -v ffprobe >"$logs/which"; then
    # As soon as there is a folder for the film, and when FFmpeg has several frames.
    fake_ffmpeg "{ head -c 500000; : >'$work/reached'; exec cat; } | '$ffmpeg' \"\$@\""
    for signal in INT TERM; do
        for moment in new "$work/reached"; do
            rm -f "$work/reached"
            start env PATH="$work/tools:$PATH" "$hedron" render --backend c "${slow[@]}" -o new/film.mp4
            wait_for "$moment" test -e "$moment"
            # Twice at once, as 'timeout' does it.
            send "$signal" "-$pid"
            kill "-$signal" "$pid" 2>/dev/null || true
            expect_end $((128 + $(kill -l "$signal")))
            expect_sentence
            expect_stdout_lines 0
            expect_files . new
            rmdir new
        done
    done

    # Several outputs: the film goes, pictures and statistics stay whole.
    rm "$work/tools/ffmpeg"
    start "$hedron" render --backend c "${slow[@]}" -o film.mkv -o 'out/%d.data' --stats "$work/stats.jsonl"
    wait_for 'the third frame' test -e out/2.data
    send TERM "$pid"
    expect_end 143
    expect_sentence
    expect_first_frames out
    if (($(grep -c '^{.*}$' "$work/stats.jsonl") != frames || $(wc -l <"$work/stats.jsonl") != frames)); then
        fail "the statistics have not one line for each of $frames frames"
    fi
    rm -r out
    expect_files .

    # An FFmpeg that stopped reading, or that does not come to its end, must not stop us from ending.
    for body in 'head -c 100000 >/dev/null' 'cat >/dev/null'; do
        fake_ffmpeg "$body; : >'$work/reached'; exec sleep 3600"
        start env PATH="$work/tools:$PATH" "$hedron" render --backend c --size 400x300 --samples 1 --depth 0 \
            --frames 0-3 -o film.mp4
        wait_for 'FFmpeg to come to its point' test -e "$work/reached"
        send TERM "$pid"
        expect_end 143
        expect_files .
        rm -rf ./*
    done

    # FFmpeg does not inherit that we ignore readers that went away.
    fake_ffmpeg "sed -n 's/^SigIgn:[[:space:]]*//p' /proc/\$\$/status >'$work/reached'; exec '$ffmpeg' \"\$@\""
    expect_exit 0 env PATH="$work/tools:$PATH" "$hedron" render --quiet --backend c "${small[@]}" --frames 0 \
        -o film.mkv
    if (((16#$(<"$work/reached") >> ($(kill -l PIPE) - 1)) & 1)); then
        fail 'FFmpeg ignores SIGPIPE'
    fi
    rm film.mkv

    # While ffprobe counts, it is an interrupt as well.
    fake_ffmpeg "exec '$ffmpeg' \"\$@\""
    printf '#!%s\n%s\n' "$(command -v bash)" ": >'$work/reached'; exec sleep 3600" >"$work/tools/ffprobe"
    chmod +x "$work/tools/ffprobe"
    start env PATH="$work/tools:$PATH" "$hedron" render --quiet --backend c "${small[@]}" --frames 0 -o film.mkv
    wait_for 'ffprobe to count' test -e "$work/reached"
    send INT "$pid"
    expect_end 130
    expect_sentence
    expect_stderr_contains interrupted
    expect_files .
    rm "$work/tools/ffprobe"

    # An FFmpeg that neither speaks nor ends is ended. Nothing stays behind.
    fake_ffmpeg "cat >/dev/null; echo \$\$ >'$work/leader'; exec >&- 2>&-; : >'$work/reached'; exec sleep 3600"
    start env PATH="$work/tools:$PATH" "$hedron" render --backend c "${small[@]}" --frames 0 -o film.mkv
    wait_for 'FFmpeg to fall silent' test -e "$work/reached"
    send INT "$pid"
    expect_end 130
    expect_sentence
    wait_for 'FFmpeg to be gone' is_gone "$(<"$work/leader")"
    expect_files .
    rm "$work/tools/ffmpeg"
else
    echo "not tested: films, for there is no FFmpeg"
fi

# ---- before the first frame: while it waits for its input
mkfifo "$work/pipe"
exec 9<>"$work/pipe"
for signal in INT TERM; do
    start "$hedron" --cpu <"$work/pipe" 9>&-
    wait_for 'it to wait for its input' waits
    send "$signal" "$pid"
    expect_end $((128 + $(kill -l "$signal")))
done
exec 9>&-

# ---- before the first frame: while it waits for a reader of the statistics
start "$hedron" render --backend c "${small[@]}" --frames 0 -o picture.data --stats "$work/pipe"
wait_for 'it to wait for a reader' waits
send INT "$pid"
expect_end 130
expect_sentence

# ---- while it waits for a reader of the statistics that does not read on
stands_still() {
    local files
    files=$(find out -type f | wc -l)
    sleep 0.3
    ((files > 3)) && [[ $(find out -type f | wc -l) == "$files" ]]
}
exec 9<>"$work/pipe"
start "$hedron" render --quiet --backend c --size 16x12 --samples 1 --depth 0 --frames 0-239 -o 'out/%d.data' \
    --stats "$work/pipe" 9>&-
wait_for 'it to wait for the reader' test -e out/3.data
wait_for 'it to wait for the reader' stands_still
send INT "$pid"
expect_end 130
expect_sentence
exec 9>&-
if (($(find out -type f | wc -l) > 200)) || [[ -n $(find out -name '*.tmp-*') ]]; then
    fail 'the pipe took all statistics, or temporary files were left'
fi
rm -r out

# ---- in the midst of a frame of many minutes
start "$hedron" render --backend c --size 1600x1200 --samples 16 --depth 12 --frames 0 -o picture.data
wait_for 'it to compute' has_computed 30
send INT "$pid"
expect_end 130
expect_sentence
expect_stderr_contains 'interrupted after 0 of 1 frames'

expect_files .
finish
