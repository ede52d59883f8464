# SPDX-License-Identifier: MIT
"""A result as tables of (title, rows, lines below), for the terminal and for documents."""
from harness.measure.numbers import number, spread_text
from harness.store.result import machine_words

FEW_ROWS = 5
HEAD = ["what", "device", "least", "aim", "figure [q1..q3]", "unit", "to least", "to aim", "met"]


def lines(rows):
    """Returns lines with the first two columns aligned left and the others right."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["  ".join(cell.ljust(width) if column < 2 else cell.rjust(width)
                      for column, (cell, width) in enumerate(zip(cells, widths))).rstrip() for cells in rows]


# ---- rows with targets

def target_words(value):
    return "" if value is None else number(value, 3).rstrip("0").rstrip(".") if value < 1 else f"{value:g}"


def cells(row):
    start = [row["what"], row["device"] or "-", target_words(row["least"]), target_words(row["aim"])]
    if row["figure"] is None:
        return [*start, "-", row["unit"], "", "", ""]
    ratios = [number(row[key], 3) if row[key] is not None else "" for key in ("ratio_to_least", "ratio_to_aim")]
    return [*start, spread_text({**row, "median": row["figure"]}), row["unit"], *ratios, row["verdict"] or ""]


def remarks(rows):
    """Returns notes and reasons, each once, with its rows; many rows by their keys."""
    said = {}
    for row in rows:
        if row["reason"]:
            alike = [each["what"] for each in rows if each["reason"] == row["reason"]]
            said.setdefault(row["reason"], {})[row["what"].strip() if len(alike) <= FEW_ROWS else row["key"]] = True
        if row["note"]:
            said.setdefault(row["note"], {})[row["key"]] = True
    return [f"{', '.join(who)}: {words}" for words, who in said.items()]


# ---- all tables

def head_lines(result):
    load = result["machine"]
    few = f"targets for two cores on {result['few_cores']}; " if "few_cores" in result else ""
    found = [f"hedron {result['hedron']['version']}, {machine_words(result)}; {few}"
             f"load {load['load_before'][0]} before, {(load['load_after'] or ['?'])[0]} after"]
    found += [f"{device['label']}: {device['name'] or '-'}{', cannot run: ' + device['reason'] if device['reason'] else ''}"
              for device in result["devices"]]
    if result["quick"]:
        found.append("QUICK: few frames and repeats; rows with a scaled time say so.")
    if result["hedron"]["options"]:
        found.append(f"CHANGED by {' '.join(result['hedron']['options'])}: figures are not compared with targets.")
    return found


def all_tables(result, tables):
    """Returns all tables, including that of the rows."""
    unfinished = [] if result["complete"] else ["Interrupted: figures are of what was measured until then."]
    below = [*remarks(result["rows"]), *unfinished, result["pictures"]["sentence"]]
    return [("", [HEAD, *map(cells, result["rows"])] if result["rows"] else [], below), *tables]


def text(result, tables):
    parts = head_lines(result)
    for title, rows, below in all_tables(result, tables):
        parts += ["", *([f"{title}:"] if title else []), *(lines(rows) + [""] if rows else []), *below]
    return "\n".join(parts)


def markdown(result, tables):
    parts = [f"- {words}" for words in head_lines(result)] + [""]
    for title, rows, below in all_tables(result, tables):
        table = ["| " + " | ".join(cell.strip().replace("|", "\\|") for cell in cells) + " |" for cells in rows]
        table[1:1] = ["|" + "---|" * len(row) for row in rows[:1]]
        parts += [*([f"## {title}", ""] if title else []), *(table + [""] if table else []),
                  *[f"- {words}" for words in below], ""]
    return "\n".join(parts)
