# SPDX-License-Identifier: MIT
"""Charts, all in one style, drawn by gnuplot as SVG and PNG."""
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


def quoted(words):
    """A string for gnuplot, in which nothing is special but the end of a line."""
    parts = ["'" + line.replace("'", "''") + "'" for line in words.split("\n")]
    return '."\\n".'.join(parts)


def plain(words, length):
    """One line of printable characters, shortened."""
    clean = " ".join("".join(letter if letter.isprintable() else " " for letter in words).split())
    return clean if len(clean) <= length else clean[: length - 3] + "..."


def device_name(device):
    return plain(device["name"].replace("(R)", "").replace("(TM)", ""), LABEL_LENGTH)


def device_title(device):
    return f"{device['label']} {device_name(device)}"


def data(name, lines):
    """What gnuplot then finds as $name."""
    return [f"${name} << END", *lines, "END"]


def numbers(*values):
    return " ".join(map(repr, values))


def colour(place):
    return COLOURS[place % len(COLOURS)]


def is_wide(values):
    """Whether an axis should be logarithmic."""
    return bool(values) and min(values) > 0 and max(values) / min(values) >= LOGARITHMIC_FROM


def style(result, title, caption, legend_lines=0):
    """What all charts have: title, scene and machine above, then the legend, one sentence below."""
    below = textwrap.wrap(caption, CAPTION_LENGTH)
    above = [title, plain(f"hedron {result['hedron']['version']}, {scene_words(result)}", TITLE_LENGTH),
             plain(machine_words(result), TITLE_LENGTH)]
    return [
        "set encoding utf8",
        f"set label 2 {quoted(chr(10).join(above))} at screen 0.5, screen 1 offset character 0, -1.5 "
        "center noenhanced",
        f"set tmargin {5 + legend_lines}",
        "set border 3 linecolor rgb '#555555'",
        "set tics nomirror out",
        "set grid linecolor rgb '#dddddd' linewidth 1 linetype 1",
        f"set bmargin {5 + len(below)}",
        "set rmargin 6",
        f"set label 1 {quoted(chr(10).join(below))} at screen 0.5, "
        f"character {len(below) - 0.3} center noenhanced textcolor rgb '#333333'",
    ]


def remove_old(folder, patterns):
    """So that no chart stands beside numbers that are not its own."""
    for pattern in patterns:
        for kind in TERMINALS:
            for file in folder.glob(f"{pattern}.{kind}"):
                file.unlink()


def draw(wanted, folder):
    """Draws the charts, {name: (height, commands)}; returns lines that tell what became of them."""
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
