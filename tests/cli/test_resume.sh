#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A sequence that is started again renders what is missing and nothing else; also when it was killed.
# A third argument says how often: tests/cli/test_resume.sh build/release/hedron build/release 25
# shellcheck disable=SC2317 # wait_until calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

kills=${3:-5}
frames=40
has_ffmpeg=0
if command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null; then
    has_ffmpeg=1
fi

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

# render COUNT OPTIONS...: of the frames 0 to 9, so many are rendered and the others left as they are.
render() {
    local expected=$1 rendered resumed
    shift
    rm -f stats.jsonl
    expect_exit 0 "$hedron" render --backend c --frames 0-9 --stats stats.jsonl "$@"
    rendered=$(grep -c '"backend"' stats.jsonl || true)
    resumed=$(grep -c -x -E '\{"frame":[0-9],"resumed":true\}' stats.jsonl || true)
    if ((rendered != expected || resumed != 10 - expected)); then
        fail "$rendered frames were rendered and $resumed resumed, expected $expected and the rest"
        show_logs
    fi
    if ((expected < 10)) && [[ " $* " != *" --quiet "* ]]; then
        expect_stderr_contains "hedron: $((10 - expected)) of 10 frames were finished already"
    elif grep -q finished "$logs/stderr"; then
        fail 'frames are said to be finished'
    fi
}

# Inode and time of change, by which a file that is written again differs from one that is left.
look_of() {
    stat -c '%n %i %y' "$@"
}

# ---- what is there is left alone, and what is missing or damaged is not
render 10 scene.json -o 'out/%d.png'
mkdir first
cp out/*.png first
looks=$(look_of out/*)
render 0 scene.json -o 'out/%d.png'
expect_stdout_lines 1 'out/%d\.png'
render 0 --quiet scene.json -o 'out/%d.png'
expect_silent_stderr
# No device is needed for nothing.
expect_exit 3 "${no_nvidia[@]}" "$hedron" render --backend cuda scene.json --frames 10 -o 'out/%d.png'
expect_exit 0 "${no_nvidia[@]}" "$hedron" render --backend cuda scene.json --frames 3-5 -o 'out/#.png'
# Nor does it matter how it would be rendered.
render 0 scene.json -o 'out/%d.png' --lanes 1 --threads 1 --pipeline wavefront
if [[ $(look_of out/*) != "$looks" ]]; then
    fail 'finished pictures were written again'
fi
rm out/3.png
printf 'x' >>out/0.png
truncate -s -1 out/9.png
cp out/1.png out/2.png
touch out/3.png.tmp-4000000-0 # as a run leaves it that was killed
render 4 scene.json -o 'out/%d.png'
expect_files out {0..9}.png
for i in {0..9}; do
    expect_same "out/$i.png" "first/$i.png"
done

# ---- whatever decides a pixel is in the fingerprint, and names are not
for variant in '--depth 3' '--set materials.plain.diffuse=0.25' '--set output.curve=linear' \
    '--set output.bits=16' '--precision double' '--crop 8x8+3+2' '--geometry triangles' '--accel brute' \
    '--aa adaptive' '--max-error 9' '--set camera.frames=41'; do
    rm -r out
    cp -r first out
    # shellcheck disable=SC2086 # an option and its value
    render 10 scene.json -o 'out/%d.png' $variant
    # shellcheck disable=SC2086
    render 0 scene.json -o 'out/%d.png' $variant
done
rm -r out
cp -r first out
cp floor.data other.data
sed 's/floor\.data/other.data/' scene.json >other.json
render 0 other.json -o 'out/%d.png' --set output.frames_per_second=25
printf '\100' | dd of=floor.data bs=1 seek=8 conv=notrunc status=none
render 10 scene.json -o 'out/%d.png'

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
    if [[ $(sources_hash "$PWD/b") != "$hash" ]]; then
        fail 'the hash of the sources depends on their place'
    fi
    for file in "${sources[@]}"; do
        echo other >"b/$file"
        if [[ $(sources_hash "$PWD/b") == "$hash" ]]; then
            fail "$file is not in the hash of the sources"
        fi
        echo text >"b/$file"
    done
fi

# ---- what is always rendered
render 10 scene.json -o 'out/%d.png' --again
render 10 scene.json -o 'out/%d.png' -o 'out/%d.pfm'
rm out/*.pfm
render 10 scene.json -o 'fast/%d.png' --math fast
render 10 scene.json -o 'fast/%d.png' --math fast
render 10 scene.json -o 'fast/%d.png'
expect_exit 0 "$hedron" render --backend c --frames 3 scene.json -o 3.png --stats stats.jsonl
expect_exit 0 "$hedron" render --backend c --frames 3 scene.json -o 3.png --stats stats.jsonl
if grep -q finished "$logs/stderr" || ! grep -q backend stats.jsonl; then
    fail 'a picture without a number was taken for finished'
fi
use_official_input
sed '2s|.*|out/%d.png|' "$work/official.in" >sequence.in
for _ in 1 2; do
    expect_exit 0 "$hedron" --cpu --quiet --size 32x24 --frames 0-2 <sequence.in
    expect_stdout_lines 3
done

# The pictures of a film, whatever else is in its file.
film_frames() {
    ffmpeg -nostdin -v error -i "$1" -f framemd5 - | sed -n 's/.*, *//p'
}

# expect_same_film FILM OTHER
expect_same_film() {
    if [[ $(film_frames "$1") != "$(film_frames "$2")" ]]; then
        fail "the films $1 and $2 have different frames"
    fi
}

