#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# 'hedron render': single pictures, sequences and films.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

render() {
    expect_exit 0 "$hedron" render --quiet --backend c --samples 1 --depth 2 "$@"
    expect_silent_stderr
}

# ---- a single picture
render --size 32x24 --frames 0 -o picture.png
expect_stdout_lines 1 'picture\.png'
expect_png picture.png 32 24
render --size 33x25 --frames 0 --output=odd.PNG
expect_png odd.PNG 33 25
render --size 32x24 --frames 0 -o picture.data
expect_data picture.data 32 24
render --size 32x24 --frames 0 -o new/folders/picture.data
expect_same picture.data new/folders/picture.data
# shellcheck disable=SC2088 # the program itself is to replace the tilde
render --size 32x24 --frames 0 -o '~/picture.data'
expect_same picture.data "$HOME/picture.data"
render --size 32x24 --frames 0 -o -dash.data
expect_same picture.data ./-dash.data
printf 'old' >old.data
render --size 32x24 --frames 0 -o old.data
expect_same picture.data old.data
(($(tail -c +9 old.data | od -A n -v -t x4 -w4 | sort -u | wc -l) >= 50)) || fail 'the picture has fewer than 50 colours'
expect_files . -dash.data new new/folders new/folders/picture.data odd.PNG old.data picture.data picture.png
rm -rf ./*

# ---- a sequence
render --size 32x24 --frames 0-2,10 -o 'out/%04d.png'
expect_stdout_lines 1
expect_files out 0000.png 0001.png 0002.png 0010.png
for file in out/*; do
    expect_png "$file" 32 24
done
expect_different out/0000.png out/0001.png
render --size 32x24 --frames 1 -o alone_%d.png
expect_same out/0001.png alone_1.png
rm -rf ./*
render --size 32x24 --frames 0,10 -o '#1/take %02d/a.data'
expect_files '#1' 'take 00' 'take 00/a.data' 'take 10' 'take 10/a.data'
expect_data '#1/take 10/a.data' 32 24
rm -rf ./*

# ---- backends, pipelines, lanes and threads, selected by options, give the same bytes; fast arithmetic nearly
# picture NAME OPTION...: with sides that are no multiple of anything.
picture() {
    expect_exit 0 "${no_nvidia[@]}" "$hedron" render --quiet --size 33x25 --samples 2 --depth 3 --frames 40 -o "$@"
    expect_silent_stderr
}
picture float.data --backend c --lanes 1 --threads 1
ways=('' '--math strict --precision float' '--backend c --math fast --threads 2' '--backend c --pipeline wavefront --threads 3'
    '--backend c --pipeline wavefront-uncompacted' "--backend c --lanes $(lanes_there float | tail -n 1)")
! has_opencl || ways+=('--backend opencl' '--backend opencl --threads 1 --pipeline wavefront')
for options in "${ways[@]}"; do
    # shellcheck disable=SC2086 # options and their values
    picture other.data $options
    expect_same other.data float.data
done
picture float.png --backend c
picture double.png --backend c --precision double
expect_exit 0 "$hedron" compare float.png double.png --fail-above 3
if has_opencl; then
    picture other.png --backend opencl --precision double
    expect_exit 0 "$hedron" compare other.png double.png --fail-above 0
    picture fast.png --backend opencl --math fast
    expect_exit 0 "$hedron" compare float.png fast.png --fail-above 32 # of four samples one may hit another edge
else
    echo "not tested: OpenCL, because no device has strict arithmetic"
fi
expect_exit 0 "$hedron" render --backend c "${small[@]}" --frames 0 --math fast -o fast.data
expect_stderr_contains 'the C backend has only strict arithmetic, so --math fast has no effect on it'
rm ./*.*

# ---- a picture describes its content, and not its place or time of rendering
texts() { # FILE: the chunks of a PNG except its fingerprint, a line each
    python3 - "$1" <<'PYTHON'
import struct, sys
data = open(sys.argv[1], "rb").read()
at = 8
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at:at + 8])
    if kind == b"iTXt":
        keyword, rest = data[at + 8:at + 8 + size].split(b"\0", 1)
        print(keyword.decode("latin-1"), rest[4:].decode("utf-8"), sep=": ")
    at += 12 + size
PYTHON
}

mkdir 'a b'
"$hedron" new "$PWD/a b/lämp.json" >"$logs/new"
expected="Software: $("$hedron" --version)
Scene: lämp.json
Frame: 3
Options: --set output.bits=16 --size 32x24 --samples 1 --aa grid --max-error 0.5"
options=(--frames 2-3 --size 32x24 --samples 1 --quiet --aa grid --max-error 0.5 --set output.bits=16)
expect_exit 0 "$hedron" render --backend c --lanes 1 --threads 1 "a b/lämp.json" -o 'one/%d.png' "${options[@]}"
cp "a b/lämp.json" .
expect_exit 0 "$hedron" render lämp.json --backend c --lanes 4 --threads 2 -o 'two/###.png' "${options[@]}" --frames 3
expect_same one/3.png two/003.png
if command -v python3 >"$logs/which"; then
    expect_same <(texts one/3.png) - <<<"$expected"
    expect_exit 0 "$hedron" render --backend c --size 32x24 --frames 0 -o plain.png
    [[ $'\n'$(texts plain.png)$'\n' == *$'\nScene: the built-in scene\n'* ]] || fail 'the built-in scene is not named'
else
    echo "not tested: the texts of a PNG, because python3 is missing"
fi
rm -rf ./*

# ---- several outputs of one run; messages have the names as given
render --size 32x24 --frames 0-1 -o 'out/%04d.png' --output='out/##.data'
expect_stdout_lines 2 'out/(%04d\.png|##\.data)'
expect_files out 0000.png 0001.png 00.data 01.data
rm -rf ./*

# ---- pictures of one scene hold the same pixels in all formats
render --size 33x25 --frames 3 -o picture.png -o picture.pfm
expect_exit 0 "$hedron" compare picture.png picture.pfm --fail-above 0.5
rm picture.*

# ---- without a name
render --size 32x24 --frames 7
expect_stdout_lines 1 'hedron\.png'
expect_png hedron.png 32 24
rm hedron.png

# ---- films; tests/unit/output/test_video.c checks their contents
if ! has_ffmpeg; then
    echo "not tested: films, because FFmpeg is missing"
    expect_files .
    finish
fi

expect_film() { # FILE FRAMES WIDTH HEIGHT
    local found
    found=$(ffprobe -v error -select_streams v:0 -count_frames -of csv=p=0 -show_entries \
        stream=nb_read_frames,width,height,pix_fmt,codec_name,r_frame_rate "$1" 2>&1 || true)
    [[ $found == "h264,$3,$4,yuv420p,30/1,$2" ]] || fail "the film $1 has '$found', expected h264,$3,$4,yuv420p,30/1,$2"
}

# H.264 with 4:2:0 needs even sides.
render --size 33x25 --frames 0-2 -o new/odd.MP4
expect_stdout_lines 1 'new/odd\.MP4'
expect_film new/odd.MP4 3 34 26
render --size 32x24 --frames 0,7
expect_stdout_lines 1 'hedron\.mp4'
expect_film hedron.mp4 2 32 24
expect_files . hedron.mp4 new new/odd.MP4
# Films and pictures at once; a film that fails keeps the pictures.
render --size 32x24 --frames 0-1 -o "it's.mp4" -o both.mkv -o both_%d.data -o both_%d.png
expect_stdout_lines 4
expect_film "it's.mp4" 2 32 24
expect_files . both.mkv "it's.mp4" both_{0,1}.{data,png} hedron.mp4 new new/odd.MP4
tail -q -c +9 both_?.data >frames.rgba
for name in both.mkv both_%d.png; do # all of the same pixels
    ffmpeg -nostdin -v error -i "$name" -f rawvideo -pix_fmt rgba -y film.rgba
    expect_same film.rgba frames.rgba
done
expect_exit 1 "$hedron" render --backend c "${small[@]}" --frames 0-1 -o bad_%d.data -o bad.gif -o hedron.mp4/x.mkv
expect_sentence
expect_stdout_lines 0
! compgen -G 'bad*' >"$logs/which" || fail "there stays $(<"$logs/which")"

finish
