# SPDX-License-Identifier: MIT
"""Failures of geometry and arithmetic methods, hedron's among them. All of it runs on the CPU, with the same numbers each
time; an interrupted study can be continued."""
from pathlib import Path

from harness.command.bench import Bench
from harness.command.options import whole_number
from harness.measure.numbers import count_words
from harness.measure.rows import NONE, Missing, Target, known
from harness.page import answer
from harness.page.section import Part
from harness.run.program import ROOT, Problem
from harness.stability import charts, methods, pictures, scenes, table

QUICK_PART = 20
SIZES = {False: ("--size", "160x120", "--samples", "2"), True: ("--size", "80x60", "--samples", "1")}
ODD_SIZE = ("--size", "96x54", "--samples", "1")
PATHS, NEAR = Target(99, 99.99), Target(99.9, 99.99)
WRONG = {"crossings": "rays that miss, count twice or are misplaced", "shadows": "segments wrongly blocked or opened"}


def percent(part, whole):
    if not whole:
        raise Missing("it was not measured")
    return [100 * part / whole]


def add_paths(plan, counts, method):
    these = methods.select(counts, "paths", method=method, place=methods.is_in_target)
    (strayed, tried), (far, tried_far) = methods.tally(these, "paths"), methods.tally(these, "far")
    note, found = None, methods.worst(these, "paths")
    if found:
        share, each = found
        note = (f"{methods.NAMES[method]}: {strayed} of {tried} paths stray; least at one place {100 - 100 * share:.2f} % of "
                f"{each['tried']} ({each['case']}, scale {each['scale']:g}, offset {each['offset']:g})")
    plan.row("paths", f"paths that follow the double path after 30 bounces, {methods.NAMES[method]}", "%",
             lambda: percent(tried - strayed, tried), target=None if method == methods.CHECK else PATHS, note=note)
    return f"  after 300 bounces, {methods.NAMES[method]}", lambda: percent(tried_far - far, tried_far)


def add_rows(plan, result):
    counts, precision, odd = [result[key] or [] for key in ("counts", "precision", "odd")]
    after_300 = [add_paths(plan, counts, method) for method in ("ours_solids", "ours_triangles", methods.CHECK)]
    for what, figure in after_300[:2]:
        plan.row("paths", what, "%", figure)
    for study, what in WRONG.items():
        def figure(study=study):
            these = known([each for each in counts if each["study"] == study and each["method"] in methods.OURS] or None)
            return [sum(methods.tally(these, wrong)[0] for wrong in (study, *["misplaced"] * (study == "crossings")))]
        plan.row(study, f"{what}, hedron", "count", figure, target=NONE)
    for geometry in pictures.GEOMETRIES:
        near, pixels = pictures.total(precision, pictures.FLOAT, geometry)
        plan.row("precision", f"pixels within 1 of 255, {pictures.FLOAT}, all scenes, {geometry}", "%",
                 lambda near=near, pixels=pixels: percent(near, pixels), target=NEAR,
                 note=f"{pictures.FLOAT}, {geometry}: {pixels - near} of {pixels} pixels off" if pixels else None)
    plan.row("odd", "pixels that are NaN or infinite, all frames", "pixels",
             lambda: [sum(each["nan"] for each in known([*precision, *odd] or None))], target=NONE)
    plan.row("odd", "odd scenes that neither render nor give a clear error", "scenes",
             lambda: [sum(not each["as_it_should"] for each in known(odd or None))], target=NONE)


