# SPDX-License-Identifier: MIT
"""The runner of all measurements: one result, one table, charts, one exit code."""
import os
import sys
import tempfile
import time
from pathlib import Path

from harness.chart import gnuplot
from harness.command.options import Command, add_common
from harness.measure.plan import Plan
from harness.page import tables
from harness.run import devices, machine
from harness.run.program import NEVER, Problem, Program
from harness.store import result as results

OWN = ("--backend", "--device", "--frames", "--stats", "--output", "-o")
NEWS_SECONDS = 10  # between lines about progress where there is no terminal


class News:
    """What is being done: one line that changes on a terminal, or a line every few seconds."""

    def __init__(self):
        self.told = None

    def __call__(self, words, seconds_left=None):
        left = ""
        if seconds_left is not None:
            left = f"; about {int(seconds_left // 60)}:{int(seconds_left % 60):02} left of the timing"
        if os.isatty(2):
            print(f"\r\033[K{words}{left}", end="", file=sys.stderr, flush=True)
        elif self.told is None or time.monotonic() - self.told >= NEWS_SECONDS:
            self.told = time.monotonic()
            print(f"{words}{left}", file=sys.stderr, flush=True)

    @staticmethod
    def end():
        if os.isatty(2):
            print("\r\033[K", end="", file=sys.stderr, flush=True)


class Bench(Command):
    """A measurement. A class of it says what there is to choose, `measure` measures, `fill` puts what came of it into the
    result, `tables` and `charts` show it."""
    codes = """exit codes: 0 done, 1 pictures differ or a run failed, 2 wrong usage or input,
3 no device can be timed, 130 interrupted (what was measured is kept)"""
    own_options = OWN
    quick = "few frames and repeats, smaller pictures; rough"
    repeats = (5, 2)  # rounds, slowly and quickly; None: no devices are timed
    parts = ()
    scene = "built-in scene"
    chart_files = ()  # patterns of those of an earlier run
    keys = {}  # of the result, beside those that all have

    @classmethod
    def add_options(cls, parser):
        add_common(parser, cls.quick, cls.repeats, cls.parts)

    @classmethod
    def complete(cls, arguments):
        if cls.repeats:
            arguments.repeats = arguments.repeats or cls.repeats[arguments.quick]

    @classmethod
    def run(cls, arguments):
        program = Program(arguments.hedron, getattr(arguments, "others", 100 * NEVER) / 100)
        try:
            arguments.out.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise Problem(1, f"cannot make the folder {arguments.out}: {error.strerror}") from error
        arguments.out = arguments.out.resolve()
        with tempfile.TemporaryDirectory(prefix="hedron-bench-") as folder:
            return cls(arguments, program, Path(folder)).work()

    def __init__(self, arguments, program, folder):
        self.arguments, self.program, self.folder, self.news = arguments, program, folder, News()
        self.file = arguments.out / f"{self.name}.json"
        entries = devices.chosen(program.backends(), arguments.device) if self.repeats else []
        self.runnable = devices.runnable(entries)
        self.plan = Plan({entry["label"]: entry for entry in entries}, {}, program, folder, self.news)
        self.result = results.begin(self.name, program, arguments, entries, scene={"name": self.scene}, rows=[],
                                    measurements=self.plan.jobs, **{key: None for key in self.keys})
        gnuplot.remove_old(arguments.out, self.chart_files)

    # ---- what a measurement says of itself

    def measure(self):
        """False: it could not be."""
        raise NotImplementedError

    def fill(self):
        """Fills in the result's own keys, and adds rows to the plan."""

    def compared(self):
        """Whether all made the same pictures."""
        return self.plan.compared()

    def tables(self):
        """[(title, rows, lines below)] beside the rows with targets."""
        return []

    def charts(self):
        """{name: (height, commands)}"""
        return {}

    # ---- what they share

    def wants(self, *parts):
        return not set(parts).isdisjoint(self.arguments.parts)

    def tried(self, what, measure, *arguments, **named):
        """What it gives, or the reason why there is nothing; that counts as a failure, but where something is missing."""
        self.news(what)
        try:
            return measure(*arguments, **named)
        except Problem as problem:
            if problem.code != 3:
                self.plan.failures.add(str(problem))
            return str(problem)

    def save(self):
        results.write(self.file, self.result)

    def work(self):
        try:
            self.result["complete"] = self.measure() is not False
        except KeyboardInterrupt:
            pass  # complete stays false
        self.news.end()
        self.fill()
        self.result["rows"] = self.plan.finished(judged=not self.arguments.options)
        self.result["pictures"] = self.compared()
        self.result["failures"] = sorted(self.plan.all_failures())
        self.result["machine"]["load_after"] = machine.load()
        self.save()
        self.tell()
        return self.exit_code()

    def tell(self):
        document = self.file.with_suffix(".md")
        results.write_text(document, tables.markdown(self.result, self.tables()))
        print(tables.text(self.result, self.tables()))
        for line in gnuplot.draw(self.charts(), self.arguments.out):
            print(line)
        for failure in self.result["failures"]:
            print(f"FAILED: {failure}")
        print(f"All of it: {self.file}; the tables for documents: {document}")

    def exit_code(self):
        if not self.result["complete"]:
            return 130
        if self.result["pictures"]["same"] is False or self.result["failures"]:
            return 1
        return 0 if self.runnable or not self.repeats else 3
