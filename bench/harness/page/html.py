# SPDX-License-Identifier: MIT
"""The page of bench/study, one file of HTML with its charts, made from saved results alone; and its table as CSV."""
import csv
import html
import io
import re

from harness.chart.sheet import NARROW, STYLE, WIDE
from harness.page.section import dagger
from harness.store.result import is_unfinished, scene_words

# Narrow screens get the narrow charts, and the first table as paragraphs.
PAGE_STYLE = STYLE + """
body{font:16px/1.5 sans-serif;max-width:1100px;margin:0 auto;padding:0 1rem 3rem;color:var(--ink);background:var(--paper)}
h1{font-size:1.3rem;margin:.7rem 0 .3rem}h2{margin:2.6rem 0 .3rem;border-top:1px solid var(--grid);padding-top:.9rem}
h1,h2,h3{line-height:1.25}h3{margin:1.4rem 0 .2rem}p,figcaption{max-width:75ch}header p{margin:.5rem 0}header strong{font-weight:inherit}
figure{margin:.6rem 0 1.2rem}svg{width:100%;height:auto;display:block}.narrow{display:none;max-width:520px}
@media(min-width:861px){header td:not(:last-child){white-space:nowrap}}
@media(max-width:860px){.wide{display:none}.narrow{display:block}body{line-height:1.42}}
table{border-collapse:collapse;font-size:14px;margin:.4rem 0}th,td{border:1px solid var(--grid);padding:.2em .5em;text-align:left;
vertical-align:top;overflow-wrap:break-word}th{font-weight:bold}.scroll{overflow-x:auto}
.wrong{background:#b00020;color:#fff;padding:.6em 1em}.soft{color:var(--soft)}a,summary{color:var(--k0)}summary{cursor:pointer}
code,.option{white-space:nowrap}details{margin:.5rem 0}#machines{margin-top:2.6rem}nav a{display:inline-block;margin:.1rem .9rem .1rem 0}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,300px),1fr));gap:1rem 1.2rem}.pictures figure{margin:0}
.pictures img{width:100%;box-sizing:border-box;border:1px solid var(--grid);height:auto;display:block}.pictures h3{font-size:1rem;margin:0 0 .25rem}.pictures figcaption{font-size:.9rem}
@media(max-width:860px){header tr:first-child{display:none}header tr{display:block;margin:.3rem 0;line-height:1.3}header th{display:block}
header :is(th,td){border:0;padding:0}header td{display:inline}header .none{display:none}header td::before{content:attr(data-column)": ";color:var(--soft)}
header td:not(:last-child)::after{content:"; "}}"""

METHOD = ("Times are those of the statistics: without the start of the program and the compiling of kernels, which the last chart "
          "of time has. The first frame of a run warms up and does not count. A run's figure is the mean of its frames. A point is "
          "the median of the runs; its whiskers reach from the first to the third quartile. Runs are interleaved.")


def text(words):
    """Returns HTML in which no line breaks within an option or before its value."""
    return re.sub(r"--[a-z][a-z-]*( [\w./]+(?=[ ,;.:]|$))?", r'<span class="option">\g<0></span>', html.escape(str(words)))


def table(rows):
    head, *body = rows
    lines = ["<table>", "<tr>" + "".join(f"<th>{text(cell)}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{text(cell)}</td>" for cell in row) + "</tr>" for row in body]
    return "<div class=\"scroll\">" + "\n".join([*lines, "</table>"]) + "</div>"


def figure(name, chart, caption, is_alone):
    """Returns both drawings of a chart; a screen shows one of them."""
    heading = "" if is_alone else f"<h3>{text(chart.title)}</h3>\n"
    label = html.escape(caption or chart.title)
    drawn = "\n".join(f"<div class=\"{kind}\" role=\"img\" aria-label=\"{label}\">{chart.svg(width)}</div>"
                      for kind, width in (("wide", WIDE), ("narrow", NARROW)))
    return (f"<figure id=\"{name}\">\n{heading}<p class=\"soft\">{text(scene_words(chart.about))}</p>\n{drawn}\n"
            f"<figcaption>{text(caption)}</figcaption>\n</figure>")


def picture(title, words, png):
    return (f"<figure><h3>{text(title)}</h3><img alt=\"{html.escape(title)}\" src=\"data:image/png;base64,{png}\">"
            f"<figcaption>{text(words)}</figcaption></figure>")


def machine_rows(results):
    yield ["machine", "processor", "cores", "system", "devices", "measured", "hedron", "study", "load before, after"]
    for result in results:
        place = result["machine"]
        devices = "; ".join(f"{device['label']} {device['name'] or ''}".strip()
                            + (f" (not: {device['reason']})" if device["reason"] else "") for device in result["devices"])
        yield [place["name"], place["cpu"], place["cores"], place["system"], devices, result["date"],
               f"{result['hedron']['version']} ({result['hedron']['sha256'][:12]})",
               ("quick" if result["quick"] else "full") + (", unfinished" if is_unfinished(result) else ""),
               f"{place['load_before'][0]}, {place['load_after'][0] if place['load_after'] else 'not yet'}"]


