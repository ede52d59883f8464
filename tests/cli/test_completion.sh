#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Completion in bash, called as bash calls it, and in zsh and fish if they are installed.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

expect_exit 0 "$hedron" help completion
expect_silent_stderr
cp "$logs/stdout" "$work/completion"
# shellcheck source=/dev/null
source "$work/completion"
[[ $(complete -p hedron) == 'complete -F _hedron hedron' ]] || fail "bash completes hedron with '$(complete -p hedron)'"

# expect_completions EXPECTED WORD...: completions of the last word, which is being typed. Bash makes words of its own of
# equals signs.
expect_completions() {
    local expected found
    COMP_WORDS=("$hedron" "${@:2}") COMP_CWORD=$(($# - 1))
    _hedron
    found=$(printf '%s\n' "${COMPREPLY[@]}" | tr -s ' ' '\n' | sort | tr '\n' ' ')
    expected=$(tr -s ' ' '\n' <<<"$1" | sort | tr '\n' ' ')
    [[ $found == "$expected" ]] || fail "'hedron ${*:2}' gives '$found', expected '$expected'"
}

commands='render view new check convert devices selftest tune compare help'
touch b.json c.in 'with space.json'
mkdir scenes
"$hedron" new a.json >"$logs/new"

expect_completions "$commands" ''
expect_completions 'check convert compare' c
expect_completions '--geometry --gpu --grid' --g
expect_completions '-v' -v
expect_completions 'linear srgb' compare --curve ''
expect_completions 'a.json b.json c.in scenes with space.json' compare a.json ''
expect_completions '' devices ''
expect_completions "$commands scene classic man completion completion-zsh completion-fish" help ''
expect_completions 'auto c opencl cuda' render --backend ''
expect_completions 'c cuda' render --backend = c
expect_completions '1 16' render --lanes 1
expect_completions 'camera.field_of_view= camera.frames= camera.eye= camera.target=' render --set camera.
expect_completions 'multijitter' render --set image.aa = m
expect_completions 'depth,normal' render --layers depth,n
expect_completions 'all' render --device a
expect_completions '0' render --device c : ''
expect_completions 'a.json b.json c.in scenes with space.json' convert ''
expect_completions 'c.in' render --output = c
expect_completions 'scenes' render --stats s
# ---- a command's own options, which are those of its help
for command in $commands; do
    "$hedron" help "$command" >"$logs/help"
    short=$(sed -n 's/^  \(-[a-zA-Z]\), .*/\1/p' "$logs/help")
    long=$(sed -n 's/^  \(-[a-zA-Z], \)*\(--[a-z-]*\).*/\2/p' "$logs/help")
    expect_completions "$long" "$command" --
    expect_completions "$short"$'\n'"$long" "$command" -
done
COMP_WORDS=("$hedron" render w) COMP_CWORD=2
_hedron
[[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == 'with space.json' ]] || fail "a name with a space gives ${COMPREPLY[*]}"

# ---- zsh, whose own functions print their arguments, and fish
"$hedron" help completion-zsh >"$work/completion.zsh"
"$hedron" help completion-fish >"$work/completion.fish"
expect_words() { # SHELL EXPECTED: its completions, in $logs/offered
    [[ $(sort "$logs/offered") == "$2" ]] || fail "$1 offers '$(<"$logs/offered")', expected '$2'"
}
if command -v zsh >"$logs/which"; then
    zsh_completes() {
        # shellcheck disable=SC2016 # for zsh
        zsh -f -c 'compdef() { echo "$*" >&2 }; compadd() { print -r -- "${@[-1]}" }; _files() { print -r -- "files$*" }
            script=$1; shift; source $script; words=("$@"); CURRENT=$#; _hedron' \
            zsh "$work/completion.zsh" "$hedron" "$@" >"$logs/offered" 2>"$logs/zsh"
    }
    zsh_completes render --backend c
    expect_words zsh $'c\ncuda'
    [[ $(cat "$logs/zsh") == '_hedron hedron' ]] || fail "zsh says $(cat "$logs/zsh")"
    zsh_completes check ''
    expect_words zsh 'files-g *.json'
    zsh_completes render a.json --set image.wi
    expect_words zsh 'image.width='
else
    echo "not tested: there is no zsh"
fi
if command -v fish >"$logs/which"; then
    # shellcheck disable=SC2016 # for fish
    fish_completes() {
        PATH=${hedron%/*}:$PATH fish --no-config -c 'source $argv[1]; complete -C $argv[2]' \
            "$work/completion.fish" "$1" | cut -f 1 >"$logs/offered"
    }
    fish_completes 'hedron render --backend c'
    expect_words fish $'c\ncuda'
    fish_completes 'hedron render a.json --set image.wi'
    expect_words fish 'image.width='
else
    echo "not tested: there is no fish"
fi
finish
