# SPDX-License-Identifier: MIT
"""Dots along a common axis, a row for each name; marks distinguish several dots of a row."""
import itertools
from dataclasses import dataclass

from harness.chart.axes import Axis, Scale, draw_below, limits, logarithmic_ticks
from harness.chart.sheet import Chart, mark_of
from harness.measure.numbers import number

NAMES, WORDS = 0.3, 0.24  # shares of a wide chart's width, for names and for words
APART = 9  # distance between dots of one row
SIZE = 5.5


@dataclass(frozen=True)
class Row:
    """A dot. Rows of one name and group that follow each other share a line."""
    name: str
    spread: dict  # "median", "q1", "q3"
    words: str = ""  # words at the end of the row
    colour: object = 0  # a device's number, or a name
    bound: float = None  # a mark, such as a lower bound
    group: str = ""  # a heading of rows
    variant: str = ""  # distinguishes dots of a line


def one_value(value):
    return {"median": value, "q1": value, "q3": value}


def ms(value):
    return f"{number(value, 3)} ms" if value < 1000 else f"{number(value / 1000, 3)} s"


def spread_words(spread):
    unit, name = (1, "ms") if spread["median"] < 1000 else (1000, "s")
    first, middle, third = (number(spread[key] / unit, 3) for key in ("q1", "median", "q3"))
    return f"{middle} {name} [{first} .. {third}]"


class Painter:
    def __init__(self, sheet, drawn, axis, ends, spans):
        self.sheet, self.drawn, self.spans = sheet, drawn, spans
        self.variants = list(dict.fromkeys(row.variant for row in drawn if row.variant))
        has_words = any(row.words for row in drawn)
        left, right = (8.0, sheet.width - 8) if sheet.is_narrow else (
            NAMES * sheet.width, sheet.width * (1 - WORDS * has_words) - 8)
        self.scale = Scale(axis, *ends, left, right)

    def legend(self, bound_name):
        entries = []
        for place, variant in enumerate(self.variants):
            colours = {row.colour for row in self.drawn if row.variant == variant}
            colour = colours.pop() if len(colours) == 1 else "ink"
            entries.append((lambda x, y, place=place, colour=colour: self.sheet.mark(mark_of(place), x, y, SIZE, colour), variant))
        if bound_name and any(row.bound for row in self.drawn):
            entries.append((lambda x, y: self.sheet.stroke([(x, y - 8), (x, y + 8)], "ink", 2.5), bound_name))
        if entries:
            self.sheet.y = self.sheet.legend(entries, 0, self.sheet.width, self.sheet.y) + 4

    def dot(self, row, y):
        place = self.variants.index(row.variant) if row.variant else 0
        y += APART * (place - (len(self.variants) - 1) / 2) if self.variants else 0
        middle, first, third = (self.scale(row.spread[key]) for key in ("median", "q1", "q3"))
        if self.spans:
            self.sheet.stroke([(first, y), (max(third, first + 1), y)], row.colour, 12, 'stroke-opacity="0.8"')
            return
        if third - first > 2:
            self.sheet.stroke([(first, y), (third, y)], row.colour, 2)
        if row.bound:
            at = self.scale(row.bound)
            self.sheet.stroke([(at, y - 8), (at, y + 8)], "ink", 2.5)
        said = ": ".join(filter(None, (row.name, row.variant, row.words or number(row.spread["median"], 3))))
        self.sheet.mark(mark_of(place), middle, y, SIZE, row.colour, said, row.spread["median"] <= 0)

    def line(self, rows):
        """Draws the dots of one name, beside it if the sheet is wide, else below it."""
        sheet, words = self.sheet, " · ".join(row.words for row in rows if row.words)
        deep = max(22, APART * len(self.variants) + 12)
        if sheet.is_narrow:
            sheet.y = max(sheet.paragraph(rows[0].name, "", 0, sheet.width - sheet.length(words) - 10, sheet.y),
                          sheet.y + sheet.line)
            sheet.text(sheet.width, sheet.y - 5, words, "end", "soft")
            y = sheet.y + deep / 2
            bottom = sheet.y + deep
        else:
            names, notes = sheet.wrapped(rows[0].name, NAMES * sheet.width - 16), sheet.wrapped(words, WORDS * sheet.width)
            bottom = sheet.y + max(deep, sheet.line * max(len(names), len(notes)) + 4)
            y = (sheet.y + bottom) / 2
            for these, x, anchor, kind in ((names, NAMES * sheet.width - 14, "end", ""),
                                           (notes if words else (), sheet.width * (1 - WORDS), "start", "soft")):
                for place, each in enumerate(these):
                    sheet.text(x, y + 5 + sheet.line * (place - (len(these) - 1) / 2), each, anchor, kind)
        sheet.stroke([(self.scale.start, y), (self.scale.end, y)], None, 1, 'class="grid"')
        for row in rows:
            self.dot(row, y)
        sheet.y = bottom


def rows(about, title, caption, unit, drawn, bound_name="", spans=False):
    """Returns a chart: a dot for each row, with whiskers to the quartiles, and a mark at its bound. The axis is logarithmic,
    except with `spans`, which reach from the first to the third quartile. A value of 0 stands at the left end, hollow."""
    values = [row.spread[key] for row in drawn for key in ("median", "q1", "q3")] + [row.bound for row in drawn if row.bound]
    axis, ends = Axis(unit, not spans), limits(values, not spans)
    if not spans and min(values) <= 0:
        ends = ends[0] / 3, ends[1]
        usual = {words: value for words, value in logarithmic_ticks(*ends).items() if value > 2 * ends[0]}
        axis = Axis(unit, True, {"none": ends[0], **usual})

    def paint(sheet):
        painter = Painter(sheet, drawn, axis, ends, spans)
        painter.legend(bound_name)
        top, before, under = sheet.y, None, len(sheet.parts)
        for (group, _), these in itertools.groupby(drawn, key=lambda row: (row.group, row.name)):
            if group and group != before:
                sheet.y += 4
                sheet.paragraph(group, "strong")
            before = group
            painter.line(list(these))
        words = f"{unit}{'' if spans else ', logarithmic'}"
        over = sheet.parts[under:]
        del sheet.parts[under:]
        sheet.y = draw_below(sheet, painter.scale, sheet.y + 4, words, None if sheet.is_narrow else top)
        sheet.parts += over
    return Chart(about, title, caption, paint)

