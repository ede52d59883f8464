# SPDX-License-Identifier: MIT
"""Horizontal bars of one or several parts, in the style of all charts."""
from dataclasses import dataclass

from harness import charts


@dataclass(frozen=True)
class Bar:
    name: str
    parts: tuple  # lengths, one behind the other
    words: str  # at the end of the bar
    colour: int = 0  # of a bar with one part; parts have colours of their own


def chart(result, title, caption, unit, bars, parts=()):
    """(height, commands). `parts` names those of the bars, for the legend."""
    longest = max(sum(bar.parts) for bar in bars)
    ticks = ", ".join(f"{charts.quoted(charts.plain(bar.name, 60).replace('%', '%%'))} {-place}"
                      for place, bar in enumerate(bars))
    commands = charts.style(result, title, caption, 1 if parts else 0)
    commands += [f"set xlabel {charts.quoted(unit)}", f"set xrange [0:{max(longest * 1.45, 1e-9)!r}]",
                 f"set yrange [{-len(bars) + 0.4}:0.6]", f"set ytics ({ticks}) noenhanced", "set grid noytics",
                 "set key at graph 0.5, graph 1.02 center bottom horizontal Left reverse noenhanced" if parts
                 else "unset key", "$data << END"]
    for place, bar in enumerate(bars):
        begin = 0
        for number, length in enumerate(bar.parts):
            shade = int(charts.colour(number if parts else bar.colour)[1:], 16)
            commands.append(f"{-place} {begin!r} {begin + length!r} {shade} {number}")
            begin += length
    commands += ["END", "$ends << END",
                 *(f'{-place} {sum(bar.parts)!r} "{charts.plain(bar.words, 70)}"' for place, bar in enumerate(bars)),
                 "END", "set style fill solid 0.85 noborder"]
    boxes = "using (($2+$3)/2):1:2:3:($1-0.35):($1+0.35):4 with boxxyerror linecolor rgb variable"
    plots = [f"$data {boxes} notitle",
             "$ends using 2:1:3 with labels left offset 0.8, 0 noenhanced notitle"]
    plots += [f"NaN with boxes linecolor rgb '{charts.colour(number)}' title {charts.quoted(name)}"
              for number, name in enumerate(parts)]
    commands.append("plot " + ", ".join(plots))
    return 230 + 30 * len(bars), commands
