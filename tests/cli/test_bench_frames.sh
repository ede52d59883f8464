#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/frames: its arithmetic on made-up statistics, its outputs, and what it refuses.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
bench=$(realpath "$cli_folder/../../bench/frames")

# expect_value FILE EXPRESSION EXPECTED: what Python makes of the result `r`.
expect_value() {
    local found
    found=$(python3 -c '
import json, sys
r = json.load(open(sys.argv[1], encoding="utf-8"))
jobs = {job["device"]: job for job in r["measurements"]}
d = {device["backend"] + ":" + str(device["index"]): {**device, **jobs.get(device["label"], {})} for device in r["devices"]}
print(json.dumps(eval(sys.argv[2])))' "$1" "$2" 2>&1) || true
    if [[ $found != "$3" ]]; then
        fail "$2 is $found, expected $3"
    fi
}

expect_charts() {
    local name
    for name in frames frames_animation; do
        expect_svg "$1/$name.svg"
    done
}

# A program that has three devices and says what FAKE_* tell it to. Milliseconds of tracing are those of
# a table; every frame has 3000 rays and 8000 shadow tests, and copying, storing and so on take 1 ms.
mkdir fake
cat >fake/hedron <<'FAKE'
#!/usr/bin/env bash
set -euo pipefail
device() {
    printf '{"backend": "%s", "index": %s, "name": "%s", "driver": "none", "is_cpu": true, "compute_units": 0,
        "clock_mhz": 0, "has_double": true, "unusable": %s, "not_strict": null}' "$@"
}
case $1 in
--version) echo 'hedron 9.8.7' ;;
devices)
    printf '{"backends": [{"name": "cuda", "available": false, "reason": "no driver here", "devices": []},
        {"name": "opencl", "available": true, "reason": null, "devices": [%s, %s]},
        {"name": "c", "available": true, "reason": null, "devices": [%s]}]}\n' \
        "$(device opencl 0 "Fast_{1}^@ \`Card' %d" null)" "$(device opencl 1 Old '"too old"')" \
        "$(device c 0 Plain null)"
    ;;
render)
    while (($# > 0)); do
        case $1 in
        --backend) backend=$2 ;;
        --frames) frames=$2 ;;
        esac
        shift
    done
    echo "$backend" >>"$FAKE_LOG"
    run=$(grep -c "^$backend" "$FAKE_LOG")
    case ${FAKE_MODE:-} in
    "bad $backend") printf 'hedron: the scene is bad\n' >&2; exit 2 ;;
    "missing $backend") printf 'hedron: the card is gone\n' >&2; exit 3 ;;
    "broken $backend") printf 'hedron: the card burns\n' >&2; exit 1 ;;
    esac
    case "$backend $run" in
    'opencl 1') times=(99 2 4) ;;
    'opencl 2') times=(77 10 20) ;;
    'c 1') times=(500 100 200) ;;
    *) times=(600 300 400) ;;
    esac
    [[ $frames != 7 ]] || times=(5)
    for frame in "${!times[@]}"; do
        picture=$frame
        [[ ${FAKE_MODE:-} != "wrong $backend" || $frame != 2 ]] || picture=wrong
        echo "$picture" >"000000$frame.data"
        printf '{"frame":%d,"backend":"%s","device":"x","renderer":"made up","width":64,"height":48,"samples":2,
            "depth":5,"seconds":{"prepare":0.0001,"trace":%s,"copy":0.0002,"convert":0,"store":0.0007},
            "rays":{"primary":1000,"mirrored":1500,"transmitted":500},"shadow_tests":8000,"clamps":0}' \
            "$frame" "$backend" "$(awk -v ms="${times[frame]}" 'BEGIN { print ms / 1000 }')" | tr -d '\n' >>stats.jsonl
        echo >>stats.jsonl
        # Ctrl-C is pressed in the second run, after two frames, and this program obeys at once.
        if [[ ${FAKE_MODE:-} == interrupt && $backend == c && $frame == 1 ]]; then
            trap 'exit 130' INT
            kill -INT "$PPID"
            for ((wait = 0; wait < 200; wait++)); do sleep 0.1; done
        fi
    done
    ;;
esac
FAKE
chmod +x fake/hedron
export FAKE_LOG=$work/fake.log

