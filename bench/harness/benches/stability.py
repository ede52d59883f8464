# SPDX-License-Identifier: MIT
"""Measures where methods of geometry and arithmetic fail, ours among them."""
from pathlib import Path

from harness.command.bench import Bench
from harness.command.options import whole_number
from harness.run.program import ROOT, Problem
from harness.stability import charts, methods, odd, pictures, rows, scenes, table

QUICK_PART = 20
SIZES = {False: ("--size", "160x120", "--samples", "2"), True: ("--size", "80x60", "--samples", "1")}
ODD_SIZE = ("--size", "96x54", "--samples", "1")


class Stability(Bench):
    name = "stability"
    about = "Measure where methods of geometry and arithmetic fail, ours among them."
    codes = """exit codes: 0 done, 1 ours failed where it never may, or a run failed, 2 wrong usage or input,
130 interrupted (what was measured is kept)"""
    quick, repeats = "a twentieth of the rays, and smaller pictures; rough", None
    own_options = (*Bench.own_options, "--precision", "--math", "--geometry")
    parts = (*methods.STUDIES, "precision", "odd")
    scene = "solids, triangles and odd scenes"
    chart_files = ("stability_*",)
    keys = ("counts", "precision", "odd", "table")

    @classmethod
    def add_options(cls, parser):
        super().add_options(parser)
        parser.add_argument("--rays", type=whole_number, metavar="N",
                            help="rays, paths or segments for each method and place (default: by the part)")
        parser.add_argument("--scenes", type=Path, default=ROOT / "scenes", metavar="FOLDER",
                            help="the scenes of the part precision (default: scenes)")

    def tried(self, what, measure, *arguments, **named):
        """An empty list where it cannot be, which counts as a failure."""
        try:
            self.news(what)
            return measure(*arguments, **named)
        except Problem as problem:
            self.plan.failures.add(str(problem))
            return []

    def measure_methods(self, study):
        count = self.arguments.rays or methods.COUNTS[study] // (QUICK_PART if self.arguments.quick else 1)
        found = self.tried(f"methods: {study}", methods.run, self.program, study, count)
        self.result["counts"] = [*(self.result["counts"] or []), *found]

    def measure_precision(self):
        files, self.result["precision"] = sorted(self.arguments.scenes.resolve().glob("*.json")), []
        if not files:
            raise Problem(2, f"there is no scene in {self.arguments.scenes}")
        for file in files:
            self.result["precision"] += self.tried(f"precision: {file.stem}", pictures.study_scene, self.program, file, [
                *SIZES[self.arguments.quick], *self.arguments.options], self.folder)

    def measure_odd(self):
        study = odd.OddScenes(self.program, self.folder, [*ODD_SIZE, *self.arguments.options])
        self.result["odd"] = study.entries
        for each in scenes.all_scenes(self.folder, self.arguments.quick):
            self.tried(f"odd scenes: {each.name}", study.run, each)

    def measure(self):
        for study in filter(self.wants, methods.STUDIES):
            self.measure_methods(study)
        if self.wants("precision"):
            self.measure_precision()
        if self.wants("odd"):
            self.measure_odd()

    def fill(self):
        result = self.result
        rows.add(self.plan, result)
        result["table"] = table.rows(result)
        self.plan.failures |= {*methods.failures(result["counts"] or []), *odd.failures(result["odd"] or [])}

    def compared(self):
        return {"same": None, "sentence": "A share that is 0 was not seen to fail; how many were tried stands beside ours."}

    def tables(self):
        return [("How methods fail", [table.HEAD, *(list(row.values()) for row in self.result["table"])], [])]

    def charts(self):
        return charts.charts(self.result)


BENCH = Stability
