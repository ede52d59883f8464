#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The page of bench/study as a browser shows it, of the results in bench/results: its first screen. Nothing may be cut off, or
# tiny, at 400, 1280 and 1920 pixels, light and dark.
set -euo pipefail
# shellcheck source=bench_lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/bench_lib.sh"

# ---- a result of this program's kernels beside another's
"$hedron" devices --json >devices.json
mkdir out results
cat >make.py <<'PYTHON'
import json, sys
r = json.load(open(f"{sys.argv[1]}/intel-xeon-2-cores.json", encoding="utf-8"))
r["hedron"]["kernels"] = json.load(open("devices.json", encoding="utf-8"))["kernels"]
json.dump(r, open("out/study.json", "w", encoding="utf-8"))
other = json.load(open(f"{sys.argv[1]}/nvidia-h200.json", encoding="utf-8"))
other["hedron"]["kernels"] = "of other kernels"
json.dump(other, open("results/nvidia-h200.json", "w", encoding="utf-8"))
PYTHON
python3 -B make.py "$project/bench/results"
expect_exit 0 "$project/bench/study" --report --hedron "$hedron" --out out --results results
page=out/report.html

# ---- the first screen has figures of the results
cat >figures.py <<'PYTHON'
import json, re
from pathlib import Path
from statistics import mean, median
def read(name):
    return Path(name).read_text(encoding="utf-8")
page, own = read("out/report.html"), json.loads(read("out/study.json"))
h200 = json.loads(read("results/nvidia-h200.json"))
answer = page[page.index("<header>"):page.index("</header>")]
said = re.findall(r'data-figure="(\w+)" data-value="([^"]+)">([^<]*)<', answer)
def ms(label):
    """Milliseconds of the official example on the H200's machine, by the raw seconds."""
    entry = next(e for e in h200["measurements"] if (e["part"], e["device"]) == ("official", label))
    return median(1e3 * entry["scale"] * mean(sum(f["seconds"][s] for s in ("prepare", "trace", "copy")) for f in run["frames"] if not f["warm_up"])
                  for run in [run for run in entry["runs"] if not run["noisy"]] or entry["runs"])
gpu, cpu = min(ms("cuda:0"), ms("opencl:1")), ms("c:0")
wanted = {"gpu_ms": gpu, "cpu_ms": cpu, "gpu_to_cpu": cpu / gpu,
          "frames_alike": sum(r["pictures"]["compared"] for r in (own, h200) if r["pictures"] and r["pictures"]["same"]),
          "frame_ms": gpu, "times_cpu": 84.5e3 / gpu, "times_gtx_1050": 1.1e3 / gpu}
values = {name: float(value) for name, value, _ in reversed(said)}  # of the first row, which is the fastest device's
wrong = [name for name, value in wanted.items() if abs(values.get(name, -1) - value) > 1e-9 * abs(value)]
told = re.sub("<[^>]+>", "", answer)
sentences = re.split(r"(?<=[.]) (?=[A-Z])", re.sub("<[^>]+>", "", answer[answer.index("<p>"):]))
own_kernels = ["2-core Xeon (C)" + mark in page for mark in ("", " \u2020")]
print(wrong, len(said) >= 15, page.index("<header>") < page.index("<h2"), "H200 (CUDA) \u2020" in told, own_kernels,
      [len(each.split()) <= 30 for each in sentences], "cannot run: the NVIDIA driver" in told)
PYTHON
expect_python '[] True True True [True, False] [True, True, True] True' "$(cat figures.py)"

for browser in chromium chromium-browser google-chrome none; do
    ! command -v "$browser" >"$logs/which" || break
done
if ((failures == 0)) && [[ $browser == none ]]; then
    skip "there is no Chromium (Debian's package chromium)"
fi

# ---- the display: one start of the browser, in which frames are its screens
cat >look.js <<'JAVASCRIPT'
const wrong = [], heights = {400: 860, 1280: 720, 1920: 1080}
let left = 6
function light(colour) {
    const [r, g, b] = colour.match(/[\d.]+/g).map(v => v / 255).map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    return 0.2126 * r + 0.7152 * g + 0.0722 * b
}
function look(width, scheme, view) {
    const page = view.document, say = words => wrong.push(`${width} ${scheme}: ${words}`), style = e => view.getComputedStyle(e)
    if (page.documentElement.scrollWidth > width) say(`it is ${page.documentElement.scrollWidth} wide`)
    const first = page.querySelector('header').getBoundingClientRect()
    if (first.bottom > heights[width]) say(`the first screen ends at ${first.bottom}`)
    const paper = style(page.body).backgroundColor
    if ((light(paper) > 0.5) != (scheme == 'light')) say(`the paper is ${paper}`)
    const figures = [...page.querySelectorAll('figure[id]')]
    if (figures.length < 15) say(`${figures.length} charts`)
    for (const figure of figures) {
        const drawn = [...figure.querySelectorAll('svg')].filter(e => e.checkVisibility() && e.clientWidth > 0)
        const it = `${figure.id}: `
        if (drawn.length != 1) { say(it + `${drawn.length} drawings`); continue }
        const svg = drawn[0], box = svg.getBoundingClientRect(), scale = box.width / svg.viewBox.baseVal.width
        if (box.left < 0 || box.right > width || box.height < 80) say(it + `${box.left} to ${box.right}, ${box.height} high`)
        const texts = [...svg.querySelectorAll('text')].map(e => [e.textContent, e.getBoundingClientRect()])
        for (const e of svg.querySelectorAll('text'))
            if (scale * parseFloat(e.getAttribute('font-size')) < 12) { say(it + `'${e.textContent}' is tiny`); break }
        texts.forEach(([words, at], place) => {
            if (at.left < box.left - 2 || at.right > box.right + 2 || at.top < box.top - 2 || at.bottom > box.bottom + 2) say(it + `'${words}' is cut off`)
            for (const [others, there] of texts.slice(place + 1))
                if (Math.min(at.right, there.right) - Math.max(at.left, there.left) > 2 &&
                    Math.min(at.bottom, there.bottom) - Math.max(at.top, there.top) > 5) say(it + `'${words}' is on '${others}'`)
        })
    }
}
for (const width of [400, 1280, 1920]) for (const scheme of ['light', 'dark']) {
    const frame = document.createElement('iframe')
    frame.style.cssText = `width:${width}px;height:${heights[width]}px;border:0;color-scheme:${scheme}`
    frame.onload = () => {
        look(width, scheme, frame.contentWindow)
        if (--left == 0) document.body.innerHTML = '<pre></pre>', document.querySelector('pre').textContent = JSON.stringify(wrong)
    }
    frame.srcdoc = page
    document.body.append(frame)
}
JAVASCRIPT
python3 -B - "$page" >screens.html <<'PYTHON'
import json, sys
page = json.dumps(open(sys.argv[1], encoding="utf-8").read()).replace("</", "<\\/").replace("<!--", "<\\!--")
print(f"<!DOCTYPE html><meta charset=\"utf-8\"><body><script>const page = {page}\n{open('look.js', encoding='utf-8').read()}</script>")
PYTHON
expect_exit 0 timeout 300 "$browser" --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$work/browser" \
    --virtual-time-budget=60000 --dump-dom "file://$PWD/screens.html"
cp "$logs/stdout" seen.html
expect_python '[]' 'import html, json, re' 'page = open("seen.html", encoding="utf-8").read()' \
    'print(json.loads(html.unescape(re.search("<pre>(.*)</pre>", page, re.S)[1]))[:20])'
finish
