# SPDX-License-Identifier: MIT
"""A section of bench/study's page, and what the sentences of all have in common."""
from dataclasses import dataclass, field, replace

from harness.chart.gnuplot import is_wide
from harness.chart.lines import Axis, axis_number, lines
from harness.measure.numbers import number, spread_text
from harness.measure.points import WHOLE_FRAME

MOST_CLAUSES = 4
TOO_LITTLE = "Too little was measured to compare."


@dataclass
class Section:
    part: str
    title: str
    about: str  # what was measured, in a sentence or two
    charts: dict = field(default_factory=dict)  # name: (height, commands)
    captions: dict = field(default_factory=dict)
    table: list = field(default_factory=list)  # rows of cells, the first is the head
    notes: list = field(default_factory=list)

    def draw(self, name, kind, about, title, caption, *arguments, **named):
        self.charts[f"study_{name}"] = kind(about, title, caption, *arguments, **named)
        self.captions[f"study_{name}"] = caption


def ratio(value):
    return f"{number(value, 3)} times"


def sentence(words):
    return words[:1].upper() + words[1:]


def speed_words(factor, than):
    return f"{ratio(factor)} as fast as {than}" if factor >= 1 else f"{ratio(1 / factor)} as slow as {than}"


def middle(entry):
    return entry["summary"]["trace_ms"]["median"]


def y_axis(drawn=None):
    """Logarithmic, or as the lines need it."""
    return Axis("milliseconds for each frame",
                drawn is None or is_wide([spread["median"] for line in drawn for _, spread in line.points]))


def ticks_of(drawn):
    return {axis_number(x): x for x in sorted({x for line in drawn for x, _ in line.points})}


def growth(line):
    """(x, y) of both ends of a line."""
    (x, first), (last_x, last) = line.points[0], line.points[-1]
    return x, first["median"], last_x, last["median"]


def few(told):
    """As many clauses as a sentence can have."""
    more = len(told) - MOST_CLAUSES
    return "; ".join(told[:MOST_CLAUSES]) + (f"; and {more} more in the figures below" if more > 0 else "")


def growth_words(drawn, what, words=axis_number):
    """How each line grows from end to end."""
    told = []
    for line in drawn:
        if len(line.points) > 1:
            x, first, last_x, last = growth(line)
            start = "" if told else f"From {words(x)} to {words(last_x)} {what} a frame takes "
            told.append(f"{start}{ratio(last / first)} as long on {line.short}")
    return few(told) + "." if told else "There is one point only."


def best_words(drawn, words=axis_number):
    """The fastest point of each line."""
    told = []
    for line in drawn:
        x, spread = min(line.points, key=lambda point: point[1]["median"])
        worst = max(each["median"] for _, each in line.points)
        told.append(f"{words(x)} on {line.short} (the slowest takes {ratio(worst / spread['median'])} as long)")
    return few(told)


def table_of(sources, part, name, what):
    """A row for each measurement."""
    found = [["device", "machine", what, "milliseconds [quartiles]", "times", "runs", "rejected", "options", "renderer"]]
    for device in sources.with_part(part):
        for entry in device.entries(part):
            each = entry["summary"]
            disturbed = " (disturbed)" if each["noisy"] else ""
            found.append([device.label, device.result["machine"]["name"], name(entry),
                          spread_text(each["trace_ms"], " .. ") + disturbed, str(entry["scale"]), str(each["runs"]),
                          str(each["rejected"]), " ".join(entry["options"]), entry["renderer"]])
    return found


def ideal(drawn):
    """As if twice as many took half as long, from the first point of each line."""
    found = {"bounds": [], "bound_name": "bound: in proportion to one"}
    for line in drawn:
        x, first = line.points[0][0], line.points[0][1]["median"]
        if len(line.points) > 1:
            found["bounds"].append([(each, first * x / each) for each, _ in line.points])
    return found


def sweep(sources, section, title, x_axis, caption=None, scene=WHOLE_FRAME, bounded=False):
    """A line for each device, and a table."""
    drawn = [device.line(section.part) for device in sources.with_part(section.part)]
    words = caption(drawn) if caption else growth_words(drawn, x_axis.words)
    section.draw(section.part, lines, sources.about(scene), title, words, replace(x_axis, ticks=ticks_of(drawn)),
                 y_axis(None if x_axis.logarithmic else drawn), drawn, **(ideal(drawn) if bounded else {}))
    section.table = table_of(sources, section.part, lambda entry: f"{entry['x']:g}", x_axis.words)


def scaled_note(entries):
    found = []
    for scale in sorted({entry["scale"] for entry in entries if entry["scale"] > 1}):
        devices = sorted({entry["device"] for entry in entries if entry["scale"] == scale})
        found.append(f"Times of {' and '.join(devices)} are those of a picture with 1/{scale} of the samples, "
                     f"times {scale}, where the figures say so.")
    return found
