# SPDX-License-Identifier: MIT
"""Charts what the choices behind the pipelines are worth."""
from harness.command.bench import Bench
from harness.pipelines import cuda, order, rows
from harness.run.program import ROOT

PARTS = ("pipelines", "queue_order", "image_sums", "texture_lookups")
QUEUE_SCENES = ("headline", "default")


class Pipelines(Bench):
    name = "pipelines"
    about = "Measure what the choices behind the pipelines are worth, and draw charts."
    quick = "few frames, rounds and samples; rough"
    own_options = (*Bench.own_options, "--pipeline")
    parts = PARTS
    scene = f"scenes {', '.join(rows.SCENES)}"
    chart_files = PARTS  # a chart for each
    keys = PARTS

    def __init__(self, arguments, program, folder):
        super().__init__(arguments, program, folder)
        self.scenes = self.plan.scenes = {"default": ROOT / "scenes/default.json", **{
            name: ROOT / f"bench/scenes/{name}.json" for name in ("headline", "fullhd")}}
        self.backends = program.backends()
        self.jobs = rows.add_jobs(self.plan, self.runnable, "0-2" if arguments.quick else "0-4", arguments.options
                                  ) if self.wants("pipelines") else []

    def part(self, name, measure):
        """What it gives goes into the result, or the reason why there is nothing."""
        if self.wants(name):
            found = self.tried(name.replace("_", " "), measure)
            self.result[name] = {"reason": found} if isinstance(found, str) else found

    def order_queues(self):
        return order.measure(self.program, [self.scenes[name] for name in QUEUE_SCENES], self.arguments.repeats,
                             1 << 14 if self.arguments.quick else 1 << 19)

    def add_up(self):
        cuda.demand_gpu(self.backends)
        recording = self.folder / "recording"
        order.run(self.program, "--record", recording, self.scenes["headline"])
        return cuda.run("image_sums", self.folder, recording)

    def look_up(self):
        cuda.demand_gpu(self.backends)
        return cuda.run("texture_lookups", self.folder)

    def measure(self):
        self.part("queue_order", self.order_queues)
        self.part("image_sums", self.add_up)
        self.part("texture_lookups", self.look_up)
        self.plan.run_all(self.arguments.repeats)

    def fill(self):
        if self.jobs:
            self.result["pipelines"] = rows.all_rows(self.plan, self.jobs)
        if self.has("image_sums") and not cuda.fixed_is_exact(self.result["image_sums"]):
            self.plan.failures.add("two runs of sums in fixed point differ")

    def has(self, name):
        return self.result[name] and "reason" not in self.result[name]

    def tables(self):
        found = [("Pipelines", [rows.HEAD, *map(rows.cells, self.result["pipelines"])], [])] if self.jobs else []
        for name, head, cells in (
                ("queue_order", order.HEAD, lambda each: map(order.cells, each["orders"])),
                ("image_sums", cuda.SUM_HEAD, lambda each: (cuda.sum_cells(each, name) for name in cuda.SUMS)),
                ("texture_lookups", cuda.LOOKUP_HEAD, lambda each: (cuda.lookup_cells(each, name) for name in cuda.LOOKUPS))):
            title, each = name.replace("_", " ").capitalize(), self.result[name]
            if self.has(name):
                found.append((title, [head, *cells(each)], []))
            elif each:
                found.append((title, [], [f"Not measured: {each['reason']}"]))
        return found

    def charts(self):
        wanted = {"queue_order": order.chart, "image_sums": cuda.sum_chart, "texture_lookups": cuda.lookup_chart}
        found = {name: chart(self.result) for name, chart in wanted.items() if self.has(name)}
        if any(each["ratio_to_mega"] for each in self.result["pipelines"] or []):
            found["pipelines"] = rows.chart(self.result)
        return found


BENCH = Pipelines
