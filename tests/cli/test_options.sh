#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Handling of options by the commands: if they are wrong, exit code 2, one sentence and no file, even if only the scene, the
# device or other options show it. tests/unit/cli/test_options.c covers each option by itself.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
sed -e '1s/.*/3/' -e '3s/.*/16 12 120/' -e '$s/.*/2 1/' "$work/official.in" >"$work/good.in"
input=$work/good.in
render=("$hedron" render --backend c "${small[@]}")

right() { # OPTION...: a render of one frame with these
    rm -f picture.data
    expect_exit 0 "${render[@]}" --quiet --frames 0 -o picture.data "$@"
    expect_stdout_lines 1 'picture\.data'
    expect_silent_stderr
    [[ -s picture.data ]] || fail "no picture: $*"
}

wrong() { # WORDS ARGUMENT...: 'hedron render' refuses these with a sentence that has the words
    expect_refusal 2 "${render[@]}" "${@:2}"
    expect_stderr_contains "$1"
}

classic_wrong() { # WORDS ARGUMENT...: likewise the classic mode
    expect_refusal 2 "$hedron" "${@:2}" <"$input"
    expect_stderr_contains "$1"
}

# ---- values: they reach the picture; of several the last one counts
right --size=33X25
expect_data picture.data 33 25
right --size 5x5 --size 6x7 --samples=2 --cutoff .5 --device c:0 --block 96 --grid 7 --max-launch 12.5
expect_data picture.data 6 7
right --geometry=triangles --divisions=2 --accel bvh --precision=double --math fast --pipeline wavefront-uncompacted
frame_count=$("$hedron" --default | head -n 1)
right --frames $((frame_count - 1))
right --frames 7,7
for value in 1 10; do
    expect_exit 0 "$hedron" --cpu --variant "$value" --frames 0 <"$input"
    expect_stdout_lines 1
done
wrong --cutoff -o none.data --frames 0 --cutoff=1
classic_wrong --cutoff --cpu --cutoff=1
classic_wrong --gpu --gpu --cpu

# ---- wrong together, or for this scene or device
wrong 'hedron: --size 65535x65535 --samples 2 --depth 2: 65535 x 65535 pixels are too many' --size 65535x65535 --samples 2
wrong '--divisions needs --geometry triangles' --divisions 2
expect_refusal 3 "$hedron" render "${small[@]}" --frames 0 -o none.data --device c:7
expect_stderr_contains "; see 'hedron devices'"
expect_refusal 2 "$hedron" render "${small[@]}" --frames 0 -o none.data --backend opencl --device c:0
expect_stderr_contains "--device is 'c:0', but --backend is 'opencl'"
for value in 5-3 10000000; do
    wrong frame -o none_%d.data --frames "$value"
    classic_wrong frame --cpu --frames "$value"
done
wrong 'frame' --set camera.frames=12 -o none_%d.data --frames 0-12
wrong 'the scene has one frame, 0' --set camera.frames=1 --frames 3 -o none.data
wrong --set --set ''

# ---- outputs: several at once; one file is one output, however it is spelled
expect_exit 0 "${render[@]}" --quiet --frames 0 --output other.data -o picture.data
expect_stdout_lines 2
expect_same other.data picture.data
rm other.data
for names in 'same.gif ./same.gif' 'same.mkv ./no/../same.mkv' '##.data ./%02d.data'; do
    # shellcheck disable=SC2086 # two names
    wrong 'are the same file' --frames 0-1 -o ${names/ / -o }
done
# A percent sign, and the name of the only frame of a pattern.
expect_exit 0 "${render[@]}" --quiet --frames 3 -o 'a%%.data' -o 'b%03d.data'
expect_same "$logs/stdout" <(printf '%s\n' 'a%.data' b003.data)
rm 'a%.data' b003.data
for value in '' picture.jpg 'out/%5d.png'; do
    wrong "$value" --frames 3 -o "$value"
done
wrong picture.png --frames 0-2 -o picture.png # one name for several frames
wrong '%d.mkv' --frames 0-2 -o '%d.mkv'     # a film has no number

# ---- each command refuses others' options
for command in render devices tune; do
    expect_refusal 2 "$hedron" "$command" --gpu
    expect_stderr_contains '--gpu'
    expect_stderr_contains "$command"
done
classic_wrong --output --cpu -o x.png
classic_wrong "'--nonsense'" --nonsense
wrong "'two.json'" one.json two.json
wrong "see 'hedron help render'" --nonsense
classic_wrong "did you mean 'hedron render'?" rendr
for command in render ''; do
    # shellcheck disable=SC2086 # a command or none
    expect_refusal 2 "$hedron" $command --quiet --verbose </dev/null
    expect_stderr_contains 'only one of --verbose and --quiet'
done
expect_exit 0 "$hedron" -V
expect_stdout_lines 1 'hedron [0-9.]+'
expect_refusal 2 "$hedron" </dev/null # neither a terminal nor an input

# ---- no refused command left a file
rm -r picture.data out
expect_files .
finish