# fake_bench CODE MODE OPTIONS...
fake_bench() {
    local expected=$1 mode=$2
    shift 2
    rm -rf "$FAKE_LOG" out
    FAKE_MODE=$mode expect_exit "$expected" timeout "$patience" "$bench" --hedron fake/hedron --out out "$@"
}

# ---- the arithmetic: the first frame of each run does not count
fake_bench 0 '' --repeats 2 --frames 0-2
expect_same "$FAKE_LOG" <(printf '%s\n' opencl c opencl c)
expect_charts out
near='lambda value, expected: abs(value - expected) < 1e-9 * expected'
# 2 4 10 20 and 100 200 300 400
for check in 'opencl:0 trace_ms 7 3.5 12.5' 'c:0 trace_ms 250 175 325'; do
    read -r device key median q1 q3 <<<"$check"
    expect_value out/frames.json "[($near)(d['$device']['summary']['$key'][k], e)
        for k, e in (('median', $median), ('q1', $q1), ('q3', $q3))]" '[true, true, true]'
done
# Rates are 3000 rays in 2, 4, 10, 20 ms: 1.5, 0.75, 0.3 and 0.15 million a second.
for check in frame_ms=8 frames_per_second=125 rays_per_second=525000 shadow_tests_per_second=1400000 \
    ratio_to_fastest=1; do
    expect_value out/frames.json "($near)(d['opencl:0']['summary']['${check%=*}'], ${check#*=})" true
done
expect_value out/frames.json "($near)(d['c:0']['summary']['ratio_to_fastest'], 250 / 7)" true
expect_stdout_contains 'Fast_{1}^@'
for line in '^opencl .* 7\.000 \[3\.500\.\.12\.50\] +8\.000 +125\.0 +0\.5250 +1\.400 +1\.00$' \
    '^c  .* 250\.0 \[175\.0\.\.325\.0\] +251\.0 +3\.984 +0\.01250 +0\.03333 +35\.7$' \
    '^cuda cannot run: no driver here$' '^opencl:1 cannot run: too old$' \
    '^The pictures of opencl:0, c:0 are the same bytes\.$'; do
    if (($(grep -c -E "$line" "$logs/stdout") != 1)); then
        fail "the table has no line like $line"
        show_logs
    fi
done

# ---- the keys that bench/README.md tells of
expect_value out/frames.json 'list(r)' '["hedron_bench", "bench", "complete", "date", "quick", "repeats", "hedron", "machine", "devices", "pictures", "failures", "scene", "rows", "measurements", "frames"]'
expect_value out/frames.json '[r["hedron_bench"], r["complete"], r["hedron"]]' '[1, true, {"version": "9.8.7", "options": []}]'
expect_value out/frames.json '[list(r["machine"]), len(r["machine"]["load_after"])]' \
    '[["cpu", "cores", "system", "load_before", "load_after"], 3]'
expect_value out/frames.json 'r["scene"]' \
    '{"name": "built-in scene", "width": 64, "height": 48, "samples": 2, "depth": 5, "rays_per_frame": 3000.0}'
expect_value out/frames.json '[[run["repeat"], [frame["warm_up"] for frame in run["frames"]]] for run in d["c:0"]["runs"]]' \
    '[[0, [true, false, false]], [1, [true, false, false]]]'
expect_value out/frames.json 'list(d["c:0"]["runs"][0]["frames"][0])' \
    '["frame", "width", "height", "samples", "depth", "seconds", "rays", "shadow_tests", "warm_up", "picture"]'
expect_value out/frames.json '[d["cuda:None"]["reason"], d["opencl:1"]["reason"], d["c:0"]["reason"]]' \
    '["no driver here", "too old", null]'

# ---- one device, one run, options for hedron
fake_bench 0 '' --device c --repeats 1 -- --math fast
expect_same "$FAKE_LOG" <(echo c)
expect_stdout_contains 'not compared: --math fast'
expect_value out/frames.json '[r["hedron"]["options"], r["pictures"]["same"], len(r["devices"])]' '[["--math", "fast"], null, 1]'
fake_bench 0 '' --device opencl:0 --device c:0 --repeats 1
expect_same "$FAKE_LOG" <(printf '%s\n' opencl c)

