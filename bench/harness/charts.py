# SPDX-License-Identifier: MIT
"""Charts, all in one style, drawn by gnuplot as SVG and PNG."""
import os
import shutil
import subprocess
import textwrap

from harness import report, summary

# Okabe and Ito's colours, told apart by everyone; yellow is left out, for it is faint on white.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"]
WIDTH = 1200
TERMINALS = {"svg": "svg background rgb 'white' font 'sans-serif,15'", "png": "pngcairo font 'sans-serif,12'"}
LOGARITHMIC_FROM = 20  # times the smallest value
LABEL_LENGTH = 42
LEGEND_COLUMNS = 2
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
    return f"{summary.label(device)} {device_name(device)}"


def tick(device):
    """Two lines; the label of a tick is a format."""
    return quoted(f"{summary.label(device)}\n{device_name(device)}".replace("%", "%%"))


def colour(place):
    return COLOURS[place % len(COLOURS)]


def logarithmic(values):
    return min(values) > 0 and max(values) / min(values) >= LOGARITHMIC_FROM


def style(result, title, caption, legend_lines=0):
    """What all charts have: title, scene and machine above, then the legend, one sentence below."""
    below = textwrap.wrap(caption, CAPTION_LENGTH)
    above = [title, plain(f"hedron {result['hedron']['version']}, {report.settings(result)}", TITLE_LENGTH),
             plain(report.machine_words(result), TITLE_LENGTH)]
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


def bars_caption(devices):
    fastest = min(devices, key=lambda device: device["summary"]["trace_ms"]["median"])
    each = fastest["summary"]
    words = f"{device_title(fastest)} traces a frame in {report.number(each['trace_ms']['median'], 3)} ms"
    others = [device for device in devices if device is not fastest]
    if others:
        slowest = max(others, key=lambda device: device["summary"]["trace_ms"]["median"])
        ratio = report.number(slowest["summary"]["ratio_to_fastest"], 3)
        words += f", and {summary.label(slowest)}, the slowest, takes {ratio} times as long"
    return (f"{words}; bars are medians of {each['frames']} frames, whiskers reach from the first to the third "
            "quartile, and diamonds are whole frames, with copying and storing.")


def bars(result):
    """(height, commands): the time of a frame on each device."""
    devices = [device for device in result["devices"] if device["summary"]]
    points = [(device["summary"]["trace_ms"], device["summary"]["frame_ms"]) for device in devices]
    values = [value for trace, frame in points for value in [*trace.values(), frame]]
    commands = style(result, "Time of a frame on each device", bars_caption(devices))
    start = 0
    if logarithmic(values):
        start = min(values) / 2
        commands += ["set logscale x", f"set xrange [{start!r}:{max(values) * (max(values) / start) ** 0.5!r}]"]
    else:
        commands += [f"set xrange [0:{max(max(values) * 1.5, 1e-6)!r}]"]
    ticks = ", ".join(f"{tick(device)} {-place}" for place, device in enumerate(devices))
    commands += [
        "set xlabel 'milliseconds for each frame'" + (" .' (logarithmic)'" if start else ""),
        f"set yrange [{-len(devices) + 0.4}:0.6]",
        f"set ytics ({ticks}) noenhanced",
        "unset key",
        "set grid noytics",
        "$data << END",
    ]
    for place, (trace, frame) in enumerate(points):
        commands.append(f"{-place} {trace['median']!r} {trace['q1']!r} {trace['q3']!r} {frame!r} "
                        f"{max(trace['q3'], frame)!r} {report.number(trace['median'], 3)} "
                        f"{report.number(frame, 3)} {int(colour(place)[1:], 16)}")
    commands += [
        "END",
        "set style fill solid 0.85 noborder",
        f"plot $data using (($2+{start!r})/2):1:({start!r}):2:($1-0.3):($1+0.3):9 with boxxyerror"
        " linecolor rgb variable,"
        " $data using 2:1:3:4 with xerrorbars pointtype -1 linewidth 1.5 linecolor rgb '#222222',"
        " $data using 5:1 with points pointtype 12 pointsize 1.4 linewidth 1.5 linecolor rgb '#222222',"
        " $data using 6:1:(sprintf('%s ms, whole %s ms', strcol(7), strcol(8))) with labels left offset 1.2, 0",
    ]
    return 260 + 70 * len(devices), commands


