# SPDX-License-Identifier: MIT
"""Searches of triangles beside Embree's, in its plain and in its robust mode: rates, and rays aimed at edges and corners."""
from statistics import median

from harness.chart.rows import Row, rows
from harness.measure.numbers import count_words, number, spread
from harness.page.section import Part
from harness.run import machine
from harness.triangles import rates

ROUNDS, SECONDS, MOST_THREADS = {True: 1, False: 3}, {True: 0.05, False: 0.15}, 64
WHO = {"hedron": ("hedron",), "Embree": rates.ANY, "Embree, robust": tuple(f"robust_{way}" for way in rates.ANY)}
HEAD = ["machine", "triangles", "who", *(f"{kind} rays, M a CPU-second" for kind in rates.KINDS), "rays aimed at edges and corners",
        "of which leak", "cross a closed surface an odd number of times, by its ways"]


def measure(study):
    """Raises Problem where it cannot be; an interrupted study goes on where it was."""
    found = study.result["searches"] = study.result.get("searches") or {}
    quick = study.arguments.quick
    for count in map(str, rates.COUNTS[:2] if quick else rates.COUNTS):
        if count not in found:
            study.news(f"searches, {count} triangles")
            found[count] = rates.run(study.program, count, SECONDS[quick], min(ROUNDS[quick], study.arguments.repeats),
                                     min(machine.cores(), MOST_THREADS))
            study.save()
    return None if "Embree" in who_are_there(next(iter(found.values()))) else f"{rates.NO_RIVAL}."


def who_are_there(measured):
    return [who for who, ways in WHO.items() if rates.best_way(measured["rates"]["primary"], ways)]


def best(measured, kind, who):
    """The rates of its fastest way."""
    found = measured["rates"][kind]
    return found[rates.best_way(found, WHO[who])]


def cells(measured, who):
    aimed = [each for way, each in measured["aimed"].items() if way.startswith(WHO[who])]
    odd = sorted(each[2] for each in aimed)
    return [str(measured["triangles"]), who, *(number(1e-6 * median(best(measured, kind, who)), 3) for kind in rates.KINDS),
            str(aimed[0][0]), str(max(each[1] for each in aimed)),
            str(odd[0]) if odd[0] == odd[-1] else f"{odd[0]} to {odd[-1]}"]


def ratio_words(found, other):
    """For each kind of rays the least and the greatest of the ratios."""
    told = []
    for kind in rates.KINDS:
        ratios = sorted(median(best(measured, kind, "hedron")) / median(best(measured, kind, other)) for measured in found)
        told.append(f"{kind} {number(ratios[0], 2)} to {number(ratios[-1], 2)}")
    return f"against {other}: {', '.join(told)} times"


def bars(measured):
    drawn = []
    for kind in rates.KINDS:
        for place, who in enumerate(who_are_there(measured)):
            millions = spread([1e-6 * rate for rate in best(measured, kind, who)])
            drawn.append(Row(f"{who}, {kind} rays", millions, f"{number(millions['median'], 3)} M", place, group=kind))
    return drawn


def fill(section):
    section.table = [HEAD]
    for place, result in enumerate(section.results):
        found = list((result.get("searches") or {}).values())
        section.table += [[result["machine"]["name"], *cells(measured, who)] for measured in found
                          for who in who_are_there(measured)]
        both = [measured for measured in found if "Embree" in who_are_there(measured)]
        if both:
            shown = both[min(1, len(both) - 1)]
            caption = (f"Rates of hedron, {'; '.join(ratio_words(both, other) for other in WHO if other != 'hedron')}, over "
                       f"{', '.join(count_words(measured['triangles']) for measured in both)} triangles; each by its fastest way.")
            about = {**result, "scene": {"name": f"one mesh of {count_words(shown['triangles'])} triangles"}}
            section.add(f"searches{place}", rows(about, "Searches of triangles beside Embree's", caption,
                                                 "M rays a second of processor time", bars(shown)), caption)


PART = Part(19, "Searches of triangles beside Embree", "Searches of one mesh on one thread, the same rays for both; and rays aimed at "
            "edges and corners of the closed mesh, which must neither pass through nor count a crossing twice.", measure=measure,
            fill=fill, failures=lambda result: rates.failures({int(count): measured for count, measured in (
                result.get("searches") or {}).items()}))
