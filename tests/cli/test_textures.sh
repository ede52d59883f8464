#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The floor's texture in the classic mode: every format, the places of its file, and files that are no textures; notes on an
# environment. The unit tests cover the contents of files, right and wrong (image).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input

# with_texture PATH: the example with this texture, a white tint and no floor mirror, as standard input.
with_texture() {
    sed -e '1s/.*/8/' -e '3s/.*/24 18 70/' -e "9s|~.*|$1   1 1 1   0|" -e '$s/.*/1 1/' \
        -e '4s/.*/6 4 0   0 0   1 1 1   0 0/' -e '5s/.*/0 -1 0   0 0   1 1 1   0 0/' "$work/official.in"
}

# accept PATH FILE: the picture with this texture.
accept() {
    expect_exit 0 "$hedron" --cpu --frames 0 < <(with_texture "$1")
    expect_data out/img_0.data 24 18
    mv out/img_0.data "$2" && rmdir out
}

# refuse PATH WORDS
refuse() {
    expect_refusal 2 "$hedron" --cpu --frames 0 < <(with_texture "$1")
    expect_stderr_contains "${1/#\~/$HOME}"
    expect_stderr_contains "$2"
}

# ---- places of the file; the name does not decide the format
# shellcheck disable=SC2088 # the program itself is to replace the tilde
accept '~/floor.data' home.data
cp "$HOME/floor.data" here.png
for path in here.png "$work/here/here.png"; do
    accept "$path" other.data
    expect_same home.data other.data
done

# ---- the formats: one picture as a texture in either format gives one picture; it is not that of the chequers
expect_exit 0 "$hedron" render --backend c "${small[@]}" --frames 0 -o texture.png -o texture.data
for kind in png data; do
    accept "texture.$kind" "from_$kind.data"
done
expect_same from_png.data from_data.data
# A JPEG; its file in the corpus follows a byte of the fuzz target's own.
tail -c +2 "$cli_folder/../fuzz/corpus/texture/jpeg_420" >photo.png
accept photo.png photo.data
expect_different photo.data home.data
head -c -40 photo.png >early.png
accept early.png early.data
expect_stderr_contains 'early.png ends early, so a part of the picture is grey or coarse'
# As an environment it is too narrow, and remains where pixels have alpha.
echo '{"hedron": 1, "camera": {"eye": [9, 0, 0]}}' >sky.json
expect_exit 0 "$hedron" check sky.json --set 'environment={"file": "early.png"}' --set output.alpha=true --set environment.intensity=0
expect_stdout_contains 'early.png has 37 x 29 pixels, so it is stretched'
expect_stdout_contains 'environment.intensity is 0'
expect_stdout_contains 'environment remains at the borders of objects'
# Alpha carries no meaning.
for alpha in 000 377; do
    printf '%b' '\1\0\0\0\1\0\0\0\0200\0100\040' "\\0$alpha" >alpha.texture
    accept alpha.texture "alpha$alpha.data"
done
expect_same alpha000.data alpha377.data
# The built-in texture has a name of its own.
accept builtin:floor builtin.data
expect_different builtin.data home.data

# ---- files that cannot be read, or are no textures
refuse no/such/folder.data 'No such file'
refuse "$work/here" 'not a regular file'
mkfifo pipe
refuse pipe 'not a regular file'
# shellcheck disable=SC2088
refuse '~/nothing.data' 'No such file'
printf 'this is a text and no picture\n' >bad.texture
refuse bad.texture 'neither PNG, JPEG nor the data format'
expect_refusal 2 "$hedron" check sky.json --set 'environment={"file": "bad.texture"}'
expect_stderr_contains 'an environment may also be OpenEXR or PFM, and a Radiance'
head -c 200 photo.png >bad.texture
refuse bad.texture 'cannot read bad.texture as JPEG: Invalid JPEG file structure: missing SOS marker'
finish
