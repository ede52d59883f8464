# SPDX-License-Identifier: MIT
# shellcheck shell=bash
#
# Functions for the tests of the command line. A script sources this file with the path of the program as
# its first argument. It then runs in an empty temporary folder with a home folder of its own; both are
# removed when it ends. A failed expectation is reported and counted, and the script continues; it ends
# with 1 if there was any. Its last line is `finish`.

if [[ $# -lt 1 || ! -x $1 ]]; then
    echo "usage: $0 HEDRON [BUILD_FOLDER]" >&2
    exit 1
fi
hedron=$(realpath "$1")
cli_folder=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
project=$(realpath "$cli_folder/../..")

# Compiled OpenCL kernels stay in this user's cache, because compiling takes seconds.
export POCL_CACHE_DIR=${POCL_CACHE_DIR:-${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/pocl/kcache}
export LC_ALL=C
export HEDRON_STOP_PATIENCE=600 # a slow machine ends in order as well
unset CDPATH XDG_CACHE_HOME # hedron's own cache is the folder in HEDRON_CACHE, else in the home folder below

work=$(mktemp -d "${TMPDIR:-/tmp}/hedron-cli-XXXXXX")
logs=$work/logs # output of the last command: logs/stdout, logs/stderr
export HOME=$work/home
mkdir "$logs" "$HOME" "$work/here" "$work/no_vendors"
: | tee "$logs/stdout" >"$logs/stderr"
cd "$work/here" || exit 1

last_command=none
failures=0
finished=0
code=0

clean_up() {
    local last=$?
    cd / || exit 1
    rm -rf -- "$work"
    if ((last == 0 && finished == 0)); then
        echo "the script ended before its last line" >&2
        exit 1
    fi
}
trap clean_up EXIT

finish() {
    finished=1
    ((failures > 0)) || exit 0
    echo "$failures expectations failed" >&2
    exit 1
}

# lanes_there PRECISION: the lane counts that plain C supports on this processor.
lanes_there() {
    local lanes
    for lanes in 1 2 4 8 16; do
        if "$hedron" render --quiet --backend c --lanes "$lanes" --precision "$1" --frames 0 --size 16x16 --samples 1 \
            -o "$work/lanes.data" >"$work/lanes.txt" 2>&1; then
            echo "$lanes"
        elif ! grep -q 'the processor has registers for ' "$work/lanes.txt"; then
            cat "$work/lanes.txt" >&2
        fi
    done
}

skip() {
    ((failures == 0)) || finish
    echo "skipped: $*"
    finished=1
    exit 77
}

need_python() {
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 10))' 2>"$logs/which" ||
        skip "there is no python3 of version 3.10 or newer"
}

# The line of the script, not of this file, that led here.
script_line() {
    local i
    for ((i = 1; i < ${#BASH_SOURCE[@]}; i++)); do
        if [[ ${BASH_SOURCE[i]} != "${BASH_SOURCE[0]}" ]]; then
            echo "$(basename "${BASH_SOURCE[i]}"):${BASH_LINENO[i - 1]}"
            return
        fi
    done
}

# With the last command, and its messages.
fail() {
    failures=$((failures + 1))
    echo "FAILED $(script_line): $*"
    echo "  command: $last_command"
    head -c 600 "$logs/stdout" | sed 's/^/  stdout: /'
    head -c 600 "$logs/stderr" | sed 's/^/  stderr: /'
} >&2

# Runs a command and keeps its output and exit code. Standard input is passed on.
run() {
    last_command="$*"
    code=0
    "$@" >"$logs/stdout" 2>"$logs/stderr" || code=$?
}

# expect_exit CODE COMMAND...
expect_exit() {
    run "${@:2}"
    (($1 == code)) || fail "exit code $code, expected $1"
}

# expect_stdout_lines COUNT [REGEX]: so many lines, each matching as a whole.
expect_stdout_lines() {
    if (($(wc -l <"$logs/stdout") != $1)) || [[ -s $logs/stdout && -n $(tail -c 1 "$logs/stdout") ]]; then
        fail "standard output has $(wc -l <"$logs/stdout") whole lines, expected $1 and nothing else"
    fi
    (($# == 1)) || ! grep -q -v -x -E -e "$2" "$logs/stdout" || fail "a line of standard output does not match $2"
}

expect_stdout_contains() {
    grep -q -F -e "$1" "$logs/stdout" || fail "standard output lacks '$1'"
}

expect_stderr_contains() {
    grep -q -F -i -e "$1" "$logs/stderr" || fail "standard error lacks '$1'"
}

expect_silent_stderr() {
    [[ ! -s $logs/stderr ]] || fail "standard error is not empty"
}

# Exactly one line: the program's name and a message.
expect_sentence() {
    if (($(wc -l <"$logs/stderr") != 1)) || ! grep -q -E '^hedron: .{10,}$' "$logs/stderr" ||
        [[ -n $(tail -c 1 "$logs/stderr") ]]; then
        fail "standard error is not one sentence"
    fi
}

# expect_refusal CODE COMMAND...: that exit code at once, one sentence, and no standard output.
expect_refusal() {
    expect_exit "$1" timeout "$time_limit" "${@:2}"
    if ((code == $1)); then
        expect_sentence
        expect_stdout_lines 0
    fi
}

# expect_files FOLDER [NAME...]: the folder holds these entries and no others.
expect_files() {
    local folder=$1 expected found
    shift
    expected=$(if (($# > 0)); then printf '%s\n' "$@" | sort; fi)
    found=$(find "$folder" -mindepth 1 -printf '%P\n' 2>&1 | sort)
    [[ $found == "$expected" ]] || fail "$folder holds '${found//$'\n'/ }', expected '${expected//$'\n'/ }'"
}

expect_same() {
    cmp -s -- "$1" "$2" || fail "$1 and $2 differ, expected the same bytes"
}

expect_different() {
    if cmp -s -- "$1" "$2" || [[ ! -s $1 || ! -s $2 ]]; then
        fail "$1 and $2 have the same bytes or are missing, expected different pictures"
    fi
}

# The number in four bytes from an offset of a file: number_at FILE OFFSET [big]
number_at() {
    od -A n -t u4 -j "$2" -N 4 --endian="${3:-little}" "$1" | tr -d ' '
}

# expect_data FILE WIDTH HEIGHT: a whole picture in the data format.
expect_data() {
    if [[ ! -f $1 ]]; then
        fail "there is no file $1"
    elif (($(stat -c %s "$1") != 8 + $2 * $3 * 4)); then
        fail "$1 has $(stat -c %s "$1") bytes, expected $((8 + $2 * $3 * 4))"
    elif (($(number_at "$1" 0) != $2 || $(number_at "$1" 4) != $3)); then
        fail "the head of $1 says $(number_at "$1" 0) x $(number_at "$1" 4), expected $2 x $3"
    fi
}

# expect_png FILE WIDTH HEIGHT: signature, size and the end chunk.
expect_png() {
    if [[ ! -f $1 ]]; then
        fail "there is no file $1"
    elif [[ $(head -c 8 "$1" | od -A n -t x1 | tr -d ' ') != 89504e470d0a1a0a ]]; then
        fail "$1 does not begin as a PNG"
    elif (($(number_at "$1" 16 big) != $2 || $(number_at "$1" 20 big) != $3)); then
        fail "$1 has $(number_at "$1" 16 big) x $(number_at "$1" 20 big) pixels, expected $2 x $3"
    elif [[ $(tail -c 8 "$1" | od -A n -t x1 | tr -d ' ') != 49454e44ae426082 ]]; then
        fail "$1 does not end as a PNG"
    fi
}

# Writes a chequered texture of 4 x 4 pixels in the data format.
make_texture() {
    local white='\377\377\377\377' green='\040\200\100\000'
    local row=$white$green$white$green other=$green$white$green$white
    printf '%b' '\4\0\0\0\4\0\0\0' "$row$other$row$other" >"$1"
}

# The task's own example, with its texture in the home folder.
use_official_input() {
    cp "$cli_folder/official.in" "$work/official.in"
    make_texture "$HOME/floor.data"
}

# One frame of the built-in scene, quickly.
small=(--size 32x24 --samples 1 --depth 2)
# Hides NVIDIA's graphics cards from this command, in CUDA and in OpenCL.
no_nvidia=(env CUDA_VISIBLE_DEVICES=)
# Hides OpenCL from this command. Khronos' loader takes drivers of OCL_ICD_FILENAMES too.
no_opencl=(env -u OCL_ICD_FILENAMES OCL_ICD_VENDORS="$work/no_vendors")
# Hides both.
nothing=("${no_opencl[@]}" CUDA_VISIBLE_DEVICES=)
export small no_nvidia nothing project

# True if some backend has a GPU that no_nvidia does not hide.
has_other_gpu() {
    "${no_nvidia[@]}" "$hedron" devices | grep -q '^ *GPU,'
}

# True if films can be made.
has_ffmpeg() {
    command -v ffmpeg && command -v ffprobe
} >/dev/null

# fake NAME BODY: a program of that name in a folder that with_tools puts first in PATH.
with_tools=(env PATH="$work/tools:$PATH")
export with_tools
fake() {
    mkdir -p "$work/tools"
    printf '#!%s\n%s\n' "$(command -v bash)" "$2" >"$work/tools/$1"
    chmod +x "$work/tools/$1"
}

# stop_at_third SIGNAL: from now on, with_tools, the FFmpeg of the third segment first sends it to hedron, after the second one is whole. If
# hedron is killed it does not begin: it might make its file at any time.
stop_at_third() {
    fake ffmpeg "if [[ \$* == *.part-0002* ]]; then
            until compgen -G '*.part-0001-????????????????' >/dev/null; do sleep 0.01; done
            kill -$1 \$PPID
            [[ $1 != KILL ]] || exit 1
        fi
        exec '$(command -v ffmpeg)' \"\$@\""
}

is_sanitized() {
    grep -q -a -E '__(asan|tsan)_init' "$hedron"
}

has_opencl() {
    "${no_nvidia[@]}" "$hedron" devices | sed -n '/^opencl$/,/^c$/p' | grep -q -E 'strict arithmetic: (yes|not measured)'
}

# wait_until SECONDS COMMAND...: true as soon as the command succeeds, false after the timeout.
wait_until() {
    local end=$((SECONDS + $1))
    until "${@:2}"; do
        ((SECONDS <= end)) || return 1
        sleep 0.01
    done
}

# wait_for WHAT COMMAND...: until it succeeds, at most for the timeout.
wait_for() {
    wait_until "$time_limit" "${@:2}" || fail "timed out waiting for $1"
}

# In a group of its own, so that the shell does not make it ignore SIGINT. Sets `pid`.
start() {
    last_command="$*"
    set -m
    "$@" >"$logs/stdout" 2>"$logs/stderr" &
    pid=$!
    set +m
}

is_gone() {
    ! kill -0 "$1" 2>/dev/null
}

# send SIGNAL TARGET: if the target is already gone, the test would show nothing.
send() {
    kill "-$1" -- "$2" 2>/dev/null || fail 'it was over before the signal'
}

# Seconds after which a program counts as hanging: more than any needs on a slow and busy machine.
time_limit=300

# expect_end CODE: the started program ends by itself, with this code.
expect_end() {
    if ! wait_until "$time_limit" is_gone "$pid"; then
        fail "still running after $time_limit s"
        kill -KILL -- "-$pid" 2>/dev/null || true
    fi
    code=0
    wait "$pid" 2>/dev/null || code=$?
    ((code == $1)) || fail "exit code $code, expected $1"
}

# expect_output_json EXPRESSION: true of `j`, the JSON on standard output.
expect_output_json() {
    python3 -B -c "import json, math, sys
j = json.load(open(sys.argv[1]))
sys.exit(not ($1))" "$logs/stdout" || fail "JSON: not $1"
}

# use_fake_cuda BUILD: replaces CUDA's driver and compiler by those of the tests, and hides OpenCL, for all later commands.
use_fake_cuda() {
    nvrtc=$1/tests/fake_cuda/libnvrtc.so.12
    [[ -e $nvrtc ]] || skip "no compiler of C++ is here that could build the kernels"
    export OCL_ICD_VENDORS=$work/no_vendors
    unset OCL_ICD_FILENAMES
    export LD_LIBRARY_PATH=$1/tests/fake_cuda${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    export HEDRON_CACHE=$work/cache HEDRON_NVRTC=$nvrtc
}

# take BUILD TEXT FOR: ${driver[@]} runs a command with an OpenCL whose compiler mistakes one text of the kernels for another.
take() {
    # shellcheck disable=SC2034 # for the scripts
    driver=("${no_nvidia[@]}" LD_PRELOAD="$1/tests/failing/libfailing_opencl.so" FAILING_OPENCL_TEXT="$2"
        FAILING_OPENCL_FOR="$3")
}
