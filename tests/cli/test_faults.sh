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

wait_for() {
    local what=$1
    shift
    if ! wait_until 100 "$@"; then
        fail "waited in vain for $what"
        show_logs
    fi
}

# An orphan may lie dead for long, until its new parent looks after it.
is_dead() {
    is_gone "$1" || [[ $(ps -o stat= -p "$1") == Z* ]]
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
    expect_end 1
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
        remove_folder "gone/$name.*tmp-*" -o "gone/$name"
        expect_files .
    done
fi
# A folder of each frame's own is made when its turn comes.
expect_exit 0 "$hedron" render --quiet --backend c "${small[@]}" --frames 0-40 -o 'frames/%d/picture.data'
expect_data frames/40/picture.data 32 24
rm -r frames

# ---- an FFmpeg, or an ffprobe, that stands still
stuck=(env PATH="$tools:$PATH" HEDRON_FFMPEG_PATIENCE=2 "$hedron" render --quiet --backend c --samples 1 --depth 0)
# expect_stuck PROGRAM: with few bytes, and with more than the buffers on the way hold.
expect_stuck() {
    local size
    for size in 32x24 400x300; do
        rm -f "$work/leader"
        expect_exit 1 timeout 100 "${stuck[@]}" --size "$size" --frames 0-2 -o film.mkv
        expect_sentence
        expect_stderr_contains "$1 stood still for 2 s"
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
    # Nor does it outlive the program: what it wrote late would stay for ever.
    for signal in KILL TERM; do
        fake ffmpeg "echo \$\$ >'$work/leader.new'; mv '$work/leader.new' '$work/leader'; exec sleep 1000"
        rm -f "$work/leader"
        start "${stuck[@]}" --size 32x24 --frames 0-2 -o film.mkv
        wait_for 'FFmpeg to be started' test -e "$work/leader"
        kill "-$signal" "$pid"
        wait_for "FFmpeg to be dead after SIG$signal" is_dead "$(<"$work/leader")"
        wait "$pid" || true
        rm -f ./*
    done
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
    for seconds in x 0 -1 1.5 1e9; do
        expect_refusal 2 env HEDRON_FFMPEG_PATIENCE=$seconds "$hedron" render --backend c "${small[@]}" --frames 0 \
            -o film.mkv
        expect_stderr_contains 'HEDRON_FFMPEG_PATIENCE'
        expect_files .
    done
else
    echo "not tested: films, for there is no FFmpeg"
fi

# ---- a signal while a file server does not answer, which holds the main thread or another one
# expect_end_by_signals WHAT COMMAND...: by each of them, once there is `reached`.
expect_end_by_signals() {
    local signal
    for signal in INT TERM HUP; do
        rm -f "$work/reached"
        start "$@"
        wait_for 'it to hang' test -e "$work/reached"
        kill "-$signal" "$pid" || fail 'it was over before the signal'
        expect_end $((128 + $(kill -l "$signal")))
        expect_sentence
        expect_stderr_contains 'interrupted; what was at work did not end in time'
        if [[ -e 0.data ]]; then # a frame that was finished before
            expect_data 0.data 32 24
            rm 0.data
        fi
        expect_files .
    done
}
if is_sanitized; then
    echo "not tested: memory, threads and files that fail, for sanitizers bring their own"
    expect_files .
    finish
fi
# ---- a system that cannot end FFmpeg with the program: the next run waits until it is gone
# It writes to its file once that is gone, as a true one may that was about to open it, or once it may go on.
if [[ -n ${true_ffmpeg:-} ]]; then
    fake ffmpeg "for last; do :; done; file=\${last#file:}; echo \$\$ >'$work/leader.new'; mv '$work/leader.new' '$work/leader'
        while [[ -e \$file && ! -e '$work/may_go_on' ]]; do sleep 0.02; done; echo late >\"\$file\""
    rm -f "$work/leader"
    start env LD_PRELOAD="$failing/libfailing_orphans.so" "${stuck[@]}" --size 32x24 --frames 0-2 -o film.mkv
    wait_for 'FFmpeg to be started' test -e "$work/leader"
    kill -KILL "$pid"
    wait "$pid" || true
    ! is_dead "$(<"$work/leader")" || fail 'FFmpeg died with the program all the same'
    ! flock -n film.mkv.tmp-* true || fail 'nobody has the file locked'
    rm "$tools/ffmpeg"
    start "${stuck[@]}" --size 32x24 --frames 0-2 -o film.mkv
    touch "$work/may_go_on"
    expect_end 0
    wait_for 'FFmpeg to be dead' is_dead "$(<"$work/leader")"
    expect_files . film.mkv
    rm film.mkv
fi

hanging=(env -u HEDRON_STOP_PATIENCE STUCK_MARK="$work/reached" LD_PRELOAD="$failing/libfailing_stuck.so")
cp "$project/scenes/default.json" "$work/scene.json"
expect_end_by_signals "${hanging[@]}" STUCK_OPEN=/scene.json "$hedron" render "$work/scene.json" --backend c "${small[@]}" \
    --frames 0 -o picture.data
# The first file of that name only asks whether it can be written.
expect_end_by_signals "${hanging[@]}" STUCK_OPEN=1.data.tmp- "$hedron" render --quiet --backend c "${small[@]}" --frames 0-1 \
    -o '%d.data' -o film.mkv
# Later signals end it at once, however much patience there is.
ends_by_another() {
    kill -INT "$pid" 2>/dev/null || true
    sleep 0.6
    is_gone "$pid"
}
rm -f "$work/reached"
start env STUCK_MARK="$work/reached" LD_PRELOAD="$failing/libfailing_stuck.so" STUCK_OPEN=1.data.tmp- \
    "$hedron" render --quiet --backend c "${small[@]}" --frames 0-1 -o '%d.data'
wait_for 'it to hang' test -e "$work/reached"
wait_for 'the second signal to end it' ends_by_another
expect_end 130
expect_silent_stderr
rm -f 0.data
expect_files .
for seconds in x 0 -1 1e9 nan; do
    expect_refusal 2 env HEDRON_STOP_PATIENCE=$seconds "$hedron" render --backend c "${small[@]}" --frames 0 -o x.png
    expect_stderr_contains HEDRON_STOP_PATIENCE
done

# ---- threads that the system refuses
few=("$hedron" render --backend c "${small[@]}" --frames 0-2 -o '%d.data' --threads 4)
"${few[@]}" --quiet >"$logs/which"
mkdir "$work/whole"
mv ./*.data "$work/whole"
refused=0
for ((after = 0; after < 12; after++)); do
    run env FAILING_THREADS_AFTER=$after LD_PRELOAD="$failing/libfailing_threads.so" "${few[@]}"
    if ((code == 0)); then
        for i in 0 1 2; do
            expect_same "$i.data" "$work/whole/$i.data"
        done
        if grep -q 'the system refused threads for' "$logs/stderr"; then
            refused=$((refused + 1))
        fi
    elif ((code != 1)); then
        fail "exit code $code, expected 0 or 1"
        show_logs
    else
        expect_stderr_contains 'cannot start'
        expect_files .
    fi
    if ((after > 8 || after < 2)) && ((code != (after < 2))); then
        fail "exit code $code with $after threads"
    fi
    rm -f ./*.data
done
if ((refused == 0)); then
    fail "fewer threads never did the work"
fi
# Finished frames beside a missing one, which nobody can store: it ends.
most_finished=("$hedron" render --quiet --backend c "${small[@]}" --frames 0-19 -o 'finished/%d.png' --threads 1)
"${most_finished[@]}" >"$logs/which"
for ((after = 0; after < 6; after++)); do
    rm -f finished/19.png
    run timeout "$patience" env FAILING_THREADS_AFTER=$after LD_PRELOAD="$failing/libfailing_threads.so" "${most_finished[@]}"
    if ((code != 0 && code != 1)); then
        fail "exit code $code with $after threads, expected 0 or 1"
        show_logs
    fi
done
rm -r finished
run env FAILING_THREADS_AFTER=2 LD_PRELOAD="$failing/libfailing_threads.so" "${few[@]}"
expect_stderr_contains '1 of 4 do it'
expect_stderr_contains '--threads leaves more'

# ---- memory that is at its end, at any of the allocations of a run
lean=("$hedron" render --quiet --backend c --threads 1 "${small[@]}" --frames 0-1 --stats stats.jsonl -o '%d.png' -o '%d.pfm')
memory=(env HEDRON_CACHE=off LD_PRELOAD="$failing/libfailing_memory.so")
expect_exit 0 "${memory[@]}" FAILING_MEMORY_COUNT="$work/count" "${lean[@]}"
count=$(<"$work/count")
if ((count < 200)); then
    fail "$count allocations were counted, expected hundreds"
fi
mv 0.png 1.png 0.pfm 1.pfm "$work/whole"
rm stats.jsonl
expect_whole() {
    local file
    for file in 0.png 1.png 0.pfm 1.pfm; do
        expect_same "$file" "$work/whole/$file"
    done
}
# The first ones are those of the system's loader; then those that read the scene, each like the other.
step=1
failed=0
for ((at = 1; at <= count; at += step)); do
    run "${memory[@]}" FAILING_MEMORY_AT=$at "${lean[@]}"
    if ((code == 1)); then
        failed=$((failed + 1))
        expect_sentence
        # A thread needs some, and the system does not say what it lacked.
        if ! grep -q -i -E 'memory|cannot start .*thread' "$logs/stderr"; then
            fail "where allocation $at of $count fails, nothing says so"
            show_logs
        fi
    elif ((code == 0)); then
        expect_whole
    else
        fail "exit code $code where allocation $at of $count fails, expected 0 or 1"
        show_logs
    fi
    if compgen -G '*.tmp-*' >"$logs/which"; then
        fail "where allocation $at of $count fails, there stays $(ls)"
    fi
    rm -f ./*
    step=$((at > 40 && at < count / 2 ? 7 : 1))
done
if ((failed < 20)); then
    fail "only $failed allocations were missed"
fi
# From then on for good; what is written by then, with the last ones gone, is whole.
for ((at = 60; at <= count; at += 23)); do
    run "${memory[@]}" FAILING_MEMORY_AT=$at FAILING_MEMORY_TIMES=1000000 "${lean[@]}"
    if ((code == 0 && at > count - 23)); then
        expect_whole
    else
        expect_stderr_contains memory
        if ((code != 1)); then
            fail "exit code $code where all allocations from $at of $count on fail, expected 1"
            show_logs
        fi
    fi
    rm -f ./*
done

expect_files .
# ---- few descriptors: fewer frames are under way
for descriptors in 8 9 12 16 24; do
    # shellcheck disable=SC2016 # for the inner shell
    expect_exit 0 bash -c 'ulimit -n "$1"; shift; exec "$@"' few "$descriptors" \
        "$hedron" render --quiet --backend c "${small[@]}" --frames 0-30 -o '%d.png'
    if (($(find . -name '*.png' | wc -l) != 31)); then
        fail "with $descriptors descriptors not all frames are there: $(ls)"
    fi
    rm -f ./*.png
done
# shellcheck disable=SC2016 # for the inner shell
expect_exit 1 bash -c 'ulimit -n 5; exec "$@"' few "$hedron" render --quiet --backend c "${small[@]}" --frames 0-3 -o '%d.png'
expect_stderr_contains 'Too many open files'
rm -f ./*.png

# ---- small stacks: threads have their own size, and the first one's is checked
if ! is_sanitized; then
    deep=("$hedron" render --quiet --backend c --size 32x24 --samples 1 --depth 1000 --frames 0 -o '%d.png')
    # shellcheck disable=SC2016 # for the inner shell
    expect_exit 0 bash -c 'ulimit -s 1024; exec "$@"' small "${deep[@]}"
    # shellcheck disable=SC2016
    expect_exit 0 bash -c 'ulimit -S -s 256; exec "$@"' small "${deep[@]}"
    if ((EUID != 0)) || ! (ulimit -H -s 256 && ulimit -H -s 512) 2>"$logs/ulimit"; then
        # shellcheck disable=SC2016
        expect_exit 1 bash -c 'ulimit -s 256; exec "$@"' small "${deep[@]}"
        expect_stderr_contains 'the stack may have 256 KiB (ulimit -s), expected at least 1024 KiB'
    fi
    rm -f ./*.png
fi

finish
