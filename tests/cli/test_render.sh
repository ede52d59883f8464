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
expect_files . out out/0000.png out/0001.png out/0002.png out/0010.png alone_1.png
rm -rf ./*
render --size 32x24 --frames 0,10 -o 'take ##/a.data'
expect_files . 'take 00' 'take 00/a.data' 'take 10' 'take 10/a.data'
expect_data 'take 10/a.data' 32 24
rm -rf ./*
for name in '#_##.data' '##########.data'; do
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0 -o "$name"
    expect_stderr_contains "$name"
done
expect_files .

# ---- a picture says what it is, and not where or when it was made
# texts FILE: the texts of a PNG but for its mark, a line each.
texts() {
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
Options: --set output.bits=16 --size 32x24 --samples 1 --aa adaptive --max-error 0.5"
options=(--frames 2-3 --size 32x24 --samples 1 --quiet --aa adaptive --max-error 0.5 --set output.bits=16)
expect_exit 0 "$hedron" render --backend c --lanes 1 --threads 1 "a b/lämp.json" -o 'one/%d.png' "${options[@]}"
cp "a b/lämp.json" .
expect_exit 0 "$hedron" render lämp.json --backend c --lanes 4 --threads 2 -o 'two/###.png' "${options[@]}" --frames 3
expect_same one/3.png two/003.png
if has_opencl; then
    expect_exit 0 "$hedron" render lämp.json --backend opencl -o 'three_#.png' "${options[@]}" --frames 3
    expect_same one/3.png three_3.png
fi
if command -v python3 >"$logs/which"; then
    expect_same <(texts one/3.png) - <<<"$expected"
    expect_exit 0 "$hedron" render --backend c --size 32x24 --frames 0 -o plain.png
    expect_same <(texts plain.png) - <<<"Software: $("$hedron" --version)
Scene: the built-in scene
Frame: 0
Options: --size 32x24"
else
    echo "not tested: the texts of a PNG, for there is no python3"
fi
rm -rf ./*

# ---- several outputs of one run; the names are told as they were given
render --size 32x24 --frames 0-1 -o 'out/%04d.png' --output='out/##.data'
expect_stdout_lines 2 'out/(%04d\.png|##\.data)'
expect_files out 0000.png 0001.png 00.data 01.data
render --size 32x24 --frames 1 -o alone.data
expect_same alone.data out/01.data
rm -rf ./*
expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0-1 -o 'a_%d.png' -o b.png
expect_stderr_contains b.png
expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0 -o a.png -o b.png -o a.png
expect_stderr_contains "'a.png' is there twice"
expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0 \
    -o 1.png -o 2.png -o 3.png -o 4.png -o 5.png -o 6.png -o 7.png -o 8.png -o 9.png
expect_stderr_contains "'9.png'"
expect_files .

# ---- one name for several frames
for name in picture.png picture.data; do
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0-2 -o "$name"
    expect_stderr_contains "$name"
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" -o "$name"
done
expect_files .

# A film has no number.
for name in film_%d.mp4 '###.mkv' '#/film.gif'; do
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0-2 -o "$name"
    expect_stderr_contains "$name"
done
expect_files .

# ---- films
if ! command -v ffmpeg >"$logs/which" || ! command -v ffprobe >"$logs/which"; then
    if ((failures > 0)); then
        finish
    fi
    skip "the films, for there is no FFmpeg"
fi

# film_says FIELD FILE
film_says() {
    ffprobe -v error -select_streams v:0 -count_frames -show_entries "stream=$1" -of csv=p=0 "$2"
}

# expect_film FILE FRAMES WIDTH HEIGHT
expect_film() {
    local found
    found=$(film_says nb_read_frames,width,height,pix_fmt,codec_name,r_frame_rate "$1" 2>&1 || true)
    if [[ $found != "h264,$3,$4,yuv420p,30/1,$2" ]]; then
        fail "the film $1 has '$found', expected 'h264,$3,$4,yuv420p,30/1,$2'"
    fi
    if ! ffmpeg -nostdin -v error -xerror -i "$1" -f null - 2>"$logs/ffmpeg" || [[ -s $logs/ffmpeg ]]; then
        fail "FFmpeg cannot decode the film $1: $(head -c 300 "$logs/ffmpeg")"
    fi
}

render --size 32x24 --frames 0-2 -o film.mp4
expect_stdout_lines 1 'film\.mp4'
expect_film film.mp4 3 32 24
expect_files . film.mp4
# H.264 with 4:2:0 needs even sides.
render --size 33x25 --frames 0-2 -o new/odd.MP4
expect_film new/odd.MP4 3 34 26
expect_files . film.mp4 new new/odd.MP4
render --size 1x1 --frames 5 -o new/odd.MP4
expect_film new/odd.MP4 1 2 2
# Without a name.
render --size 32x24 --frames 0,7
expect_stdout_lines 1 'hedron\.mp4'
expect_film hedron.mp4 2 32 24
render --size 32x24 --frames 7
expect_stdout_lines 1 'hedron\.png'
expect_png hedron.png 32 24
rm hedron.png
# Films and pictures at once; a film that fails takes no pictures with it.
render --size 32x24 --frames 0-1 -o both.mp4 -o both.mkv -o both_%d.data
expect_stdout_lines 3
expect_film both.mp4 2 32 24
expect_files . both.mkv both.mp4 both_0.data both_1.data film.mp4 hedron.mp4 new new/odd.MP4
expect_exit 1 "$hedron" render --backend c "${small[@]}" --frames 0-1 -o bad_%d.data -o bad.gif \
    -o film.mp4/x.mkv
expect_sentence
expect_stdout_lines 0
expect_files . both.mkv both.mp4 both_0.data both_1.data film.mp4 hedron.mp4 new new/odd.MP4
rm both*
# Names that FFmpeg would take for something else.
for name in -film.mp4 'a b.mp4' 'pipe:1.mp4' '50%.mp4' "it's.mp4"; do
    render --size 32x24 --frames 0 -o "$name"
    expect_film "file:$name" 1 32 24
done
expect_files . -film.mp4 '50%.mp4' 'a b.mp4' "it's.mp4" film.mp4 hedron.mp4 new new/odd.MP4 'pipe:1.mp4'
rm -rf ./*

# The lossless film has the frames' bytes, and the GIF as many frames.
render --size 33x25 --frames 3-5 -o film.mkv
expect_stdout_lines 1 'film\.mkv'
render --size 33x25 --frames 3-5 -o '###.data'
for number in 003 004 005; do
    tail -c +9 "$number.data"
done >frames.rgba
ffmpeg -nostdin -v error -i film.mkv -f rawvideo -pix_fmt rgba film.rgba
expect_same film.rgba frames.rgba
render --size 33x25 --frames 3-5 -o film.gif
found=$(film_says codec_name,width,height,nb_read_frames film.gif)
if [[ $found != gif,33,25,3 ]]; then
    fail "film.gif has '$found', expected 'gif,33,25,3'"
fi
rm -rf ./*

# PFM has the values themselves.
render --size 33x25 --frames 3 -o picture.pfm
if [[ $(head -c 14 picture.pfm) != $'PF\n33 25\n-1.0' ]] ||
    (($(stat -c %s picture.pfm) != 14 + 33 * 25 * 12)); then
    fail "picture.pfm is no PFM of 33 x 25 pixels"
fi
rm picture.pfm

# Pictures of one scene in the two formats hold the same pixels.
for kind in png data; do
    render --size 33x25 --frames 3 -o "picture.$kind"
done
ffmpeg -nostdin -v error -i picture.png -f rawvideo -pix_fmt rgb24 png.rgb
tail -c +9 picture.data >rgba
ffmpeg -nostdin -v error -f rawvideo -pix_fmt rgba -s 33x25 -i rgba -f rawvideo -pix_fmt rgb24 data.rgb
expect_same png.rgb data.rgb
if (($(stat -c %s png.rgb) != 33 * 25 * 3)); then
    fail "the pixels of the picture are $(stat -c %s png.rgb) bytes"
fi

finish
