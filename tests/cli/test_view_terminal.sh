#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The live view in a terminal: it saves what 'hedron render' makes of that view, with each protocol.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need_python

small=(--size 48x36 --samples 2)
export TERM=xterm-256color COLORTERM=truecolor

# see ANSWER STEP... -- OPTION...: a view in a terminal of 80 x 24.
see() {
    local answer=$1
    shift
    local steps=()
    while [[ $1 != -- ]]; do
        steps+=("$1")
        shift
    done
    shift
    expect_exit "${expected_code:-0}" "${no_nvidia[@]}" "$cli_folder/in_terminal" 80x24 "$answer" screen "${steps[@]}" \
        -- "$hedron" view --terminal "$@"
    cp "$logs/stdout" said
}

# expect_view PICTURE OPTION...: equals 'hedron render' of the last printed camera.
expect_view() {
    local picture=$1 camera
    shift
    camera=$(sed -n 's/^"camera": //p' said | tail -n 1)
    expect_exit 0 "${no_nvidia[@]}" "$hedron" render --quiet --again --frames 0 -o view.png --set "camera=$camera" "$@"
    expect_exit 0 "$hedron" compare view.png "$picture" --fail-above 0
    expect_stdout_contains identical
    rm -f "$picture"
}

setsid -w "$hedron" view --terminal --backend c </dev/null 2>lacking || true
! grep -q 'built without' lacking || skip "hedron-view has no terminal, for chafa (libchafa-dev) was not there"

# ---- a rotated, moved and zoomed view
right='\x1b[C' up='\x1b[A'
see blocks wait:finished "keys:$right$right${up}dw+pc" wait:saved keys:q -- --backend c "${small[@]}"
expect_stdout_contains hedron-001.png
grep -q $'\xe2\x96' screen || fail "the screen got no block symbols"
grep -q -F $'\033[38;2;' screen || fail "the screen got no 24-bit colours"
grep -q -F $'\033[?1049l' screen || fail "the screen was not given back"
expect_view hedron-001.png --backend c "${small[@]}"
if has_opencl; then
    see blocks wait:finished "keys:${right}pc" wait:saved keys:q -- --backend opencl "${small[@]}"
    expect_view hedron-001.png --backend c "${small[@]}"
fi

# ---- settings by keys
see blocks wait:finished 'keys:fpc' wait:saved 'keys:]m' 'keys:pc' wait:saved keys:xpc wait:saved keys:q \
    -- --backend c "${small[@]}"
grep -q 'double, depth 15, grid, 3 x 3 samples' screen || fail "the settings are not on the screen"
deeper=(--backend c --size 48x36 --samples 3 --depth 15 --precision double)
expect_view hedron-001.png --backend c "${small[@]}" --precision double
expect_view hedron-002.png "${deeper[@]}"
expect_view hedron-003.png "${deeper[@]}" --aa grid

# ---- a picture of dependent passes that takes minutes is abandoned for a key
waits='wait:refining: 1 x 1 samples, 100 %'
see blocks "$waits" "keys:$right" wait:moving: "$waits" "keys:$right" wait:moving: "$waits" keys:q \
    -- --backend c --size 960x540 --samples 64 --max-error 0.05

# ---- the camera path: a frame that it stopped at is that of the film
see blocks wait:finished keys:.... 'wait:frame 4 of 240' 'keys: ' wait:playing 'keys: ' keys:p wait:saved keys:q \
    -- --backend c "${small[@]}"
frame=$(tr '\033' '\n' <screen | sed -n 's/.*frame \([0-9]*\) of 240; h.*/\1/p' | tail -n 1)
expect_exit 0 "$hedron" render --quiet --frames "$frame" --backend c -o path.png "${small[@]}"
expect_exit 0 "$hedron" compare path.png hedron-001.png --fail-above 0
rm -f hedron-001.png

# ---- two settings side by side
see blocks wait:finished 'keys:2' 'wait:difference' 'keys:f' 'wait:right *: double' wait:finished 'keys:2q' \
    -- --backend c "${small[@]}"

# ---- the scene's file is watched; an error is reported with its place and leaves the picture
expect_exit 0 "$hedron" new scene.json
cp scene.json good.json
sed 's/"circumradius": [0-9.]*/"circumradius": -1/' good.json >wrong.json
head -n 5 good.json >torn.json
see blocks wait:finished 'sh:cp wrong.json scene.json' 'wait:circumradius is -1' 'sh:cp torn.json scene.json' \
    'wait:scene.json:6' 'sh:sed "s/\"kind\": *\"cube\"/\"kind\": \"icosahedron\"/" good.json >scene.json' wait:moving \
    keys:pc wait:saved keys:q -- scene.json --backend c "${small[@]}"
expect_stdout_contains scene-001.png
expect_view scene-001.png scene.json --backend c "${small[@]}"

# ---- terminals' answers about themselves
see kitty wait:finished keys:q -- --backend c "${small[@]}"
grep -q -a -F $'\033_Ga=T,f=' screen || fail "a terminal with the kitty protocol got no picture by it"
see sixel wait:finished keys:q -- --backend c "${small[@]}"
grep -q -a $'\033P[0-9;]*q"1;1;' screen || fail "a terminal with sixels got none"
TERM=xterm COLORTERM='' see blocks wait:finished keys:q -- --backend c "${small[@]}"
grep -q -F $'\033[38;5;' screen || fail "a terminal of 256 colours got none"

# ---- ends
# shellcheck disable=SC2016 # the shell of the step knows it
expected_code=143 see blocks wait:finished 'sh:kill -TERM $PROGRAM' -- --backend c "${small[@]}"
expected_code=2 see blocks -- nothing.json
expect_stderr_contains nothing.json
expect_exit 3 setsid -w "$hedron" view --terminal --backend c </dev/null
expect_sentence
expect_stderr_contains 'needs a terminal'
expect_exit 2 "$hedron" view - </dev/null
finish
