#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The man page: every formatter takes it without warnings, and everything is in it.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

expect_exit 0 "$hedron" help man
cp "$logs/stdout" "$work/hedron.1"
# formatted COMMAND...: the page as text; the formatter has nothing to complain about.
formatters=0
formatted() {
    formatters=$((formatters + 1))
    expect_exit 0 "$@" "$work/hedron.1"
    expect_silent_stderr
    sed 's/.\x08//g; s/\x1b\[[0-9;]*m//g' "$logs/stdout" | tr -s ' \n' '  ' >"$work/page"
    for word in NAME SYNOPSIS DESCRIPTION COMMANDS 'EXIT STATUS' EXAMPLES 'hedron render scene.json -o out/%04d.png -o film.mkv' \
        '130, 143' 'hedron '{render,convert} check devices selftest tune compare help \
        $(sed -n "s/^  \(-[a-zA-Z], \)*\(--[a-z-]*\).*/\2/p" <("$hedron" --help; "$hedron" help render)); do
        if ! grep -q -F -e "$word" "$work/page"; then
            fail "the man page lacks '$word'"
        fi
    done
}
if command -v groff >"$logs/which"; then
    formatted groff -man -Tascii -ww
fi
if command -v man >"$logs/which" && man --warnings -l "$work/hedron.1" >"$logs/man" 2>&1; then
    formatted env MANWIDTH=100 man --warnings -l
fi
if command -v mandoc >"$logs/which"; then
    formatted mandoc -T ascii -W error
fi
if ((formatters == 0 && failures == 0)); then
    skip "there is no groff, man or mandoc"
fi

expect_files .
finish
