# SPDX-License-Identifier: MIT
"""A sheet of SVG, filled from the top, and charts. Each chart can be drawn wide, and narrow for a telephone. Its
colours follow the reader's light or dark screen."""
import html
import re
import textwrap
from collections.abc import Callable
from dataclasses import dataclass

from harness.store.result import machine_words, scene_words

WIDE, NARROW, MARGIN = 960, 368, 16  # the margin of charts in files of their own
LETTER = 0.56  # width of a letter by its height, an estimate without a browser
VENDOR_WORDS = re.compile(r"NVIDIA|AMD|Intel|Processor|CPU|\d+GB|HBM\w*|\d+-Core|@|\d[.\d]*GHz")  # length of devices' names
MARKS = ("circle", "square", "diamond", "triangle", "cross", "down", "plus")
# Colours of devices, distinct for the colour-blind, on light and on dark paper.
LIGHT = ("#0072b2", "#c24e00", "#007a5a", "#a3397a", "#5a46b8", "#8a6100", "#5b6570", "#b3202c")
DARK = ("#5ab4f0", "#ff9350", "#2ccb9a", "#f09ac8", "#a99dff", "#e2b443", "#aeb8c2", "#ff7b80")
COLOURS = len(LIGHT)
SHAPES = {"square": "M-.9-.9H.9V.9H-.9Z", "diamond": "M0-1.25 1.25 0 0 1.25-1.25 0Z", "triangle": "M0-1.2 1.15.9H-1.15Z",
          "down": "M0 1.2 1.15-.9H-1.15Z", "cross": "M-1-1 1 1M-1 1 1-1", "plus": "M0-1.2V1.2M-1.2 0H1.2"}


def variables(ink, soft, grid, paper, bad, colours):
    return (f"--ink:{ink};--soft:{soft};--grid:{grid};--paper:{paper};--bad:{bad};"
            + "".join(f"--k{place}:{value};" for place, value in enumerate(colours)))


STYLE = (":root{color-scheme:light dark;" + variables("#1c1e21", "#5a6068", "#d9dce0", "#ffffff", "#b3202c", LIGHT) + "}\n"
         "@media(prefers-color-scheme:dark){:root{" + variables("#e7e9ec", "#a3abb5", "#3a4048", "#16181b", "#ff7b80", DARK)
         + "}}\n" + "".join(f".k{place}{{color:var(--k{place})}}" for place in range(COLOURS)) + """
.ink{color:var(--ink)}.soft{color:var(--soft)}.bad{color:var(--bad)}
svg text{fill:var(--ink);font-family:sans-serif}svg text.soft{fill:var(--soft)}svg text.strong{font-weight:bold}
svg .grid{stroke:var(--grid)}svg .axis{stroke:var(--soft)}svg .guide{stroke:var(--soft);stroke-dasharray:2 4;fill:none}
svg .over{paint-order:stroke;stroke:var(--paper);stroke-width:4px}svg .paper{fill:var(--paper)}""")


def plain(words):
    """Returns one line of printable characters."""
    return " ".join("".join(letter if letter.isprintable() else " " for letter in words).split())


def model(device):
    """Returns the short name of a device: without vendor, sizes, and what PoCL puts before a processor's name."""
    name = plain(re.sub(r"^(pthread|cpu)-\S+-", "", device["name"]).replace("(R)", "").replace("(TM)", ""))
    return " ".join(word for word in name.split() if not VENDOR_WORDS.fullmatch(word)) or name


def device_title(device):
    return f"{device['label']} {model(device)}"


def look(colour):
    """Returns the class of a device's number, or of a name."""
    return f"k{colour % COLOURS}" if isinstance(colour, int) else colour


def mark_of(place):
    return MARKS[place % len(MARKS)]


