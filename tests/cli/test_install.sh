#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The installed program needs nothing of its source and build folders.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=${2:?the build folder is the second argument}
if ! command -v cmake >"$logs/which"; then
    skip "there is no cmake"
fi

prefix=$work/prefix
unset DESTDIR
expect_exit 0 cmake --install "$build" --prefix "$prefix"
installed=$(find "$prefix" -path '*/bin/hedron' -type f)
for file in "$installed" "${installed%/*}"/hedron-{submit,task,report}; do
    [[ -x $file ]] || fail "there is no program '$file'"
done
[[ -n $(find "$prefix" -type f -name LICENSE) ]] || fail "no LICENSE was installed"
if ! grep -q -a __tsan_init "$hedron"; then
    expect_same "$prefix/share/man/man1/hedron.1" <("$hedron" help man)
fi
expect_same "$prefix/share/bash-completion/completions/hedron" <("$hedron" help completion)
expect_same "$prefix/share/zsh/site-functions/_hedron" <("$hedron" help completion-zsh)
expect_same "$prefix/share/fish/vendor_completions.d/hedron.fish" <("$hedron" help completion-fish)

# ---- documents, whose links lead to existing files, and scenes, which need nothing else
documents=$prefix/share/doc/hedron
while IFS= read -r found; do
    document=${found%%:*} link=${found#*](}
    link=${link%)*}
    if [[ ! -e $(dirname "$document")/${link%%#*} ]]; then
        fail "$document leads to $link, which is not installed"
    fi
done < <(grep -r -o --include='*.md' ']([^h#)][^)]*)' "$documents")
expect_exit 0 "$installed" check "$documents"/scenes/*.json
expect_stdout_contains 'five.json: fine'
expect_exit 0 "${installed%/*}/hedron_model" sphere 12

# ---- the Debian packages have the same files, and name their dependencies
if command -v cpack >"$logs/which" && command -v dpkg-shlibdeps >"$logs/which"; then
    expect_exit 0 cpack --config "$build/CPackConfig.cmake" -B "$work/package"
    package=("$work"/package/hedron_*.deb)
    for file in "$work"/package/*.deb; do
        dpkg-deb -x "$file" "$work/root"
    done
    zsh=share/zsh/site-functions
    if [[ -e /etc/debian_version ]]; then
        zsh=share/zsh/vendor-completions
    fi
    expect_same "$work/root/usr/$zsh/_hedron" <("$hedron" help completion-zsh)
    expect_same <(cd "$work/root/usr" && find . -type f | sed "s,$zsh,share/zsh/site-functions," | sort) \
        <(cd "$prefix" && find . -type f | sort)
    expect_exit 0 env -i "$work/root/usr/bin/hedron" --version
    dpkg-deb -f "${package[0]}" Depends Recommends >"$logs/fields"
    for needed in libpng16-16 libjpeg libopenexr libjansson4 ocl-icd-libopencl1 ffmpeg pocl-opencl-icd; do
        grep -q "$needed" "$logs/fields" || fail "the package does not name $needed: $(cat "$logs/fields")"
    done
else
    echo "not tested: the package, because cpack or dpkg-shlibdeps is missing"
fi

# expect_picture OPTION...: of the installed program, in the root folder, with only the environment in `bare`.
expect_picture() {
    cd /
    expect_exit 0 env -i "${bare[@]}" "$installed" render --quiet "${small[@]}" --frames 3 -o "$work/here/picture.data" "$@"
    cd "$work/here"
    expect_same picture.data expected.data
    rm -f picture.data
}
expect_exit 0 "$hedron" render --quiet --backend c "${small[@]}" --frames 3 -o expected.data
bare=(PATH="$PATH" HOME="$work/no/such/home")
expect_picture
expect_silent_stderr
if has_opencl; then
    bare=(PATH="$PATH" HOME="$HOME")
    expect_picture --backend opencl
fi

finish
