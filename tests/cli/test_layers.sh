#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Alpha and the layers of OpenEXR: the channels, their values, and the same bytes from every backend.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=${2:?the build folder is the second argument}
cat >"$work/scene.json" <<'END'
{
  "hedron": 1,
  "image": {"width": 50, "height": 34, "samples": 3, "depth": 3},
  "camera": {"field_of_view": 60, "eye": [4, -4, 2.5], "target": [0.3, 0, 0]},
  "background": [0.125, 0.25, 0.5],
  "materials": {"a": {"diffuse": 0.7, "reflection": 0.2}},
  "solids": [{"kind": "cube", "circumradius": 1, "material": "a"},
             {"kind": "icosahedron", "centre": [1.5, 1.5, 0.4], "circumradius": 0.9, "material": "a"}],
  "lights": [{"position": [3, -4, 5]}],
  "floor": {"corners": [[-2, 2, -1], [2, 2, -1], [2, -2, -1], [-2, -2, -1]], "material": "a"}
}
END
# A reader of our own: channels by their names, as (type, rows of values).
cat >"$work/exr.py" <<'END'
import json, math, struct, sys, zlib

def unpack(packed, size):
    if len(packed) == size:
        return packed
    bytes_ = bytearray(zlib.decompress(packed))
    for i in range(1, size):
        bytes_[i] = (bytes_[i - 1] + bytes_[i] - 128) & 255
    out = bytearray(size)
    out[0::2], out[1::2] = bytes_[:(size + 1) // 2], bytes_[(size + 1) // 2:]
    return bytes(out)

def read(path):
    data, attributes, at = open(path, "rb").read(), {}, 8
    while data[at]:
        name, kind, rest = data[at:].split(b"\0", 2)
        size, = struct.unpack_from("<i", rest)
        attributes[name.decode()] = rest[4:4 + size]
        at += len(name) + len(kind) + size + 6
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    assert attributes["compression"] == b"\3"
    channels, place, listed = {}, 0, attributes["channels"]
    while listed[place]:
        name = listed[place:listed.index(b"\0", place)]
        channels[name.decode()] = "Ihf"[listed[place + len(name) + 1]], []
        place += len(name) + 17
    line = sum(width * (2 if kind == "h" else 4) for kind, _ in channels.values())
    for offset in struct.unpack_from("<%dQ" % ((height + 15) // 16), data, at + 1):
        y, size = struct.unpack_from("<2i", data, offset)
        lines = min(16, top + height - y)
        pixels, here = unpack(data[offset + 8:offset + 8 + size], line * lines), 0
        for _ in range(lines):
            for kind, rows in channels.values():
                code = {"h": "e", "f": "f"}[kind]
                rows.append(struct.unpack_from("<%d%s" % (width, code), pixels, here))
                here += width * struct.calcsize(code)
    return channels

def flat(channels, name):
    return [value for row in channels[name][1] for value in row]
END
# expect_exr FILE EXPRESSION: true of c, the file's channels, and of what(NAME), all values of one.
expect_exr() {
    if ! PYTHONPATH=$work python3 - "$1" "$2" <<'END'
from exr import *
c = read(sys.argv[1])
sys.exit(not eval(sys.argv[2], dict(globals(), c=c, what=lambda name: flat(c, name))))
END
    then
        fail "$1 is not so: $2"
    fi
}

render=("$hedron" render "$work/scene.json" --quiet)
expect_exit 0 "${render[@]}" --backend c -o plain.exr -o plain.pfm
if [[ ! -s plain.exr ]]; then
    skip "this build has no OpenEXR"
fi

# ---- channels: colour and coverage in the requested bits, all others in float
expect_exr plain.exr '{n: t for n, (t, _) in c.items()} == {"A": "h", "B": "h", "G": "h", "R": "h"}'
all=depth,normal,object
expect_exit 0 "${render[@]}" --backend c --layers "$all" -o all.exr
expect_exr all.exr '{n for n, (t, _) in c.items() if t == "h"} == set("RGBA")'
expect_exr all.exr '{n for n, (t, _) in c.items() if t == "f"} == {"Z", "normal.X", "normal.Y", "normal.Z", "object"}'
expect_exit 0 "${render[@]}" --backend c --layers object --set output.bits=32 -o some.exr
expect_exr some.exr '{n: t for n, (t, _) in c.items()} == dict.fromkeys(("A", "B", "G", "R", "object"), "f")'

# ---- values
expect_exr all.exr 'set(what("object")) == {0, 1, 2, 3}'
# The floor lies 3.5 below the eye and faces up; its farthest corner is 2 * sqrt(18) + sqrt(2) away along the ground.
expect_exr all.exr 'all((z == math.inf) == (o == 0) and z > 2 and abs(math.hypot(*n) - (o > 0)) < 1e-6
    and (o != 3 or 3.5 < z < math.hypot(3.5, math.hypot(6, 6)) and abs(n[2] - 1) < 1e-6)
    for z, o, *n in zip(*map(what, ("Z", "object", "normal.X", "normal.Y", "normal.Z"))))'
# Coverage comes in ninths. At 0 the colour is the background's, and only there and in part in between.
expect_exr all.exr 'len(set(what("A"))) == 10 and all(abs(a * 9 - round(a * 9)) < 0.01 and
    (o == 0 and rgb == [0.125, 0.25, 0.5] if a == 0 else a < 1 or o > 0) for a, o, *rgb in zip(*map(what, ("A", "object", *"RGB"))))'
# With triangles the same things have the same numbers.
expect_exit 0 "${render[@]}" --backend c --layers "$all" --geometry triangles -o triangles.exr
expect_exit 0 "$hedron" compare --json all.exr triangles.exr
expect_output_json '{c["name"]: c["largest"] for c in j["channels"]}["object"] == 0'
expect_output_json '0 < {c["name"]: c["largest"] for c in j["channels"]}["Z"] < 1e-4'
# A part of the picture has the layers of that part.
expect_exit 0 "${render[@]}" --backend c --layers "$all" --crop 20x11+26+17 -o part.exr
expect_exr part.exr 'all(c[name][1] == [row[26:46] for row in read("all.exr")[name][1][17:28]] for name in c)'

# ---- an error bound: the truncation of pixels agrees with the statistics
bounded=("${render[@]}" --max-error 1.5 --samples 4 --layers "$all,bound")
expect_exit 0 "${bounded[@]}" --backend c -o bounded.exr --stats lines.jsonl
expect_exr bounded.exr '(lambda line, bound: 0 < bound <= 1.5 and abs(bound - line["missing"]["largest"]) < 1e-6)(
    json.load(open("lines.jsonl")), max(what("bound")))'