class Sheet:
    """A sheet; `y` is the end of the drawing so far."""

    def __init__(self, width):
        self.width, self.y, self.parts = width, 0.0, []
        self.is_narrow = width < WIDE
        self.size = 13 if self.is_narrow else 14
        self.line = self.size + 5  # distance between baselines

    def add(self, element):
        self.parts.append(element)

    def length(self, words):
        return LETTER * self.size * len(words)

    def wrapped(self, words, width):
        return textwrap.wrap(words, max(8, int(width / LETTER / self.size))) or [""]

    def text(self, x, y, words, anchor="start", kind=""):
        self.add(f"<text x=\"{x:.1f}\" y=\"{y:.1f}\" font-size=\"{self.size}\" text-anchor=\"{anchor}\""
                 f"{f' class={chr(34)}{kind}{chr(34)}' if kind else ''}>{html.escape(words)}</text>")

    def paragraph(self, words, kind="", x=0.0, width=None, y=None):
        """Returns the y at which it ends."""
        end = self.y if y is None else y
        for line in self.wrapped(words, width or self.width):
            end += self.line
            self.text(x, end - 5, line, kind=kind)
        if y is None:
            self.y = end
        return end

    def stroke(self, points, colour, width=1.0, more=""):
        """Draws a line through all points; without a colour `more` has a class."""
        path = "M" + " ".join(f"{x:.1f} {y:.1f}" for x, y in points)
        kind = f" class=\"{look(colour)}\" stroke=\"currentColor\" fill=\"none\"" if colour is not None else ""
        self.add(f"<path d=\"{path}\"{kind} stroke-width=\"{width:g}\" {more}/>")

    def mark(self, name, x, y, size, colour, hint="", hollow=False):
        """Draws one of MARKS; `hint` appears when the reader points at it."""
        words = f"<title>{html.escape(hint)}</title>" if hint else ""
        start = f"class=\"{look(colour)}\" stroke=\"currentColor\" stroke-width=\"1.8\""
        fill = "class=\"paper\"" if hollow and name not in ("cross", "plus") else "fill=\"currentColor\""
        if name == "circle":
            shape = f"<circle cx=\"{x:.1f}\" cy=\"{y:.1f}\" r=\"{size:.1f}\" {fill}/>"
        else:
            shape = (f"<path d=\"{SHAPES[name]}\" transform=\"translate({x:.1f} {y:.1f}) scale({size:.1f})\" "
                     f"vector-effect=\"non-scaling-stroke\" {fill}/>")
        self.add(f"<g {start}>{words}{shape}</g>")

    def legend(self, entries, x, width, y):
        """Draws entries of (function that draws a sample at a place, words), as many in a row as fit; returns the y at
        which it ends."""
        at, sample = x, 30
        y += self.line
        for draw, words in entries:
            written = self.wrapped(words, width - sample)
            if at > x and at + sample + self.length(words) > x + width:
                at, y = x, y + self.line
            draw(at + 12, y - 9)
            for place, each in enumerate(written):
                self.text(at + sample, y - 5 + place * self.line, each)
            y += self.line * (len(written) - 1)
            at += sample + max(map(self.length, written)) + 18
        return y + 4

    def svg(self, more="", margin=0):
        box = f"{-margin} {-margin} {self.width + 2 * margin:g} {self.y + 4 + 2 * margin:.0f}"
        return f"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{box}\">{more}" + "\n".join(self.parts) + "</svg>"


@dataclass(frozen=True)
class Chart:
    """A chart; `paint` draws it alone on a sheet, and the words stand beside it, on a page or in a file of its own."""
    about: dict
    title: str
    caption: str
    paint: Callable

    def svg(self, width):
        sheet = Sheet(width)
        self.paint(sheet)
        return sheet.svg()

    def document(self):
        """Returns SVG with title, scene, machine and caption."""
        sheet = Sheet(WIDE)
        sheet.paragraph(self.title, "strong")
        sheet.paragraph(f"hedron {self.about['hedron']['version']}, {scene_words(self.about)}", "soft")
        sheet.paragraph(machine_words(self.about), "soft")
        sheet.y += 10
        self.paint(sheet)
        sheet.y += 6
        sheet.paragraph(self.caption)
        paper = f"<rect x=\"{-MARGIN}\" y=\"{-MARGIN}\" width=\"100%\" height=\"100%\" class=\"paper\"/>"
        return sheet.svg(f"<style>{STYLE}</style>{paper}\n", MARGIN) + "\n"
