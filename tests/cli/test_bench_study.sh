#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/study: its figures on made-up statistics, what goes on after it was killed, its page, and what it
# refuses; a tiny run of the program itself.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
bench=$project/bench/study

# expect_value FILE EXPRESSION EXPECTED: what Python makes of the result `r`, its measurements by part, series,
# x and device, and their medians.
expect_value() {
    expect_python "$3" 'import json' "r = json.load(open('$1', encoding='utf-8'))" \
        'm = {(e["part"], e["series"], e["x"], e["device"]): e for e in r["measurements"]}' \
        'def ms(*key): return round(m[key]["summary"]["trace_ms"]["median"], 6)' "print(json.dumps($2))"
}

# A program with three devices of the CPU kind and a GPU. A frame takes 10 ms of tracing on c, 20 on opencl and 1 on
# cuda, and frames after the first one more than the one before; 100 lights add 5. It logs what it is asked
# for, and waits where the file `hold` has the number of the run, until it is killed.
mkdir fake
cat >fake/hedron <<'FAKE'
#!/usr/bin/env bash
set -euo pipefail
device() {
    printf '{"backend": "%s", "index": 0, "name": "Made up", "driver": "%s", "is_cpu": %s, "compute_units": 2,
        "clock_mhz": %s, "has_double": true, "unusable": null, "not_strict": null}' "$1" "$2" "$3" $((1000 + RANDOM))
}
case $1 in
--version) echo 'hedron 9.8.7' ;;
devices)
    printf '{"backends": [{"name": "cuda", "available": true, "reason": null, "devices": [%s]},
        {"name": "opencl", "available": true, "reason": null, "devices": [%s]},
        {"name": "c", "available": true, "reason": null, "devices": [%s]}]}\n' \
        "$(device cuda 'sm_90' false)" "$(device opencl 'none' true)" "$(device c 'none' true)"
    ;;
selftest)
    echo "$*" >>"$FAKE_LOG"
    test='{"name": "arithmetic", "verdict": "%s", "reason": %s, "tuples": 8192, "division_by_fma": %s, "hash": "1", "seconds": 1}'
    one='{"hedron": "9.8.7", "backend": "%s", "index": 0, "name": "Made up", "driver": "none", "compiler": null, "verdict": "%s",
        "tests": [%s], "time": "then", "seconds": 1.25, "hash": "abcd"}'
    # shellcheck disable=SC2059 # they are templates
    printf '{"certificates": [%s, %s]}\n' "$(printf "$one" c right "$(printf "$test" right null true)")" \
        "$(printf "$one" opencl wrong "$(printf "$test" wrong '"fma of 1 & 2 is 3"' false)")"
    exit 1
    ;;
tune)
    echo "$*" >>"$FAKE_LOG"
    printf '{"candidates": [%s, %s, %s]}\n' \
        '{"pipeline": "mega", "lanes": null, "block": null, "registers": null, "ms": 8, "ratio": 1, "failure": null}' \
        '{"pipeline": "mega", "lanes": 4, "block": null, "registers": null, "ms": null, "ratio": null, "failure": "no room"}' \
        '{"pipeline": "wavefront", "lanes": 16, "block": null, "registers": null, "ms": 6, "ratio": 0.75, "failure": null}'
    ;;