class Stability(Bench):
    name = "stability"
    about = "Measure where methods of geometry and arithmetic fail, hedron's among them."
    codes = """exit codes: 0 done, 1 hedron's method failed or a run failed, 2 wrong usage or input,
130 interrupted (what was measured is kept)"""
    quick, repeats = "measure a twentieth of the rays and smaller pictures; figures are rough", None
    own_options = (*Bench.own_options, "--precision", "--math", "--geometry")
    parts = (*methods.STUDIES, "precision", "odd")
    scene = "solids, triangles and odd scenes"
    chart_files = ("stability_*",)
    keys = ("counts", "precision", "odd", "table")

    def add_options(self, parser):
        super().add_options(parser)
        parser.add_argument("--rays", type=whole_number, metavar="N",
                            help="rays, paths or segments of each method and place (default: crossings and shadows 20000, paths "
                                 "5000)")
        parser.add_argument("--scenes", type=Path, default=ROOT / "scenes", metavar="FOLDER",
                            help="folder of the scenes of the part precision (default: scenes)")

    def tried(self, what, measure, *arguments, **named):
        """Returns an empty list after a failure, which counts."""
        found = super().tried(what, measure, *arguments, **named)
        if isinstance(found, str):
            self.plan.failures.add(found)
        return [] if isinstance(found, str) else found

    def measure(self):
        for study in filter(self.wants, methods.STUDIES):
            count = self.arguments.rays or methods.COUNTS[study] // (QUICK_PART if self.arguments.quick else 1)
            found = self.tried(f"methods: {study}", methods.run, self.program, study, count)
            self.result["counts"] = [*(self.result["counts"] or []), *found]
        if self.wants("precision"):
            files, self.result["precision"] = sorted(self.arguments.scenes.resolve().glob("*.json")), []
            if not files:
                raise Problem(2, f"there is no scene in {self.arguments.scenes}")
            for file in files:
                self.result["precision"] += self.tried(f"precision: {file.stem}", pictures.study_scene, self.program, file, [
                    *SIZES[self.arguments.quick], *self.arguments.options], self.folder)
        if self.wants("odd"):
            study = pictures.OddScenes(self.program, self.folder, [*ODD_SIZE, *self.arguments.options])
            self.result["odd"] = study.entries
            for each in scenes.all_scenes(self.folder, self.arguments.quick):
                self.tried(f"odd scenes: {each.name}", study.run, each)

    def fill(self):
        add_rows(self.plan, self.result)
        self.result["table"] = table.rows(self.result)
        self.plan.failures |= {*methods.failures(self.result["counts"] or []), *pictures.failures(self.result["odd"] or [])}

    def compared(self):
        return {"same": None, "sentence": "A share of 0 means that no failure was seen; the column of hedron has the number of tries."}

    def tables(self):
        return [("How methods fail", [table.HEAD, *(list(row.values()) for row in self.result["table"])], [])]

    def charts(self):
        return charts.charts(self.result)


BENCH = Stability


# ---- the study's part

FEWER = {True: QUICK_PART, False: 4}  # divisor of the counts


def measure(study):
    """Measures what is missing from the result; raises Problem if a run fails."""
    memory = study.result["stability"] = study.result["stability"] or {"steps": [], "counts": [], "precision": [], "odd": None}
    options = (*SIZES[True], *study.arguments.options)
    steps = {each: ("counts", methods.run, study.program, each, methods.COUNTS[each] // FEWER[study.arguments.quick])
             for each in methods.STUDIES}
    steps |= {f"precision {file.stem}": ("precision", pictures.study_scene, study.program, file, options, study.folder)
              for file in sorted((ROOT / "scenes").glob("*.json"))}
    for step, (key, work, *arguments) in steps.items():
        if step not in memory["steps"]:
            study.news(f"stability, {step}")
            memory[key] += work(*arguments)
            memory["steps"].append(step)
            study.save()


def fill(section):
    """Shows the first machine's result, because all give the same numbers."""
    found = next((result for result in section.results if result["stability"]), None)
    if found is None:
        return
    about = {**found["stability"], "hedron": found["hedron"], "machine": found["machine"],
             "scene": {"name": "solids and triangles"}}
    for name, chart in charts.charts(about).items():
        section.add(name, chart, chart.caption)
    section.table = [table.HEAD, *[list(row.values()) for row in table.rows(about)]]


NEVER = {"crossings": "crossings", "misplaced": "crossings", "lost": "paths", "shadows": "shadows"}  # study that it belongs to


def answers(results):
    """Yields a sentence about the first machine that has the result."""
    found = next((result["stability"] for result in results if result["stability"] and result["stability"]["counts"]), None)
    if found is None:
        yield "Stability was measured on no machine here."
        return
    counts = found["counts"]
    ours = [methods.tally([each for each in counts if each["study"] == study and each["method"] in methods.OURS
                           and each["case"] not in methods.CRACKS], what) for what, study in NEVER.items()]
    wrong, tried = map(sum, zip(*ours))
    words = (f"Hedron lost, misplaced or wrongly shadowed {answer.figure('ours_failed', wrong, f'{wrong}')} of "
             f"{answer.figure('ours_tried', tried, count_words(round(tried, -4)))} rays")
    others = [methods.worst(methods.select(counts, "crossings", charts.EDGES, method), "crossings")[0]
              for method in methods.methods(counts, "crossings") if method not in methods.OURS]
    if others:
        words += (f"; other methods lose {answer.figure('others_least', 100 * min(others))} % to "
                  f"{answer.figure('others_most', 100 * max(others))} % of the rays at edges, each at its worst place")
    yield f"{words}."


def failures(result):
    return methods.failures(result["stability"]["counts"]) if result["stability"] else []


PART = Part(16, "Stability: what fails where", "How often methods of geometry and arithmetic fail at many sizes and distances. "
            "Hedron's own are in bold.", measure=measure, fill=fill, failures=failures,
            answer=answers, lead=4)
