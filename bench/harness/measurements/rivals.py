# SPDX-License-Identifier: MIT
"""Other programs beside hedron: the time to the same error, of a scene that all of them can be told of."""
from harness.accuracy import front
from harness.chart.axes import Axis
from harness.chart.lines import Line, lines
from harness.measure.numbers import number, spread, spread_text
from harness.measure.scenes import read_scene
from harness.page.section import Part, few
from harness.rivals import shapes
from harness.rivals.hedron import Hedron
from harness.rivals.mitsuba import Mitsuba
from harness.rivals.povray import Povray
from harness.run import machine, pfm
from harness.run.program import ROOT, Problem

SCENE, SIZES, ROUNDS = ROOT / "bench/scenes/rivals.json", {True: (80, 45), False: (160, 90)}, {True: 1, False: 3}
TOLD = (4.0, 2.0, 1.0, 0.5)  # errors at which times are told
HEAD = ["machine", "program", "setting", "processor ms [quartiles]", "ms by the clock", "RMSE", "largest error",
        "RMSE against its own deep picture"]


# ---- the work

def installed(study, scene, size, reasons):
    """The other programs that are there."""
    found = []
    for rival in (Povray, Mitsuba):
        try:
            found.append(rival(scene, size, study.folder))
        except Problem as problem:
            if problem.code != 3:
                raise
            reasons[rival.name] = str(problem)
    return found


def agreement(study, rival, ours, truth, deep):
    """How far its picture is from ours: of the same samples where it has a grid."""
    setting, grid = rival.deep(study.arguments.quick), study.folder / "rivals-grid.pfm"
    study.news(f"{rival.name}, deep")
    rival.render(setting, deep, 0)
    if not isinstance(rival, Povray):
        return {"deep": f"its own has {setting[1]} samples a pixel", **pfm.errors(study.program, deep, truth)}
    ours.grid(setting[0], grid)
    return {"deep": f"{setting[0]} x {setting[0]} samples, the same ones", **pfm.errors(study.program, deep, grid)}


def agreements(study, others, ours, deep, reasons):
    """Of those that render the scene; of the others the reason why not."""
    found = {}
    for rival in others:
        deep[rival.name] = study.folder / f"rivals-{rival.name}.pfm"
        try:
            found[rival.name] = agreement(study, rival, ours, deep[ours.name], deep[rival.name])
        except Problem as problem:
            if problem.code != 3:
                raise
            reasons[rival.name] = str(problem)
    return found


def timed(study, programs, deep):
    """Every setting of every program, in turns."""
    points, file = {}, study.folder / "rivals.pfm"
    for turn in range(min(ROUNDS[study.arguments.quick], study.arguments.repeats)):
        for program in programs:
            for name, setting in program.settings(study.arguments.quick).items():
                study.news(f"{program.name}, {name}")
                took = program.render(setting, file, turn)
                point = points.setdefault((program.name, name), {
                    "program": program.name, "name": name, "cpu": [], "wall": [],
                    **pfm.errors(study.program, file, deep["hedron"]),
                    "own_rmse": pfm.errors(study.program, file, deep[program.name])["rmse"]})
                for key in ("cpu", "wall"):
                    point[key].append(1e3 * took[key])
    return [{**point, "ms": spread(point["cpu"])["median"]} for point in points.values()]


def measure(study):
    """Raises Problem where a run of hedron fails; a program that cannot is left out, with the reason."""
    if study.result.get("rivals"):
        return None
    scene, size, reasons = shapes.checked(read_scene(SCENE)), SIZES[study.arguments.quick], {}
    ours, others = Hedron(study.program, scene, size, study.folder), installed(study, scene, size, reasons)
    deep = {ours.name: study.folder / "rivals-truth.pfm"}
    if others:
        ours.truth(deep[ours.name])
    agreed = agreements(study, others, ours, deep, reasons)
    if not agreed:
        return " ".join(f"{words}." for words in reasons.values())
    programs = [ours, *(rival for rival in others if rival.name in agreed)]
    points = timed(study, programs, deep)
    study.result["rivals"] = {"size": list(size), "threads": machine.cores(), "reasons": reasons, "agreements": agreed,
                              "versions": {each.name: each.version for each in programs}, "points": points}
    return None


# ---- the page

def points_of(found, name):
    return [point for point in found["points"] if point["program"] == name]


def times_words(found, rival):
    """At which errors it takes how many times as long as hedron."""
    told = []
    for error in TOLD:
        ours, theirs = [front.time_at(points_of(found, name), "rmse", error) for name in ("hedron", rival)]
        if ours and theirs:
            told.append(f"{number(theirs / ours, 2)} times at an RMSE of {error:g}")
    return f"{rival} takes {', '.join(told)}" if told else f"{rival} comes to none of these errors"


def agreement_words(found, rival):
    each = found["agreements"][rival]
    return (f"The deep pictures of {rival} {found['versions'][rival]} and of hedron are {number(each['rmse'], 2)} apart (RMSE, steps of 255; "
            f"{each['deep']}), {number(100 * (1 - each['above_1']), 4)} % of the pixels within 1.")


def line_of(found, name, place):
    these = front.front(points_of(found, name))
    return Line(f"{name} {found['versions'][name]}", [(point["ms"], dict.fromkeys(("median", "q1", "q3"), point["rmse"]))
                                                      for point in these], place, mark=place, short=name)


def fill(section):
    section.table = [HEAD]
    for place, result in enumerate(section.results):
        found = result.get("rivals")
        if not found:
            continue
        width, height = found["size"]
        rivals = list(found["agreements"])
        caption = (f"Processor time for the same error, against hedron: {few([times_words(found, rival) for rival in rivals])}. Each line "
                   f"has the settings that no other of its program beats in both; {found['threads']} threads.")
        about = {**result, "scene": {"name": f"bench/scenes/rivals.json, {width} x {height}"}}
        section.add(f"rivals{place}", lines(
            about, "Error against time, other programs", caption, Axis("milliseconds of processor time for a frame", True),
            Axis("root mean square error, steps of 255", True),
            [line_of(found, name, number) for number, name in enumerate(found["versions"])]), caption)
        section.notes += [agreement_words(found, rival) for rival in rivals]
        section.notes += [f"{words}." for words in found["reasons"].values()]
        section.table += [[result["machine"]["name"], point["program"], point["name"], spread_text(spread(point["cpu"]), " .. "),
                           number(spread(point["wall"])["median"]), number(point["rmse"], 3), number(point["largest"], 3),
                           number(point["own_rmse"], 3)] for point in found["points"]]


PART = Part(18, "Other programs at equal error", "One scene of mirrors, coloured glass that does not refract and shadows, in every "
            "program that is installed, by its own model where that is ours; error against a dense picture of hedron's.",
            measure=measure, fill=fill)
