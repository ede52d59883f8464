#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The man page: every formatter takes it without warnings, and everything is in it.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

expect_exit 0 "$hedron" help man
expect_silent_stderr
cp "$logs/stdout" "$work/hedron.1"
if [[ $(head -c 10 "$work/hedron.1") != '.TH HEDRON' ]]; then
    fail "the man page does not begin as one"
fi
commands='render check convert devices selftest tune compare help'
# formatted COMMAND...: the page as text; the formatter has nothing to complain about.
formatted() {
    expect_exit 0 "$@"
    expect_silent_stderr
    sed 's/.\x08//g; s/\x1b\[[0-9;]*m//g' "$logs/stdout" >"$work/page"
    for word in NAME SYNOPSIS DESCRIPTION COMMANDS 'EXIT STATUS' EXAMPLES 'hedron render' 'hedron convert' \
        'hedron render scene.json -o out/%04d.png -o film.mkv' '130, 143' $commands \
        $(sed -n "s/^  \(-[a-zA-Z], \)*\(--[a-z-]*\).*/\2/p" <("$hedron" --help; "$hedron" help render)); do
        if ! tr -s ' \n' '  ' <"$work/page" | grep -q -F -e "$word"; then
            fail "the man page lacks '$word'"
        fi
    done
}
formatters=0
if command -v groff >"$logs/which"; then
    formatted groff -man -Tascii -ww "$work/hedron.1"
    formatters=$((formatters + 1))
fi
if command -v man >"$logs/which" && man --warnings -l "$work/hedron.1" >"$logs/man" 2>&1; then
    formatted env MANWIDTH=100 man --warnings -l "$work/hedron.1"
    formatters=$((formatters + 1))
fi
if command -v mandoc >"$logs/which"; then
    formatted mandoc -T ascii -W error "$work/hedron.1"
    formatters=$((formatters + 1))
fi
if ((formatters == 0 && failures == 0)); then
    skip "there is no groff, man or mandoc"
fi

expect_files .
finish
