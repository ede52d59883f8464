#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# 'hedron tune': its measurements and output, that later runs use its result, and that pictures do not depend on it. The unit
# tests cover which runs it applies to (choice/test_measured_choice).
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

export HEDRON_CACHE=$work/cache
tune=("$hedron" tune --backend c --threads 1 "${small[@]}")
render=("$hedron" render --backend c --threads 1 "${small[@]}" --frames 0 --verbose -o picture.data)

# expect_launch WORDS OPTION...: a rendering reports that it uses this; "": that it uses nothing; the picture is unchanged.
expect_launch() {
    expect_exit 0 "${render[@]}" "${@:2}"
    [[ $(sed -n 's/^launch *//p' "$logs/stderr") == "${1:+$1: the best for this kind of scene, by 'hedron tune'}" ]] ||
        fail "standard error does not say that '$1' is remembered"
    expect_same picture.data expected.data
}

"$hedron" render --backend c "${small[@]}" --frames 0 --quiet -o expected.data >"$logs/stdout"
expect_launch ''

# ---- the table: a line for each candidate, and the best one
expect_exit 0 "${tune[@]}"
expect_silent_stderr
mapfile -t lanes < <(lanes_there float)
some=${lanes[-1]}
number='[0-9]+\.[0-9]{3}'
if ! head -n 1 "$logs/stdout" | grep -q -x -E 'the built-in scene on c 0, .*' ||
    ! sed -n 2p "$logs/stdout" | grep -q -x -E 'pictures of 32 x 24 pixels, [0-9]+ x [0-9]+ samples' ||
    (($(grep -c -x -E "(mega|wavefront)(, (4|8|16) lanes)? +$number +$number" "$logs/stdout") != 1 + ${#lanes[@]})) ||
    ! grep -q -x -E "mega +$number +1\.000" "$logs/stdout"; then
    fail 'the table has other candidates'
fi
best=$(sed -n 's/^the best: \(.*\); remembered for scenes of this kind$/\1/p' "$logs/stdout")
[[ -n $best ]] || fail "the table does not name the best"

# ---- later runs use it, with the same bytes; their own options come first
expect_launch "$best"
grep -q -E "^renderer .*, ${best%%,*}$" "$logs/stderr" || fail "the remembered choice is not used"
expect_launch '' --pipeline wavefront

# ---- a scene from standard input, and JSON
expect_exit 0 "${tune[@]}" --json --lanes "$some" --frames 3 --set camera.field_of_view=40 - \
    < <("$hedron" convert < <("$hedron" --default))
expect_silent_stderr
if [[ $(jq -c '[.scene, .backend, .index, .width, .height, .remembered, .reason, (.candidates | map([.pipeline, .lanes,
        .block, .grid, .registers, .failure])), (.candidates[0].ratio == 1), (.best | . == 0 or . == 1),
        (.candidates | all(.ms > 0 and .ratio > 0))]' "$logs/stdout") != '["standard input","c",0,32,24,true,null,[["mega",'"$some"',null,null,null,null],["wavefront",'"$some"',null,null,null,null]],true,true,true]' ]]; then
    fail "the JSON is another"
fi

# ---- nothing can be remembered
expect_exit 0 env HEDRON_CACHE=off "${tune[@]}" --lanes "$some" --json
expect_stdout_contains '"reason": "HEDRON_CACHE is off"'
expect_exit 1 env HEDRON_CACHE=/dev/null "${tune[@]}" --lanes "$some"
expect_stdout_contains '; not remembered: cannot use the folder /dev/null: it is not a folder'
expect_stderr_contains 'hedron: cannot use the folder /dev/null: it is not a folder'

# ---- errors
expect_refusal 2 "${tune[@]}" none.json
expect_stderr_contains 'none.json'
expect_refusal 2 "${tune[@]}" --frames 9999
expect_refusal 3 "${tune[@]}" --device 7
expect_stderr_contains "see 'hedron devices'"
finish
