#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# --stats: a line of JSON for each frame, and failing files.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

command -v jq >"$logs/which" || skip "there is no jq"
use_official_input
render=("$hedron" render --quiet --backend c "${small[@]}")

expect_json() { # FILE FILTER EXPECTED: the result of jq on all lines together
    [[ $(jq -c -s "$2" "$1" 2>&1) == "$3" ]] || fail "$1: $2 is $(jq -c -s "$2" "$1"), expected $3"
}

# ---- a file, in a folder that is made
expect_exit 0 "${render[@]}" --samples 2 --frames 3-5 -o '##.data' --stats new/stats.jsonl
expect_stdout_lines 1 '##\.data'
expect_silent_stderr
expect_json new/stats.jsonl 'map(.frame)' '[3,4,5]'
# A frame's stages follow one another, and frames are traced one after the other.
expect_json new/stats.jsonl 'all(.[]; .began.prepare >= 0 and .began.trace >= .began.prepare + .seconds.prepare - 1e-6
    and .began.copy >= .began.trace and .began.store >= .began.copy + .seconds.copy - 1e-6)' true
expect_json new/stats.jsonl 'map(.began.trace) | . == sort' true
expect_json new/stats.jsonl 'map([.backend, .width, .height, .samples, .depth, .rays.primary]) | unique' '[["c",32,24,2,2,3072]]'
expect_json new/stats.jsonl 'all(.[]; .seconds | all(.[]; . >= 0) and .trace > 0 and .store > 0)' true
# Only films need a frame in 8 bits.
expect_json new/stats.jsonl 'map([.seconds.convert, .seconds.film, .began.convert, .began.film]) | unique' '[[0,0,null,null]]'
# Plain C has lanes and no launches.
expect_json new/stats.jsonl 'all(.[]; (.renderer | test("lane")) and .longest_launch_ms == null)' true
# Another run replaces the file; standard output then has nothing else.
expect_exit 0 "${render[@]}" --frames 7 -o a.data --stats new/stats.jsonl
expect_json new/stats.jsonl 'map(.frame)' '[7]'
expect_exit 0 "${render[@]}" --frames 0-1 -o '##.data' --stats -
expect_stdout_lines 2 '\{.*\}'
rm -r new ./*.data

# ---- the classic mode: the same counts as in its lines
expect_exit 0 "$hedron" --cpu "${small[@]}" --frames 0-2 --stats stats.jsonl <"$work/official.in"
expect_stdout_lines 3
expect_same <(cut -f 1,3 "$logs/stdout") \
    <(jq -r '[.frame, .rays.primary + .rays.mirrored + .rays.transmitted] | @tsv' stats.jsonl)
rm -r out stats.jsonl
expect_refusal 2 "$hedron" --cpu "${small[@]}" --frames 0 --stats - <"$work/official.in"

# ---- films, and a reader that goes away: it ends the program, but only after cleaning up
if has_ffmpeg; then
    expect_exit 0 "${render[@]}" --frames 0-1 -o film.mkv --stats stats.jsonl
    expect_json stats.jsonl 'all(.[]; .seconds.convert > 0 and .seconds.film > 0 and .seconds.store == 0 and .began.store == null
        and .began.film >= .began.convert + .seconds.convert - 1e-6)' true
    rm film.mkv stats.jsonl
    mkfifo "$work/pipe"
    # Descriptor 4 is a pipe that nobody reads.
    exec 3<>"$work/pipe"
    exec 4>"$work/pipe" 3<&-
    code=0
    "${render[@]}" --frames 0-1 -o film.mkv --stats - >&4 2>"$logs/stderr" || code=$?
    ((code == 1)) || fail "exit code $code, expected 1"
    expect_sentence
    expect_stderr_contains 'cannot write the statistics to standard output'
    expect_files .
    # If only the messages are lost, the film is made.
    "$hedron" render --verbose --backend c "${small[@]}" --frames 0-1 -o film.mkv >"$logs/stdout" 2>&4 ||
        fail 'nothing is made without a reader of standard error'
    exec 4>&-
    expect_files . film.mkv
    rm film.mkv
fi

# ---- files that cannot be written, or are full
mkdir folder
for file in /dev/null/stats.jsonl folder; do
    expect_refusal 1 "${render[@]}" --frames 0 -o a.data --stats "$file"
    expect_stderr_contains "${file%/stats.jsonl}"
done
rmdir folder
expect_files .
expect_refusal 1 "${render[@]}" --frames 0-1 -o '##.data' --stats /dev/full
expect_stderr_contains 'cannot write the statistics to /dev/full: No space left on device'
# The frame was stored before its line, and the other one may be that was ready with it.
for file in 00.data ./*.data; do
    expect_data "$file" 32 24
done
rm ./*.data

# ---- files that the run reads or writes otherwise, and text that is no statistics
"$hedron" convert "$work/official.in" -o scene.json
cp scene.json "$work/scene.json"
ln -s scene.json link.json
for file in scene.json ./scene.json link.json; do
    expect_refusal 2 "${render[@]}" scene.json --frames 0 -o a.data --stats "$file"
    expect_stderr_contains 'which is the scene'
done
expect_refusal 2 "${render[@]}" --frames 0 -o a.data --stats scene.json
expect_stderr_contains "--stats is 'scene.json', which has other JSON in it"
expect_same scene.json "$work/scene.json"
for file in a07.data ./new/../a07.data; do
    expect_refusal 2 "${render[@]}" --frames 7 -o 'a##.data' --stats "$file"
    expect_stderr_contains 'which is an output'
done
# A failed start leaves an earlier file unchanged.
echo '{"frame":0}' >stats.jsonl
expect_refusal 3 "${render[@]}" --device 'no such device' --frames 0 -o a.data --stats stats.jsonl
[[ $(<stats.jsonl) == '{"frame":0}' ]] || fail 'a start that failed wrote to the statistics'
rm scene.json link.json stats.jsonl

expect_files .
finish
