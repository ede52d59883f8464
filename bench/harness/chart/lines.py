# SPDX-License-Identifier: MIT
"""Lines with quartiles: a panel for each machine, on the same axes. Each line of a panel is narrower than the one
below it and has other marks, so that none hides another."""
from dataclasses import dataclass

from harness.chart.axes import Scale, draw_below, limits
from harness.chart.sheet import Chart, mark_of
from harness.measure.numbers import number

HEIGHT = {True: 230, False: 280}  # whether the sheet is narrow
GAP = 34
WIDTHS, SIZES = (6.0, 3.5, 1.6), (6.5, 5.0, 3.6)  # widths of lines and marks, from the lowest on
DASHES = {1: "", 2: "stroke-dasharray=\"9 5\"", 4: "stroke-dasharray=\"9 5\""}


@dataclass(frozen=True)
class Line:
    name: str
    points: list  # (x, {"median", "q1", "q3"})
    colour: int
    dash: int = 1
    mark: int = 0
    short: str = ""  # in sentences
    panel: str = ""  # lines of a panel share a plot
    joined: bool = True
    labels: tuple = ()  # (x, y, words) beside points

    def draw(self, sheet, x, y, layer):
        width, size = WIDTHS[layer % len(WIDTHS)], SIZES[layer % len(SIZES)]
        places = [(x(at), y(each["median"])) for at, each in self.points]
        if self.joined:
            sheet.stroke(places, self.colour, width,
                         f"stroke-opacity=\"{0.45 if width > 3 else 0.9}\" stroke-linejoin=\"round\" {DASHES[self.dash]}")
        for (at, each), (left, top) in zip(self.points, places):
            if abs(y(each["q1"]) - y(each["q3"])) > 2:
                sheet.stroke([(left, y(each["q1"])), (left, y(each["q3"]))], self.colour, 1.5)
            sheet.mark(mark_of(self.mark), left, top, size if self.joined else 3, self.colour,
                       f"{self.name}: {at:g}, {number(each['median'], 3)}", layer % 3 == 0 or not self.joined)

    def sample(self, sheet, layer):
        def draw(x, y):
            if self.joined:
                sheet.stroke([(x - 12, y), (x + 12, y)], self.colour, WIDTHS[layer % 3],
                             f"stroke-opacity=\"{0.45 if layer % 3 < 2 else 0.9}\" {DASHES[self.dash]}")
            sheet.mark(mark_of(self.mark), x, y, SIZES[layer % 3] if self.joined else 3, self.colour,
                       hollow=layer % 3 == 0 or not self.joined)
        return draw


def values_of(drawn, bounds):
    xs = [x for line in drawn for x, _ in line.points] + [x for points in bounds for x, _ in points]
    ys = [spread[key] for line in drawn for _, spread in line.points for key in ("median", "q1", "q3")]
    return xs, ys + [y for points in bounds for _, y in points]


def draw_panel(sheet, drawn, scales, top, y_words, bounds, guides):
    x, y = scales
    for words, place in y.ticks().items():
        sheet.stroke([(x.start, place), (x.end, place)], None, 1, 'class="grid"')
        sheet.text(x.start - 6, place + 5, words, "end", "soft")
    sheet.text(x.start, top - 8, y_words, kind="soft")
    for points in bounds:
        sheet.stroke([(x(at), y(value)) for at, value in points], None, 2, 'class="guide"')
    for words, value in guides.items():
        if y.low < value < y.high:
            sheet.stroke([(x.start, y(value)), (x.end, y(value))], None, 1.5, 'class="guide"')
            sheet.text(x.end, y(value) - 5, words, "end", "soft over")
    for layer, line in enumerate(drawn):
        line.draw(sheet, x, y, layer)
    for line in drawn:
        for at, value, words in line.labels:
            right = x(at) + 8 + sheet.length(words) < x.end
            sheet.text(x(at) + (9 if right else -9), y(value) - 7, words, "start" if right else "end", "strong over")


def lines(about, title, caption, x_axis, y_axis, drawn, bounds=(), bound_name="", guides=None):
    """Returns a chart. `bounds` are lists of (x, y), lower limits drawn with the first line's panel that they fit;
    `guides` {words: y} are marked across."""
    drawn = [line for line in drawn if line.points]
    names = list(dict.fromkeys(line.panel for line in drawn))
    of_panel = {name: [line for line in drawn if line.panel == name] for name in names}
    x_values, y_values = values_of(drawn, bounds)
    x_range, y_range = limits(x_values, x_axis.logarithmic), limits(y_values, y_axis.logarithmic, 0)

    def bounds_of(name):
        """Returns the lines that begin at a point of the panel."""
        starts = {(line.points[0][0], line.points[0][1]["median"]) for line in of_panel[name]}
        return [points for points in bounds if points[0] in starts]

    def paint(sheet):
        columns = 1 if sheet.is_narrow else min(2, len(names))
        whole = (sheet.width - GAP * (columns - 1)) / columns
        margin = 12 + max(map(sheet.length, Scale(y_axis, *y_range, 0, 1).ticks()), default=0)
        for first in range(0, len(names), columns):
            row = list(enumerate(names[first:first + columns]))
            ends = []
            for place, name in row:
                left = place * (whole + GAP)
                end = sheet.paragraph(name, "strong", left, whole, sheet.y) if name else sheet.y
                entries = [(line.sample(sheet, layer), line.name) for layer, line in enumerate(of_panel[name])]
                if bounds_of(name) and bound_name:
                    entries.append((lambda x, y: sheet.stroke([(x - 12, y), (x + 12, y)], None, 2, 'class="guide"'), bound_name))
                ends.append(sheet.legend(entries, left, whole, end))
            top = max(ends) + sheet.line + 6
            bottom = top + HEIGHT[sheet.is_narrow]
            for place, name in row:
                left = place * (whole + GAP)
                x = Scale(x_axis, *x_range, left + margin, left + whole - 6)
                sheet.y = max(sheet.y, draw_below(sheet, x, bottom, scale_words(x_axis), top))
                draw_panel(sheet, of_panel[name], (x, Scale(y_axis, *y_range, bottom, top)), top, scale_words(y_axis),
                           bounds_of(name), guides or {})
            sheet.y += 14
    return Chart(about, title, caption, paint)


def scale_words(axis):
    return f"{axis.words}{', logarithmic' if axis.logarithmic else ''}"

