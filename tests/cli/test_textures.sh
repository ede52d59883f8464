#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The floor's texture in the classic mode: every format, and files that are no textures.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input

# with_texture PATH: the example with this texture, a white tint and no floor mirror, as standard input.
with_texture() {
    sed -e '1s/.*/8/' -e '3s/.*/24 18 70/' -e "9s|~.*|$1   1 1 1   0|" -e '$s/.*/1 1/' \
        -e '4s/.*/6 4 0   0 0   1 1 1   0 0/' -e '5s/.*/0 -1 0   0 0   1 1 1   0 0/' \
        "$work/official.in" >"$work/texture.in"
    cat "$work/texture.in"
}

# accept PATH FILE: the picture with this texture.
accept() {
    expect_exit 0 "$hedron" --cpu --frames 0 < <(with_texture "$1")
    expect_data out/img_0.data 24 18
    if [[ -d out ]]; then
        mv out/img_0.data "$2"
        rmdir out
    fi
}

refuse() {
    expect_refusal 2 "$hedron" --cpu --frames 0 < <(with_texture "$1")
    expect_stderr_contains "$2"
}

# ---- the formats, and where the file is
# shellcheck disable=SC2088 # the program itself is to replace the tilde
accept '~/floor.data' home.data
cp "$HOME/floor.data" here.texture
accept here.texture relative.data
expect_same home.data relative.data
accept "$work/here/here.texture" absolute.data
expect_same home.data absolute.data
# The name does not tell the format.
cp here.texture misnamed.png
accept misnamed.png misnamed.data
expect_same home.data misnamed.data

# One picture as a texture in either format gives one picture; it is not that of the chequers.
for kind in png data; do
    expect_exit 0 "$hedron" render --backend c "${small[@]}" --frames 0 -o "texture.$kind"
    accept "texture.$kind" "from_$kind.data"
done
expect_same from_png.data from_data.data
expect_different from_png.data home.data

# A JPEG; its file in the corpus stands behind a byte of the fuzz target's own.
tail -c +2 "$(dirname "${BASH_SOURCE[0]}")/../fuzz/corpus/texture/jpeg_420" >photo.jpg
accept photo.jpg photo.data
expect_different photo.data home.data
cp photo.jpg photo.png
accept photo.png misnamed.data
expect_same misnamed.data photo.data

# Alpha carries no meaning.
{
    int32 1
    int32 1
    printf '\200\100\040\000'
} >clear.texture
{
    int32 1
    int32 1
    printf '\200\100\040\377'
} >solid.texture
accept clear.texture clear.data
accept solid.texture solid.data
expect_same clear.data solid.data

# The built-in texture has a name of its own.
accept builtin:floor builtin.data
expect_different builtin.data home.data

# Width and height are below 2^16.
for size in '65535 1' '1 65535' '20000 2'; do
    read -r width height <<<"$size"
    {
        int32 "$width"
        int32 "$height"
        head -c $((width * height * 4)) /dev/zero | tr '\0' '\100'
    } >wide.texture
    accept wide.texture wide.data
done
rm -f ./*.data

# ---- files that are not there or cannot be read
refuse missing.data missing.data
refuse no/such/folder.data no/such
refuse "$work/here" "$work/here"
mkfifo pipe
refuse pipe pipe
refuse /dev/zero /dev/zero
refuse /dev/full /dev/full
refuse builtin:nonsense builtin:nonsense
# shellcheck disable=SC2088
refuse '~/nothing.data' nothing.data

# ---- files that are no textures
: >bad.texture
refuse bad.texture bad.texture
printf 'abc' >bad.texture
refuse bad.texture bad.texture
printf 'this is a text and no picture\n' >bad.texture
refuse bad.texture bad.texture
head -c 70 here.texture >bad.texture # whole: 8 + 64 bytes
refuse bad.texture 72
{
    cat here.texture
    printf 'x'
} >bad.texture
refuse bad.texture 72
for size in '0 0' '0 4' '4 0' '-1 4' '4 -1' '65536 1' '65535 65535' '2147483647 2147483647' \
    '-2147483648 -2147483648' '32768 32768'; do
    read -r width height <<<"$size"
    {
        int32 "$width"
        int32 "$height"
        head -c 64 /dev/zero
    } >bad.texture
    refuse bad.texture bad.texture
done

# The same in PNG: cut off, damaged, of enormous size.
bytes=$(stat -c %s texture.png)
for part in 8 20 33 60 $((bytes / 2)) $((bytes - 13)); do
    head -c "$part" texture.png >bad.texture
    refuse bad.texture bad.texture
done
{
    head -c 60 texture.png
    head -c 40 /dev/zero
    tail -c +101 texture.png
} >bad.texture
refuse bad.texture bad.texture
for size in '0 0' '1 0' '1000000 1000000' '2147483647 2147483647' '4294967295 1'; do
    read -r width height <<<"$size"
    {
        head -c 16 texture.png
        int32 "$width" big
        int32 "$height" big
        tail -c +25 texture.png
    } >bad.texture
    refuse bad.texture bad.texture
done

# And in JPEG.
bytes=$(stat -c %s photo.jpg)
for part in 3 20 200 $((bytes / 2)) $((bytes - 2)); do
    head -c "$part" photo.jpg >bad.texture
    refuse bad.texture 'cannot read bad.texture as JPEG: Premature end of JPEG file'
done
# Where the frame begins, its length, bits, height and width follow.
frame=$(grep -obUaP '\xff\xc0' photo.jpg | head -n 1 | cut -d : -f 1)
for size in '\377\377\377\377' '\360\0\360\0' '\0\0\0\0'; do
    {
        head -c $((frame + 5)) photo.jpg
        # shellcheck disable=SC2059 # the format is made of bytes
        printf "$size"
        tail -c +$((frame + 10)) photo.jpg
    } >bad.texture
    refuse bad.texture bad.texture
done

expect_files . bad.texture clear.texture here.texture misnamed.png photo.jpg photo.png pipe solid.texture \
    texture.png wide.texture
finish
