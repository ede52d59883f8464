#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every option with right and wrong values, and what is no option.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

use_official_input
sed -e '1s/.*/3/' -e '3s/.*/16 12 120/' -e '$s/.*/2 1/' "$work/official.in" >"$work/good.in"
input=$work/good.in

# right OPTION...: a render of one frame with these.
right() {
    rm -f picture.data
    expect_exit 0 "$hedron" render --quiet --backend c "${small[@]}" --frames 0 -o picture.data "$@"
    if (($(tail -n 1 "$logs/stdout" | grep -c -x 'picture\.data') != 1)); then
        fail "the last line of standard output is not the picture's name"
    fi
    expect_silent_stderr
    if [[ ! -s picture.data ]]; then
        fail "no picture: $*"
    fi
}

# wrong OPTION...: refused by both commands, with the option's name in the sentence.
wrong() {
    expect_refusal 2 "$hedron" --cpu "$@" <"$input"
    expect_stderr_contains "${1%%=*}"
    expect_refusal 2 "$hedron" render --backend c --frames 0 -o none.data "$@"
    expect_stderr_contains "${1%%=*}"
}

# ---- each option's values
right --size 1x1
expect_data picture.data 1 1
right --size 33x25
expect_data picture.data 33 25
right --size=33X25
expect_data picture.data 33 25
for value in 0x24 32x0 -32x24 32x-24 32 32x 'x24' 32x24x3 65536x1 1x65536 abc '' 3.5x4 \
    99999999999999999999x1 '32 x 24' ' 5x5' +5x5 5x+5 '5x 5'; do
    wrong --size "$value"
    wrong "--size=$value"
done
# Right by itself, but too many pixels in all.
wrong --size 65535x65535 --samples 2
expect_stderr_contains 'hedron: --size 65535x65535 --samples 2: 65535 x 65535 pixels are too many'

right --samples 1
right --samples 3
right --samples=2
for value in 0 -1 1.5 abc '' 1x 99999999999 100000 ' 1' +1; do
    wrong --samples "$value"
done

right --depth 0
right --depth=3
for value in -1 1.5 abc '' 99999999999 100000; do
    wrong --depth "$value"
done

right --cutoff 0
right --cutoff=0.5
right --cutoff 1e-3
right --cutoff .5
for value in 1 1.5 -0.1 nan inf abc '' 0.1x 0x.8p0 ' 0.5' +0.5 . 1e 0.5e-; do
    wrong --cutoff "$value"
done

for value in 1 4 8 16; do
    right --lanes "$value"
done
right --lanes=4
for value in 0 2 3 32 -4 abc '' 4x ' 4'; do
    wrong --lanes "$value"
done

for value in 1 2 5 64; do
    right --threads "$value"
done
right --threads=2
for value in 0 -1 1.5 abc '' 100000 99999999999999999999; do
    wrong --threads "$value"
done

for value in auto mega wavefront wavefront-uncompacted; do
    right --pipeline "$value"
done
right --pipeline=wavefront
for value in Mega wave '' 1; do
    wrong --pipeline "$value"
done

for value in solids triangles; do
    right --geometry "$value"
done
right --geometry=triangles --divisions=2
for value in solid Triangles '' 1; do
    wrong --geometry "$value"
done
for value in 0 -1 1.5 abc '' 1001; do
    wrong --divisions "$value"
done
expect_refusal 2 "$hedron" render --divisions 2
expect_stderr_contains '--divisions needs --geometry triangles'
for value in auto brute bvh; do
    right --accel "$value"
done
for value in tree '' 1; do
    wrong --accel "$value"
done

# Plain C has no work groups: as --threads on a GPU, they are for another device.
for value in 32 96 1024; do
    right --block "$value"
done
for value in 0 1 33 1056 -32 abc ''; do
    wrong --block "$value"
done
for value in 1 7 1048576; do
    right --grid "$value"
done
for value in 0 -1 1048577 abc ''; do
    wrong --grid "$value"
done

for value in 1 12.5 10000; do
    right --max-launch "$value"
done
for value in 0 0.5 -1 10001 abc ''; do
    wrong --max-launch "$value"
done

right --precision float
right --precision=double
for value in single Float '' 64; do
    wrong --precision "$value"
done

right --math strict
right --math=fast
for value in loose Strict ''; do
    wrong --math "$value"
done

right --backend auto
right --backend=c
for value in vulkan C '' ' c'; do
    wrong --backend "$value"
done

