#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A tiny run of every program that bench/study names, and its refusals; their arithmetic on made-up numbers.
set -euo pipefail
# shellcheck source=bench_lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/bench_lib.sh"

mkdir arithmetic
(cd arithmetic && python3 -B "$cli_folder/bench_arithmetic.py" "$project" "$hedron") || fail "figures do not follow from made-up numbers"

# expect_run NAME OPTION...: on plain C, quickly; the result is NAME/NAME.json, beside tables for documents.
expect_run() {
    local name=$1
    shift
    expect_exit 0 "${no_nvidia[@]}" "$bench" "$name" --hedron "$hedron" --out "$name" "$@"
    expect_value "$name/$name.json" '[r[key] for key in ("hedron_bench", "bench", "complete", "failures")]' "[1, \"$name\", true, []]"
    [[ -s $name/$name.md ]] || fail "there are no tables of $name for documents"
}

# ---- speed: figures with their targets; FFmpeg's settings; the loops' rates
expect_run speed --device c --quick --repeats 1 --parts headline,headline_film,math -- "${small[@]}"
expect_stdout_contains 'CHANGED by --size 32x24'
expect_value speed/speed.json '[rows["headline c:0"]["figure"] > 0, rows["headline c:0"]["verdict"], rows["headline c:0"]["count"] // 2, [rows["headline nowhere"][key] for key in ("least", "aim", "reason")], "math c:0" in rows]' \
    '[true, null, 2, [1, 0.4, "no H200 here"], false]'
if has_ffmpeg; then
    expect_value speed/speed.json '[r["film"]["preset"], sorted({len(run["frames"]) for job in r["measurements"] for run in job["runs"] if job["output"] == "film.mp4"})]' \
        '["superfast", [4, 16]]'
fi
# The scene of the classic example equals the classic input, except for the texture and the frames' folder.
use_official_input
expect_exit 0 "$hedron" convert "$work/official.in" -o official.json
expect_same <(jq -S 'del(.floor.texture, .output, ."$schema", ."$comment")' official.json) \
    <(jq -S 'del(.floor.texture, .output, ."$schema", ."$comment")' "$project/scenes/official.json")
expect_bench_refusal 3 'no GPU whose lanes are known' predict speed/speed.json

# ---- accuracy: more samples are closer to the reference, less depth is farther off; an equal picture is equally far
expect_run accuracy --device c --quick --size 16x12 --parts settings,arithmetic,choices
expect_stdout_contains 'The same bytes from every device and pipeline'
expect_value accuracy/accuracy.json '[rows["not_finite nowhere"]["verdict"], rows["arithmetic c:0"]["figure"] > 99]' '["aim", true]'
expect_value accuracy/accuracy.json '(lambda rmse, truth: [rmse["grid 1"] > rmse["grid 4"], rmse["depth 4"] > rmse["depth 30"], rmse["mega"] == rmse["wavefront"] == rmse["grid 4"], 0 < truth["to_quarter_of_samples"]["rmse"] < rmse["grid 1"], truth["missing"]["largest"] <= truth["max_error"]])({point["name"]: point["rmse"] for point in r["points"]}, r["truth"])' \
    '[true, true, true, true, true]'
expect_value accuracy/accuracy.json '(lambda off: [off["double"], 0 < off["float"] < 0.1, off["triangles"] > off["float"]])({each["way"]: each["rmse"] for each in r["choices"]})' \
    '[0.0, true, true]'
expect_svg accuracy/accuracy_c0_{rmse,largest}.svg

# ---- triangles
expect_run triangles --device c --quick --repeats 1 --most 1000 --parts sweep,primary -- --size 32x24 --samples 1
expect_stdout_contains 'The same bytes from every device and pipeline, in 16 frames made in two ways or more.'
expect_value triangles/triangles.json '[[[each["way"], each["triangles"]] for each in r["sweep"] if each["trace_ms"]["median"] > 0][::3], rows["primary c:0"]["figure"] > 0, r["leaks"]]' \
    '[[["bvh", 12], ["bvh", 972], ["brute", 108]], true, null]'
expect_svg triangles/triangles.svg

# ---- pipelines
expect_run pipelines --device c --quick --repeats 1 -- "${small[@]}"
expect_stderr_contains '; the time left is known after this run'
expect_stderr_contains 'run 2 of 9: c:0, '
expect_stderr_contains ' left of the timing'
expect_value pipelines/pipelines.json '[[e["pipeline"], e["ratio_to_mega"] == 1] for e in r["pipelines"] if e["processor_ratio_to_mega"] > 0][6:] + [len(r["pipelines"])]' \
    '[["mega", true], ["wavefront", false], ["wavefront-uncompacted", false], 9]'
expect_svg pipelines/pipelines.svg

# ---- devices that share the frames; pictures that differ are no result
devices=(--device c:0)
expected='[[1],true]'
if has_opencl; then
    devices+=(--device opencl:0)
    expected='[[1,2],true]'
fi
devices+=(--frames 4 --repeats 1 "$project/scenes/default.json")
expect_run devices "${devices[@]}" -- "${small[@]}"
expect_same <(jq -c '[[.rates[].devices], all(.rates[]; .runs | length == 1)]' devices/devices.json) <(echo "$expected")
if has_opencl; then
    printf '#!/bin/sh\n"%s" "$@" || exit\ncase "$*" in *0-7*) printf x >>0000000.data ;; esac\n' "$hedron" >wrong
    chmod +x wrong
    expect_exit 1 "${no_nvidia[@]}" "$bench" devices --hedron wrong --out out "${devices[@]}" -- "${small[@]}"
    expect_stderr_contains 'frame 0 of 2 devices is another picture than before'
fi

# ---- the bound of --max-error, on scenes with few bright samples in a pixel; a program that states a third of it
expect_run promise --first 215 --scenes 12
expect_value promise/promise.json '[sum(e["stated"] is not None for e in r["scenes"]), any(e["missed"] > 5 for e in r["scenes"])]' '[12, true]'
cat >liar <<END
#!/usr/bin/env bash
"$hedron" "\$@" || exit
if [[ \$* == *--stats* ]]; then
    jq -c '.missing.largest /= 3' stats.jsonl >third
    mv third stats.jsonl
fi
END
chmod +x liar
expect_exit 1 "$bench" promise --hedron liar --out out --first 215 --scenes 10
expect_stdout_contains 'FAILED: --max-error, scene '

# ---- a hedron without the other programs beside it: reasons, no figures
printf '#!/bin/sh\nexec "%s" "$@"\n' "$hedron" >alone
chmod +x alone
expect_exit 0 "${no_nvidia[@]}" "$bench" triangles --hedron alone --out out --device c --quick
expect_stdout_contains 'here/hedron_model: ./dev build builds it'
expect_stdout_contains 'here/tests/leak_hunt/hedron_leak_hunt: ./dev build builds it'
expect_value out/triangles.json 'all(row["reason"] for row in r["rows"])' true

# ---- wrong usage
expect_bench_refusal 2 'a part that is none of' accuracy --hedron "$hedron" --out out --parts wrong
expect_bench_refusal 2 './dev build' speed --hedron no/hedron --out out
expect_bench_refusal 2 'cannot stand after --' triangles -- --accel=brute
expect_bench_refusal 2 "options of hedron render go behind --, as in 'bench/study pipelines -- --size 320x180'" pipelines --samples 2
expect_bench_refusal 2 'unrecognized arguments: -o' pipelines -o out
! grep -q 'go behind --' "$logs/stderr" || fail 'an option that cannot stand behind -- is sent there'
expect_bench_refusal 2 'at least 3 frames' devices --frames 2
finish
