#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compiled kernels are kept: where, when they are used, and that nothing depends on them.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

if ! has_opencl; then
    skip "no OpenCL device compiles kernels here"
fi
use_official_input
export HEDRON_CACHE=$work/cache
render=("${no_nvidia[@]}" "$hedron" render --backend opencl "${small[@]}" --frames 0)
compiled='compiled in [0-9]+ ms; passed the self-test \([0-9a-f]{16}, [0-9a-f]{16}\)'

# expect_build REGEX COMMAND...: the program says so of its kernels, and the picture is as ever.
expect_build() {
    local regex="build +$1"
    shift
    expect_exit 0 "$@" --verbose -o picture.data
    if (($(grep -c -x -E -e "$regex" "$logs/stderr") != 1)); then
        fail "standard error has no line that is $regex"
        grep '^build' "$logs/stderr" >&2 || true
    fi
    if [[ ! -e expected.data ]]; then
        "$hedron" render --backend c "${small[@]}" --frames 0 --quiet -o expected.data >"$logs/stdout"
    fi
    expect_same picture.data expected.data
    rm picture.data
}

# kernels: the files of compiled kernels.
kernels() {
    find "$HEDRON_CACHE" -name 'opencl-*.entry'
}

# ---- a cold start, then a warm one
expect_build "$compiled; cached" "${render[@]}"
expect_build "taken from $work/cache" "${render[@]}"
if [[ $(kernels | wc -l) != 1 || $(stat -c %a "$work/cache" "$(kernels)" | tr '\n' ' ') != '700 600 ' ]]; then
    fail "the cache is not one file for its user alone"
fi

# ---- what is damaged is compiled anew
entry=$(kernels)
cp "$entry" whole.entry
refused="$entry cannot be used:"
printf '\377' | dd of="$entry" bs=1 seek=5000 conv=notrunc status=none
expect_build "$refused its checksum is wrong; $compiled; cached" "${render[@]}"
expect_build "taken from $work/cache" "${render[@]}"
head -c 5000 whole.entry >"$entry"
expect_build "$refused it is cut short or too long; $compiled; cached" "${render[@]}"
: >"$entry"
expect_build "$refused its size is wrong; $compiled; cached" "${render[@]}"
seq 1000 >"$entry"
expect_build "$refused it is no entry of hedron's; $compiled; cached" "${render[@]}"
chmod 666 "$entry"
expect_build "$refused other users may write to it; $compiled; cached" "${render[@]}"
expect_build "taken from $work/cache" "${render[@]}"
mv whole.entry "$work/whole"
# Another user's own: the same format, another key.
cp "$work/cache/key" "$work/key"
rm "$work/cache/key"
expect_build "$refused its checksum is wrong; $compiled; cached" "${render[@]}"
cp "$work/whole" "$entry"
expect_build "$refused its checksum is wrong; $compiled; cached" "${render[@]}"
# A folder that others may write to.
chmod 777 "$work/cache"
shared="cannot use the folder $work/cache: other users may write to it"
expect_build "$shared; $compiled; not cached; $shared" "${render[@]}"
chmod 700 "$work/cache"
expect_build "taken from $work/cache" "${render[@]}"

# ---- other kernels are other entries
expect_exit 0 "${render[@]}" --quiet --depth 20 -o picture.data
expect_exit 0 "${render[@]}" --quiet --math fast -o picture.data
rm picture.data
if [[ $(kernels | wc -l) != 3 ]]; then
    fail "there are $(kernels | wc -l) entries of kernels, expected 3"
fi

# ---- switched off, and where nothing can be written
cp -r "$work/cache" "$work/before"
expect_build "$compiled; not cached; HEDRON_CACHE is off" env HEDRON_CACHE=off "${render[@]}"
expect_build "$compiled; not cached; cannot make the folder /proc/no/such: .*" \
    env HEDRON_CACHE=/proc/no/such "${render[@]}"
: >file
expect_build "$compiled; not cached; cannot make the folder file/cache: .*" env HEDRON_CACHE=file/cache "${render[@]}"
rm file
if ((EUID != 0)); then
    mkdir -m 500 "$work/read_only"
    expect_build "$compiled; not cached; .*" env HEDRON_CACHE="$work/read_only/cache" "${render[@]}"
fi
expect_build "$compiled; not cached; there is no cache folder, .*" \
    env -u HEDRON_CACHE -u HOME "${render[@]}"
if ! diff -r "$work/before" "$work/cache"; then
    fail "the cache changed though it was not to be used"
fi

# ---- a word of it only where it was asked for
for folder in off /proc/no/such; do
    expect_exit 0 env HEDRON_CACHE=$folder "${no_nvidia[@]}" "$hedron" --backend opencl --cpu "${small[@]}" \
        --frames 0 <"$work/official.in"
    expect_silent_stderr
    rm -r out
done

# ---- the places it may have
expect_build "$compiled; cached" env -u HEDRON_CACHE "${render[@]}"
expect_build "taken from $HOME/.cache/hedron" env -u HEDRON_CACHE "${render[@]}"
expect_build "$compiled; cached" env -u HEDRON_CACHE XDG_CACHE_HOME="$work/xdg" "${render[@]}"
expect_build "taken from $work/xdg/hedron" env -u HEDRON_CACHE XDG_CACHE_HOME="$work/xdg" "${render[@]}"
expect_build "$compiled; not cached; there is no home folder $work/nobody" \
    env -u HEDRON_CACHE HOME="$work/nobody" "${render[@]}"
if [[ -e $work/nobody ]]; then
    fail "a home folder was made"
fi

# ---- a full disk is told as such
if ((EUID == 0)) && mkdir "$work/full" && mount -t tmpfs -o size=16k tmpfs "$work/full" 2>"$logs/mount"; then
    expect_build "$compiled; not cached; cannot write .*: No space left on device" \
        env HEDRON_CACHE="$work/full/cache" "${render[@]}"
    umount "$work/full"
else
    echo "not tested: a full disk, for only root can mount one"
fi

rm expected.data
expect_files .
finish
