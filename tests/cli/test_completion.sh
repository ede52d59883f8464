#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The completion script, called as bash calls it.
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

commands='render check convert devices tune compare help'
touch a.json b.json c.in 'with space.json'
mkdir scenes

expect_completions "$commands" ''
expect_completions 'render' r
expect_completions 'check convert compare' c
expect_completions '' x
expect_completions '--geometry --gpu --grid' --g
expect_completions '--variant --verbose --version' --v
expect_completions '' --cpu ''
# ---- a command's own options, which are those of its help
for command in $commands; do
    "$hedron" help "$command" >"$logs/help"
    short=$(sed -n 's/^  \(-[a-zA-Z]\), .*/\1/p' "$logs/help")
    long=$(sed -n 's/^  \(-[a-zA-Z], \)*\(--[a-z-]*\).*/\2/p' "$logs/help")
    expect_completions "$long" "$command" --
    expect_completions "$short"$'\n'"$long" "$command" -
done
expect_completions '--schema' check --s
expect_completions '--json' devices --j
expect_completions '--json' tune --j
expect_completions '--fail-above' compare --f
expect_completions 'linear srgb' compare --curve ''
expect_completions 'a.json b.json c.in scenes with space.json' compare a.json ''
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

rm -r ./*
expect_files .
finish