right --device 0
right --device=0
right --device c:0
expect_refusal 3 "$hedron" render "${small[@]}" --frames 0 -o none.data --device c:7
expect_stderr_contains "; see 'hedron devices'"
expect_refusal 2 "$hedron" render "${small[@]}" --frames 0 -o none.data --backend opencl --device c:0
expect_stderr_contains "--device is 'c:0', but --backend is 'opencl'"
expect_refusal 2 "$hedron" render --backend open
expect_stderr_contains "did you mean 'opencl'?"

frame_count=$("$hedron" --default | head -n 1)
right --frames $((frame_count - 1))
right --frames=7
right --frames 7,7
for value in '' a 1- -1 1-2-3 5-3 ',' '1,,2' '1,' 0x1 10000000 99999999999999999999 1.5 '1 2'; do
    expect_refusal 2 "$hedron" --cpu --frames "$value" <"$input"
    expect_stderr_contains 'frame'
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" -o none_%d.data --frames "$value"
    expect_stderr_contains 'frame'
done
for value in 12 0-12; do
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" --set camera.frames=12 -o none_%d.data \
        --frames "$value"
done

# Several outputs are made at once.
expect_exit 0 "$hedron" render --quiet --backend c "${small[@]}" --frames 0 --output other.data -o picture.data
expect_stdout_lines 2
expect_same other.data picture.data
rm other.data
# One file is one output, whatever the spelling.
for names in './same.data same.data' 'same.mkv ./no/../same.mkv' '##.data ./%02d.data'; do
    # shellcheck disable=SC2086 # two names
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0-1 -o ${names/ / -o }
done
# A percent sign, and the name that the only frame of a pattern has.
expect_exit 0 "$hedron" render --quiet --backend c "${small[@]}" --frames 3 -o 'a%%.data' -o 'b%03d.data'
expect_same "$logs/stdout" <(printf '%s\n' 'a%.data' b003.data)
rm 'a%.data' b003.data
expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 3 -o 'a%.data'
# The name tells what to write, so it has to have one of the endings.
for value in '' picture picture.jpg film.avi 'out/%d.jpg' 'out/%s.png' '%d_%d.png' 'out/%5d.png' folder/; do
    expect_refusal 2 "$hedron" render --backend c "${small[@]}" --frames 0 -o "$value"
done
rm -f picture picture.jpg film.avi

for value in 1 10; do
    expect_exit 0 "$hedron" --cpu --variant "$value" --frames 0 <"$input"
    expect_stdout_lines 1
done
expect_exit 0 "$hedron" --cpu --variant=7 --frames 0 <"$input"
for value in 0 11 -1 1.5 TOD '' 99999999999; do
    expect_refusal 2 "$hedron" --cpu --variant "$value" <"$input"
    expect_stderr_contains --variant
done

# The last one of several counts; the keys exclude one another.
right --size 5x5 --size 6x7
expect_data picture.data 6 7
for keys in '--gpu --cpu' '--cpu --gpu' '--default --cpu' '--gpu --default'; do
    # shellcheck disable=SC2086 # two options
    expect_refusal 2 "$hedron" $keys <"$input"
done
expect_exit 0 "$hedron" --cpu --cpu --frames 0 <"$input"

# ---- values where none belongs, and none where one belongs
for option in --gpu --cpu --default --help --version; do
    expect_refusal 2 "$hedron" "$option=1" <"$input"
    expect_stderr_contains "$option"
done
for option in --help --version; do
    expect_refusal 2 "$hedron" render "$option=1"
    expect_stderr_contains "$option"
done
for option in --variant --backend --device --lanes --threads --pipeline --block --grid --max-launch --geometry --divisions --accel --precision --math --frames --size \
    --samples --depth --cutoff; do
    expect_refusal 2 "$hedron" --cpu "$option" <"$input"
    expect_stderr_contains "$option needs a value"
done
for option in --output --backend --device --lanes --threads --pipeline --block --grid --max-launch --geometry --divisions --accel --precision --math --frames --size \
    --samples --depth --cutoff --set --stats; do
    expect_refusal 2 "$hedron" render "$option"
    expect_stderr_contains "$option needs a value"
done
expect_refusal 2 "$hedron" render -o
expect_stderr_contains '--output'

# ---- options of another command
for option in --output=x.png --stats=x --verbose --quiet --schema --gpu; do
    expect_refusal 2 "$hedron" tune "$option"
    expect_stderr_contains "${option%=*}"
    expect_stderr_contains "tune"
done
for option in --gpu --cpu --default --variant=4 --json --schema; do
    expect_refusal 2 "$hedron" render "$option"
    expect_stderr_contains "${option%=*}"
    expect_stderr_contains "render"
    if [[ $option != --json ]]; then
        expect_refusal 2 "$hedron" devices "$option"
        expect_stderr_contains "${option%=*}"
        expect_stderr_contains "devices"
    fi
