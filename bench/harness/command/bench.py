# SPDX-License-Identifier: MIT
"""The runner of all measurements: one result, one table, charts, one exit code."""
import os
import sys
import tempfile
import time
from pathlib import Path

from harness.chart import files
from harness.command.options import Command, part_names, whole_number
from harness.measure.plan import Plan
from harness.page import tables
from harness.run import devices, machine
from harness.run.program import NEVER, ROOT, Problem, Program
from harness.store import result as results

OWN = ("--backend", "--device", "--frames", "--stats", "--output", "-o")
NEWS_SECONDS = 10  # seconds between lines of progress if the error output is no terminal


class News:
    """Progress: one line that changes on a terminal, or a line every few seconds."""
    shown_at, knows_time = None, False

    def __call__(self, words, seconds_left=None):
        is_due = self.shown_at is None or time.monotonic() - self.shown_at >= NEWS_SECONDS
        if seconds_left is not None:
            words += f"; about {int(seconds_left // 60)}:{int(seconds_left % 60):02} left of the timing"
            is_due, self.knows_time = is_due or not self.knows_time, True
        if os.isatty(2):
            print(f"\r\033[K{words}", end="", file=sys.stderr, flush=True)
        elif is_due:
            self.shown_at = time.monotonic()
            print(words, file=sys.stderr, flush=True)

    @staticmethod
    def end():
        if os.isatty(2):
            print("\r\033[K", end="", file=sys.stderr, flush=True)


class Bench(Command):
    """A measurement. A subclass declares its options; `prepare` puts jobs and rows into the plan, `measure` measures,
    `fill` fills in the result, `tables` and `charts` show it."""
    codes = """exit codes: 0 done, 1 pictures differ or a run failed, 2 wrong usage or input,
3 no device can be timed, 130 interrupted (what was measured is kept)"""
    own_options = OWN
    quick = "measure few frames, repeats and samples; figures are rough"  # None: it has no such option
    repeats = (5, 2)  # rounds, slowly and quickly; None: no devices are timed
    parts = ()
    scene = "built-in scene"
    chart_files = ()  # patterns of an earlier run's files
    keys = {}  # keys of the result, besides the common ones

    def add_options(self, parser):
        parser.set_defaults(quick=False, repeats=None, device=[])
        if self.quick:
            parser.add_argument("--quick", action="store_true", help=self.quick)
        parser.add_argument("--hedron", type=Path, default=ROOT / "build/release/hedron", metavar="PROGRAM",
                            help="program to measure, in the folder of its build (default: build/release/hedron)")
        parser.add_argument("--out", type=Path, default=ROOT / "bench/out", metavar="FOLDER",
                            help="folder for the results (default: bench/out)")
        if self.repeats:
            default = f"default: {self.repeats[0]}" + (f", with --quick {self.repeats[1]}" if self.quick else "")
            parser.add_argument("--repeats", type=whole_number, metavar="N", help=f"rounds; each runs every job once ({default})")
            parser.add_argument("--device", action="append", default=[], metavar="BACKEND[:NUMBER]",
                                help="measure only this backend or device of 'hedron devices'; repeatable")
        if self.parts:
            parser.add_argument("--parts", type=part_names(self.parts), default=list(self.parts), metavar="NAME,...",
                                help=f"measure only these parts, of {', '.join(self.parts)}")

    def complete(self, arguments):
        if self.repeats:
            arguments.repeats = arguments.repeats or self.repeats[arguments.quick]

    def run(self, arguments):
        program = Program(arguments.hedron, getattr(arguments, "others", 100 * NEVER) / 100)
        try:
            arguments.out.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise Problem(1, f"cannot make the folder {arguments.out}: {error.strerror}") from error
        arguments.out = arguments.out.resolve()
        with tempfile.TemporaryDirectory(prefix="hedron-bench-") as folder:
            self.begin(arguments, program, Path(folder))
            self.prepare()
            return self.work()

    def begin(self, arguments, program, folder):
        self.arguments, self.program, self.folder, self.news = arguments, program, folder, News()
        self.file = arguments.out / f"{self.name}.json"
        entries = devices.chosen(program.backends(), arguments.device) if self.repeats else []
        self.plan = Plan({entry["label"]: entry for entry in entries}, {}, program, folder, self.news,
                         quick=arguments.quick, options=arguments.options)
        self.runnable = self.plan.runnable
        self.result = results.begin(self.name, program, arguments, entries, scene={"name": self.scene}, rows=[],
                                    measurements=self.plan.jobs, **dict.fromkeys(self.keys))

    # ---- for subclasses

    def prepare(self):
        """Adds jobs and rows to the plan."""

    def measure(self):
        """Measures; returns False if it could not."""
        self.plan.run_all(self.arguments.repeats)

    def fill(self):
        """Fills in the result's own keys, and adds rows to the plan."""

    def compared(self):
        """Returns whether all made the same pictures."""
        return self.plan.compared()

    def tables(self):
        """Returns [(title, rows, lines below)] beside the rows with targets."""
        return []

    def charts(self):
        """Returns {name: chart}."""
        return {}

    # ---- common to all

    def wants(self, *parts):
        return not set(parts).isdisjoint(self.arguments.parts)

    def tried(self, what, measure, *arguments, **named):
        """Returns the result of `measure`, or the reason why it failed."""
        self.news(what)
        return self.plan.tried(measure, *arguments, **named)

    def demand_device(self, before=""):
        if not self.runnable:
            reasons = "; ".join(f"{device['label']}: {device['reason']}" for device in self.result["devices"])
            raise Problem(3, f"{before}{reasons}")

    def save(self):
        results.write(self.file, self.result)
        files.remove_old(self.arguments.out, self.chart_files)  # not before there is a result

    def work(self):
        try:
            self.result["complete"] = self.measure() is not False
        except KeyboardInterrupt:
            pass  # complete stays false
        self.news.end()
        self.result["machine"]["load_after"] = machine.load()
        return self.finish()

    def finish(self):
        self.fill()
        self.result["rows"] = self.plan.finished(judged=not self.arguments.options)
        self.result["pictures"] = self.compared()
        self.result["failures"] = sorted(self.plan.all_failures())
        self.save()
        self.tell()
        return self.exit_code()

    def tell(self):
        document = self.file.with_suffix(".md")
        results.write_text(document, tables.markdown(self.result, self.tables()))
        failures = [f"FAILED: {failure}" for failure in self.result["failures"]]
        print(tables.text(self.result, self.tables()), *files.draw(self.charts(), self.arguments.out), *failures,
              f"All of it: {self.file}; the tables for documents: {document}", sep="\n")

    def exit_code(self):
        if not self.result["complete"]:
            return 130
        if self.result["pictures"]["same"] is False or self.result["failures"]:
            return 1
        return 0 if self.runnable or not self.repeats else 3
