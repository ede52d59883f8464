# SPDX-License-Identifier: MIT
"""Every part on every device, and one page of them; what was interrupted goes on where it stopped."""
import csv
import hashlib
import importlib
import io
import sys
from pathlib import Path

from harness.chart import gnuplot
from harness.command.bench import OWN, Bench
from harness.measure import jobs
from harness.measure.points import DEFAULT, OFFICIAL, Points
from harness.page import html, part as page_part
from harness.page.sources import Sources
from harness.run import machine
from harness.run.program import ROOT, Problem
from harness.store import result as results
from harness.store import study

PARTS = page_part.load()
TIMED = [name for name, part in PARTS.items() if part.add]
LIMIT = 10  # per cent of all processors' time: a run of which others took more is measured again, if not said
# What the first word may name; frames and compare are programs of their own.
NAMES = sorted(file.stem for file in Path(__file__).parent.glob("[a-z]*.py") if not (ROOT / "bench" / file.stem).is_file())
SLOW_SECONDS, SLOW_ROUNDS = 6, 2  # a whole run of so long is done so often


def percent(text):
    number = float(text)
    if not 0 <= number <= 100:
        raise ValueError
    return number


percent.__name__ = "number from 0 to 100"


class Study(Bench):
    name = "study"
    about = (f"Measure everything on every device, and make one page of it. What was interrupted goes on where it stopped. "
             f"bench/study NAME measures something else, with options of its own: {', '.join(NAMES)}.")
    own_options = (*OWN, "--size", "--samples", "--depth", "--lanes", "--threads", "--pipeline", "--block", "--grid", "--accel",
                   "--precision", "--math")
    parts = tuple(PARTS)

    @classmethod
    def main(cls, words):
        if words and words[0] in NAMES:
            return importlib.import_module(f"harness.benches.{words[0]}").BENCH.main(words[1:])
        return super().main(words)

    @classmethod
    def add_options(cls, parser):
        super().add_options(parser)
        parser.add_argument("--again", action="store_true", help="measure everything anew, whatever was saved")
        parser.add_argument("--report", action="store_true", help="measure nothing: the page of what was saved")
        parser.add_argument("--machine", metavar="NAME", help="what the page calls this machine (default: its processor)")
        parser.add_argument("--others", type=percent, default=LIMIT, metavar="PERCENT",
                            help="a run is done again, a few times at most, where other programs took more of the processors "
                                 "(default: 10; 100: never)")
        parser.add_argument("--results", type=Path, default=ROOT / "bench/results", metavar="FOLDER",
                            help="results of other machines (default: bench/results)")

    @classmethod
    def complete(cls, arguments):
        super().complete(arguments)
        if arguments.report and arguments.again:
            raise ValueError("--report measures nothing, so there is no --again")

    @classmethod
    def run(cls, arguments):
        return report_only(arguments) if arguments.report else super().run(arguments)

    def __init__(self, arguments, program, folder):
        super().__init__(arguments, program, folder)
        if not self.runnable:
            reasons = "; ".join(f"{device['label']}: {device['reason']}" for device in self.result["devices"])
            raise Problem(3, f"no device can be timed: {reasons}")
        for left in arguments.out.glob("study.json.tmp-*"):
            left.unlink()
        self.result["machine"] = {"name": arguments.machine, **self.result["machine"]}
        self.result["hedron"]["sha256"] = hashlib.sha256(program.path.read_bytes()).hexdigest()
        self.result.update(interference_limit=arguments.others / 100, bounds=None, accuracy=None, stability=None)

    def before(self):
        """What was saved and may be gone on from, or None."""
        if not self.file.is_file() or self.arguments.again:
            return None
        old = study.read(self.file)
        if study.is_continued(old, self.result):
            return old
        kept = self.file.with_suffix(".before.json")
        self.file.replace(kept)
        print(f"What {self.file} has is of another program, another device or another kind of study: all is measured "
              f"anew. The old one is {kept} now.", file=sys.stderr)
        return None

    def make_scenes(self):
        scenes = {name: ROOT / f"scenes/{name}.json" for name in (DEFAULT, OFFICIAL)}
        for name in self.arguments.parts:
            if PARTS[name].scenes:
                scenes |= PARTS[name].scenes(self.program, self.folder, self.arguments.quick, self.news)
        return scenes

    def make_plan(self):
        arguments, plan = self.arguments, self.plan
        plan.scenes = self.make_scenes()
        points = Points(self.runnable, arguments.quick, machine.cores(), arguments.options, plan.scenes)
        for name in filter(self.wants, TIMED):
            points.part = name
            PARTS[name].add(points)
        study.merge(self.before(), self.result, points.found, arguments.parts, list(PARTS))
        self.result["left_out"].update(points.left_out)
        plan.jobs = [entry for entry in self.result["measurements"] if entry["part"] in arguments.parts]
        plan.save, plan.slow_seconds, plan.slow_rounds = self.save, SLOW_SECONDS, SLOW_ROUNDS

    def measure(self):
        self.make_plan()
        self.save()
        if not self.plan.run_all(self.arguments.repeats, lambda: compare(self.result)["same"] is not False):
            return False
        for name in self.arguments.parts:
            if PARTS[name].measure:
                self.measure_part(name)
            self.result["done"].append(name)
            self.save()
        return set(self.result["parts"]) <= set(self.result["done"])

    def measure_part(self, name):
        try:
            reason = PARTS[name].measure(self)
        except Problem as problem:
            if problem.code == 2:
                raise
            reason = f"{problem}."
            if problem.code == 1:
                self.result["failed"][name] = reason
        if reason:
            self.result["left_out"][name] = reason

    def work(self):
        try:
            self.result["complete"] = self.measure()
        except KeyboardInterrupt:
            pass  # complete stays false
        self.news.end()
        self.result["machine"]["load_after"] = machine.load()
        return finish(self.result, self.arguments)


