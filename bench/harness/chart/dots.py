# SPDX-License-Identifier: MIT
"""How often something fails at each of many places: the more often, the larger the dot."""
import math
from dataclasses import dataclass

from harness.chart.axes import draw_name
from harness.chart.sheet import Chart

LEAST = 1e-5  # share of the smallest dot
SMALL, LARGE, NEVER = 2.0, 9.0, 1.6
LEGEND = {"never": 0, "1 of 10 000": 1e-4, "1 of 100": 1e-2, "always": 1}
NAMES = 0.28  # share of a wide chart's width


@dataclass(frozen=True)
class Block:
    """Columns that belong together."""
    words: str
    columns: list  # names of the columns


@dataclass(frozen=True)
class Dots:
    name: str
    shares: list  # a share for each column of each block; None: not tried
    is_ours: bool = False


def radius(share):
    part = 1 - math.log(max(share, LEAST)) / math.log(LEAST)
    return SMALL + (LARGE - SMALL) * part


def dot(sheet, x, y, share, hint=""):
    if share:
        sheet.mark("circle", x, y, radius(share), "bad", hint)
    elif share is not None:
        sheet.mark("circle", x, y, NEVER, "soft", hint)


def dots(about, title, caption, blocks, drawn):
    """Returns a chart; `ours` has the names in bold."""
    def paint(sheet):
        sheet.y = sheet.legend([(lambda x, y, share=share: dot(sheet, x, y, share), words) for words, share in LEGEND.items()],
                               0, sheet.width, sheet.y)
        left = 0 if sheet.is_narrow else NAMES * sheet.width
        columns = sum(len(block.columns) for block in blocks)
        step = (sheet.width - left) / (columns + len(blocks) - 1)
        starts = [left + step * (sum(len(each.columns) for each in blocks[:place]) + place + 0.5) for place in range(len(blocks))]

        ends = [sheet.paragraph(block.words, "soft", start - step / 2, step * len(block.columns), sheet.y)
                for block, start in zip(blocks, starts)]
        sheet.y = max(ends) + sheet.line
        until = -1e9
        for block, start in zip(blocks, starts):
            for place, name in enumerate(block.columns):
                until = draw_name(sheet, start + step * place, sheet.y - 4, name, until)
        for each in drawn:
            if sheet.is_narrow:
                sheet.paragraph(each.name, "strong" if each.is_ours else "")
            else:
                sheet.text(left - 12, sheet.y + 16, each.name, "end", "strong" if each.is_ours else "")
            y = sheet.y + 11
            for start, block, shares in zip(starts, blocks, each.shares):
                sheet.stroke([(start - step / 2, y), (start + step * (len(shares) - 0.5), y)], None, 1, 'class="grid"')
                for place, share in enumerate(shares):
                    hint = "" if share is None else f"{each.name}, {block.words} {block.columns[place]}: {100 * share:.3g} %"
                    dot(sheet, start + step * place, y, share, hint)
            sheet.y += 24
    return Chart(about, title, caption, paint)
