# SPDX-License-Identifier: MIT
"""What bench/speed runs and what it makes of that: jobs, done in turns, and rows, computed afterwards."""
from dataclasses import dataclass
from statistics import median

from harness import summary
from harness.program import Interrupted, Problem

PICTURES = "#######.data"


class Missing(Exception):
    """Why a row has no figure."""


@dataclass(frozen=True)
class Target:
    least: float
    aim: float
    more_is_better: bool = True


@dataclass(frozen=True)
class Job:
    """Runs of hedron that differ in nothing but the time of day."""
    device: str
    scene: str
    frames: str
    options: tuple = ()
    output: str = PICTURES
    slow: bool = False  # once is enough
    few_cores: bool = False  # on no more cores than the target is for


class Plan:
    """`scenes` maps names to files (None: the built-in scene), `devices` labels to entries."""

    def __init__(self, devices, scenes):
        self.devices = devices
        self.scenes = scenes
        self.runs = {}  # Job: [run]
        self.reasons = {}  # Job: why it cannot run
        self.failures = set()  # those of the reasons that should not be
        self.rows = []

    def job(self, *arguments, **named):
        job = Job(*arguments, **named)
        self.runs.setdefault(job, [])
        return job

    def row(self, key, what, unit, figure, *, device=None, target=None, note=None):
        """`figure` is called when all is measured: it gives a list of values, or raises Missing."""
        self.rows.append({"key": key, "what": what, "device": device, "unit": unit, "target": target,
                          "note": note, "figure": figure})

    def absent(self, key, what, unit, target, reason):
        """A row that has no figure here."""
        def figure():
            raise Missing(reason)
        self.row(key, what, unit, figure, target=target)

    # ---- what rows ask for

    def done(self, job):
        if self.reasons.get(job):
            raise Missing(self.reasons[job])
        if not self.runs[job]:
            raise Missing("it was not run")
        return self.runs[job]

    def frames(self, run):
        """The frames that count: all but the first, which warms up, where there are several."""
        return run["frames"][1:] or run["frames"]

    def each_frame(self, job, value):
        return [value(frame) for run in self.done(job) for frame in self.frames(run)]

    def trace_ms(self, job, scale=1):
        return self.each_frame(job, lambda frame: 1e3 * scale * frame["seconds"]["trace"])

    def medians(self, job):
        """The median time of tracing of each round."""
        return [median(frame["seconds"]["trace"] for frame in self.frames(run)) for run in self.done(job)]

    def ratios(self, job, base):
        """Of the times of two jobs, round by round, so that a slow minute meets both."""
        return [one / other for one, other in zip(self.medians(job), self.medians(base)) if other > 0]

    def seconds_a_frame(self, short, long):
        """Steady state, from two lengths of a run: neither its start nor its end is in it."""
        pairs = zip(self.done(short), self.done(long))
        seconds = [(two["wall"] - one["wall"]) / (len(two["frames"]) - len(one["frames"])) for one, two in pairs]
        if seconds and min(seconds) <= 0:
            raise Missing("the frames are too fast to be told from the noise of two runs")
        return seconds

    # ---- the work

    def run_job(self, job, program, folder, cores):
        device = self.devices[job.device]
        options = [*job.options]
        run = program.render(device, self.scenes[job.scene], job.frames, options, folder, output=job.output,
                             cores=cores if job.few_cores else None)
        if run["code"] == 2:
            raise Problem(2, run["message"])
        if run["code"] != 0:
            self.reasons[job] = run["message"]
            if run["code"] != 3:
                self.failures.add(run["message"])
        else:
            self.runs[job].append(run)

    def run_all(self, program, folder, repeats, cores, news):
        """Every job once a round, so that a slow minute of the machine meets all of them."""
        for repeat in range(repeats):
            for place, job in enumerate(self.runs):
                if self.reasons.get(job) or (job.slow and self.runs[job]):
                    continue
                news(f"round {repeat + 1} of {repeats}, run {place + 1} of {len(self.runs)}: "
                     f"{job.device}, {job.scene} {' '.join(job.options)}")
                try:
                    self.run_job(job, program, folder, cores)
                except Interrupted as interrupted:
                    raise KeyboardInterrupt from interrupted


def judge(target, value):
    """(ratio to least, ratio to aim, verdict); a ratio of 1 or more says that the target is met."""
    if target is None:
        return None, None, None
    if target.least == 0:  # of what must not be at all, nothing is so many times as good
        return None, None, "aim" if value == 0 else "missed"
    if value == 0 and not target.more_is_better:
        return None, None, "aim"
    least, aim = [value / wanted if target.more_is_better else wanted / value for wanted in (target.least, target.aim)]
    return least, aim, "aim" if aim >= 1 else "least" if least >= 1 else "missed"


def finish_row(row, judged=True):
    """The row as it is written. Where `judged` is false the figure is no answer to the target."""
    target = row["target"]
    done = {"key": row["key"], "what": row["what"], "device": row["device"], "unit": row["unit"],
            "least": target and target.least, "aim": target and target.aim,
            "more_is_better": None if target is None else target.more_is_better,
            "figure": None, "q1": None, "q3": None, "count": 0, "ratio_to_least": None, "ratio_to_aim": None,
            "verdict": None, "note": row["note"], "reason": None}
    try:
        values = row["figure"]()
        if not values:
            raise Missing("nothing was measured")
    except Missing as missing:
        done["reason"] = str(missing)
        return done
    done["q1"], done["figure"], done["q3"] = summary.quartiles(values)
    done["count"] = len(values)
    if judged:
        done["ratio_to_least"], done["ratio_to_aim"], done["verdict"] = judge(target, done["figure"])
    return done


def picture_groups(plan):
    """{what promises one picture: {digest: [job]}}: how rays are shared among threads, lanes and kernels
    changes no byte, nor does how triangles are searched."""
    groups = {}
    for job, runs in plan.runs.items():
        options = " ".join(job.options)
        if "--math fast" in options or not plan.devices[job.device]["strict"]:
            continue
        words = list(job.options)
        for free in ("--threads", "--pipeline", "--accel", "--lanes", "--block", "--grid"):
            if free in words:
                del words[words.index(free):words.index(free) + 2]
        for run in runs:
            for number, picture in run["digests"].items():
                makers = groups.setdefault((job.scene, tuple(words), number), {}).setdefault(picture, [])
                makers.append(f"{job.device} {options}".strip())
    return groups


def compare_pictures(plan):
    """{"same": true, false or null, "compared": how many frames, "sentence"}"""
    groups = picture_groups(plan)
    several = [makers for makers in groups.values() if len({maker for who in makers.values() for maker in who}) > 1]
    for (scene, _, number), makers in groups.items():
        if len(makers) > 1:
            who = " / ".join(", ".join(sorted(set(each))) for each in makers.values())
            return {"same": False, "compared": len(several),
                    "sentence": f"THE PICTURES DIFFER, so these times are no result: {scene}, frame {number}: {who}."}
    if not several:
        return {"same": None, "compared": 0, "sentence": "No pictures were compared: none was made in two ways."}
    return {"same": True, "compared": len(several),
            "sentence": f"The same bytes from every device and pipeline, in {len(several)} frames made in two ways or more."}
