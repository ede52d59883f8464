#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Messages on standard error: progress, --verbose, --quiet.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
render=("$hedron" render --backend c "${small[@]}")
time='([0-9]+:)?[0-9]+:[0-9]{2}'
all='in all(, [0-9.]+ s of it to prepare)?, [0-9.]+ M rays/s'
rate='[0-9]+\.[0-9]{2} frames/s'

expect_note() { # REGEX: one line of standard error matches as a whole
    (($(grep -c -x -E -e "$1" "$logs/stderr") == 1)) || fail "standard error has no line, or more than one, that is $1"
}

# ---- progress: plain lines without a terminal; the last one has the total time
expect_exit 0 "${render[@]}" --frames 0-2 -o '%d.data'
expect_note "3/3 frames, $rate, $time $all"
! grep -v -q -x -E "[0-9]+/3 frames, $rate, $time (left|$all)" "$logs/stderr" ||
    fail "standard error has other lines than those of progress"
rm ./*.data

# ---- progress on a terminal: a bar that disappears
if script -q -e -c true /dev/null </dev/null >"$logs/script" 2>&1; then
    expect_exit 0 script -q -e -c "$hedron render --backend c ${small[*]} --frames 0-2 -o %d.data" /dev/null
    tr '\r' '\n' <"$logs/stdout" | grep -q -E "^\[#{16}\.{8}\] 2/3 frames, $rate, $time left" ||
        fail "the terminal has no bar"
    [[ $(<"$logs/stdout") == *$'\r\033[K%d.data\r' ]] || fail "the bar stays"
    rm ./*.data
else
    echo "not tested: a terminal, because the program 'script' is missing"
fi

# ---- --quiet
expect_exit 0 "${render[@]}" --quiet --frames 0-2 -o '%d.data'
expect_stdout_lines 1 '%d\.data'
expect_silent_stderr
rm ./*.data
expect_exit 0 "${nothing[@]}" "$hedron" --quiet "${small[@]}" --frames 0 <"$work/official.in"
expect_stdout_lines 1
expect_silent_stderr
rm -r out

# ---- a film of 16 bits has 8, with a message; pictures alone have them
expect_exit 0 "${render[@]}" --frames 0 --set output.bits=16 -o film.mkv -o deep.png
expect_note 'hedron: films have 8 bits a channel, though output.bits is 16'
expect_exit 0 "${render[@]}" --frames 0 --set output.bits=16 -o deep.png
! grep -q 'films have' "$logs/stderr" || fail "there is no film, but standard error mentions its bits"
rm film.mkv deep.png

# ---- --frame-lines: a line for each frame, in their order, and no other progress
expect_exit 0 "${render[@]}" --quiet --frame-lines --frames 1-2,7 -o '%d.data'
expect_same "$logs/stderr" <(printf 'hedron: frame %d stored, %d of 3\n' 1 1 2 2 7 3)
expect_exit 0 "${render[@]}" --frame-lines --frames 1-2,7 -o '%d.data'
! grep -q 'frames/s' "$logs/stderr" || fail "there is progress of two forms"
rm ./*.data

# ---- --verbose: scene, outputs, device and the reason, renderer and build
expect_exit 0 "${render[@]}" --verbose --frames 0-2 -o '%d.data' -o '%d.png'
expect_stdout_lines 2
expect_note 'scene +the built-in scene: [0-9]+ solids, a floor, [0-9]+ lights, [0-9]+ frames of 32 x 24 pixels, .*'
expect_note 'outputs +%d\.data, %d\.png \(3 frames, .*\)'
expect_note 'device +c 0, .*: the best device of the backend named by --backend'
expect_note 'renderer +[0-9]+ lanes?, .*'
expect_note 'kernels +[0-9]+ planes; compiled ahead, .*'
rm ./*.data ./*.png
expect_exit 0 "$hedron" render "${small[@]}" --verbose --frames 0 -o a.data
expect_note 'device +c 0, .*: it needs about [0-9.e-]+ s, less than other devices take to start'
expect_exit 0 "${nothing[@]}" "$hedron" render --size 320x180 --samples 6 --threads 1 --verbose --frames 0 -o a.data
expect_note 'device +c 0, .*: no GPU can do this; not used: cuda: .*; opencl: .*'
expect_exit 0 "${nothing[@]}" "$hedron" render "${small[@]}" --verbose --frames 0 -o a.data --device 0
expect_note 'device +c 0, .*: named by --device; not used: .*'
# why a picture is black
expect_exit 0 "${render[@]}" --verbose --frames 1 -o a.data --set image.exposure=1e-6
expect_note 'hedron: all that is in view in frame 1 is nearly black: image.exposure is 1e-06, and with .*'
expect_exit 0 "${render[@]}" --frames 1 -o a.data --set image.exposure=1e-6
! grep -q 'black' "$logs/stderr" || fail 'nobody asked why the picture is black'
rm a.data
expect_exit 0 "$hedron" --cpu --verbose "${small[@]}" --frames 0 <"$work/official.in"
expect_note 'scene +standard input: 3 solids, .*'
expect_note 'device +c 0, .*: the C backend, since only a CPU will do'
rm -r out
if has_opencl; then
    expect_exit 0 "${no_nvidia[@]}" "$hedron" render --backend opencl "${small[@]}" --verbose --frames 0 -o a.data
    expect_note 'device +opencl [0-9]+, .*'
    expect_note 'kernels +[0-9]+ planes; built for up to [0-9]+ planes and depth [0-9]+, .*'
    rm a.data
fi

# ---- on a terminal, if some frames exist, and all of them
on_terminal=(env TERM=xterm python3 -c
    'import os, pty, sys; sys.exit(os.waitstatus_to_exitcode(pty.spawn(sys.argv[1:])))')
if python3 -c 'import sys; sys.exit(sys.version_info < (3, 10))' 2>"$logs/which"; then
    for frames in 0-1 0-3 0-3; do
        expect_exit 0 "${on_terminal[@]}" "${render[@]}" --frames "$frames" -o 'd%d.png'
    done
    expect_stdout_contains '4 of 4 frames were finished already'
    rm d?.png
fi

expect_files .
finish