# ---- films are made of the finished frames
if ((has_ffmpeg)); then
    rm -r out
    render 10 scene.json -o 'out/%d.png' -o fresh.mkv
    render 0 scene.json -o 'out/%d.png' -o all.mkv
    expect_same_film fresh.mkv all.mkv
    rm out/0.png out/4.png out/5.png out/9.png
    render 4 scene.json -o 'out/%d.png' -o some.mkv
    expect_same_film fresh.mkv some.mkv
    render 10 scene.json -o 'out/%d.png' -o deep.mkv --set output.bits=16
    render 10 scene.json -o 'out/%d.png' -o deep.mkv --set output.bits=16
    expect_same_film fresh.mkv deep.mkv
fi

# ---- held by an FFmpeg that takes nothing, and then killed or interrupted
has_temporary() {
    compgen -G 'held/*.tmp-*' >"$logs/which"
}

if ((has_ffmpeg)); then
    mkdir "$work/tools"
    printf '#!%s\necho $$ >"%s/leader.new"; mv "%s/leader.new" "%s/leader"; exec sleep 600\n' \
        "$(command -v bash)" "$work" "$work" "$work" >"$work/tools/ffmpeg"
    chmod +x "$work/tools/ffmpeg"
    held=("$hedron" render --backend c --quiet --size 400x300 --samples 1 --depth 0 --frames 0-9 -o 'held/%d.png')

    start env PATH="$work/tools:$PATH" "${held[@]}" -o held/film.mkv
    if ! wait_until 120 has_temporary || ! wait_until 120 test -e "$work/leader"; then
        fail 'no frame was begun'
        show_logs
    fi
    kill -KILL "$pid" "$(<"$work/leader")"
    expect_end 137
    if ! has_temporary || [[ -e held/0.png ]]; then
        fail 'the first frame has its name before the film has it, or nothing is left of it'
    fi
    expect_exit 0 "${held[@]}" -o held/film.mkv
    expect_files held {0..9}.png film.mkv

    # The film of finished frames.
    rm "$work/leader"
    start env PATH="$work/tools:$PATH" "${held[@]}" -o held/other.mkv
    if ! wait_until 120 test -e "$work/leader"; then
        fail 'no film was begun'
    fi
    kill -INT "$pid"
    expect_end 130
    expect_sentence
    expect_stderr_contains interrupted
    expect_files held {0..9}.png film.mkv
fi

# ---- killed again and again
start_sequence() {
    local films=()
    if ((has_ffmpeg)); then
        films=(-o killed/film.mkv)
    fi
    rm -f stats.jsonl
    "$hedron" render --backend c --quiet --size 160x120 --samples 2 --depth 8 --frames "0-$((frames - 1))" \
        --stats stats.jsonl -o 'killed/%02d.png' "${films[@]}" >"$logs/stdout" 2>"$logs/stderr" &
    pid=$!
}

milliseconds() {
    echo $(($(date +%s%N) / 1000000))
}

# random LIMIT: 0 .. LIMIT - 1
random() {
    echo $(((RANDOM << 15 | RANDOM) % $1))
}

# A pause of 0 to LIMIT milliseconds.
pause_up_to() {
    local pause
    pause=$(random $(($1 + 1)))
    sleep "$((pause / 1000)).$(printf '%03d' $((pause % 1000)))"
}

# Nothing under a final name is incomplete.
expect_whole() {
    local name
    for name in $(cd killed && ls); do
        case $name in
        *.tmp-* | *.part-*) ;; # a film has them until it is joined
        film.mkv) expect_same_film killed/film.mkv undisturbed/film.mkv ;;
        *) expect_same "killed/$name" "undisturbed/$name" ;;
        esac
    done
}

# A line comes after its frame has its name: that frame must never be rendered again.
note_rendered() {
    local twice
    if [[ -f stats.jsonl ]]; then
        sed -n -E 's/^\{"frame":([0-9]+),"backend".*\}$/\1/p' stats.jsonl >>rendered
    fi
    twice=$(sort rendered | uniq -d | tr '\n' ' ')
    if [[ -n $twice ]]; then
        fail "frames were rendered twice: $twice"
        sort -u -o rendered rendered
    fi
}

# There must be something left to do: about half of the frames go.
lose_frames() {
    local i
    echo 'finished; some frames are taken away again'
    for ((i = 0; i < frames; i++)); do
        if (($(random 2))); then
            rm "killed/$(printf '%02d' "$i").png"
            sed -i "/^$i\$/d" rendered
        fi
    done
}

begin=$(milliseconds)
start_sequence
expect_end 0 600
duration=$(($(milliseconds) - begin))
mv killed undisturbed
mkdir killed
: >rendered

killed=0
for ((attempt = 0; killed < kills && attempt < 100 * (kills + 1); attempt++)); do
    start_sequence
    pause_up_to $((2 * duration / 3))
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
        show_logs
    fi
done
if ((killed < kills)); then
    fail "killed only $killed times of $kills"
fi
start_sequence
expect_end 0 600
note_rendered
expect_whole
for ((i = 0; i < frames; i++)); do
    expect_same "killed/$(printf '%02d' "$i").png" "undisturbed/$(printf '%02d' "$i").png"
done

# An FFmpeg whose hedron was killed may end, and make its file, only now.
is_clean() {
    start_sequence
    wait "$pid"
    [[ $(cd killed && ls) == "$(cd undisturbed && ls)" ]]
}
if ! wait_until 60 is_clean; then
    fail "there are other files: $(cd killed && echo ./*)"
fi

finish
