#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/compare: what counts as slower and as noise, and what it refuses.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
compare=$project/bench/compare

# make FILE KEY=MILLISECONDS,...: a result with these measurements of point lights, of which each has a run for every
# number of a list such as 10/11/12. `device` and `version` are options.
cat >make.py <<'PYTHON'
import json, sys
file, *words = sys.argv[1:]
r = {"hedron_bench": 1, "bench": "study", "quick": False, "date": "then", "complete": True, "pictures": None, "failures": [],
     "parts": [], "done": [], "left_out": {}, "failed": {}, "bounds": None, "accuracy": None, "stability": None,
     "hedron": {"version": "1", "sha256": "0123456789abcdef", "options": []}, "machine": {"name": "here", "cpu": "x"},
     "devices": [{"label": "c:0", "name": "X"}], "measurements": []}
for word in words:
    key, _, values = word.partition("=")
    if key == "device":
        r["devices"][0]["name"] = values
    elif key == "hedron_bench":
        r[key] = int(values)
    else:
        runs = [{"repeat": place, "noisy": False, "others": 0, "load": 0, "wall": 1,
                 "frames": [{"frame": 0, "warm_up": False, "seconds": {"prepare": 0, "trace": float(ms) / 1000, "copy": 0}}]}
                for place, ms in enumerate(values.split("/"))]
        r["measurements"].append({"part": "lights", "series": "", "x": int(key), "device": "c:0", "scene": "s", "options": [],
                                  "frames": "0", "output": "", "warm_up": False, "scale": 1, "cold": False, "runs": runs,
                                  "rejected": [], "reason": None, "failed": False})
json.dump(r, open(file, "w", encoding="utf-8"))
PYTHON
make() {
    python3 make.py "$@"
}

# expect_line REGEX
expect_line() {
    if ! grep -q -E -e "$1" "$logs/stdout"; then
        fail "no line is like $1"
        show_logs
    fi
}

make old.json 1=100/100.5/101/99.5/99 2=100/100.5/101/99.5/99 3=100/100.5/101/99.5/99 4=50/100/150/60/140
make same.json 1=100.5/101/99.5/99/100 2=101/99/100/100.5/99.5 3=100/100.5/101/99.5/99 4=100/60/70/140/150
expect_exit 0 "$compare" old.json same.json
expect_stdout_contains '0 slower, 0 faster, 4 within the noise.'
# A tenth more is beyond the noise of the quiet ones, and within that of the fourth; 2 % is no difference anyway.
make new.json 1=110/110.5/111/109.5/109 2=90/90.5/91/89.5/89 3=102/102.5/103/101.5/101 4=110/60/80/160/170
expect_exit 1 "$compare" old.json new.json
expect_stdout_contains '1 slower, 1 faster, 2 within the noise.'
expect_line '^lights 1 +c:0 +100\.0 +110\.0 +\+10\.0 % +3\.0 % +slower$'
expect_line '^lights 2 +c:0 +100\.0 +90\.00 +-10\.0 % +3\.0 % +faster$'
if grep -q -E '^lights [34]' "$logs/stdout"; then
    fail "what is within the noise is listed"
fi
expect_exit 1 "$compare" --all old.json new.json
expect_line '^lights 3 +c:0 +100\.0 +102\.0 +\+2\.0 % +3\.0 % +within the noise$'
expect_line '^lights 4 .* within the noise$'
# Faster alone is no failure.
make faster.json 1=90/90.5/91/89.5/89 2=100/100.5/101/99.5/99
expect_exit 0 "$compare" old.json faster.json
expect_stdout_contains '0 slower, 1 faster, 1 within the noise.'
expect_stdout_contains '2 measurements are only in the old one.'
# Two equal runs are no proof of quiet where the others are noisy.
make few.json 1=100/100 2=100/120 3=100/80 4=100/110
make later.json 1=110/110 2=100/120 3=100/80 4=100/110
expect_exit 0 "$compare" few.json later.json

# ---- each folder of the harness takes from those before it only, in the order of bench/README.md
cat >order.py <<'PYTHON'
import pathlib, re
bench = pathlib.Path(BENCH)
table = (bench / "README.md").read_text(encoding="utf-8").partition("| folder | what |")[2].partition("\n\n")[0]
order = re.findall(r"`(\w+)`", "\n".join(line.split("|")[1] for line in table.splitlines()[2:]))
files = sorted((bench / "harness").rglob("*.py"))
print(sorted(order) == sorted({file.parent.name for file in files}))
for file in files:
    for folder in re.findall(r"^from harness\.(\w+)", file.read_text(encoding="utf-8"), re.M):
        if order.index(folder) > order.index(file.parent.name):
            print(f"{file} takes from {folder}")
PYTHON
expect_python True "$(sed "s|BENCH|'$project/bench'|" order.py)"

# ---- what it refuses
# expect_compare_refusal TEXT OPTIONS...
expect_compare_refusal() {
    local text=$1
    shift
    expect_exit 2 timeout 60 "$compare" "$@"
    expect_stderr_contains "$text"
    expect_stdout_lines 0
}
make elsewhere.json device=Y 1=100
expect_compare_refusal 'no measurement in common' old.json elsewhere.json
make newer.json hedron_bench=2 1=100
expect_compare_refusal 'version 2 of the format, expected 1' old.json newer.json
head -c 200 old.json >cut.json
expect_compare_refusal 'cut.json is no JSON' old.json cut.json
sed 's/"trace"/"trade"/' old.json >odd.json
expect_compare_refusal 'odd.json is damaged' odd.json old.json
sed 's/"study"/"speed"/' old.json >speed.json
expect_compare_refusal 'speed.json is not what bench/study writes' speed.json old.json
expect_compare_refusal 'cannot read missing.json' missing.json old.json
expect_compare_refusal 'required: NEW.json' old.json
expect_compare_refusal 'unrecognized arguments: --wrong' --wrong old.json new.json
finish
