#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# SIGINT and SIGTERM: finished files stay whole, no incomplete ones stay, the exit code is 128 + signal.
# shellcheck disable=SC2317 # wait_for calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# Frames that take a minute together, so that a signal comes in between.
slow=(--quiet --size 240x180 --samples 2 --depth 4 --threads 1 --frames 0-239)
use_official_input

# Signals come when something shows that it is time for them, never after a fixed delay. Nothing before: the program must have
# replaced the shell that started it.
sleeps_for_signals() {
    local mask
    [[ $(ps -o s=,comm= -p "$pid") == S*hedron ]] || return 1
    mask=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$pid/status") || return 1
    switches=$(sed -n 's/^voluntary_ctxt_switches:[[:space:]]*//p' "/proc/$pid/status") || return 1
    [[ -n $mask ]] && (((16#$mask >> ($(kill -l INT) - 1)) & 1))
}

# It then waits only for its input or a pipe. Before, it may sleep for a moment: it waits if a second look finds the same
# sleep.
waits() {
    local switches before
    sleeps_for_signals || return 1
    before=$switches
    sleep 0.05
    sleeps_for_signals && [[ $switches == "$before" ]]
}

has_computed() { # SECONDS
    [[ $(ps -o cputimes=,comm= -p "$pid") == *hedron ]] && (($(ps -o cputimes= -p "$pid") >= $1))
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
    ((frames >= 3 && frames < 240)) || fail "$frames frames were written, expected the first few of 240"
}

# ---- sequences: the classic mode has a line for each stored frame
sed '2s|.*|out/%d.data|' "$work/official.in" >"$work/sequence.in"
start "$hedron" --cpu "${slow[@]}" <"$work/sequence.in"
wait_for 'the third frame' test -e out/2.data
send TERM "-$pid" # as a terminal does it: to the whole group
expect_end 143
expect_sentence
expect_first_frames out
expect_stderr_contains "after $frames of 240"
expect_stdout_lines "$frames" $'[0-9]+\t[0-9.]+\t[0-9]+'
rm -r out

# ---- nohup: signals that its parent ignores, it ignores too
start bash -c 'trap "" HUP; exec "$@"' - "$hedron" render --backend c "${slow[@]}" --frames 0-3 -o 'out/%d.data'
wait_for 'the first frame' test -e out/0.data
send HUP "$pid"
expect_end 0
expect_silent_stderr
expect_files out {0..3}.data
rm -r out

# ---- films
# start_film MARK ARGUMENTS...: with the fakes, until MARK exists.
start_film() {
    rm -f "$work/reached"
    start "${with_tools[@]}" "$hedron" render --quiet --backend c "${@:2}"
    wait_for "$1" test -e "$1"
}
# expect_end_without_files SIGNAL
expect_end_without_files() {
    expect_end $((128 + $(kill -l "$1")))
    expect_sentence
    expect_stderr_contains interrupted
    expect_stdout_lines 0
    expect_files .
}

if has_ffmpeg; then
    # As soon as the film has a folder, and when FFmpeg has several frames; twice at once, as 'timeout' does it.
    fake ffmpeg "{ head -c 500000; : >'$work/reached'; exec cat; } | '$(command -v ffmpeg)' \"\$@\""
    for case in "INT $work/here/new" "TERM $work/reached"; do
        start_film "${case#* }" "${slow[@]}" -o new/film.mp4
        send "${case% *}" "-$pid"
        kill "-${case% *}" "$pid" 2>/dev/null || true
        expect_end $((128 + $(kill -l "${case% *}")))
        expect_sentence
        expect_stdout_lines 0
        expect_files . new
        rmdir new
    done

    # Several outputs: the film goes, pictures and statistics stay whole.
    rm "$work/tools/ffmpeg"
    start_film out/2.data "${slow[@]}" -o film.mkv -o 'out/%d.data' --stats "$work/stats.jsonl"
    send TERM "$pid"
    expect_end 143
    expect_sentence
    expect_first_frames out
    (($(grep -c '^{.*}$' "$work/stats.jsonl") == frames && $(wc -l <"$work/stats.jsonl") == frames)) ||
        fail "the statistics have not one line for each of $frames frames"
    rm -r out

    # An FFmpeg that neither writes nor ends must not keep hedron from ending.
    fake ffmpeg "echo \$\$ >'$work/leader'; cat >/dev/null; exec >&- 2>&-; : >'$work/reached'; exec sleep 3600"
    start_film "$work/reached" --size 400x300 --samples 1 --depth 0 --frames 0-3 -o film.mp4
    send TERM "$pid"
    expect_end_without_files TERM
    wait_for 'FFmpeg to be gone' is_gone "$(<"$work/leader")"
    rm "$work/tools/ffmpeg"

    # While ffprobe counts, the interrupt works as well.
    fake ffprobe ": >'$work/reached'; exec sleep 3600"
    start_film "$work/reached" "${small[@]}" --frames 0 -o film.mkv
    send INT "$pid"
    expect_end_without_files INT
else
    echo "not tested: films, because FFmpeg is missing"
fi

# ---- before the first frame: while it waits for its input, or for a reader of the statistics
mkfifo "$work/pipe"
exec 9<>"$work/pipe"
start "$hedron" --cpu <"$work/pipe" 9>&-
wait_for 'it to wait for its input' waits
send TERM "$pid"
expect_end 143
exec 9>&-
start "$hedron" render --backend c "${small[@]}" --frames 0 -o picture.data --stats "$work/pipe"
wait_for 'it to wait for a reader' waits
send INT "$pid"
expect_end 130
expect_sentence

# ---- while it waits for a reader of the statistics that stopped reading
stands_still() {
    local files
    files=$(find out -type f | wc -l)
    sleep 0.3
    ((files > 3 && $(find out -type f | wc -l) == files))
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
(($(find out -type f | wc -l) <= 200)) || fail 'the pipe took all statistics'
[[ -z $(find out -name '*.tmp-*') ]] || fail 'temporary files were left'
rm -r out

# ---- during a frame of many minutes
start "$hedron" render --quiet --backend c --size 1600x1200 --samples 16 --depth 12 --frames 0 -o picture.data
wait_for 'it to compute' has_computed 1
send INT "$pid"
expect_end_without_files INT
expect_stderr_contains 'interrupted after 0 of 1 frames'

finish
