#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What --max-error states is never less than what is missing, of some random scenes; and the search finds a liar.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
bench=("$project/bench/study" promise --out out)

# Something bright in few of a pixel's samples is among both.
for first in 215 430; do
    expect_exit 0 "${bench[@]}" --hedron "$hedron" --first "$first" --scenes 25
    expect_python '[true, 25, []]' 'import json' 'r = json.load(open("out/promise.json", encoding="utf-8"))' \
        'print(json.dumps([r["complete"], sum(e["stated"] is not None for e in r["scenes"]), r["failures"]]))'
    expect_python 'True' 'import json' 'r = json.load(open("out/promise.json", encoding="utf-8"))' \
        'print(any(e["missed"] > 5 for e in r["scenes"]))'
done

# A program that states a third of it.
mkdir liar
cat >liar/hedron <<END
#!/usr/bin/env bash
"$hedron" "\$@" || exit
[[ \$* != *--stats* ]] || python3 - <<'PYTHON'
import json
line = json.load(open("stats.jsonl"))
line["missing"]["largest"] /= 3
json.dump(line, open("stats.jsonl", "w"))
PYTHON
END
chmod +x liar/hedron
expect_exit 1 "${bench[@]}" --hedron liar/hedron --first 215 --scenes 10
expect_stdout_contains 'FAILED: --max-error, scene '
expect_exit 2 "${bench[@]}" --hedron "$hedron" --scenes 0

# The study's page has it.
expect_python "1 ['Of 2 random scenes none missed more than was stated.'] ['3', '2', '0', '0.3750', '0.5000']
['Of 1 random scenes 1 missed more than was stated.']
0" 'from harness.measurements.promise import PART' 'from harness.page.section import sections' \
    'def drawn(*scenes): return sections({"promise": PART}, [{"left_out": {}, "devices": [], "machine": {"name": "m"}, "promise": [' \
    '    {"seed": 1, "options": [], "missed": missed, "stated": stated} for missed, stated in scenes]}])' \
    'found = drawn((1.0, 2.0), (1.0, 4.0), (None, None))' \
    'print(len(found), found[0].notes, found[0].table[1])' \
    'print(drawn((3.0, 2.0))[0].notes)' 'print(len(drawn()))'
finish
