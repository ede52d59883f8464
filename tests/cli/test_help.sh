#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The help of each command has every option, the man page each once, and the generated references are up to date.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# expect_help OPTIONS WORD...: hedron's help for these words has these options and no others.
expect_help() {
    local expected found
    expect_exit 0 "$hedron" "${@:2}" </dev/null
    expect_silent_stderr
    expect_stdout_contains 'Usage'
    found=$(sed -n 's/^  \(-[a-zA-Z], \)*\(--[a-z-]*\) .*/\2/p' "$logs/stdout" | sort | tr '\n' ' ')
    expected=$(tr -s ' \n' '\n' <<<"$1" | sort | tr '\n' ' ')
    [[ $found == "$expected" ]] || fail "the help has '$found', expected '$expected'"
    ! grep -q -E '.{121}|[[:space:]]$' "$logs/stdout" || fail 'a line is longer than 120, or ends in white space'
}

viewing='--backend --device --lanes --threads --pipeline --block --grid --max-launch --geometry --divisions --accel --precision
    --math --size --samples --depth --cutoff --aa --max-error --help'
rendering="$viewing --stats --verbose --quiet --frames --version --no-sync"
for option in --help -h help; do
    expect_help "$rendering --gpu --cpu --default --variant" "$option"
done
for usage in render view new check convert devices selftest tune compare help complete --default '[OPTIONS] < INPUT'; do
    expect_stdout_contains "hedron $usage"
done
for words in 'render -h' 'help render' 'render --size 1x1 --help'; do
    # shellcheck disable=SC2086 # a command and its arguments
    expect_help "$rendering --frame-lines --output --layers --set --strict-files --again --crop --reference" $words
done
expect_help "$viewing --terminal --set --strict-files" view --help
expect_help '--help --json' devices --help
expect_help '--help --schema --json --set --strict-files' check --help
expect_help '--help --output --variant' convert --help
expect_help '--help --json --diff --fail-above --curve' compare --help
expect_help '--help --mesh --up' new --help

# ---- first what to do, the classic mode last
expect_exit 0 "$hedron" help
order=$(grep -n -E '^(Start|Usage|Classic mode|Options of the classic mode):$' "$logs/stdout" | cut -d: -f2 | tr '\n' ' ')
[[ $order == 'Start Usage Classic mode Options of the classic mode ' ]] || fail "the parts of the help are '$order'"
[[ $(sed -n '3,4p' "$logs/stdout") == $'Start:\n  hedron render'* ]] || fail 'the help does not begin with what to do'

expect_exit 0 "$hedron" help classic
expect_stdout_contains '--default'
expect_stdout_contains 'docs/reference/files.md'

# ---- a topic that does not exist: the error lists those that do
expect_refusal 2 "$hedron" help nosuch
for topic in render compare scene man completion-fish; do
    expect_stderr_contains "$topic"
done

# ---- the references are what the program prints
for page in scene command-line statistics; do
    expect_exit 0 "$hedron" help "reference-$page"
    cmp -s "$logs/stdout" "$project/docs/reference/$page.md" ||
        fail "docs/reference/$page.md is out of date; ./dev docs writes it"
done

# ---- a reader that goes away ends what only prints, silently: by SIGPIPE
for words in 'help man' 'help reference-scene' --default 'check --schema' devices 'devices --json'; do
    # shellcheck disable=SC2086 # a command and its arguments
    { sleep 0.1 && "$hedron" $words </dev/null 2>"$logs/stderr" || echo $? >"$logs/code"; } | true
    [[ $(cat "$logs/code") == 141 ]] || fail "'hedron $words' ends with $(cat "$logs/code") if its reader is gone"
    expect_silent_stderr
done

# ---- each variable that the program reads is explained, in the help and in the man page
variables=$(grep -rh -o 'getenv("HEDRON_[A-Z_]*")' "$project/src" | grep -o 'HEDRON_[A-Z_]*' | sort -u)
for form in help 'help man'; do
    # shellcheck disable=SC2086 # one or two words
    expect_exit 0 "$hedron" $form
    for variable in $variables; do
        expect_stdout_contains "$variable"
    done
done

# ---- scenes: every key of the schema; the small scene in the text is one
expect_exit 0 "$hedron" help scene
expect_silent_stderr
# shellcheck disable=SC2016 # not variables
if command -v jq >"$logs/which"; then
    "$hedron" check --schema | jq -r '.. | .properties? // empty | keys[]' | sort -u | grep -v -F '$comment' >"$work/keys"
    sed -n 's/^  \([a-z_$0-9]*\)\( .*\)*$/\1/p' "$logs/stdout" | grep . | sort -u >"$work/told"
    expect_same "$work/told" "$work/keys"
fi
sed -n '/^  {/,/^  }/p' "$logs/stdout" >small.json
expect_exit 0 "$hedron" check small.json
rm small.json

expect_refusal 2 "$hedron" help nonsense
expect_exit 0 "$hedron" render --version
expect_stdout_lines 1 'hedron [0-9]+\.[0-9]+\.[0-9]+'
expect_silent_stderr

# Without arguments at a terminal it prints the help, too.
if script -q -e -c true /dev/null </dev/null >"$logs/script" 2>&1; then
    expect_exit 0 script -q -e -c "$hedron" /dev/null
    expect_stdout_contains 'Usage'
else
    echo "not tested: a terminal, because the program 'script' is missing"
fi

# ---- the man page
expect_exit 0 "$hedron" help man
cp "$logs/stdout" "$work/hedron.1"
# formatted COMMAND...: the page as text; the formatter has no complaint.
formatted() {
    expect_exit 0 "$@" "$work/hedron.1"
    expect_silent_stderr
    sed 's/.\x08//g; s/\x1b\[[0-9;]*m//g' "$logs/stdout" | tr -s ' \n' '  ' >"$work/page"
    for word in NAME SYNOPSIS DESCRIPTION COMMANDS 'EXIT STATUS' EXAMPLES 'hedron render scene.json -o out/%04d.png -o film.mkv' \
        '130, 143' 'hedron convert' check devices selftest tune compare $rendering --output --layers --set; do
        grep -q -F -e "$word" "$work/page" || fail "the man page lacks '$word'"
    done
    for word in 'SCENE FILES' 'SEE ALSO' index_of_refraction; do
        grep -q -F -e "$word" "$work/page" || fail "the man page lacks '$word'"
    done
}
repeated=$(sed -n '/^\.SH OPTIONS/,/^\.SH SCENE/p' "$work/hedron.1" | sed -n 's/^\\fB.*\(\\-\\-[a-z\\-]*\).*\\fR$/\1/p' | grep -v 'output' | sort | uniq -d)
[[ -z $repeated ]] || fail "the man page has more than once: $repeated"
if command -v groff >"$logs/which"; then
    formatted groff -man -Tascii -ww
fi
if command -v man >"$logs/which" && man --warnings -l "$work/hedron.1" >"$logs/man" 2>&1; then
    formatted env MANWIDTH=100 man --warnings -l
fi
finish