expect_exit 0 "${render[@]}" --samples 4 --layers depth,normal,object -o plain.exr
expect_exit 0 "$hedron" compare --json bounded.exr plain.exr
expect_output_json 'len(j["channels"]) == 6 and all(c["largest"] == 0 for c in j["channels"])'
# ---- the same bytes from every backend
expect_exit 0 "${render[@]}" --backend c --lanes 1 --threads 1 --pipeline wavefront --layers "$all" -o other.exr
expect_same all.exr other.exr
if has_opencl; then
    expect_exit 0 "${render[@]}" --backend opencl --layers "$all" -o other.exr
    expect_same all.exr other.exr
    expect_exit 0 "${bounded[@]}" --backend opencl -o other.exr
    expect_same bounded.exr other.exr
fi
if [[ -e $build/tests/fake_cuda/libnvrtc.so.12 ]]; then
    fake=(env "LD_LIBRARY_PATH=$build/tests/fake_cuda" "HEDRON_NVRTC=$build/tests/fake_cuda/libnvrtc.so.12")
    for pipeline in mega wavefront; do
        expect_exit 0 "${fake[@]}" "${render[@]}" --backend cuda --pipeline $pipeline --layers "$all" -o other.exr
        expect_silent_stderr
        expect_same all.exr other.exr
    done
    expect_exit 0 "${fake[@]}" "${bounded[@]}" --backend cuda -o other.exr
    expect_same bounded.exr other.exr
    # Frames in flight keep their own layers.
    still=("${render[@]}" --set camera.frames=3 --set 'camera.eye={"r0": 5, "z0": 2, "phi_frequency": 1}' --layers "$all")
    expect_exit 0 "${still[@]}" --backend c -o c/%d.exr
    expect_exit 0 "${fake[@]}" "${still[@]}" --backend cuda -o cuda/%d.exr
    expect_same <(cat c/*) <(cat cuda/*)
    rm -r c cuda
fi

# ---- compare names the channel that differs most
expect_exit 0 "${render[@]}" --backend c --layers "$all" --set 'solids[1].centre=[1.5, 1.5, 0.65]' -o moved.exr
expect_exit 0 "$hedron" compare --json all.exr moved.exr
expect_output_json 'j["most_different"] == "Z" and not j["identical"]'
expect_output_json '[c["largest"] for c in j["channels"] if c["name"] == "Z"] == [None]'
expect_exit 0 "$hedron" compare all.exr some.exr
expect_stdout_contains 'normal.X             only in the first'
python3 -c 'import sys; sys.stdout.buffer.write(open("all.exr", "rb").read().replace(b"object\0", b"obje\x1bt\0"))' >odd.exr
expect_exit 0 "$hedron" compare all.exr odd.exr
expect_stdout_contains 'obje\u001bt'

# ---- refused combinations
expect_refusal 2 "${render[@]}" --layers depth -o a.png
expect_stderr_contains '--layers is for OpenEXR: expected an output that ends in .exr'
expect_refusal 2 "${render[@]}" --layers depth,colour -o a.exr
expect_stderr_contains "--layers has 'colour', expected some of depth, normal, object or bound, separated by commas"
expect_refusal 2 "${render[@]}" --layers depth,object,depth -o a.exr
expect_stderr_contains '--layers has depth twice'
expect_refusal 2 "${render[@]}" --layers depth,bound -o a.exr
expect_stderr_contains 'bound, expected --max-error or --reference with it'
expect_refusal 2 "${render[@]}" --layers= -o a.exr

rm -f ./*.exr plain.pfm lines.jsonl
expect_files .
finish
