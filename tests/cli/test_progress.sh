#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Progress within a slow frame: on a terminal, in a pipe, in the classic mode.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need_python

use_official_input
size=(--size 160x120 --frames 0)
time='([0-9]+:)?[0-9]+:[0-9]{2}'
all='in all(, [0-9.]+ s of it to prepare)?, [0-9.]+ M rays/s'
part="0/1 frames, [0-9]+ % of the next, $time left"

# on_terminal COMMAND...: standard error is a terminal, whose contents go to the file screen; the output is not.
# shellcheck disable=SC2317 # expect_exit calls functions by their names
on_terminal() {
    env TERM=xterm "$cli_folder/in_terminal" 100x24 blocks screen -- bash -c 'exec "$@" 2>/dev/tty' bash "$@"
}

# ---- on a terminal, during the passes of an error bound: with enough samples for some two seconds, estimated by a shorter
# frame. The share grows, never shrinks, and nothing of its line stays.
render=("$hedron" render --backend c --threads 1 "${size[@]}" --max-error 2 -o long.png)
most=64
for ((samples = 4; samples <= most; samples = next > most && samples < most ? most : next)); do
    begin=${EPOCHREALTIME//[.,]/}
    expect_exit 0 on_terminal "${render[@]}" --samples "$samples"
    next=$(awk -v n="$samples" -v took="$((${EPOCHREALTIME//[.,]/} - begin))" \
        'BEGIN { more = int(n * sqrt(2.1e6 / took)); print (more > n ? more : n + 1) }')
    tr '\r' '\n' <screen | sed -e 's/\x1b\[K$//' >shown
    grep -o '[0-9]* % of the next' shown | grep -o '^[0-9]*' >parts || true
    (($(sort -u parts | wc -l) < 2)) || break
done
((samples <= most)) || fail 'no frame took long'
sort -n -c parts 2>"$logs/which" || fail "the progress does not grow: $(tr '\n' ' ' <parts)"
! grep '% of the next' shown | grep -v -x -E "\[[#.]{24}\] $part" >"$logs/which" ||
    fail "there is another line than those of progress: $(head -n 3 "$logs/which")"
[[ $(tail -c 4 screen) == $'\r\033[K' ]] || fail "the line stays: $(tail -c 60 screen | od -c | tail -n 4)"
# In a pipe: the same bytes, and few, plain lines.
mv long.png before.png
expect_exit 0 "${render[@]}" --samples "$samples"
! grep -v -q -x -E "$part|1/1 frames, [0-9.]+ frames/s, $time $all" "$logs/stderr" ||
    fail 'a pipe gets other lines than those of progress'
(($(wc -l <"$logs/stderr") <= 101)) || fail 'a pipe gets too many lines'
expect_same long.png before.png
expect_exit 0 on_terminal "${render[@]}" --quiet --samples "$samples"
[[ ! -s screen ]] || fail "--quiet is not quiet on a terminal"

# ---- the classic mode: standard output is unchanged, even on the same terminal
# shellcheck disable=SC2317 # as above
classic() {
    "$hedron" --cpu --threads 1 "${size[@]}" "$@" <"$work/official.in"
}
export -f classic
export hedron work
expect_exit 0 classic --samples 1
expect_silent_stderr
expect_exit 0 env TERM=xterm "$cli_folder/in_terminal" 100x24 blocks screen -- \
    bash -c "exec >/dev/tty 2>&1; $(declare -p size); classic --samples 1 --frames 0-3" bash
(($(tr '\r' '\n' <screen | grep -c -E $'^(\033\\[K)?[0-3]\t[0-9]+\\.[0-9]{3}\t[0-9]+$') == 4)) ||
    fail "frames' lines are written behind the bar"

finish
