#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The live view in a window, under Xvfb with keys and a mouse simulated by xdotool.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

small=(--size 96x54 --samples 2)

# ---- without the window's program, or without a display
mkdir alone
cp "$hedron" alone/hedron
expect_exit 3 env PATH=/usr/bin:/bin alone/hedron view --backend c
expect_sentence
expect_stderr_contains 'hedron-view, cannot be started'
window=$(dirname "$hedron")/hedron-view
for driver in '' x11 dummy offscreen evdev; do
    expect_exit 3 timeout 60 env -u DISPLAY -u WAYLAND_DISPLAY XDG_RUNTIME_DIR="$PWD" SDL_VIDEODRIVER=$driver "$hedron" view --backend c
    expect_sentence
    expect_stderr_contains '--terminal'
done
! grep -q 'built without' "$logs/stderr" || skip "hedron-view has no window, for SDL 2 (libsdl2-dev) was not there"
expect_exit 2 "$window" devices
for tool in Xvfb xdotool import identify; do
    command -v "$tool" >/dev/null || skip "$tool is not installed"
done

# ---- a display of its own
# Without -noreset it restarts when its last client leaves, and loses the next one.
timeout 300 Xvfb -displayfd 3 -noreset -screen 0 1280x800x24 -nolisten tcp 3>display 2>/dev/null &
server=$!
trap 'clean_up; kill "$server"' EXIT
# await WHAT COMMAND...: until the command succeeds, 20 s at most.
await() {
    wait_until 20 "${@:2}" >/dev/null 2>&1 || fail "$1 did not come: $(cat errors 2>/dev/null)"
}
await 'the display' test -s display
DISPLAY=:$(<display)
export DISPLAY
unset WAYLAND_DISPLAY
export SDL_VIDEODRIVER=x11 DBUS_SESSION_BUS_ADDRESS=unix:path=/nonexistent # waiting for a missing file would hang

# expect_saved NUMBER OPTION...: the picture with that number equals 'hedron render' of the camera.
expect_saved() {
    local picture=hedron-$1.png camera
    shift
    await "$picture" grep -q -x -F "$picture" said
    await 'the camera' grep -q '^"camera"' said
    camera=$(sed -n 's/^"camera": //p' said | tail -n 1)
    expect_exit 0 "${no_nvidia[@]}" "$hedron" render --quiet --again --frames 0 --backend c -o view.png --set "camera=$camera" "$@"
    expect_exit 0 "$hedron" compare view.png "$picture" --fail-above 0
    expect_stdout_contains identical
}

# ---- keys and mouse, which go to the window under the pointer: there is no window manager
"${no_nvidia[@]}" "$hedron" view --backend c "${small[@]}" >said 2>errors &
view=$!
await 'the window' xdotool search --name '^hedron$'
xdotool mousemove 640 400
xdotool key Right Up d plus
xdotool mousedown 1 mousemove 700 380 mouseup 1 click 4
xdotool key c p
expect_saved 001 "${small[@]}"
import -window root still.png
(($(identify -format '%k' still.png) > 500)) || fail "the window shows no picture"

# ---- settings, the split view and the help are drawn
xdotool key f bracketright m x p
expect_saved 002 --size 96x54 --samples 3 --depth 15 --precision double --aa grid
xdotool key 2 x h
sleep 1
import -window root split.png
expect_different still.png split.png
xdotool key q
wait "$view" || fail "the view ended with $?: $(<errors)"
finish
