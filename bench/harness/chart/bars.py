# SPDX-License-Identifier: MIT
"""Horizontal bars: of medians with quartiles, and of parts one behind the other."""
from dataclasses import dataclass

from harness.chart.gnuplot import Chart, colour, is_wide, plain, quoted
from harness.measure.numbers import number

KEY = "set key at graph 0.5, graph 1.02 center bottom horizontal Left reverse noenhanced"


@dataclass(frozen=True)
class Row:
    name: str
    spread: dict  # "median", "q1", "q3"
    words: str  # at its end
    colour: int = 0
    bound: float = None  # a mark, such as what cannot be undercut
    group: str = ""  # rows of a group stand together


def shade(place):
    return int(colour(place)[1:], 16)


def frame(about, title, caption, names, places, has_key):
    """A chart with a name for each place, downwards."""
    chart = Chart(about, title, caption, int(has_key))
    chart.add(f"set yrange [{places[-1] - 0.7!r}:0.7]", "set grid noytics", KEY if has_key else "unset key",
              "set style fill solid 0.85 noborder")
    ticks = ", ".join(f"{quoted(plain(name, 62).replace('%', '%%'))} {place!r}" for name, place in zip(names, places))
    chart.add(f"set ytics ({ticks}) noenhanced")
    return chart


def rows(about, title, caption, unit, drawn, bound_name=""):
    """A chart: a bar for each row, with whiskers to the quartiles, and a mark at its bound."""
    values = [row.spread[key] for row in drawn for key in ("median", "q1", "q3")]
    values += [row.bound for row in drawn if row.bound]
    wide = is_wide([value for value in values if value > 0])
    start = min(value for value in values if value > 0) / 2 if wide else 0
    end = max(values) * min((max(values) / start) ** 0.45, 60) if wide else max(max(values) * 1.5, 1e-9)
    bounded = any(row.bound for row in drawn)
    places = row_places(drawn)
    chart = frame(about, title, caption, (row.name for row in drawn), places, bounded)
    if wide:
        chart.axis("x", unit, start * 1.4, end / 1.4, True)
    else:
        chart.add(f"set xlabel {quoted(unit)}", f"set xrange [0:{end!r}]")
    chart.data("data", ((place, max(row.spread["median"], start), max(row.spread["q1"], start), row.spread["q3"],
                         shade(row.colour)) for row, place in zip(drawn, places)))
    chart.data("words", ((max(row.spread["q3"], row.spread["median"], start), place, f'"{plain(row.words, 60)}"')
                         for row, place in zip(drawn, places)))
    chart.data("bounds", ((row.bound, place) for row, place in zip(drawn, places) if row.bound))
    chart.plot(f"$data using (($2+{start!r})/2):1:({start!r}):2:($1-0.36):($1+0.36):5 with boxxyerror "
               "linecolor rgb variable notitle")
    chart.plot("$data using 2:1:3:4 with xerrorbars pointtype -1 linewidth 1.5 linecolor rgb '#222222' notitle")
    chart.plot("$words using 1:2:3 with labels left offset 0.8, 0 noenhanced notitle")
    if bounded:
        chart.plot(f"$bounds using 1:2 with points pointtype 2 pointsize 1.6 linewidth 2.5 linecolor rgb '#000000' "
                   f"title {quoted(bound_name)}")
    return chart.finished(265 + 24 * bounded + chart.caption_height + round(34 * (1 - places[-1])))


def row_places(drawn):
    """Downwards, with a gap between groups."""
    places, place = [], 0.0
    for before, row in zip([None, *drawn], drawn):
        if before is not None:
            place -= 1.5 if before.group != row.group else 1
        places.append(place)
    return places


def boxes(about, title, caption, unit, drawn, parts=()):
    """A chart: for each (name, words at its end, [(begin, end, shade)]) a row of boxes. `parts` are names of the first
    colours, for the legend."""
    places = [-float(place) for place in range(len(drawn))]
    longest = max(end for _, _, row in drawn for _, end, _ in row)
    chart = frame(about, title, caption, (name for name, _, _ in drawn), places, bool(parts))
    chart.add(f"set xlabel {quoted(unit)}", f"set xrange [0:{max(longest * 1.45, 1e-9)!r}]")
    chart.data("data", ((place, *box) for place, (_, _, row) in zip(places, drawn) for box in row))
    chart.data("ends", ((place, row[-1][1], f'"{plain(words, 70)}"') for place, (_, words, row) in zip(places, drawn)))
    chart.plot("$data using (($2+$3)/2):1:2:3:($1-0.35):($1+0.35):4 with boxxyerror linecolor rgb variable notitle")
    chart.plot("$ends using 2:1:3 with labels left offset 0.8, 0 noenhanced notitle")
    for place, name in enumerate(parts):
        chart.plot(f"NaN with boxes linecolor rgb '{colour(place)}' title {quoted(name)}")
    return chart.finished(230 + 30 * len(drawn))


def one_value(value):
    return {"median": value, "q1": value, "q3": value}


def ms(value):
    return f"{number(value, 3)} ms" if value < 1000 else f"{number(value / 1000, 3)} s"


def spread_words(spread):
    unit, name = (1, "ms") if spread["median"] < 1000 else (1000, "s")
    first, middle, third = (number(spread[key] / unit, 3) for key in ("q1", "median", "q3"))
    return f"{middle} {name} [{first} .. {third}]"
