#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/study and bench/frames on made-up statistics: figures, continuation after a kill, the page, refusals; bench/compare of
# two studies; and a tiny study of the program itself.
set -euo pipefail
# shellcheck source=bench_lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/bench_lib.sh"

# A program with three devices of the CPU kind, of which one is unusable, and a GPU. A frame takes 10 ms of tracing on c, 20 on
# opencl and 1 on cuda; 100 lights add 5. Each frame after the first takes more than the one before. It logs its arguments. In
# the run whose number the file `hold` has, it waits after two frames until it is killed.
mkdir fake
cat >fake/hedron <<'FAKE'
#!/usr/bin/env bash
set -euo pipefail
device() {
    printf '{"backend": "%s", "index": %s, "name": "Made up", "driver": "%s", "is_cpu": %s, "compute_units": 2,
        "clock_mhz": %s, "has_double": true, "unusable": %s, "not_strict": null}' "$1" "$2" "$3" "$4" $((1000 + RANDOM)) "$5"
}
case $1 in
--version) echo 'hedron 9.8.7' ;;
devices)
    printf '{"backends": [{"name": "cuda", "available": true, "reason": null, "devices": [%s]},
        {"name": "opencl", "available": true, "reason": null, "devices": [%s, %s]},
        {"name": "c", "available": true, "reason": null, "devices": [%s]}]}\n' "$(device cuda 0 sm_90 false null)" \
        "$(device opencl 0 none true null)" "$(device opencl 1 none true '"too old"')" "$(device c 0 none true null)"
    ;;
render)
    words="${*:3}" last=${*: -1}
    while (($# > 0)); do
        case $1 in
        --backend) backend=$2 ;;
        --frames) frames=$2 ;;
        -o) output=$2 ;;
        esac
        shift
    done
    echo "$backend ${words/"$last"/"${last##*/}"}" >>"$FAKE_LOG"
    mapfile -t runs <"$FAKE_LOG"
    case "${FAKE_MODE:-} $backend" in
    'broken opencl opencl') printf 'hedron: the card burns\n' >&2; exit 1 ;;
    'missing opencl opencl') printf 'hedron: the card is gone\n' >&2; exit 3 ;;
    esac
    case $backend in c) ms=10 ;; opencl) ms=20 ;; *) ms=1 ;; esac
    [[ $last != *lights-100.json ]] || ms=$((ms + 5))
    [[ $frames != *-* ]] || eval "frames={${frames%-*}..${frames#*-}}"
    for frame in $(eval "echo ${frames//,/ }"); do
        if [[ ($frame == 2 || $words == *--reference*) && -e $FAKE_HOLD && $(<"$FAKE_HOLD") == "${#runs[@]}" ]]; then
            trap 'exit 130' INT
            echo $$ >"$FAKE_HOLD.held"
            for ((wait = 0; wait < 6000; wait++)); do sleep 0.1; done
        fi
        picture=$frame
        [[ ${FAKE_MODE:-} != wrong || $backend != opencl || $frame != 1 ]] || picture=wrong
        [[ $output != *.data ]] || echo "$picture" >"000000$frame.data"
        printf '{"frame":%d,"backend":"%s","device":"x","renderer":"16 lanes, avx512","width":64,"height":48,"samples":2,"depth":5,"seconds":{"prepare":0.0001,"trace":%d.%03d,"copy":0.0002,"convert":0,"store":0.0007,"film":0},"began":{"prepare":0.001,"trace":0.0011,"copy":0.003,"convert":null,"store":0.004,"film":null},"rays":{"primary":1000,"mirrored":1500,"transmitted":500},"shadow_tests":8000,"clamps":0}\n' \
            "$frame" "$backend" $((ms / 1000)) $((ms % 1000)) >>stats.jsonl
        ms=$((ms + 1))
    done
    ;;
esac
FAKE
chmod +x fake/hedron
export FAKE_LOG=$work/fake.log FAKE_HOLD=$work/hold
study=("$bench" --hedron fake/hedron --others 100 --results none --quick --machine 'Made & up') # no run is rejected

# fake_study CODE MODE OPTIONS...
fake_study() {
    FAKE_MODE=$2 expect_exit "$1" timeout "$time_limit" "${study[@]}" "${@:3}"
}

# hold_in RUN COMMAND...: starts it and waits for its run with that number in the log. Sets `pid`, and `held`.
hold_in() {
    rm -f "$FAKE_LOG" "$FAKE_HOLD.held"
    echo "$1" >"$FAKE_HOLD"
    shift
    start "$@"
    wait_until 60 test -s "$FAKE_HOLD.held" || fail "the program was not run so often"
    rm "$FAKE_HOLD"
    held=$(<"$FAKE_HOLD.held")
}

# expect_in FILE TEXT...
expect_in() {
    local text
    for text in "${@:2}"; do
        grep -q -F -e "$text" "$1" || fail "$1 lacks $text"
    done
}

