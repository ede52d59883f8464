# SPDX-License-Identifier: MIT
"""Every part on every device, and one page of them; an interrupted study can be continued."""
import hashlib
import importlib
import sys
from pathlib import Path

from harness.chart import files
from harness.command.bench import OWN, Bench
from harness.measure import jobs
from harness.measure.numbers import spread_text
from harness.measure.plan import DEFAULT, OFFICIAL
from harness.page import answer, html, tables
from harness.page.section import sections
from harness.run.program import ROOT, Problem, Program
from harness.store import result as results

FOLDER = Path(__file__).resolve().parent.parent / "measurements"
MEASUREMENTS = {file.stem: importlib.import_module(f"harness.measurements.{file.stem}") for file in FOLDER.glob("[a-z]*.py")}
PARTS = dict(sorted(((name, module.PART) for name, module in MEASUREMENTS.items() if hasattr(module, "PART")),
                    key=lambda each: each[1].place))
# Words that may come first; frames and compare are programs of their own.
NAMES = sorted(name for name, module in MEASUREMENTS.items()
               if hasattr(module, "BENCH") and not (ROOT / "bench" / name).is_file())
LIMIT = 10  # default of --others, in per cent of all processors' time
SLOW_SECONDS, SLOW_ROUNDS = 6, 2  # rounds of slow jobs


def percent(text):
    number = float(text)
    if not 0 <= number <= 100:
        raise ValueError
    return number


percent.__name__ = "number from 0 to 100"


