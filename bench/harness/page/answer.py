# SPDX-License-Identifier: MIT
"""The first screen of the page: a table of all devices, and a few sentences, all in numbers of the results."""
import html

from harness.chart.rows import ms
from harness.measure.numbers import number
from harness.page.section import BACKENDS, all_devices

FAILS, ABSENT, NONE = "what fails", "not measured", "-"


def figure(name, value, words=None):
    """Returns HTML of a number; its class names the kind."""
    words = words or (number(value, 3) if value else "0")
    return f"<strong data-figure=\"{html.escape(name)}\" data-value=\"{value!r}\">{html.escape(words)}</strong>"


def milliseconds(name, value):
    return figure(name, value, ms(value))


def runnable(result):
    return [device for device in result["devices"] if device["reason"] is None]


def failing(device):
    """Returns what failed on the device, in words."""
    result, label = device.result, device.label
    found = [f"self-test: {each['verdict']}" for each in result.get("certificates") or []
             if f"{each['backend']}:{each['index']}" == label and each["verdict"] != "right"]
    if result["pictures"] and result["pictures"]["same"] is False:
        found.append("pictures differ")
    return "; ".join([*found, *dict.fromkeys(f"{entry['part']}: {entry['reason']}" for entry in result["measurements"]
                                             if entry["device"] == label and entry["failed"])]) or "nothing"


def row(parts, device):
    """Returns {column: (value, HTML)} of a device."""
    found = {}
    for part in parts:
        for column, name, value, words in part.cells(device) if part.cells else ():
            found[column] = value, html.escape(words) if value is None else figure(name, value, words)
    return found


def table(parts, results):
    """Returns HTML: a row for each device, the fastest first, then those that cannot run."""
    rows = [(device, row(parts, device)) for device in all_devices(results)]
    if not rows:
        return ""
    rows.sort(key=lambda each: [*each[1].values(), (None, "")][0][0] or float("inf"))
    columns = [*rows[0][1], FAILS]
    lines = ["<tr>" + "".join(f"<th>{html.escape(column)}</th>" for column in ["device", *columns]) + "</tr>"]
    cells = [(device.name, [*(words for _, words in found.values()), html.escape(failing(device))]) for device, found in rows]
    cells += [(f"{BACKENDS[device['backend']]} on {result['machine']['name']}",
               [NONE] * (len(columns) - 1) + [f"cannot run: {html.escape(device['reason'])}"])
              for result in results for device in result["devices"] if device["reason"] is not None]
    lines += [f"<tr><th>{html.escape(name)}</th>" + "".join(
        f"<td data-column=\"{html.escape(column)}\"{' class=none' * (words == NONE)}>{words}</td>"
        for column, words in zip(columns, these)) + "</tr>"
        for name, these in cells]
    return "<table>" + "\n".join(lines) + "</table>"


def opening(parts, results):
    parts = sorted(parts.values(), key=lambda part: part.lead)
    said = [sentence for part in parts if part.answer for sentence in part.answer(results)]
    return f"<header>{table(parts, results)}\n<p>{' '.join(said)}</p></header>"