# ---- a wrong picture is told, also where it is fast; a device that fails leaves the others
fake_bench 1 'wrong opencl' --repeats 1
expect_stdout_contains 'THE PICTURES DIFFER, so these times are no result: frame 2, opencl:0 / c:0.'
expect_value out/frames.json 'r["pictures"]["same"]' false
fake_bench 1 'broken opencl' --repeats 2
expect_same "$FAKE_LOG" <(printf '%s\n' opencl c c)
expect_stdout_contains 'opencl:0 failed: the card burns'
expect_value out/frames.json '[d["opencl:0"]["failed"], d["opencl:0"]["summary"], d["c:0"]["summary"]["frames"]]' '[true, null, 4]'
fake_bench 0 'missing opencl' --repeats 1
expect_stdout_contains 'opencl:0 cannot run: the card is gone'
fake_bench 3 'missing c' --repeats 1 --device c
# A chart of another run does not stay.
fake_bench 3 '' --device cuda
expect_stdout_contains 'cuda cannot run: no driver here'
touch out/frames.svg
expect_exit 3 "$bench" --hedron fake/hedron --out out --device cuda
expect_files out frames.json

# ---- Ctrl-C leaves what was measured
fake_bench 130 interrupt --repeats 2
expect_same "$FAKE_LOG" <(printf '%s\n' opencl c)
expect_stdout_contains Interrupted
expect_value out/frames.json '[r["complete"], d["opencl:0"]["summary"]["frames"], d["c:0"]["summary"]["frames"]]' '[false, 2, 1]'

# ---- wrong usage
# expect_bench_refusal CODE TEXT OPTIONS...
expect_bench_refusal() {
    local expected=$1 text=$2
    shift 2
    rm -rf out
    expect_exit "$expected" timeout "$patience" "$bench" --out out "$@"
    expect_stderr_contains "$text"
    expect_stdout_lines 0
}
fake=(--hedron fake/hedron)
expect_bench_refusal 2 'unrecognized arguments: --wrong' "${fake[@]}" --wrong
expect_bench_refusal 2 "invalid number from 1 on value: '0'" "${fake[@]}" --repeats 0
expect_bench_refusal 2 'there is no scene file missing.json' "${fake[@]}" missing.json
expect_bench_refusal 2 "--device is 'metal'" "${fake[@]}" --device metal
expect_bench_refusal 2 "--device is 'c:x'" "${fake[@]}" --device c:x
expect_bench_refusal 3 "--device is 'c:7'" "${fake[@]}" --device c:7
expect_bench_refusal 2 '--stats=x cannot stand after --' "${fake[@]}" -- --stats=x
expect_bench_refusal 2 'at least two frames' "${fake[@]}" --frames 7
FAKE_MODE='bad c' expect_bench_refusal 2 'the scene is bad' "${fake[@]}"
expect_bench_refusal 2 './dev build' --hedron no/hedron
expect_bench_refusal 1 'cannot make the folder' "${fake[@]}" --out fake/hedron/out

# ---- the program itself, on a tiny scene file; in a folder whose name would be a pattern
mkdir '##%d'
use_official_input
expect_exit 0 "$hedron" convert -o '##%d/tiny.json' "$work/official.in"
devices=(--device c)
if has_opencl; then
    devices+=(--device opencl)
fi
TMPDIR="$PWD/##%d" expect_exit 0 "${no_nvidia[@]}" "$bench" --hedron "$hedron" --out 'new/##%d' \
    "${devices[@]}" --repeats 2 --frames 3,5 '##%d/tiny.json' -- "${small[@]}"
expect_charts 'new/##%d'
expect_files '##%d' tiny.json
expect_value 'new/##%d/frames.json' '[r["scene"]["name"], r["scene"]["width"], r["scene"]["samples"]]' '["tiny", 32, 1]'
expect_value 'new/##%d/frames.json' '[r["complete"], r["pictures"]["same"] is not False]' '[true, true]'
expect_value 'new/##%d/frames.json' '[frame["frame"] for frame in d["c:0"]["runs"][1]["frames"]]' '[3, 5]'
if (($(grep -c -E '^(c|opencl) +[0-9]+  .*\[.*\.\..*\]' "$logs/stdout") != \
    $(python3 -c 'import json; print(sum(d["summary"] is not None for d in json.load(open("new/##%d/frames.json"))["measurements"]))'))); then
    fail "the table has not one line for each device"
    show_logs
fi
if has_opencl; then
    expect_stdout_contains 'are the same bytes'
fi
expect_exit 2 timeout "$patience" "$bench" --hedron "$hedron" --out out --device c --frames 5-3
finish