# ---- figures: the first frame warms up, and CPUs' smaller pictures count so many times
parts=lights,lanes,official
fake_study 0 '' --out one --parts $parts
expect_value one/study.json '[[r[key] for key in ("hedron_bench", "bench", "complete", "quick", "repeats", "failures")], r["machine"]["name"]]' \
    '[[1, "study", false, true, 2, []], "Made & up"]'
# Frames 1 and 2 of the CPUs: 11 and 12, and 16 times that; of the GPU 2 and 3.
expect_value one/study.json '[ms("lights", "", 10, "c:0"), ms("lights", "", 100, "c:0"), ms("lights", "", 10, "opencl:0"), ms("lights", "", 10, "cuda:0"), ms("official", "", 0, "cuda:0"), ms("official", "", 0, "cuda:0", what="frame_ms")]' \
    '[184.0, 264.0, 344.0, 2.5, 5.0, 5.3]'
expect_value one/study.json '[r["missing"]["samples"], {*"lights lanes official".split()}.isdisjoint(r["missing"]), r["pictures"]["same"], sorted({key[3] for key in m if key[0] == "lanes"}), read("one/study.csv").count("\n") - len(m)]' \
    '["it was not asked for", true, true, ["c:0", "opencl:0"], 1]'
# Points are interleaved: a round of all, then the next.
expect_same <(head -n $(($(wc -l <"$FAKE_LOG") / 2)) "$FAKE_LOG") <(tail -n $(($(wc -l <"$FAKE_LOG") / 2)) "$FAKE_LOG")
expect_svg one/study_{official,lights,lanes}.svg
expect_in one/report.html 'Made &amp; up' 'same bytes from every device' 'nothing was measured of' '<figure id="study_'{official,lights,lanes}'"'

# ---- killed after some runs were saved, and continued: the killed run is repeated, and no other
mv "$FAKE_LOG" whole.log
hold_at=$(($(wc -l <whole.log) / 2 + 6)) # in the second round
hold_in $hold_at "${study[@]}" --out killed --parts $parts
kill -KILL -- "-$pid"
kill -KILL -- "-$held" 2>"$logs/kill" || kill -KILL "$held"
wait "$pid" 2>"$logs/kill" || true
cp killed/study.json saved.json
expect_value saved.json '[r["complete"], sum(len(e["runs"]) for e in r["measurements"])]' "[false, $((hold_at - 1))]"
fake_study 0 '' --report --out killed
expect_in killed/report.html unfinished
fake_study 0 '' --out killed --parts $parts
expect_same <(sed "${hold_at}p" whole.log) "$FAKE_LOG"
expect_value killed/study.json '(lambda old: [old["date"] == r["date"], r["pictures"]["same"], all(one["runs"] == other["runs"][:len(one["runs"])] for one, other in zip(old["measurements"], r["measurements"]))])(json.loads(read("saved.json")))' \
    '[true, true, true]'
# ---- saved results are not measured again
rm "$FAKE_LOG"
fake_study 0 '' --out one --parts lights
[[ ! -e $FAKE_LOG ]] || fail "it measured again: $(<"$FAKE_LOG")"

# ---- another program's figures are kept aside, not continued; --again measures everything
echo '# other bytes' >>fake/hedron
cp killed/study.json before.json
fake_study 0 '' --out killed --parts lights --device c
expect_stderr_contains 'another kind of study'
expect_same before.json killed/study.before.json
fake_study 0 '' --out killed --parts lights --device c --again
expect_value killed/study.json '[r["parts"], [len(e["runs"]) for e in r["measurements"]], read(os.environ["FAKE_LOG"]).count("\n")]' \
    '[["lights"], [2, 2, 2, 2], 16]'

# ---- Ctrl-C keeps all measurements, of bench/frames also a part of a run
frames=("$project/bench/frames" --hedron fake/hedron --out out)
hold_in 3 "${frames[@]}" --repeats 2
kill -INT "$pid"
expect_end 130
expect_stdout_contains Interrupted
expect_value out/frames.json '[r["complete"], *((e["summary"] or {}).get("frames") for e in r["measurements"])]' '[false, 4, 4, 1]'

# ---- interrupted before accuracy's reference is complete
hold_in 1 "${study[@]}" --out early --parts accuracy
kill -INT "$pid"
expect_end 130
expect_stdout_contains Interrupted
expect_in early/report.html unfinished

# ---- a wrong picture fails; a device that fails leaves the others
fake_study 1 wrong --out wrong --parts lights
expect_value wrong/study.json '[r["pictures"]["same"], r["complete"], max(len(e["runs"]) for e in r["measurements"])]' '[false, false, 1]'
expect_value wrong/study.json 'len(re.findall("class=\"wrong\">.*THE PICTURES DIFFER", read("wrong/report.html")))' 1
fake_study 1 'broken opencl' --out broken --parts lights
expect_value broken/study.json '[len(m["lights", "", 1, "c:0"]["runs"]), m["lights", "", 1, "opencl:0"]["reason"]]' '[2, "the card burns"]'
FAKE_MODE=wrong expect_exit 1 "${frames[@]}" --repeats 1
expect_stdout_contains 'THE PICTURES DIFFER, so these times do not count: frame 1, cuda:0, c:0 / opencl:0.'
FAKE_MODE='missing opencl' expect_exit 3 "${frames[@]}" --repeats 1 --device opencl
expect_files out frames.json # no chart of another run stays