render)
    shift
    words="$*"
    while (($# > 0)); do
        case $1 in
        --backend) backend=$2 ;;
        --frames) frames=$2 ;;
        -o) output=$2 ;;
        esac
        last=$1
        shift
    done
    echo "$backend ${words#--quiet }" | sed 's|/[^ ]*/||g' >>"$FAKE_LOG"
    run=$(wc -l <"$FAKE_LOG")
    if [[ -e $FAKE_HOLD && $(cat "$FAKE_HOLD") == "$run" ]]; then
        trap 'exit 130' INT
        echo $$ >"$FAKE_HOLD.held"
        for ((wait = 0; wait < 6000; wait++)); do sleep 0.1; done
    fi
    case "${FAKE_MODE:-} $backend" in
    'broken opencl opencl') printf 'hedron: the card burns\n' >&2; exit 1 ;;
    'missing opencl opencl') printf 'hedron: the card is gone\n' >&2; exit 3 ;;
    'bad c c') printf 'hedron: the scene is bad\n' >&2; exit 2 ;;
    esac
    case $backend in c) ms=10 ;; opencl) ms=20 ;; *) ms=1 ;; esac
    [[ $last != *lights-100.json ]] || ms=$((ms + 5))
    [[ $frames != *-* ]] || frames=$(seq -s , "${frames%-*}" "${frames#*-}")
    for frame in ${frames//,/ }; do
        picture=$frame
        [[ ${FAKE_MODE:-} != wrong || $backend != opencl || $frame != 1 ]] || picture=wrong
        [[ $output != *.data ]] || echo "$picture" >"$(printf '%07d.data' "$frame")"
        printf '{"frame":%d,"backend":"%s","device":"x","renderer":"16 lanes, avx512","width":64,"height":48,"samples":2,"depth":5,"seconds":{"prepare":0.0001,"trace":%d.%03d,"copy":0.0002,"convert":0,"store":0.0007,"film":0},"began":{"prepare":0.001,"trace":0.0011,"copy":0.003,"convert":null,"store":0.004,"film":null},"rays":{"primary":1000,"mirrored":1500,"transmitted":500},"shadow_tests":8000,"clamps":0}\n' \
            "$frame" "$backend" $((ms / 1000)) $((ms % 1000)) >>stats.jsonl
        ms=$((ms + 1))
    done
    ;;
esac
FAKE
chmod +x fake/hedron
export FAKE_LOG=$work/fake.log FAKE_HOLD=$work/hold

# fake_study CODE MODE OPTIONS...: no run is rejected, and no other machine's results are there.
fake_study() {
    local expected=$1 mode=$2
    shift 2
    FAKE_MODE=$mode expect_exit "$expected" timeout 300 "$bench" --hedron fake/hedron --others 100 \
        --results none "$@"
}

# ---- figures: the first frame warms up, CPUs' smaller pictures count so many times, the machine's name
fake_study 0 '' --quick --out one --machine 'Made & up' --parts lights,lanes,threads,blocks,official
expect_value one/study.json '[r["hedron_bench"], r["bench"], r["complete"], r["quick"], r["repeats"], r["machine"]["name"], r["failures"], r["interference_limit"]]' \
    '[1, "study", false, true, 2, "Made & up", [], 1.0]'
# Frames of 188.8 ms on c against 5.3 on cuda; of other scenes tracing alone.
expect_python '[35.622642, True, True, 2]' 'import re' "page = open('one/report.html', encoding='utf-8').read()" \
    'said = page[page.index("<p class=\"answer\">"):page.index("<h2")]' \
    'figures = {name: round(float(value), 6) for name, value in re.findall("data-figure=\"(.*?)\" data-value=\"(.*?)\"", said)}' \
    'print([figures["gpu_to_cpu"], figures["gpu_to_cpu_most"] > 70, figures["opencl_to_c"] > 1.5, said.count("<em>missing</em>")])'
# It is complete with every part only, and tells which are missing.
expect_value one/study.json '[r["missing"]["samples"], {"lights", "lanes", "threads", "blocks", "official"}.isdisjoint(r["missing"]), len(r["missing"]) > 5]' \
    '["it was not asked for", true, true]'
grep -q 'nothing was measured of .*samples' one/report.html || fail "the page does not say what is missing"
if grep -q unfinished one/report.html; then
    fail "the page calls a study unfinished that did all that was asked for"
fi
# Frames 1 and 2 of the CPUs: 11 and 12, and 16 times that; of the GPU 2 and 3.
expect_value one/study.json '[ms("lights", "", 10, "c:0"), ms("lights", "", 100, "c:0"), ms("lights", "", 10, "opencl:0"), ms("lights", "", 10, "cuda:0")]' \
    '[184.0, 264.0, 344.0, 2.5]'
expect_value one/study.json '[ms("official", "", 0, "c:0"), ms("official", "", 0, "cuda:0"), round(m["official", "", 0, "cuda:0"]["summary"]["frame_ms"]["median"], 6)]' \
    '[184.0, 5.0, 5.3]'
expect_value one/study.json '[[run["repeat"], [frame["warm_up"] for frame in run["frames"]]] for run in m["lights", "", 1, "c:0"]["runs"]]' \
    '[[0, [true, false, false]], [1, [true, false, false]]]'
expect_value one/study.json '[r["pictures"]["same"], sorted({key[3] for key in m if key[0] == "blocks"}), sorted({key[3] for key in m if key[0] == "lanes"})]' \
    '[true, ["cuda:0"], ["c:0", "opencl:0"]]'
# Points take turns: a round of all, then the next.
expect_same <(head -n $(($(wc -l <"$FAKE_LOG") / 2)) "$FAKE_LOG") <(tail -n $(($(wc -l <"$FAKE_LOG") / 2)) "$FAKE_LOG")
grep -q -F 'Made &amp; up' one/report.html || fail "the page does not name the machine"
grep -q -F 'same bytes from every device' one/report.html || fail "the page does not tell of the pictures"
if (($(wc -l <one/study.csv) != $(python3 -c 'import json; print(1 + len(json.load(open("one/study.json"))["measurements"]))'))); then
    fail "the CSV has not a line for each measurement"
fi
for name in official lights lanes threads blocks_block blocks_grid; do
    expect_svg "one/study_$name.svg"
    grep -q "<figure id=\"study_$name\"" one/report.html || fail "the page has no chart $name"
done
cat >page.py <<'PYTHON'
import re, sys
from html.parser import HTMLParser
page = open(sys.argv[1], encoding="utf-8").read()
names = re.findall(r"\bid=[\"']([^\"']+)", page)
used = re.findall(r"href=[\"']#([^\"']+)", page)
print(len(names) == len(set(names)), set(used) <= set(names), "http://" in page.replace("http://www.w3.org", ""), re.search("src=.(?!data:)", page) is not None)
PYTHON
# expect_page FILE: one page with nothing beside it, whose names are there once.
expect_page() {
    local found
    found=$(python3 -B page.py "$1" 2>&1)
    if [[ $found != 'True True False False' ]]; then
        fail "$1: names there once, names used that are there, links, files: $found"
    fi
}
expect_page one/report.html

# ---- what is there is not measured again; parts can be added; --report measures nothing
runs=$(wc -l <"$FAKE_LOG")
fake_study 0 '' --quick --out one --parts lights --machine 'Made & up'
fake_study 0 '' --report --out one
if (($(wc -l <"$FAKE_LOG") != runs)); then
    fail "what was measured before was measured again"
fi
fake_study 0 '' --quick --out one --parts threads,arithmetic
expect_value one/study.json '[r["complete"], r["parts"], len(m["arithmetic", "", 3, "cuda:0"]["runs"])]' \
    '[false, ["official", "blocks", "lights", "lanes", "threads", "arithmetic"], 2]'
if (($(grep -c -e --precision "$FAKE_LOG") != $(wc -l <"$FAKE_LOG") - runs)); then
    fail "more was measured than the part that was added"
fi

# ---- killed after some runs were saved, and continued
parts=lights,lanes,arithmetic
rm -f "$FAKE_LOG"
fake_study 0 '' --quick --out whole --parts $parts
mv "$FAKE_LOG" whole.log
hold_at=$(($(wc -l <whole.log) / 2 + 3)) # in the second round
echo $hold_at >"$FAKE_HOLD"
start "$bench" --hedron fake/hedron --others 100 --results none --quick --out killed --parts $parts
if ! wait_until 120 test -s "$FAKE_HOLD.held"; then
    fail "the program was not run so often"
    show_logs
fi
kill -KILL -- "-$pid"
kill -KILL -- "-$(cat "$FAKE_HOLD.held")" 2>"$logs/kill" || kill -KILL "$(cat "$FAKE_HOLD.held")"
wait "$pid" 2>"$logs/kill" || true
rm "$FAKE_HOLD"
cp killed/study.json saved.json
expect_value saved.json '[r["complete"], sum(len(e["runs"]) for e in r["measurements"])]' "[false, $((hold_at - 1))]"
# A page of what there is so far, which says so.
mkdir part
cp saved.json part/study.json
fake_study 0 '' --report --out part
grep -q 'unfinished' part/report.html || fail "the page does not say that the study is unfinished"
fake_study 0 '' --quick --out killed --parts $parts
# The run that was killed is done again, and no other.
expect_same <(sed "${hold_at}p" whole.log) "$FAKE_LOG"
cat >kept.py <<'PYTHON'
import json
old, new = [json.load(open(name, encoding="utf-8")) for name in ("saved.json", "killed/study.json")]
pairs = list(zip(old["measurements"], new["measurements"]))
print(all(one["runs"] == other["runs"][:len(one["runs"])] for one, other in pairs), old["date"] == new["date"], new["complete"],
      {len(other["runs"]) for _, other in pairs})
PYTHON
expect_python 'True True False {2}' "$(cat kept.py)"
cp killed/report.html killed.html
fake_study 0 '' --report --out killed
expect_same killed.html killed/report.html
# But for dates, loads and the time of whole programs, it is the page of the study that was not killed.
cat >even.py <<'PYTHON'
import json
for name in ("whole", "killed"):
    r = json.load(open(f"{name}/study.json", encoding="utf-8"))
    r["date"], r["machine"]["load_before"], r["machine"]["load_after"] = "then", [0, 0, 0], [0, 0, 0]
    for run in (run for e in r["measurements"] for run in e["runs"]):
        run.update(wall=1, cpu=1, load=0, others=0 if run["others"] is not None else None)
    for device in r["devices"]:
        device["clock_mhz"] = 0
    json.dump(r, open(f"{name}/study.json", "w", encoding="utf-8"))
PYTHON
expect_python '' "$(cat even.py)"
fake_study 0 '' --report --out whole
fake_study 0 '' --report --out killed
for file in report.html study.csv study.json; do
    expect_same whole/$file killed/$file
done

# ---- another program's figures are kept aside, not gone on from; --again measures anew
echo '# other bytes' >>fake/hedron
rm -f "$FAKE_LOG"
fake_study 0 '' --quick --out killed --parts lights
expect_stderr_contains 'another kind of study'
expect_same whole/study.json killed/study.before.json
expect_value killed/study.json '[r["parts"], {len(e["runs"]) for e in r["measurements"]} == {2}]' '[["lights"], true]'
runs=$(wc -l <"$FAKE_LOG")
fake_study 0 '' --quick --out killed --parts lights --again
if (($(wc -l <"$FAKE_LOG") != 2 * runs)); then
    fail "--again did not measure all anew"
fi

# ---- Ctrl-C, or the signal to end, leaves what was measured, and a page of it
rm -f "$FAKE_LOG" "$FAKE_HOLD.held"
echo 4 >"$FAKE_HOLD"
start "$bench" --hedron fake/hedron --others 100 --results none --quick --out stopped --parts lights
wait_until 120 test -s "$FAKE_HOLD.held" || fail "the program was not run so often"
kill -TERM "$pid"
expect_end 130
rm "$FAKE_HOLD"
expect_value stopped/study.json '[r["complete"], sum(len(e["runs"]) for e in r["measurements"])]' '[false, 3]'
grep -q 'unfinished' stopped/report.html || fail "the page does not say that the study is unfinished"

# ---- a wrong picture fails the study; a device that fails leaves the others
fake_study 1 wrong --quick --out wrong --parts lights,threads
expect_stdout_contains 'THE PICTURES DIFFER'
grep -q 'class="wrong">.*THE PICTURES DIFFER' wrong/report.html || fail "the page does not tell of the wrong picture"
expect_value wrong/study.json '[r["pictures"]["same"], r["complete"], max(len(e["runs"]) for e in r["measurements"])]' '[false, false, 1]'
fake_study 1 'broken opencl' --quick --out broken --parts lights
expect_stdout_contains 'the card burns'
expect_value broken/study.json '[len(m["lights", "", 1, "c:0"]["runs"]), m["lights", "", 1, "opencl:0"]["reason"]]' '[2, "the card burns"]'
fake_study 0 'missing opencl' --quick --out missing --parts lights
fake_study 2 'bad c' --quick --out bad --parts lights
expect_stderr_contains 'the scene is bad'

# ---- results of other machines are on the page, with theirs
mkdir results
python3 - <<'PYTHON'
import json
r = json.load(open("one/study.json", encoding="utf-8"))
r["machine"]["name"], r["date"] = "Elsewhere", "2020-02-02T02:02:02+00:00"
json.dump(r, open("results/elsewhere.json", "w", encoding="utf-8"))
PYTHON
expect_exit 0 "$bench" --report --out one --results results
for words in Elsewhere 2020-02-02T02:02:02 'c:0 (Elsewhere)'; do
    grep -q -F "$words" one/report.html || fail "the page lacks $words"
done
grep -q '^Elsewhere,c:0,' one/study.csv || fail "the CSV lacks the other machine"
expect_page one/report.html
# A copy of the own result is no other machine's.
cp one/study.json results/elsewhere.json
expect_exit 0 "$bench" --report --out one --results results
if grep -q '(Elsewhere)' one/report.html || (($(grep -c '^Made & up,c:0,Made up,lights,' one/study.csv) != 4)); then
    fail "the own result counts twice"
fi

# ---- damaged results, wrong usage
# expect_study_refusal CODE TEXT OPTIONS...
expect_study_refusal() {
    local expected=$1 text=$2
    shift 2
    expect_exit "$expected" timeout 60 "$bench" "$@"
    expect_stderr_contains "$text"
    expect_stdout_lines 0
}
fake=(--hedron fake/hedron --out refused)
expect_study_refusal 2 'unrecognized arguments: --wrong' "${fake[@]}" --wrong
expect_study_refusal 2 'a part that is none of certificates' "${fake[@]}" --parts lights,wrong
expect_study_refusal 2 "invalid number from 1 on value: '0'" "${fake[@]}" --repeats 0
expect_study_refusal 2 'from 0 to 100' "${fake[@]}" --others 101
expect_study_refusal 2 '--size=1x1 cannot stand after --' "${fake[@]}" -- --size=1x1
expect_study_refusal 2 'no --again' "${fake[@]}" --report --again
expect_study_refusal 2 'to make a page of' "${fake[@]}" --report
expect_study_refusal 2 "--device is 'metal'" "${fake[@]}" --device metal
expect_study_refusal 2 './dev build' --hedron no/hedron --out refused
expect_study_refusal 1 'cannot make the folder' --hedron fake/hedron --out fake/hedron/out
mkdir -p refused
for damage in '{"bench": "study"' '[]' '{"bench": "speed"}' '{"bench": "study", "hedron_bench": 99}' \
    '{"bench": "study", "hedron_bench": 1, "measurements": [{}]}'; do
    echo "$damage" >refused/study.json
    expect_study_refusal 2 'refused/study.json' "${fake[@]}" --quick --parts lights
    expect_study_refusal 2 'refused/study.json' "${fake[@]}" --report
    expect_same refused/study.json <(echo "$damage")
done
echo '{' >results/elsewhere.json
expect_study_refusal 2 'elsewhere.json is no JSON' --report --out one --results results

# ---- disturbed runs: tried again a few times, and the least disturbed one counts
cat >noise.py <<'PYTHON'
from harness.measure.jobs import job, summarize
from harness.measure.plan import Plan
def study(noise, repeats=1, points=1):
    made, saved = [], []
    class Program:
        def render(self, *arguments, **named):
            others = noise[len(made)] if len(made) < len(noise) else 0
            made.append(others)
            seconds = {"prepare": 0, "trace": len(made), "copy": 0}
            return {"code": 0, "message": "", "wall": 1, "cpu": 1, "load": 0, "others": others, "noisy": others > 0.1,
                    "digests": {}, "frames": [{"frame": 0, "seconds": seconds, "renderer": "x"}]}
    plan = Plan({"c:0": {"strict": True}}, {"s": None}, Program(), None, lambda *news: None, lambda: saved.append(1))
    entries = plan.jobs = [job("c:0", "s", "0", part="lights", x=x) for x in range(points)]
    print(plan.run_all(repeats), len(made), len(saved),
          [[[run["others"] for run in each["runs"]], [run["others"] for run in each["rejected"]]] for each in entries])
    summarize(entries)
    print([(each["summary"]["trace_ms"]["median"], each["summary"]["noisy"]) for each in entries])
study([0], 2)
study([0, 0.5, 0, 0], 2, 2)  # the second point of the first round, again after the round
study([0.5, 0.3, 0.4], 4, 1)  # no more than twice again
study([0.5, 0, 0, 0.5, 0.6, 0.7], 2, 2)  # a disturbed run does not count beside one that was not
study([0.5] * 99, 2, 2)  # always busy: half as many again are enough
PYTHON
expect_python 'True 2 2 [[[0, 0], []]]
[(1500.0, False)]
True 5 5 [[[0, 0], []], [[0, 0], [0.5]]]
[(2500.0, False), (4000.0, False)]
True 6 6 [[[0.3, 0, 0, 0], [0.5, 0.4]]]
[(5000.0, False)]
True 6 6 [[[0, 0.5], [0.5, 0.7]], [[0, 0.6], []]]
[(3000.0, False), (2000.0, False)]
True 6 6 [[[0.5, 0.5], [0.5]], [[0.5, 0.5], [0.5]]]
[(3000.0, True), (4000.0, True)]' "$(cat noise.py)"

# ---- the bound: shadow tests by operations, over the peak of all cores or of a GPU's lanes
expect_python '[20.0, 4.0, None, None]' 'from harness.measurements import bounds as b' \
    'cpu, gpu = {"is_cpu": True, "name": "c"}, {"is_cpu": False, "name": "g", "driver": "sm_90", "compute_units": 2, "clock_mhz": 1000}' \
    'odd = {**gpu, "driver": "?"}' \
    'bounds = {"instructions_per_core_second": 1e9, "lanes": 4, "operations_per_test": 80, "operations_per_test_one_lane": 512}' \
    'r = {"bounds": bounds, "devices": [cpu], "machine": {"cores": 2}}' \
    'entry = {"scale": 4, "runs": [{"noisy": False, "frames": [{"warm_up": False, "shadow_tests": n} for n in (0, 2000000)]}]}' \
    'print([b.milliseconds(r, cpu, entry), b.milliseconds(r, gpu, entry), b.milliseconds(r, odd, entry), b.milliseconds({**r, "bounds": None}, cpu, entry)])'

# ---- error against time goes on where it was: with the same points, and nothing measured again
cat >accuracy.py <<'PYTHON'
import json
from pathlib import Path
from harness.accuracy import points, settings
from harness.measure.plan import Plan
from harness.run.program import Program
settings.FAMILIES = {name: settings.FAMILIES[name] for name in ("grid", "depth")}
every = settings.settings
settings.settings = lambda quick: {name: every(quick)[name][:2] for name in ("grid", "depth")}
made, saves, memory = [], [], points.empty_memory()
class Watched(Program):
    def render(self, *arguments, **named):
        made.append(arguments[3])
        return super().render(*arguments, **named)
program, out, folder = Watched(Path(PATH)), Path(".").resolve(), Path("work").resolve()
folder.mkdir()
device = {"label": "c:0", "backend": "c", "index": 0, "strict": True, "is_cpu": True, "name": "x", "reason": None}
class Stop(Exception):
    pass
def save(most=99):
    saves.append(json.loads(json.dumps(memory)))
    if len(saves) >= most:
        raise Stop
def measure(most=99):
    plan = Plan({"c:0": device}, {points.SCENE: None}, program, folder, lambda *news: None, quick=True)
    points.Points(plan, device, (16, 12), memory, out / "study_truth_16x12.pfm", lambda: save(most)).measure(2)
try:
    measure(3)
except Stop:
    pass
first, memory = len(made), saves[-1]
measure()
whole, done = len(made), json.loads(json.dumps(memory))
measure()
print(len(memory["points"]), len(made) == whole, memory == done, [len(job["runs"]) for job in memory["jobs"].values()], memory["failures"])
# The reference and its coarser one and estimates are not made again, nor what was saved.
print(sum("--reference" in options for options in made[first:]), whole - first == 8 - 3, all(point["on_front"] is not None for point in memory["points"]))
(out / "study_truth_16x12.pfm").write_bytes(b"damaged")
measure()
print(sum("--reference" in options for options in made[whole:]) > 1, len(made) - whole > 8, memory["truth"] is not None)
PYTHON
expect_python "4 True True [2, 2, 2, 2] []
0 True True
True True True" "$(sed "s|PATH|'$hedron'|" accuracy.py)"

# ---- what devices compute, and what suits them; once is enough
rm "$FAKE_LOG"
fake_study 0 '' --quick --out told --parts certificates,tuning
fake_study 0 '' --quick --out told --parts certificates,tuning
expect_stdout_contains 'told/report.html'
grep -q ': 1 of 2 devices compute rightly' told/report.html || fail "the page does not say how many devices are right"
grep -q 'fma of 1 &amp; 2 is 3' told/report.html || fail "the page does not tell the first difference"
grep -q 'opencl:0: the fastest is wavefront, 16 lanes, in 0.750 times' told/report.html || fail "the page does not tell what is the fastest"
expect_value told/study.json '[[c["verdict"] for c in r["certificates"]], sorted(r["tuning"])]' \
    '[["right", "wrong"], ["c:0", "cuda:0", "opencl:0"]]'
if [[ $(grep -c '^tune' "$FAKE_LOG") != 3 || $(grep '^selftest' "$FAKE_LOG" | sort -u) != 'selftest --json --quick' ]]; then
    fail "the program was asked: $(cat "$FAKE_LOG")"
fi

# ---- the README's table of devices is that of the results
expect_exit 0 "$project/bench/results/table"
cp "$logs/stdout" table.md
expect_python '5 True' 'table = open("table.md", encoding="utf-8").read()' \
    "readme = open('$project/README.md', encoding='utf-8').read()" 'print(table.count("\n") - 2, "\n\n" + table + "\n" in readme)'
rm table.md

# ---- the program itself
expect_exit 0 "${no_nvidia[@]}" timeout 800 "$bench" --hedron "$hedron" --out real --results none --device c --quick --repeats 1 \
    --parts threads,stages
expect_value real/study.json '[r["complete"], r["failures"], all(e["summary"]["trace_ms"]["median"] > 0 for e in r["measurements"]), m["threads", "", 1, "c:0"]["renderer"].count(", 1 thread")]' \
    '[false, [], true, 1]'
expect_page real/report.html
finish
