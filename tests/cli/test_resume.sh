#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A repeated run renders the missing frames only, and makes the same files: numbered pictures, films after their last whole
# segment. It may have been killed, as often as a third argument says.
# shellcheck disable=SC2317 # wait_until calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

kills=${3:-2}
cat >scene.json <<'JSON'
{
  "hedron": 1,
  "image": {"width": 48, "height": 36, "samples": 1, "depth": 4},
  "camera": {"frames": 40, "eye": {"r0": 6, "phi_frequency": 1}, "target": [0, 0, 0]},
  "materials": {"plain": {"colour": [1, 0.5, 0.25], "ambient": 0.5, "diffuse": 0.5}},
  "solids": [{"kind": "cube", "material": "plain"}],
  "lights": [{"position": [5, 5, 5], "intensity": 2}],
  "floor": {"corners": [[-5, 5, -2], [5, 5, -2], [5, -5, -2], [-5, -5, -2]],
            "material": "plain", "texture": {"file": "floor.data"}}
}
JSON
make_texture floor.data

# render COUNT OPTIONS...: of the frames 0 to 5, renders so many and leaves the others unchanged.
render() {
    local expected=$1 rendered resumed
    rm -f stats.jsonl
    expect_exit 0 "$hedron" render --backend c --frames 0-5 --stats stats.jsonl "${@:2}"
    rendered=$(grep -c '"backend"' stats.jsonl || true)
    resumed=$(grep -c -x -E '\{"frame":[0-5],"resumed":true\}' stats.jsonl || true)
    ((rendered == expected && resumed == 6 - expected)) ||
        fail "$rendered frames were rendered and $resumed resumed, expected $expected and the rest"
    if ((expected < 6)) && [[ " $* " != *" --quiet "* ]]; then
        expect_stderr_contains "hedron: $((6 - expected)) of 6 frames were finished already"
    else
        ! grep -q finished "$logs/stderr" || fail 'frames are said to be finished'
    fi
}

# ---- existing frames are left alone, and missing or damaged ones are not
render 6 scene.json -o 'out/%d.png'
cp -r out first
looks=$(stat -c '%n %i %y' out/*) # a file that is written again differs in inode and time of change
render 0 scene.json -o 'out/%d.png'
expect_stdout_lines 1 'out/%d\.png'
render 0 --quiet scene.json -o 'out/%d.png' --lanes 1 --threads 1 --pipeline wavefront # which does not matter
expect_silent_stderr
# A finished run needs no device.
expect_exit 3 "${no_nvidia[@]}" "$hedron" render --backend cuda scene.json --frames 10 -o 'out/%d.png'
expect_exit 0 "${no_nvidia[@]}" "$hedron" render --backend cuda scene.json --frames 3-5 -o 'out/#.png'
[[ $(stat -c '%n %i %y' out/*) == "$looks" ]] || fail 'finished pictures were written again'
rm out/3.png
printf 'x' >>out/0.png
truncate -s -1 out/5.png
cp out/1.png out/2.png
touch out/3.png.tmp-4000000-0 # as a killed run leaves it
render 4 scene.json -o 'out/%d.png'
expect_exit 0 diff -r out first

# ---- everything that decides a pixel is in the fingerprint, and names are not
cp floor.data other.data
sed 's/floor\.data/other.data/' scene.json >other.json
render 0 other.json -o 'out/%d.png' --set output.frames_per_second=24000/1001
for variant in '--set materials.plain.diffuse=0.25' '--set output.bits=16' '--set output.alpha=true' '--crop 8x8+3+2' '--set camera.frames=41'; do
    # shellcheck disable=SC2086 # an option and its value
    render 6 scene.json -o 'out/%d.png' $variant
done
render 0 scene.json -o 'out/%d.png' --set camera.frames=41
printf '\100' | dd of=floor.data bs=1 seek=8 conv=notrunc status=none
render 6 scene.json -o 'out/%d.png' --set camera.frames=41

# ---- always rendered
render 6 scene.json -o 'out/%d.png' --set camera.frames=41 --again
for math in fast fast strict; do
    render 6 scene.json -o 'fast/%d.png' --math "$math"
done
for _ in 1 2; do
    expect_exit 0 "$hedron" render --backend c --frames 3 scene.json -o 3.png --stats stats.jsonl
done
grep -q backend stats.jsonl || fail 'a picture without a number was taken for finished'

# ---- another program has another hash, wherever its sources lie
sources_hash() {
    cmake -DFOLDER="$1" -DOUTPUT="$work/hash.c" -P "$project/cmake/sources_hash.cmake"
    cat "$work/hash.c"
}
if command -v cmake >"$logs/which"; then
    mkdir -p a/{src/c,cpu,cmake,kernels/common}
    sources=(CMakeLists.txt src/a.c src/b.h src/c/d.c cpu/k.c kernels/common/d.h kernels/e.cl kernels/f.cu
        cmake/compile_options.cmake cmake/cpu_kernels.cmake)
    for file in "${sources[@]}"; do
        echo text >"a/$file"
    done
    hash=$(sources_hash "$PWD/a")
    cp -r a b
    [[ $(sources_hash "$PWD/b") == "$hash" ]] || fail 'the hash of the sources depends on their place'
    for file in "${sources[@]}"; do
        echo other >"b/$file"
        [[ $(sources_hash "$PWD/b") != "$hash" ]] || fail "$file is not in the hash of the sources"
        echo text >"b/$file"
    done
fi

# ---- films: of finished frames; joined segments equal a film made in one run
frames=70 # 30 a second: three segments
film=("$hedron" render --backend c --size 64x48 --samples 1 --depth 2 --frames "0-$((frames - 1))")

# Joining must not change: the pictures, in order, and the times; those of an MP4, which are not lossless, by time.
content() {
    ffprobe -v error -show_entries packet=pts_time -of csv=p=0 "$1" | tr -d , | sort -n
    if [[ $1 != *.mp4 ]]; then
        ffmpeg -nostdin -v error -i "$1" -f framemd5 - | sed -n 's/.*, *//p'
    fi
}

