#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The cache of compiled kernels: its place, its use, and that nothing depends on it.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

has_opencl || skip "no OpenCL device compiles kernels here"
export HEDRON_CACHE=$work/cache
render=("${no_nvidia[@]}" "$hedron" render --backend opencl "${small[@]}" --frames 0)
compiled='compiled in [0-9]+ ms; passed the self-test'

"$hedron" render --backend c "${small[@]}" --frames 0 --quiet -o "$work/expected.data" >"$logs/stdout"
# expect_build REGEX COMMAND...: the program reports this about its kernels, and the picture is unchanged.
expect_build() {
    expect_exit 0 "${@:2}" --verbose -o picture.data
    (($(grep -c -x -E -e "build +$1" "$logs/stderr") == 1)) || fail "standard error has no line that is $1"
    expect_same picture.data "$work/expected.data"
    rm picture.data
}


# ---- a cold start, then a warm one
expect_build "$compiled; cached" "${render[@]}"
expect_build "taken from $work/cache" "${render[@]}"
entry=$(find "$work/cache" -name 'opencl-*.entry')
[[ $(stat -c %a "$work/cache" "$entry") == $'700\n600' ]] || fail "the cache is not one file for its user alone"

# ---- untrusted entries are compiled again, for each of the reasons in tests/unit/system/test_cache_folder.c
refused="$entry cannot be used:"
printf '\377' | dd of="$entry" bs=1 seek=5000 conv=notrunc status=none
expect_build "$refused its checksum is wrong; $compiled; cached" "${render[@]}"
chmod 777 "$work/cache"
shared="cannot use the folder $work/cache: other users may write to it"
expect_build "$shared; $compiled; not cached; $shared" "${render[@]}"
chmod 700 "$work/cache"
expect_build "taken from $work/cache" "${render[@]}"

# ---- switched off, and not writable; reported only if the user asked for a cache
cp -r "$work/cache" "$work/before"
expect_build "$compiled; not cached; HEDRON_CACHE is off" env HEDRON_CACHE=off "${render[@]}"
expect_build "$compiled; not cached; cannot make the folder /proc/no/such: .*" env HEDRON_CACHE=/proc/no/such "${render[@]}"
expect_build "$compiled; not cached; there is no home folder $work/nobody" \
    env -u HEDRON_CACHE HOME="$work/nobody" "${render[@]}"
[[ ! -e $work/nobody ]] || fail "a home folder was made"
diff -r "$work/before" "$work/cache" || fail "the cache changed though it was not to be used"

# ---- a place of its own below the home folder
mkdir "$HOME/.cache"
cp -r "$work/cache" "$HOME/.cache/hedron"
expect_build "taken from $HOME/.cache/hedron" env -u HEDRON_CACHE "${render[@]}"

# ---- a full disk is reported as such
if ((EUID == 0)) && mkdir "$work/full" && mount -t tmpfs -o size=16k tmpfs "$work/full" 2>"$logs/which"; then
    expect_build "$compiled; not cached; cannot write .*: No space left on device" \
        env HEDRON_CACHE="$work/full/cache" "${render[@]}"
    umount "$work/full"
else
    echo "not tested: a full disk, for only root can mount one"
fi

expect_files .
finish
