#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The completion script, called as bash calls it, and the man page.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

expect_exit 0 "$hedron" help completion
expect_silent_stderr
cp "$logs/stdout" "$work/completion"
# shellcheck source=/dev/null
source "$work/completion"
if [[ $(complete -p hedron) != 'complete -F _hedron hedron' ]]; then
    fail "bash completes hedron with '$(complete -p hedron)'"
fi
if command -v shellcheck >"$logs/which" && ! shellcheck -s bash "$work/completion"; then
    fail "the completion script has mistakes"
fi

# expect_completions EXPECTED WORD...: what may follow; the last word is the one that is being typed.
# Bash makes words of its own of equals signs.
expect_completions() {
    local expected=$1 found
    shift
    COMP_WORDS=(hedron "$@")
    COMP_CWORD=$#
    _hedron
    found=$(printf '%s\n' "${COMPREPLY[@]}" | tr -s ' ' '\n' | sort | tr '\n' ' ')
    expected=$(tr -s ' ' '\n' <<<"$expected" | sort | tr '\n' ' ')
    if [[ $found != "$expected" ]]; then
        fail "'hedron $*' gives '$found', expected '$expected'"
    fi
}

commands='render check convert devices help'
touch a.json b.json c.in 'with space.json'
mkdir scenes

expect_completions "$commands" ''
expect_completions 'render' r
expect_completions 'check convert' c
expect_completions '' x
expect_completions '--gpu' --g
expect_completions '--variant --verbose --version' --v
expect_completions '' --cpu ''
# ---- a command's own options, which are those of its help
for command in $commands; do
    "$hedron" help "$command" >"$logs/help"
    short=$(sed -n 's/^  \(-[a-z]\), .*/\1/p' "$logs/help")
    long=$(sed -n 's/^  \(-[a-z], \)*\(--[a-z]*\).*/\2/p' "$logs/help")
    expect_completions "$long" "$command" --
    expect_completions "$short"$'\n'"$long" "$command" -
done
expect_completions '--schema' check --s
expect_completions '--json' devices --j
expect_completions '' devices ''
expect_completions "$commands man completion" help ''
expect_completions 'man' help m
# ---- values
expect_completions 'auto c opencl cuda' render --backend ''
expect_completions 'c cuda' render --backend c
expect_completions 'opencl' render --backend o
expect_completions 'auto c opencl cuda' render --backend =
expect_completions 'c cuda' render --backend = c
expect_completions 'strict fast' --math ''
expect_completions 'double' --precision d
expect_completions '1 16' render --lanes 1
expect_completions '' render --size ''
expect_completions '' render --set c
# ---- files: scenes for 'render' and 'check', any for the rest
expect_completions 'a.json b.json scenes with space.json' render ''
expect_completions 'a.json' check a
expect_completions 'a.json b.json scenes with space.json' check a.json ''
expect_completions 'a.json b.json c.in scenes with space.json' convert ''
expect_completions 'c.in' convert -o c
expect_completions 'c.in' render --output = c
expect_completions 'scenes' render --stats s
COMP_WORDS=(hedron render w) COMP_CWORD=2
_hedron
if [[ ${#COMPREPLY[@]} != 1 || ${COMPREPLY[0]} != 'with space.json' ]]; then
    fail "a name with a space gives ${#COMPREPLY[@]} completions"
fi

# ---- the man page: no warnings, and everything is in it
expect_exit 0 "$hedron" help man
expect_silent_stderr
cp "$logs/stdout" "$work/hedron.1"
if [[ $(head -c 10 "$work/hedron.1") != '.TH HEDRON' ]]; then
    fail "the man page does not begin as one"
fi
# formatted COMMAND...: the page as text; the formatter has nothing to complain about.
formatted() {
    expect_exit 0 "$@"
    expect_silent_stderr
    sed 's/.\x08//g; s/\x1b\[[0-9;]*m//g' "$logs/stdout" >"$work/page"
    for word in NAME SYNOPSIS DESCRIPTION COMMANDS 'EXIT STATUS' EXAMPLES 'hedron render' 'hedron convert' \
        'hedron render scene.json -o out/%04d.png -o film.mkv' '130, 143' $commands \
        $(sed -n "s/^  \(-[a-z], \)*\(--[a-z]*\).*/\2/p" <("$hedron" --help; "$hedron" help render)); do
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
if ((formatters == 0)); then
    echo "not tested: how the man page looks, for there is no groff, man or mandoc"
fi

rm -r ./*
expect_files .
finish