# expect_segments NAME COUNT: so many whole ones, and no unfinished one.
expect_segments() {
    local found
    found=$(find . -name "$1.part-*" | grep -c -E 'part-[0-9]{4}-[0-9a-f]{16}$' || true)
    ((found == $2)) || fail "there are $found segments, expected $2"
    ! compgen -G './*.tmp-*' || fail 'temporary files are left'
}

if has_ffmpeg; then
    rm -r out fast
    render 6 scene.json -o 'out/%d.png' -o fresh.mkv
    rm out/0.png out/4.png out/5.png
    render 3 scene.json -o 'out/%d.png' -o some.mkv
    expect_same <(content fresh.mkv) <(content some.mkv)
    rm -r ./*

    for ending in mkv mp4; do
        # Fast arithmetic, in plain C the same, keeps no segments.
        expect_exit 0 "${film[@]}" --quiet --math fast -o "whole.$ending"
        expect_exit 0 "${film[@]}" --quiet -o "film.$ending"
        expect_same <(content "film.$ending") <(content "whole.$ending")
        mv "film.$ending" "$work/undisturbed.$ending"
        rm "whole.$ending"
        # Interrupted in the third segment, it continues there.
        stop_at_third TERM
        expect_exit 143 "${with_tools[@]}" "${film[@]}" -o "film.$ending"
        expect_stderr_contains 'of 70 frames; frames kept: 0-59; the same command goes on with 60-69'
        expect_segments "film.$ending" 2
        expect_exit 0 "${film[@]}" -o "film.$ending"
        expect_stderr_contains 'hedron: 60 of 70 frames were finished already'
        expect_files . "film.$ending"
        expect_same "film.$ending" "$work/undisturbed.$ending"
        rm "film.$ending"
    done
    # Killed, it leaves its unfinished file, which the next run removes.
    stop_at_third KILL
    expect_exit 137 "${with_tools[@]}" "${film[@]}" -o film.mkv
    stop_at_third TERM
    expect_exit 143 "${with_tools[@]}" "${film[@]}" -o film.mkv
    expect_stderr_contains 'hedron: 60 of 70 frames were finished already'
    expect_segments film.mkv 2
    # Two films, one of which has more: frames of both are needed until the other has as many.
    expect_exit 0 "${film[@]}" -o film.mkv -o "it's.mp4"
    expect_files . film.mkv "it's.mp4"
    expect_same film.mkv "$work/undisturbed.mkv"
    expect_same "it's.mp4" "$work/undisturbed.mp4"
    rm ./*
    # Segments of another film are not used, and go once there is a new one; --again uses none.
    for change in '--depth 3' ''; do
        # shellcheck disable=SC2086 # several words
        expect_exit 143 "${with_tools[@]}" "${film[@]}" $change -o film.mkv
        ! grep -q 'finished already' "$logs/stderr" || fail "with $change segments of another film are taken"
    done
    expect_exit 0 "${film[@]}" --again -o film.mkv
    ! grep -q 'finished already' "$logs/stderr" || fail "with --again segments are taken"
    expect_files . film.mkv
    expect_same film.mkv "$work/undisturbed.mkv"
    rm film.mkv

    # ---- a frame gets its name only after the film has it: FFmpeg accepts nothing, and the run is killed or interrupted
    fake ffmpeg "echo \$\$ >'$work/leader.new'; mv '$work/leader.new' '$work/leader'; exec sleep 600"
    held=("$hedron" render --backend c --quiet --size 400x300 --samples 1 --depth 0 --frames 0-9 -o 'held/%d.png')
    has_temporary() {
        compgen -G 'held/*.tmp-*' >"$logs/which"
    }
    start "${with_tools[@]}" "${held[@]}" -o held/film.mkv
    wait_for 'the first frame' has_temporary
    wait_for 'FFmpeg' test -e "$work/leader"
    kill -KILL "$pid" "$(<"$work/leader")"
    expect_end 137
    has_temporary || fail 'nothing is left of the first frame'
    [[ ! -e held/0.png ]] || fail 'the first frame has its name before the film has it'
    expect_exit 0 "${held[@]}" -o held/film.mkv
    expect_files held {0..9}.png film.mkv
    film+=(-o killed/film.mkv)
else
    echo "not tested: films, because FFmpeg is missing"
fi

# ---- killed repeatedly at random instants: every file under a final name is complete, and none is lost
start_sequence() {
    rm -f stats.jsonl
    start "${film[@]}" --size 96x72 --samples 2 --depth 6 --quiet --stats stats.jsonl -o 'killed/%02d.png'
}

expect_whole() {
    local name
    for name in $(cd killed && ls); do
        [[ $name == *.tmp-* || $name == *.part-* ]] || expect_same "killed/$name" "undisturbed/$name"
    done
}

# A line comes after its frame has its name: that frame must never be rendered again.
note_rendered() {
    local twice
    if [[ -f stats.jsonl ]]; then
        sed -n -E 's/^\{"frame":([0-9]+),"backend".*\}$/\1/p' stats.jsonl >>rendered
    fi
    twice=$(sort rendered | uniq -d | tr '\n' ' ')
    [[ -z $twice ]] || fail "frames were rendered twice: $twice"
}

lose_frames() { # about half of them: something must remain to do
    local i
    for ((i = 0; i < frames; i++)); do
        if ((RANDOM % 2)); then
            rm "killed/$(printf '%02d' "$i").png"
            sed -i "/^$i\$/d" rendered
        fi
    done
}

begin=${EPOCHREALTIME//[.,]/}
start_sequence
expect_end 0
duration=$((${EPOCHREALTIME//[.,]/} - begin)) # microseconds
mv killed undisturbed
mkdir killed
: >rendered
killed=0
for ((attempt = 0; killed < kills && attempt < 100 * (kills + 1); attempt++)); do
    start_sequence
    sleep "$(printf '0.%06d' "$(((RANDOM << 15 | RANDOM) % (2 * duration / 3)))")"
    kill -KILL "$pid" 2>/dev/null || true
    code=0
    wait "$pid" 2>/dev/null || code=$?
    note_rendered
    expect_whole
    if ((code == 128 + 9)); then
        killed=$((killed + 1))
        echo "kill $killed: $(find killed -name '*.png' | wc -l) of $frames frames are there"
    elif ((code == 0)); then
        lose_frames
    else
        fail "exit code $code, expected to be killed or 0"
    fi
done
((killed == kills)) || fail "killed only $killed times of $kills"
start_sequence
expect_end 0
note_rendered
expect_whole

# An FFmpeg whose hedron was killed may end, and make its file, only now.
is_clean() {
    start_sequence
    wait "$pid"
    [[ $(cd killed && ls) == "$(cd undisturbed && ls)" ]]
}
wait_for 'the same files' is_clean

finish