def animation_caption(devices, lines, repeats):
    fastest = {min(range(len(lines)), key=lambda place: dict(lines[place]).get(number, float("inf")))
               for number in sorted({number for line in lines for number, _ in line})}
    spread = max(range(len(lines)), key=lambda place: ratio(lines[place]))
    words = f"The slowest frame takes {report.number(ratio(lines[spread]), 3)} times as long as the fastest"
    words += f" on {summary.label(devices[spread])}"
    if len(lines) > 1:
        words += ", where that differs most, and "
        if len(fastest) == 1:
            words += f"{summary.label(devices[fastest.pop()])} is the fastest device in every frame"
        else:
            words += "which device is the fastest depends on the frame"
    kind = "the only run" if repeats == 1 else f"the median of {repeats} runs"
    return f"{words}; each point is {kind}, without the first frame, which warms up."


def ratio(line):
    times = [time for _, time in line]
    return max(times) / min(times) if min(times) > 0 else 1


def animation(result):
    """(height, commands): the time along the animation, a line for each device."""
    devices = [device for device in result["devices"] if device["summary"]]
    lines = [summary.trace_by_frame(device) for device in devices]
    times = [time for line in lines for _, time in line]
    numbers = [number for line in lines for number, _ in line]
    legend_lines = (len(devices) + LEGEND_COLUMNS - 1) // LEGEND_COLUMNS
    commands = style(result, "Time of tracing along the animation",
                     animation_caption(devices, lines, result["repeats"]), legend_lines)
    if logarithmic(times):
        commands += ["set logscale y", f"set yrange [{min(times) / 1.5!r}:{max(times) * 1.5!r}]"]
    else:
        commands += [f"set yrange [0:{max(max(times) * 1.1, 1e-6)!r}]"]
    commands += [
        "set xlabel 'frame number'",
        "set ylabel 'milliseconds for each frame" + (" (logarithmic)'" if logarithmic(times) else "'"),
        f"set xrange [{min(numbers) - 0.5}:{max(numbers) + 0.5}]",
        f"set key at graph 0.5, graph 1.03 center bottom vertical maxrows {legend_lines} Left reverse noenhanced",
    ]
    if max(numbers) - min(numbers) < 20:
        commands.append("set xtics 1")
    plots = []
    for place, (device, line) in enumerate(zip(devices, lines)):
        commands += [f"$line{place} << END", *(f"{number} {time!r}" for number, time in line), "END"]
        plots.append(f"$line{place} using 1:2 with linespoints linewidth 2 pointsize 1 pointtype {place % 14 + 4} "
                     f"linecolor rgb '{colour(place)}' title {quoted(device_title(device))}")
    commands.append("plot " + ", ".join(plots))
    return 560 + 20 * legend_lines, commands


CHARTS = {"frames": bars, "frames_animation": animation}


def remove_old(folder, names=tuple(CHARTS)):
    """So that no chart stands beside numbers that are not its own."""
    for name in names:
        for kind in TERMINALS:
            (folder / f"{name}.{kind}").unlink(missing_ok=True)


def draw(result, folder, wanted=None):
    """Draws the charts of the result, those of bench/frames if not said; returns lines that tell what
    became of them."""
    if shutil.which("gnuplot") is None:
        return ["There is no gnuplot, so there are no charts; its package is gnuplot-nox."]
    told = []
    for name, chart in (wanted or CHARTS).items():
        height, commands = chart(result)
        for kind, terminal in TERMINALS.items():
            file = folder / f"{name}.{kind}"
            script = [f"set terminal {terminal} size {WIDTH},{height}", f"set output {quoted(str(file))}", *commands, ""]
            done = subprocess.run(["gnuplot", "-"], input="\n".join(script), text=True, capture_output=True,
                                  encoding="utf-8", env={**os.environ, "LC_ALL": "C.UTF-8"})
            if done.returncode == 0:
                told.append(f"Chart: {file}")
            else:
                told.append(f"gnuplot could not draw {file}: {plain(done.stderr, 200)}")
    return told