# ---- everything that follows from what was saved

def compare(result):
    """Whether all that must make the same pictures did."""
    return jobs.compare_pictures(result["measurements"], {device["label"]: device for device in result["devices"]})


def failures(result):
    broken = [f"{name}: {reason}" for name, reason in result["failed"].items()]
    return [*sorted(jobs.failures(result["measurements"])), *broken,
            *[f"{name}: {words}" for name, part in PARTS.items() for words in part.failures(result)]]


def others(arguments, own):
    """The results of other machines, by their names; not that which was copied from here."""
    found = []
    for file in sorted(arguments.results.glob("*.json")):
        result = study.read(file)
        if (result["date"], result["machine"]["name"]) != (own["date"], own["machine"]["name"]):
            found.append({**result, "pictures": compare(result)})
    return sorted(found, key=lambda result: (result["machine"]["name"], result["date"]))


def draw(sections, out):
    """Charts of sections that are gone go too."""
    gnuplot.remove_old(out, ["study_*"])
    charts = {name: chart for section in sections for name, chart in section.charts.items()}
    return [line for line in gnuplot.draw(charts, out) if not line.startswith("Chart: ")]


def write_csv(file, found):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([html.CSV_HEAD, *(row for each in found for row in html.csv_rows(each))])
    results.write_text(file, text.getvalue())


def finish(result, arguments):
    """The page, the charts, the table; the exit code."""
    out = arguments.out
    jobs.summarize(result["measurements"])
    result["pictures"] = compare(result)
    result["failures"] = failures(result)
    results.write(out / "study.json", result)
    found = [result, *others(arguments, result)]
    sections = page_part.sections(PARTS, Sources(found))
    problems = draw(sections, out)
    wrong, told = [[f"{each['machine']['name']}: {each['pictures']['sentence']}" for each in found
                    if (each["pictures"]["same"] is False) is differ] for differ in (True, False)]
    failed = [f"FAILED: {words}" for words in result["failures"]]
    results.write_text(out / "report.html", html.page(found, sections, [*wrong, *failed], told, out))
    write_csv(out / "study.csv", found)
    print("\n".join([*html.summary_lines(result), "", *problems, *failed, *wrong, *told]))
    if not result["complete"]:
        print("Interrupted: the same call goes on where it stopped.")
    print(f"The page: {out / 'report.html'}; all figures: {out / 'study.json'} and study.csv")
    if result["pictures"]["same"] is False or result["failures"]:
        return 1
    return 0 if result["complete"] else 130


def report_only(arguments):
    file = arguments.out / "study.json"
    if not file.is_file():
        raise Problem(2, f"there is no {file} to make a page of: leave --report away to measure")
    result = study.read(file)
    result["machine"]["name"] = arguments.machine or result["machine"]["name"]
    code = finish(result, arguments)
    return 0 if code == 130 else code


BENCH = Study
