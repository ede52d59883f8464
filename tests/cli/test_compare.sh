#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# 'hedron compare': figures, exit codes, JSON, the heat map, and pictures that cannot be compared.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need_python

# Writes pictures: png(NAME, ROWS...) and pfm(NAME, ROWS...); a row is a list of (r, g, b).
cat >"$work/pictures.py" <<'PYTHON'
import struct
import zlib


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(name, *rows, srgb=True, interlace=0):
    lines = b"".join(b"\0" + bytes(value for p in row for value in p) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, interlace)
    with open(name, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head))
        file.write(chunk(b"sRGB", b"\0") if srgb else b"")
        file.write(chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


def pfm(name, *rows):
    with open(name, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (len(rows[0]), len(rows)))
        for row in reversed(rows):
            file.write(b"".join(struct.pack("<3f", *p) for p in row))
PYTHON
pictures() {
    PYTHONPATH=$work python3 -B -c "from pictures import *
$1"
}

# ---- known figures, errors 0, 1, 3 and 9 in a channel each
pictures '
png("a.png", [(10, 20, 30), (0, 0, 0)], [(200, 0, 0), (5, 6, 7)])
png("b.png", [(10, 20, 30), (0, 1, 0)], [(203, 0, 0), (5, 6, 16)])'
expect_exit 0 "$hedron" compare --json a.png b.png
expect_silent_stderr
expect_output_json 'j["first"] == {"file": "a.png", "format": "PNG", "bits": 8, "not_finite": 0} and j["second"]["file"] == "b.png"'
expect_output_json '[j[key] for key in ("curve", "pixels", "width", "height", "identical", "above_1", "above_8")] == ["srgb", 4, 2, 2, False, 0.5, 0.25]'
expect_output_json 'abs(j["display"]["rmse"] - math.sqrt(91 / 12)) < 1e-12 and j["display"]["p999"] == j["display"]["largest"] == 9'
expect_output_json 'j["display"]["at"] == {"x": 1, "y": 1, "channel": "blue"} and j["linear"]["at"] == {"x": 0, "y": 1, "channel": "red"}'
expect_exit 0 "$hedron" compare a.png b.png
expect_silent_stderr
for line in 'first   a.png: PNG, 8 bits, 2 x 2 pixels' '  at x, y                      1, 1 blue' 'pixels off by > 1                   50 %'; do
    expect_stdout_contains "$line"
done

# ---- the limit is on the largest display error, and equality passes
expect_exit 1 "$hedron" compare a.png b.png --fail-above 8.9999999
expect_sentence
expect_stderr_contains 'the largest error is 9 of 255, at x 1, y 1 in blue'
expect_stdout_contains 'RMSE'
expect_exit 0 "$hedron" compare a.png b.png --fail-above 9
expect_silent_stderr
expect_exit 0 "$hedron" compare a.png a.png
expect_stdout_contains 'The pictures are identical.'
expect_exit 0 "$hedron" compare --json a.png a.png --fail-above 0
expect_output_json 'j["identical"] and j["display"]["psnr"] is None and j["display"]["at"] is None and j["display"]["largest"] == 0'

# ---- PNG beside PFM, whose values above 1 no PNG holds
pictures '
pfm("bright.pfm", [(1, 0.5, 7), (-3, 0, 0)])
pfm("white.pfm", [(1, 0.5, 1), (0, 0, 0)])
png("half.png", [(255, 188, 255), (0, 0, 0)])
png("plain.png", [(255, 128, 255), (0, 0, 0)], srgb=False)'
expect_exit 0 "$hedron" compare --json half.png bright.pfm --fail-above 0.5
expect_output_json 'j["curve"] == "srgb" and 0 < j["linear"]["largest"] < 0.003'
expect_output_json '0 < j["display"]["largest"] < 0.5 and j["display"]["at"]["channel"] == "green"'

# ---- OpenEXR: in float the same as PFM, in half the nearest
frame=(render --quiet --size 70x40 --samples 1 --depth 3 --frames 0 --backend c)
expect_exit 0 "$hedron" "${frame[@]}" -o true.pfm -o half.exr
if [[ ! -s half.exr ]]; then
    echo "not tested: OpenEXR, for this build has none"
else
    expect_exit 0 "$hedron" compare --json true.pfm half.exr
    expect_output_json 'j["second"]["bits"] == 16 and not j["identical"] and 0 < j["linear"]["largest"] < 0.002'
    head -c 3000 half.exr >cut.exr
    expect_refusal 2 "$hedron" compare true.pfm cut.exr
    expect_stderr_contains 'cannot read cut.exr as OpenEXR'
fi
expect_refusal 2 "$hedron" "${frame[@]}" --set output.bits=32 -o deep.png
expect_stderr_contains 'deep.png cannot have 32 bits a channel: expected output.bits 8 or 16'

# ---- curves: as in the files, or else --curve
expect_exit 0 "$hedron" compare --json bright.pfm plain.png --fail-above 0.51
expect_output_json 'j["curve"] == "linear" and abs(j["display"]["largest"] - 0.5) < 1e-9'
expect_refusal 2 "$hedron" compare plain.png half.png
expect_stderr_contains 'half.png is marked as sRGB, but plain.png is not'
for curve in linear srgb; do
    expect_exit 0 "$hedron" compare --json plain.png half.png --curve "$curve"
    expect_output_json "j['curve'] == '$curve' and j['display']['largest'] == 60"
done

# ---- NaN and infinity
pictures '
nan, inf = float("nan"), float("inf")
pfm("wrong.pfm", [(nan, 0, inf), (0, 0, 0)])
pfm("worse.pfm", [(0, 0, 0), (0, 0, -inf)])'
expect_exit 1 "$hedron" compare --json white.pfm wrong.pfm
expect_sentence
expect_stderr_contains '0 values of white.pfm and 2 of wrong.pfm are NaN or infinite'
expect_output_json 'j["second"]["not_finite"] == 2 and j["pixels"] == 1 and j["display"]["largest"] == 0 and not j["identical"]'
expect_exit 1 "$hedron" compare --json wrong.pfm worse.pfm --fail-above 255
expect_output_json 'j["pixels"] == 0 and j["display"]["rmse"] is None and j["above_1"] is None'

# ---- the heat map
pictures '
png("zero.png", [(0, 0, 0)] * 2)
png("errors.png", [(4, 1, 2), (0, 0, 16)])
png("expected.png", [(198, 63, 76), (243, 120, 25)])'
expect_exit 0 "$hedron" compare zero.png errors.png --diff maps/heat.png
expect_silent_stderr
expect_exit 0 "$hedron" compare maps/heat.png expected.png --fail-above 0
expect_files maps heat.png

# No input is replaced, under any name, and a map that fails leaves nothing.
ln a.png link.png
for name in link.png "$PWD/b.png"; do
    cp a.png "$work/a.png"
    expect_refusal 2 "$hedron" compare a.png b.png --diff "$name"
    expect_stderr_contains 'would replace the picture'
    expect_same a.png "$work/a.png"
done
rm link.png
expect_refusal 2 "$hedron" compare a.png b.png --diff heat.pfm
expect_stderr_contains '.png'
expect_exit 0 "$hedron" render --quiet --backend c --frames 0 --samples 1 --size 160x120 -o one.png
head -c 2000 one.png >damaged.png
expect_refusal 2 "$hedron" compare one.png damaged.png --diff full/heat.png
expect_stderr_contains 'damaged.png'
[ ! -e full ] || fail "a folder was made for a map that failed"

# ---- pictures that cannot be compared
expect_refusal 2 "$hedron" compare a.png half.png
expect_stderr_contains 'a.png has 2 x 2 pixels, but half.png has 2 x 1; expected the same size'
expect_refusal 2 "$hedron" compare a.png missing.png
expect_stderr_contains 'missing.png'
pictures 'png("laced.png", [(7, 7, 7)], interlace=1)'
expect_refusal 2 "$hedron" compare laced.png a.png
expect_stderr_contains 'laced.png is an interlaced PNG'
expect_refusal 2 "$hedron" compare a.png
expect_refusal 2 "$hedron" compare a.png b.png a.png
for value in -1 256 nan; do
    expect_refusal 2 "$hedron" compare a.png b.png --fail-above "$value"
    expect_stderr_contains --fail-above
done
expect_refusal 2 "$hedron" compare a.png b.png --curve gamma

# ---- figures that nobody reads
for form in '' --json; do
    expect_exit 1 bash -c "'$hedron' compare a.png a.png $form >/dev/full"
    expect_sentence
done

# ---- size does not matter: 65535 rows in 256 MiB of address space
pictures '
png("tall.png", *[[(0, 0, 0)] * 3] * 65535)
pfm("tall.pfm", *[[(0, 0, 0)] * 3] * 65534, [(0, 0, 0), (0, 0, 0), (0, 0, 1)])'
# The address sanitizer reserves far more for itself.
limit='ulimit -v 262144'
if grep -q -a -F __asan_init "$hedron"; then
    limit=true
fi
expect_exit 0 bash -c "$limit; exec '$hedron' compare --json tall.png tall.pfm --diff heat.png"
expect_output_json 'j["display"]["largest"] == 255 and j["display"]["at"] == {"x": 2, "y": 65534, "channel": "blue"}'
finish
