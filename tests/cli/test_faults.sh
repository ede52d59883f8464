#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Failures around a run (docs/reference/faults.md): folders that go away, an FFmpeg that hangs, missing memory and threads, a
# signal while everything hangs. The result is a clear sentence, the right exit code, and no incomplete file; or a reduced run
# and a sentence that says so.
# shellcheck disable=SC2317 # wait_for calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
failing=$build/tests/failing/libfailing_system.so # is preloaded
render=("$hedron" render --quiet --backend c "${small[@]}")

# A dead orphan may stay for long, until its new parent reaps it.
is_dead() {
    is_gone "$1" || [[ $(ps -o stat= -p "$1") == Z* ]]
}

# expect_nothing_temporary WHEN
expect_nothing_temporary() {
    ! find . -name '*.tmp-*' | grep . >"$logs/which" || fail "$1 there stays $(<"$logs/which")"
}

# ---- an output folder that goes away during a run: its name is reported, and files elsewhere stay
# The statistics are a pipe that nobody reads at first, so that the run cannot end.
mkfifo "$work/pipe"
# remove_folder FILE ARGUMENTS...: removes the folder `gone` once a file of that pattern exists.
remove_folder() {
    local reader
    exec 9<>"$work/pipe"
    start "${render[@]}" --threads 1 --frames 0-239 --stats "$work/pipe" "${@:2}" 9>&-
    wait_for "$1" compgen -G "$1" >"$logs/which"
    mv gone "$work/taken_away"
    cat <&9 >"$work/lines" &
    reader=$!
    expect_end 1
    kill "$reader"
    exec 9>&-
    rm -r "$work/taken_away"
    expect_sentence
    expect_stdout_lines 0
    expect_stderr_contains 'its folder gone/ was removed'
    expect_nothing_temporary 'where the folder is gone,'
    [[ ! -e gone ]] || fail 'the folder was made again'
}
remove_folder gone/3.data -o 'gone/%d.data' -o 'stays/%d.data'
for file in stays/0.data stays/*; do
    expect_data "$file" 32 24
done
rm -r stays
if has_ffmpeg; then
    remove_folder 'gone/film.mkv.*tmp-*' -o gone/film.mkv
fi
expect_files .
# A frame's own folder is made just before the frame is written.
expect_exit 0 "${render[@]}" --frames 0-40 -o 'frames/%d/picture.data'
expect_data frames/40/picture.data 32 24
rm -r frames

# ---- an FFmpeg, or an ffprobe, that hangs
note_leader="echo \$\$ >'$work/leader.new'; mv '$work/leader.new' '$work/leader'"
# expect_stuck PROGRAM BODY: a fake of that name is ended; pictures and an older film stay.
expect_stuck() {
    printf 'old' >film.mkv
    fake "$1" "$note_leader; $2"
    expect_exit 1 timeout "$time_limit" "${with_tools[@]}" HEDRON_FFMPEG_PATIENCE=1 "${render[@]}" --frames 0-2 \
        -o film.mkv -o '%d.data'
    rm "$work/tools/$1"
    expect_sentence
    expect_stderr_contains "${1/ffmpeg/FFmpeg} was idle for 1 s"
    expect_stderr_contains 'HEDRON_FFMPEG_PATIENCE'
    rm -f ./*.data
    expect_files . film.mkv
    [[ $(<film.mkv) == old ]] || fail 'the old film changed'
    wait_for "$1 to be gone" is_gone "$(<"$work/leader")"
    rm "$work/leader" film.mkv
}
if has_ffmpeg; then
    expect_stuck ffmpeg "cat >/dev/null; echo 'last words'; exec sleep 1000 >/dev/null 2>&1"
    expect_stderr_contains 'last words'
    expect_stuck ffprobe 'exec sleep 1000'
    expect_refusal 2 env HEDRON_FFMPEG_PATIENCE=1.5 "${render[@]}" --frames 0 -o film.mkv
    # Nor does it outlive the program: a file that it wrote late would stay for ever.
    fake ffmpeg "$note_leader; exec sleep 1000"
    start "${with_tools[@]}" "${render[@]}" --frames 0-2 -o film.mkv
    wait_for 'FFmpeg to be started' test -e "$work/leader"
    kill -KILL "$pid"
    wait_for "FFmpeg to be dead" is_dead "$(<"$work/leader")"
    wait "$pid" || true
    rm -f ./* "$work/leader"
else
    echo "not tested: films, because FFmpeg is missing"
fi
expect_refusal 2 env HEDRON_STOP_PATIENCE=0 "${render[@]}" --frames 0 -o x.png

if is_sanitized; then
    echo "not tested: memory, threads and files that fail, for sanitizers bring their own"
    finish
fi

# ---- a system that cannot end FFmpeg with the program: the next run waits until it is gone
# It writes its file after that, as a real one about to open it may, or when allowed to.
if has_ffmpeg; then
    fake ffmpeg "for last; do :; done; file=\${last#file:}; $note_leader
        while [[ -e \$file && ! -e '$work/may_go_on' ]]; do sleep 0.02; done; echo late >\"\$file\""
    start "${with_tools[@]}" LD_PRELOAD="$failing" FAILING_ORPHANS=1 "${render[@]}" --frames 0-2 -o film.mkv
    wait_for 'FFmpeg to be started' test -e "$work/leader"
    kill -KILL "$pid"
    wait "$pid" || true
    ! is_dead "$(<"$work/leader")" || fail 'FFmpeg died with the program all the same'
    ! flock -n film.mkv.tmp-* true || fail "no process holds the file's lock"
    rm "$work/tools/ffmpeg"
    start "${render[@]}" --frames 0-2 -o film.mkv
    touch "$work/may_go_on"
    expect_end 0
    wait_for 'FFmpeg to be dead' is_dead "$(<"$work/leader")"
    expect_files . film.mkv
    rm film.mkv
fi

# ---- a signal while a file server does not answer, which blocks the main thread or another one
# start_hanging TIMEOUT FILE ARGUMENTS...: until it hangs because of that file.
start_hanging() {
    rm -f "$work/reached"
    start env HEDRON_STOP_PATIENCE="$1" STUCK_MARK="$work/reached" LD_PRELOAD="$failing" STUCK_OPEN="$2" \
        "${render[@]}" "${@:3}"
    wait_for 'it to hang' test -e "$work/reached"
}
cp "$project/scenes/default.json" "$work/scene.json"
# The first file of that name only tests whether it can be written.
for case in 'INT /scene.json' 'TERM 1.data.tmp-' 'HUP 1.data.tmp-'; do
    start_hanging 0.2 "${case#* }" "$work/scene.json" --frames 0-1 -o '%d.data'
    send "${case% *}" "$pid"
    expect_end $((128 + $(kill -l "${case% *}")))
    expect_sentence
    expect_stderr_contains 'interrupted; the running work did not end in time'
    rm -f 0.data # a frame of an earlier run
    expect_files .
done
# Later signals end it at once, whatever the timeout.
ends_by_another() {
    kill -INT "$pid" 2>/dev/null || true
    sleep 0.6
    is_gone "$pid"
}
start_hanging 600 1.data.tmp- --frames 0-1 -o '%d.data'
wait_for 'the second signal to end it' ends_by_another
expect_end 130
expect_silent_stderr
rm -f 0.data
expect_files .

# ---- threads that the system refuses
refused_from() {
    run timeout "$time_limit" env FAILING_THREADS_AFTER="$1" LD_PRELOAD="$failing" "${@:2}"
}
few=("$hedron" render --backend c "${small[@]}" --frames 0-2 -o '%d.data' --threads 4)
"${few[@]}" --quiet >"$logs/which"
mkdir "$work/whole"
mv ./*.data "$work/whole"
refused=0
for after in {0..11}; do
    refused_from "$after" "${few[@]}"
    if ((code == 0)); then
        diff -r . "$work/whole" >"$logs/which" || fail "with $after threads pictures differ: $(<"$logs/which")"
        ! grep -q 'the system refused threads for' "$logs/stderr" || refused=$((refused + 1))
    else
        ((code == 1)) || fail "exit code $code with $after threads, expected 0 or 1"
        expect_stderr_contains 'cannot start'
        expect_files .
    fi
    ((after > 1 && after < 9 || code == (after < 2))) || fail "exit code $code with $after threads"
    rm -f ./*.data
done
((refused > 0)) || fail "fewer threads never did the work"
refused_from 2 "${few[@]}"
expect_stderr_contains '1 of 4 do it'
expect_stderr_contains '--threads leaves more'
rm -f ./*.data "$work/whole"/*
# Finished frames and a missing one, which nobody can store: it ends.
most_finished=("${render[@]}" --frames 0-19 -o 'finished/%d.png' --threads 1)
"${most_finished[@]}" >"$logs/which"
for after in {0..5}; do
    rm -f finished/19.png
    refused_from "$after" "${most_finished[@]}"
    ((code == 0 || code == 1)) || fail "exit code $code with $after threads, expected 0 or 1"
done
rm -r finished

# ---- memory that runs out, at any of the allocations of a run, once or from then on
lean=("${render[@]}" --threads 1 --frames 0-1 --no-sync --stats stats.jsonl -o '%d.png' -o '%d.pfm')
memory=(env HEDRON_CACHE=off LD_PRELOAD="$failing")
expect_exit 0 "${memory[@]}" FAILING_MEMORY_COUNT="$work/count" "${lean[@]}"
count=$(<"$work/count")
((count >= 200)) || fail "$count allocations were counted, expected hundreds"
rm stats.jsonl
mv ./* "$work/whole"
failed=0
# fail_at NUMBER TIMES: so many allocations fail; pictures are whole, or a sentence names the failure.
fail_at() {
    run "${memory[@]}" FAILING_MEMORY_AT="$1" FAILING_MEMORY_TIMES="$2" "${lean[@]}"
    if ((code == 0)); then
        rm stats.jsonl
        diff -r . "$work/whole" >"$logs/which" || fail "pictures differ after allocation $1 failed: $(<"$logs/which")"
    else
        ((code == 1)) || fail "exit code $code after allocation $1 of $count failed, expected 0 or 1"
        # A thread needs memory, and the system does not say what it lacked.
        grep -q -i -E 'memory|cannot start .*thread' "$logs/stderr" || fail "no message says that allocation $1 failed"
    fi
    expect_nothing_temporary "where allocation $1 of $count fails,"
    rm -f ./*
}
step=1
for ((at = 1; at <= count; at += step)); do
    fail_at "$at" 1
    ((code == 0)) || expect_sentence
    failed=$((failed + code))
    step=1
    # Those that read the scene are alike, and so are those for a line of statistics.
    case $(<"$logs/stderr") in
    *'room for the scene') step=13 ;;
    *'line of statistics') step=4 ;;
    esac
done
((failed >= 60)) || fail "only $failed allocations were missed"
for ((at = 60; at <= count; at += 97)); do
    fail_at "$at" 1000000
    ((code == 1 || at > count - 97)) || fail "the run succeeds although all allocations from $at of $count on fail"
done
expect_files .

# ---- few descriptors: fewer frames are in flight; small stacks: threads have their own size
# with_limit LIMIT COMMAND...
with_limit() {
    # shellcheck disable=SC2086 # an option of ulimit and its value
    (ulimit $1 && exec "${@:2}")
}
for descriptors in 8 12; do
    expect_exit 0 with_limit "-n $descriptors" "${render[@]}" --frames 0-30 -o '%d.png'
    expect_files . {0..30}.png
    rm -f ./*.png
done
expect_exit 1 with_limit '-n 5' "${render[@]}" --frames 0-3 -o '%d.png'
expect_stderr_contains 'Too many open files'
rm -f ./*.png
for limit in '-s 1024' '-S -s 256'; do
    expect_exit 0 with_limit "$limit" "${render[@]}" --depth 1000 --frames 0 -o picture.data
done
# The first thread's stack is checked if it cannot be raised.
if ((EUID != 0)) || ! (ulimit -H -s 256 && ulimit -H -s 512) 2>"$logs/which"; then
    expect_exit 1 with_limit '-s 256' "${render[@]}" --depth 1000 --frames 0 -o picture.data
    expect_stderr_contains 'the stack may have 256 KiB (ulimit -s), expected at least 1024 KiB'
fi

finish