done
for option in --output=x.png '-o x.png'; do
    # shellcheck disable=SC2086 # an option and its value
    expect_refusal 2 "$hedron" --cpu $option <"$input"
    expect_stderr_contains --output
done
for option in --output=x.png --backend=c --device=0 --lanes=1 --threads=1 --pipeline=mega \
    --geometry=solids --divisions=1 --accel=auto --block=32 --grid=1 --max-launch=50 --precision=float --math=fast \
    --frames=0 --size=1x1 --samples=1 --depth=1 --cutoff=0 --set=a=1 --stats=x --verbose --quiet; do
    expect_refusal 2 "$hedron" devices "$option"
    expect_stderr_contains "${option%%=*}"
done

# ---- what is no option
for argument in --nonsense --nonsense=1 -x - --siz=32x24 --sizes=1x1 -gpu --GPU --gpus -cpu word '' \
    Render -oh --=1; do
    expect_refusal 2 "$hedron" "$argument" <"$input"
    expect_refusal 2 "$hedron" render "$argument"
    expect_refusal 2 "$hedron" devices "$argument"
done
expect_refusal 2 "$hedron" --nonsense <"$input"
expect_stderr_contains "'--nonsense'"
expect_refusal 2 "$hedron" render --frames 0 word
expect_stderr_contains 'word'
expect_refusal 2 "$hedron" render one.json two.json
expect_stderr_contains "'two.json'"
expect_refusal 2 "$hedron" --cpu render <"$input"
expect_refusal 2 "$hedron" --cpu word <"$input"
expect_refusal 2 "$hedron" render devices
expect_refusal 2 "$hedron" "--$(printf '%050000d' 0)" <"$input"
expect_refusal 2 "$hedron" --depth "$(printf '%050000d' 0)x" <"$input"

# ---- what was meant
# meant WORDS ARGUMENT...: the sentence ends with this.
meant() {
    local words=$1
    shift
    expect_refusal 2 "$hedron" "$@" </dev/null
    expect_stderr_contains "did you mean '$words'?"
}
meant 'hedron render' rendr
meant 'hedron devices' device
meant 'hedron render scene.json' scene.json
meant 'hedron render' --cpu render
meant 'hedron help completion' completion
meant 'hedron help man' man
meant 'hedron --version' version
meant 'hedron help' hlep
meant --size render --siz=32x24
meant --samples --sample 3
meant --schema check --shema
meant 'hedron help completion' help completions
expect_refusal 2 "$hedron" nonsense </dev/null
expect_stderr_contains "see 'hedron help'"
expect_refusal 2 "$hedron" render --nonsense
expect_stderr_contains "see 'hedron help render'"

expect_refusal 2 "$hedron" devices --size 1x1
expect_stderr_contains "see 'hedron help devices'"
expect_refusal 2 "$hedron" scenes/classic.in </dev/null
expect_stderr_contains 'the classic mode reads standard input: hedron --cpu < scenes/classic.in'
expect_refusal 2 "$hedron" render --set camera.frames=1 --frames 3 -o none.data
expect_stderr_contains 'the scene has one frame, 0'

# ---- short forms, and the end of the options
expect_exit 0 "$hedron" -V
expect_stdout_lines 1 'hedron [0-9.]+'
expect_exit 0 "$hedron" render --quiet --backend c "${small[@]}" --frames 0 -oshort.data
rm short.data
expect_refusal 2 "$hedron" render -o=short.data
expect_refusal 2 "$hedron" check -- --schema
expect_stderr_contains "--schema"
expect_refusal 2 "$hedron" check --

# ---- options that exclude each other
for command in render ''; do
    # shellcheck disable=SC2086 # a command or none
    expect_refusal 2 "$hedron" $command --quiet --verbose </dev/null
    expect_stderr_contains 'only one of --verbose and --quiet'
done
expect_refusal 2 "$hedron" check
expect_refusal 2 "$hedron" check --schema scene.json
expect_refusal 2 "$hedron" convert one.in two.in
expect_refusal 2 "$hedron" convert -o one.json -o two.json
expect_refusal 2 "$hedron" devices word
for value in abc =1 ''; do
    expect_refusal 2 "$hedron" render --set "$value"
    expect_stderr_contains --set
done

# ---- nothing at all: neither a terminal nor an input
expect_refusal 2 "$hedron" </dev/null

# ---- none of the wrong ones left anything behind
rm -f picture.data
rm -r out
expect_files .
finish
