# SPDX-License-Identifier: MIT
"""The page of bench/study: one file of HTML with its charts in it, made of nothing but saved results; and its table."""
import csv
import html
import io
import re

from harness.store.result import is_unfinished

STYLE = """body{font:16px/1.5 sans-serif;max-width:1200px;margin:2em auto;padding:0 1em;color:#222}
h1,h2{line-height:1.2}h2{margin-top:2.2em;border-top:1px solid #ccc;padding-top:.8em}
figure{margin:1em 0}svg{width:100%;height:auto;display:block}
table{border-collapse:collapse;font-size:14px;margin:1em 0}th,td{border:1px solid #ccc;padding:.2em .6em;text-align:left;
vertical-align:top;overflow-wrap:break-word}th{background:#f3f3f3}.wide{overflow-x:auto}
.bad{background:#b00020;color:#fff;padding:.6em 1em}
nav a{margin-right:1em;white-space:nowrap}summary{cursor:pointer;color:#0072B2}"""


METHOD = ("Times are the statistics' own: no start of a program and no building of kernels is in them, but in the last of the "
          "charts of time. The first frame of a run warms up and does not count. A run's figure is the mean of its frames, "
          "and a point is the median of the runs, with whiskers from the first to the third quartile. Runs took turns.")


def text(words):
    return html.escape(str(words))


def table(rows):
    head, *body = rows
    lines = ["<table>", "<tr>" + "".join(f"<th>{text(cell)}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{text(cell)}</td>" for cell in row) + "</tr>" for row in body]
    return "<div class=\"wide\">" + "\n".join([*lines, "</table>"]) + "</div>"


def figure(name, caption, folder):
    """With the SVG in it, but for its head; names within it are its own on a page with others."""
    file = folder / f"{name}.svg"
    if not file.is_file():
        return f"<p>{text(caption)}</p>"
    svg = file.read_text(encoding="utf-8")
    svg = re.sub(r"<title>.*?</title>\s*|<desc>.*?</desc>\s*", "", svg[svg.index("<svg"):], flags=re.S)
    svg = re.sub(r"(\bid=['\"]|href=['\"]#|url\(['\"]?#)", rf"\g<1>{name}-", svg).strip()
    return f"<figure id=\"{name}\" role=\"img\" aria-label=\"{text(caption)}\">\n{svg}\n</figure>"


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
    words += (f"Where other programs took more than {100 * result['interference_limit']:g} % of the processors, a run was "
              f"done again: {rejected} were rejected, and {disturbed} measurements stayed disturbed."
              if all(run["others"] is not None for run in runs) else
              "This system does not tell what other programs took of the processors, so no run was rejected.")
    return words + (f" The load was {min(loads)} to {max(loads)}." if loads else "")


def head(results, failures, pictures):
    words = ["<h1>hedron: a study of speed</h1>", *(f"<p class=\"bad\">{text(each)}</p>" for each in failures)]
    if any(map(is_unfinished, results)):
        words.append("<p class=\"bad\">A study here is unfinished: bench/study goes on where it stopped.</p>")
    if any(result["quick"] for result in results):
        words.append("<p>Quick studies have few repeats and small pictures; they are rough.</p>")
    changed = [f"{result['machine']['name']}: every run had the options {' '.join(result['hedron']['options'])}."
               for result in results if result["hedron"]["options"]]
    absent = [f"{result['machine']['name']}: nothing was measured of {', '.join(result['missing'])}." for result in results
              if result.get("missing")]
    told = [*changed, *map(noise_words, results), *absent, *pictures]
    words += [table(machine_rows(results)), "<ul>", *(f"<li>{text(each)}</li>" for each in told), f"<li>{METHOD}</li>", "</ul>"]
    return words


def section_words(section, folder):
    words = [f"<h2 id=\"{section.part}\">{text(section.title)}</h2>", f"<p>{text(section.about)}</p>"]
    words += [figure(name, caption, folder) for name, (_, caption) in section.charts.items()]
    words += [f"<p>{text(note)}</p>" for note in section.notes]
    if len(section.table) > 1:
        words.append(f"<details><summary>The figures</summary>{table(section.table)}</details>")
    return words


def page(results, sections, failures, pictures, folder):
    links = "\n".join(f"<a href=\"#{section.part}\">{text(section.title)}</a>" for section in sections)
    words = ["<!DOCTYPE html>", "<html lang=\"en\"><head><meta charset=\"utf-8\">",
             "<meta name=\"viewport\" content=\"width=device-width\"><title>hedron: a study of speed</title>",
             f"<style>{STYLE}</style></head><body>", *head(results, failures, pictures), f"<nav>{links}</nav>"]
    for section in sections:
        words += section_words(section, folder)
    return "\n".join([*words, "</body></html>", ""])


CSV_HEAD = ["machine", "device", "device_name", "part", "series", "x", "scene", "options", "renderer", "runs", "rejected",
            "disturbed", "trace_ms_q1", "trace_ms_median", "trace_ms_q3", "frame_ms_median", "scale", "reason"]


def csv_text(results):
    """A line for each measurement of each machine."""
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