def noise_words(result):
    entries = [each for each in result["measurements"] if each["summary"]]
    disturbed = sum(each["summary"]["noisy"] for each in entries)
    rejected = sum(len(each["rejected"]) for each in entries)
    runs = [run for each in entries for run in each["runs"]]
    loads = [run["load"] for run in runs]
    words = f"{result['machine']['name']}: {len(runs)} runs of {len(entries)} measurements count. "
    words += (f"A run is repeated if other programs took more than {100 * result['interference_limit']:g} % of the processors: "
              f"{rejected} were rejected, and {disturbed} measurements stayed disturbed."
              if all(run["others"] is not None for run in runs) else
              "This system does not report what other programs took of the processors, so no run was rejected.")
    return words + (f" The load was {min(loads)} to {max(loads)}." if loads else "")


def parts_without_figures(result):
    """Returns parts without any; an interrupted part may have some."""
    measured = {entry["part"] for entry in result["measurements"]}
    return [part for part in result.get("missing") or () if part not in measured]


def machines(results, pictures):
    """Returns what the figures come from, folded away."""
    changed = [f"{result['machine']['name']}: every run had the options {' '.join(result['hedron']['options'])}."
               for result in results if result["hedron"]["options"]]
    absent = [f"{result['machine']['name']}: nothing was measured of {', '.join(parts)}."
              for result in results if (parts := parts_without_figures(result))]
    sentences = [*changed, *map(noise_words, results), *absent, *pictures]
    return ["<details id=\"machines\"><summary>Machines, programs and method</summary>", table(machine_rows(results)), "<ul>",
            *(f"<li>{text(each)}</li>" for each in sentences), f"<li>{METHOD}</li>", "</ul></details>"]


def warnings(results, failures):
    words = [f"<p class=\"wrong\">{text(each)}</p>" for each in failures]
    if is_unfinished(results[0]):  # the result that a call would continue
        words.append("<p class=\"wrong\">A study here is unfinished: bench/study continues it.</p>")
    quick = [result["machine"]["name"] for result in results if result["quick"]]
    if quick:
        words.append("<p class=\"soft\">Rough, because quick studies have few repeats and small pictures: "
                     f"{text('; '.join(quick))}.</p>")
    strange = [result["machine"]["name"] for result in results if dagger(result)]
    if strange:
        words.append("<p class=\"soft\">\u2020 Measured with other kernels than this program's, which may be faster or slower: "
                     f"{text('; '.join(strange))}.</p>")
    return words


def section_words(section):
    words = [f"<h2 id=\"{section.part}\">{text(section.title)}</h2>", f"<p>{text(section.about)}</p>"]
    if section.pictures:
        words += ["<div class=\"pictures\">", *(picture(*each) for each in section.pictures), "</div>"]
    for title, rows in section.shown:
        words += [f"<h3>{text(title)}</h3>", table(rows)]
    words += [figure(name, chart, caption, len(section.charts) == 1) for name, (chart, caption) in section.charts.items()]
    words += [f"<p>{text(note)}</p>" for note in section.notes]
    if len(section.table) > 1:
        remarks = "".join(f"<p>{text(remark)}</p>" for remark in section.remarks)
        words.append(f"<details><summary>The figures</summary>{table(section.table)}{remarks}</details>")
    return words


def page(results, sections, opening, failures, pictures):
    """Returns the page. `opening` is HTML, the first screen."""
    links = "\n".join(f"<a href=\"#{section.part}\">{text(section.title)}</a>" for section in sections)
    words = ["<!DOCTYPE html>", "<html lang=\"en\"><head><meta charset=\"utf-8\">",
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">",
             f"<title>hedron: how fast, how exact, how stable</title><style>{PAGE_STYLE}</style></head><body>",
             "<h1>hedron: how fast, how exact, how stable</h1>", opening, *warnings(results, failures),
             f"<details><summary>Contents</summary><nav>{links}</nav></details>"]
    for section in sections:
        words += section_words(section)
    return "\n".join([*words, *machines(results, pictures), "</body></html>", ""])


CSV_HEAD = ["machine", "device", "device_name", "part", "series", "x", "scene", "options", "renderer", "runs", "rejected",
            "disturbed", "trace_ms_q1", "trace_ms_median", "trace_ms_q3", "frame_ms_median", "scale", "reason"]


def csv_text(results):
    """Returns a line for each measurement of each machine."""
    found = io.StringIO()
    writer = csv.writer(found, lineterminator="\n")
    writer.writerow(CSV_HEAD)
    for result in results:
        names = {device["label"]: device["name"] for device in result["devices"]}
        for entry in result["measurements"]:
            each, figures = entry["summary"], [0, len(entry["rejected"]), *[""] * 5]
            if each:
                figures = [each["runs"], each["rejected"], int(each["noisy"]),
                           *(each["trace_ms"][key] for key in ("q1", "median", "q3")), each["frame_ms"]["median"]]
            writer.writerow([result["machine"]["name"], entry["device"], names[entry["device"]], entry["part"], entry["series"],
                             entry["x"], entry["scene"], " ".join(entry["options"]), entry["renderer"] or "", *figures,
                             entry["scale"], entry["reason"] or ""])
    return found.getvalue()