class Study(Bench):
    name = "study"
    about = (f"Measure everything on every device, and write one page. An interrupted study continues if it is called again. "
             f"bench/study NAME measures something else, with its own options: {', '.join(NAMES)}.")
    own_options = (*OWN, "--size", "--samples", "--depth", "--lanes", "--threads", "--pipeline", "--block", "--grid", "--accel",
                   "--precision", "--math")
    parts = tuple(PARTS)

    def main(self, words):
        if words and words[0] in NAMES:
            return MEASUREMENTS[words[0]].BENCH().main(words[1:])
        return super().main(words)

    def add_options(self, parser):
        super().add_options(parser)
        parser.add_argument("--again", action="store_true", help="measure everything again and replace what was saved")
        parser.add_argument("--report", action="store_true", help="measure nothing; write the page from saved results")
        parser.add_argument("--machine", metavar="NAME", help="what the page calls this machine (default: its processor)")
        parser.add_argument("--others", type=percent, default=LIMIT, metavar="PERCENT",
                            help="repeat a run, a few times at most, if other programs took more of the processors "
                                 "(default: 10; 100: never repeat)")
        parser.add_argument("--results", type=Path, default=ROOT / "bench/results", metavar="FOLDER",
                            help="results of other machines (default: bench/results)")

    def complete(self, arguments):
        super().complete(arguments)
        if arguments.report and arguments.again:
            raise ValueError("--report measures nothing, so --again cannot stand with it")

    def run(self, arguments):
        return self.report(arguments) if arguments.report else super().run(arguments)

    def prepare(self):
        self.demand_device("no device can be timed: ")
        arguments, plan = self.arguments, self.plan
        for left in arguments.out.glob("study.json.tmp-*"):
            left.unlink()
        self.result["machine"] = {"name": arguments.machine, **self.result["machine"]}
        self.kernels = self.program.kernels()
        self.result["hedron"].update(sha256=hashlib.sha256(self.program.path.read_bytes()).hexdigest(), kernels=self.kernels)
        self.result.update(interference_limit=arguments.others / 100, bounds=None, accuracy=None, stability=None)
        plan.save, plan.slow_seconds, plan.slow_rounds = self.save, SLOW_SECONDS, SLOW_ROUNDS

    def before(self):
        """Returns saved results that can be continued, or None."""
        if not self.file.is_file() or self.arguments.again:
            return None
        old = results.read_study(self.file)
        if results.question(old) == results.question(self.result):
            return old
        kept = self.file.with_suffix(".before.json")
        self.file.replace(kept)
        print(f"{self.file} is of another program, another device or another kind of study, so everything is measured again. "
              f"{kept} keeps the old results.", file=sys.stderr)
        return None

    def make_plan(self):
        plan, wanted = self.plan, self.arguments.parts
        plan.scenes = {name: ROOT / f"scenes/{name}.json" for name in (DEFAULT, OFFICIAL)}
        for plan.part in wanted:
            if PARTS[plan.part].scenes:
                plan.scenes |= PARTS[plan.part].scenes(plan)
            if PARTS[plan.part].add:
                PARTS[plan.part].add(plan)
        results.merge(self.before(), self.result, plan.jobs, wanted, list(PARTS))
        self.result["left_out"].update(plan.left_out)
        plan.jobs = [entry for entry in self.result["measurements"] if entry["part"] in wanted]

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
        return not results.is_unfinished(self.result)

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

    def report(self, arguments):
        self.arguments, self.file = arguments, arguments.out / "study.json"
        if not self.file.is_file():
            raise Problem(2, f"{self.file} does not exist; without --report, bench/study measures")
        self.result = results.read_study(self.file)
        self.result["machine"]["name"] = arguments.machine or self.result["machine"]["name"]
        self.kernels = Program(arguments.hedron).kernels() if arguments.hedron.is_file() else None
        code = self.finish()
        return 0 if code == 130 else code

    def is_same(self, result):
        """Returns whether this program's kernels measured it; if no program is known, the newest result counts as its own."""
        kernels, wanted = result["hedron"].get("kernels"), self.kernels or self.result["hedron"].get("kernels")
        return kernels == wanted if wanted else result is self.result

    def finish(self):
        """Writes the page, the charts and the table of saved results; returns the exit code."""
        result, out = self.result, self.arguments.out
        jobs.summarize(result["measurements"])
        missing = results.missing_parts(result, PARTS)
        result.update(pictures=compare(result), failures=failures(result), missing=missing, complete=not missing)
        self.save()
        found = [{**each, "same_kernels": self.is_same(each)} for each in (result, *others(self.arguments.results, result))]
        drawn = sections(PARTS, found)
        files.remove_old(out, ["study_*"])  # removes the charts of removed sections too
        charts = {name: chart for section in drawn for name, (chart, _) in section.charts.items()}
        files.draw(charts, out)
        wrong, remarks = [[f"{each['machine']['name']}: {each['pictures']['sentence']}" for each in found
                        if (each["pictures"]["same"] is False) is differ] for differ in (True, False)]
        failed = [f"FAILED: {words}" for words in result["failures"]]
        results.write_text(out / "report.html", html.page(found, drawn, answer.opening(PARTS, found), [*wrong, *failed], remarks))
        results.write_text(out / "study.csv", html.csv_text(found))
        print(*summary_lines(result), "", *failed, *wrong, *remarks, sep="\n")
        if results.is_unfinished(result):
            print("Interrupted: the same call continues.")
        print(f"The page: {out / 'report.html'}; all figures: {self.file} and study.csv")
        if result["pictures"]["same"] is False or result["failures"]:
            return 1
        return 130 if results.is_unfinished(result) else 0


def compare(result):
    """Returns whether all that must make the same pictures did."""
    return jobs.compare_pictures(result["measurements"], {device["label"]: device for device in result["devices"]})


def failures(result):
    return [*sorted(jobs.failures(result["measurements"])), *(f"{name}: {words}" for name, words in result["failed"].items()),
            *(f"{name}: {words}" for name, part in PARTS.items() for words in part.failures(result))]


def others(folder, own):
    """Returns other machines' results, sorted by name, without copies of this one's."""
    found = [results.read_study(file) for file in sorted(folder.glob("*.json"))]
    return sorted(({**result, "pictures": compare(result)} for result in found
                   if (result["date"], result["machine"]["name"]) != (own["date"], own["machine"]["name"])),
                  key=lambda result: (result["machine"]["name"], result["date"]))


def summary_lines(result):
    """Returns the table for the terminal."""
    rows = [["part", "device", "what", "trace ms [q1..q3]", "runs"]]
    for entry in result["measurements"]:
        each = entry["summary"]
        if each:
            rows.append([entry["part"], entry["device"], f"{entry['series']} {entry['x']:g}".strip(),
                         spread_text(each["trace_ms"]) + (" disturbed" if each["noisy"] else ""), str(each["runs"])])
    return tables.lines(rows)
