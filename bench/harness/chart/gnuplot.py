# SPDX-License-Identifier: MIT
"""Charts, all in one style, drawn by gnuplot as SVG and PNG. A chart is (height, commands)."""
import math
import os
import shutil
import subprocess
import textwrap

from harness.store.result import machine_words, scene_words

# Okabe and Ito's colours, told apart by everyone; yellow is left out, for it is faint on white.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"]
WIDTH = 1200
TERMINALS = {"svg": "svg background rgb 'white' font 'sans-serif,15'", "png": "pngcairo font 'sans-serif,12'"}
LOGARITHMIC_FROM = 20  # times the smallest value
LABEL_LENGTH = 42
CAPTION_LENGTH = 140
TITLE_LENGTH = 110
TICKS, FEW_TICKS, FEW_POWERS = (1, 2, 5), (1,), 3  # digits of the labels of a logarithmic axis: of few powers of ten, of many


def quoted(words):
    """A string for gnuplot, in which nothing is special but the end of a line."""
    parts = ["'" + line.replace("'", "''") + "'" for line in words.split("\n")]
    return '."\\n".'.join(parts)


def plain(words, length):
    """One line of printable characters, shortened."""
    clean = " ".join("".join(letter if letter.isprintable() else " " for letter in words).split())
    return clean if len(clean) <= length else clean[: length - 3] + "..."


def device_title(device):
    return f"{device['label']} {plain(device['name'].replace('(R)', '').replace('(TM)', ''), LABEL_LENGTH)}"


def colour(place):
    return COLOURS[place % len(COLOURS)]


def is_wide(values):
    """Whether an axis should be logarithmic."""
    return bool(values) and min(values) > 0 and max(values) / min(values) >= LOGARITHMIC_FROM


def axis_number(value):
    """For an axis: no exponent and no trailing zeros."""
    return f"{value:,.12f}".rstrip("0").rstrip(".") if value < 1e15 else f"{value:g}"


def tick_words(low, high):
    """{words: value} for a logarithmic axis."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    values = [digit * 10.0 ** power for power in powers
              for digit in (TICKS if math.log10(high / low) <= FEW_POWERS else FEW_TICKS)]
    return {axis_number(value): value for value in values if low <= value <= high}


class Chart:
    """Commands in the making: title, scene and machine are above, then room for so many lines of the legend, and the caption
    is below."""

    def __init__(self, about, title, caption, legend_lines=0):
        below = textwrap.wrap(caption, CAPTION_LENGTH)
        above = [title, plain(f"hedron {about['hedron']['version']}, {scene_words(about)}", TITLE_LENGTH),
                 plain(machine_words(about), TITLE_LENGTH)]
        self.caption_height = 23 * len(below)
        self.plots = []
        self.commands = [
            "set encoding utf8",
            f"set label 2 {quoted(chr(10).join(above))} at screen 0.5, screen 1 offset character 0, -1.5 center noenhanced",
            f"set tmargin {5 + legend_lines}", "set border 3 linecolor rgb '#555555'", "set tics nomirror out",
            "set grid linecolor rgb '#dddddd' linewidth 1 linetype 1", f"set bmargin {5 + len(below)}", "set rmargin 6",
            f"set label 1 {quoted(chr(10).join(below))} at screen 0.5, character {len(below) - 0.3} center noenhanced "
            "textcolor rgb '#333333'"]

    def add(self, *commands):
        self.commands += commands

    def data(self, name, rows):
        """What gnuplot then finds as $name; values of a row are numbers, or words that are quoted already."""
        self.add(f"${name} << END", *(" ".join(value if isinstance(value, str) else repr(value) for value in row)
                                      for row in rows), "END")

    def ticks(self, name, ticks):
        if ticks:
            self.add(f"set {name}tics (" + ", ".join(f"{quoted(words.replace('%', '%%'))} {value!r}"
                                                      for words, value in ticks.items()) + ") noenhanced")

    def axis(self, name, words, low, high, logarithmic=False, ticks=None):
        """`ticks` are places by their words; none: usual ones."""
        if logarithmic:
            low, high, words = low / 1.4, high * 1.4, f"{words} (logarithmic)"
            self.add(f"set logscale {name}")
        self.ticks(name, ticks or (tick_words(low, high) if logarithmic else {}))
        self.add(f"set {name}label {quoted(words)}", f"set {name}range [{low!r}:{high!r}]")

    def legend(self, rows, more=""):
        self.add(f"set key at graph 0.5, graph 1.03 center bottom vertical maxrows {rows} Left reverse noenhanced{more}")

    def plot(self, what):
        self.plots.append(what)

    def flush(self):
        """Everything that is to be plotted in the same place."""
        self.add("plot " + ", ".join(self.plots))
        self.plots = []

    def finished(self, height):
        if self.plots:
            self.flush()
        return height, self.commands


def remove_old(folder, patterns):
    """So that no chart stands beside numbers that are not its own."""
    for file in (file for pattern in patterns for kind in TERMINALS for file in folder.glob(f"{pattern}.{kind}")):
        file.unlink()


def draw(wanted, folder):
    """Draws the charts, by their names; returns lines that tell what became of them."""
    if not wanted:
        return []
    if shutil.which("gnuplot") is None:
        return ["There is no gnuplot, so there are no charts; its package is gnuplot-nox."]
    told = []
    for name, (height, commands) in wanted.items():
        for kind, terminal in TERMINALS.items():
            file = folder / f"{name}.{kind}"
            script = [f"set terminal {terminal} size {WIDTH},{height}", f"set output {quoted(str(file))}", *commands, ""]
            done = subprocess.run(["gnuplot", "-"], input="\n".join(script), text=True, capture_output=True,
                                  encoding="utf-8", env={**os.environ, "LC_ALL": "C.UTF-8"})
            told.append(f"Chart: {file}" if done.returncode == 0 else
                        f"gnuplot could not draw {file}: {plain(done.stderr, 200)}")
    return told