# ---- bench/frames: the first frame of each run does not count, and rates are those of the median frame
expect_exit 0 "${frames[@]}" --repeats 2 --frames 0-2
expect_svg out/frames.svg out/frames_animation.svg
for line in '^c  .* 11\.50 \[11\.00\.\.12\.00\] +12\.50 +80\.00 +0\.2614 +0\.6970 +4\.60$' '^opencl:1 cannot run: too old$' \
    '^The pictures of cuda:0, opencl:0, c:0 are the same bytes\.$'; do
    (($(grep -c -E "$line" "$logs/stdout") == 1)) || { fail "the table has no line like $line"; }
done

# ---- bench/compare
expect_exit 0 "$project/bench/compare" --all one/study.json one/study.json
expect_stdout_contains '0 slower, 0 faster, 23 within the noise.'
expect_value one/study.json '[[run["frames"][1]["seconds"].update(trace=9) for e in r["measurements"] for run in e["runs"]], json.dump(r, open("slow.json", "w"))][1]' null
expect_exit 1 "$project/bench/compare" one/study.json slow.json
expect_stdout_contains ' slower, '
# ---- the page includes results of other machines; a copy of the own result does not count as another's
mkdir results
sed 's/Made & up/Elsewhere/; s/"date": "[^"]*"/"date": "2020-02-02"/' one/study.json >results/elsewhere.json
fake_study 0 '' --report --out one --results results
expect_in one/report.html Elsewhere 2020-02-02 'c:0 of Elsewhere'
expect_in one/study.csv 'Elsewhere,c:0,'
cp one/study.json results/elsewhere.json
fake_study 0 '' --report --out one --results results
(($(grep -c '^Made & up,c:0,Made up,lights,' one/study.csv) == 4)) || fail "the own result counts twice"

# ---- damaged results, wrong usage
fake=(--hedron fake/hedron --out refused)
mkdir refused
for damage in '{"bench": "study"' '{"bench": "study", "hedron_bench": 99}' '{"bench": "study", "hedron_bench": 1, "measurements": [{}]}'; do
    echo "$damage" >refused/study.json
    expect_bench_refusal 2 'refused/study.json' "${fake[@]}" --report
    expect_same refused/study.json <(echo "$damage")
done
rm refused/study.json
expect_bench_refusal 2 '--size=1x1 cannot stand after --' "${fake[@]}" -- --size=1x1
expect_bench_refusal 3 "--device is 'c:7'" "${fake[@]}" --device c:7
expect_bench_refusal 1 'cannot make the folder' --hedron fake/hedron --out fake/hedron/out
bench=$project/bench/frames
expect_bench_refusal 2 'at least two frames' "${fake[@]}" --frames 7
# A scene with errors: all of them are printed, and earlier results stay.
cp -r out earlier
echo '{"hedron": 1, "colour": 1, "size": 2}' >bad.json
expect_bench_refusal 2 'c:0, scene: ' --hedron "$hedron" --out out --device c bad.json
expect_stderr_contains '  size is an unknown key'
expect_exit 0 diff -r earlier out
echo '{"hedron": 1, "camera": {"eye": [4, 0, 0]}}' >still.json
expect_bench_refusal 2 'the scene has one frame, 0; a still scene gets more by -- --set camera.frames=5' --hedron "$hedron" --out out --device c still.json
bench=$project/bench/compare
expect_bench_refusal 2 'no measurement in common' one/study.json <(sed 's/"Made up"/"Other"/' one/study.json)

# ---- the table of devices in docs/performance.md is that of the results
expect_exit 0 "$project/bench/results/table"
cp "$logs/stdout" table.md
expect_python '5 True' 'table = open("table.md", encoding="utf-8").read()' \
    "text = open('$project/docs/performance.md', encoding='utf-8').read()" 'print(table.count("\n") - 2, "\n\n" + table + "\n" in text)'

# ---- the program itself; a folder whose name would be a pattern
mkdir '##%d'
study[2]=$hedron
TMPDIR="$PWD/##%d" expect_exit 0 "${no_nvidia[@]}" timeout "$time_limit" "${study[@]}" --out 'real/##%d' --device c --repeats 1 --parts threads
expect_value 'real/##%d/study.json' '[r["failures"], all(e["summary"]["trace_ms"]["median"] > 0 for e in r["measurements"]), m["threads", "", 1, "c:0"]["renderer"].count(", 1 thread")]' \
    '[[], true, 1]'
expect_python '[True, True, False, None]' 'import re' 'page = open("real/##%d/report.html", encoding="utf-8").read()' \
    "names, used = re.findall(r'\bid=[\"\\']([^\"\\']+)', page), re.findall(r'href=[\"\\']#([^\"\\']+)', page)" \
    'print([len(names) == len(set(names)), set(used) <= set(names), "http://" in page.replace("http://www.w3.org", ""),
        re.search("src=.(?!data:)", page)])'
finish
