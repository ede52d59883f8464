# SPDX-License-Identifier: MIT
"""The plan: jobs of hedron, interleaved, repeated if disturbed; and the rows that need them."""
import tempfile
from pathlib import Path
from statistics import median

from harness.measure import jobs
from harness.measure.jobs import run_of
from harness.measure.rows import Missing, Rows, known
from harness.run.program import Interrupted, Problem

AGAIN = 2  # repetitions of a disturbed run, at most
MOST_REJECTED = 0.5  # share of all planned runs: beyond it the machine is simply busy
CACHES = ("HEDRON_CACHE", "POCL_CACHE_DIR", "CUDA_CACHE_PATH")

DEFAULT, OFFICIAL = "default", "official"
# View for CPUs or others, and the factor of its times: a GPU's frame of the CPUs' size is too short to be timed.
VIEWS = {True: (("--size", "320x180", "--samples", "2"), 16), False: (("--size", "1280x720", "--samples", "2"), 1)}


class Plan(Rows):
    """Jobs and rows. `devices` are entries by their labels, `runnable` those that can run. `scenes` maps names to
    files (None: the built-in scene), or to the reason why one could not be made. `save` is called after every run,
    `news` with the progress. `options` come before each job's own. A job whose run takes more than `slow_seconds` runs
    in `slow_rounds` rounds only; one whose frames take more than `once_seconds` in one."""

    def __init__(self, devices, scenes, program=None, folder=None, news=None, save=lambda: None, *, quick=False, options=()):
        super().__init__()
        self.devices, self.scenes, self.program, self.folder, self.news, self.save = (
            devices, scenes, program, folder, news, save)
        self.quick, self.options = quick, tuple(options)
        self.runnable = {label: device for label, device in devices.items() if device.get("reason") is None}
        self.jobs, self.made, self.failures = [], {}, set()
        self.part, self.left_out = None, {}  # the part that adds points; by part: why it has no points, or not all
        self.cores = None  # processors of jobs on few cores; None: all
        self.keeps_parts = False  # whether it keeps parts of an interrupted run
        self.slow_seconds, self.slow_rounds, self.once_seconds = float("inf"), 1, None

    # ---- jobs

    def job(self, device, scene, frames, options=(), **named):
        """Returns the job, the same one if it was requested before."""
        wanted = jobs.job(device, scene, frames, (*options, *self.options), **named)
        made = self.made.setdefault(repr(wanted), wanted)
        if made is wanted:
            self.jobs.append(wanted)
        return made

    def point(self, series, x, device, scene, options, *, frames=None, **named):
        """Adds a point of a chart of the part: one job on one device."""
        if isinstance(self.scenes[scene], str):
            self.left_out[self.part] = self.scenes[scene]
            return
        self.job(device, scene, frames or ("0-2" if self.quick else "0-3"), options, part=self.part, series=series, x=x, **named)

    def each(self, views=None):
        """Returns [(label, device, options of its view, factor of its times)]."""
        return [(label, device, *(views or VIEWS)[device["is_cpu"]]) for label, device in self.runnable.items()]

    def sweep(self, option, values, wanted=lambda device: True, views=None, series="", none=None):
        """Adds points of one option on the requested devices; `none` says that there is no such device."""
        if not any(map(wanted, self.runnable.values())):
            self.left_out[self.part] = none
        for label, device, view, scale in self.each(views):
            for value in values if wanted(device) else ():
                self.point(series, value, label, DEFAULT, (*view, option, str(value)), scale=scale)

    # ---- figures for rows

    @staticmethod
    def done(job):
        """Returns the job's runs."""
        return known(job["reason"] or job["runs"] or "it was not run")

    def each_frame(self, job, value):
        return [value(frame) for run in self.done(job) for frame in jobs.counted(run)]

    def trace_ms(self, job):
        return self.each_frame(job, lambda frame: 1e3 * job["scale"] * frame["seconds"]["trace"])

    def medians(self, job):
        """Returns the median tracing time of each round."""
        return [median(frame["seconds"]["trace"] for frame in jobs.counted(run)) for run in self.done(job)]

    def ratios(self, job, base):
        """Returns ratios of two jobs' times, round by round, so that a slow minute meets both."""
        return [one / other for one, other in zip(self.medians(job), self.medians(base)) if other > 0]

    def seconds_a_frame(self, short, long):
        """Returns the steady-state time from two lengths of a run: it contains neither the start nor the end."""
        pairs = zip(self.done(short), self.done(long))
        seconds = [(two["wall"] - one["wall"]) / (len(two["frames"]) - len(one["frames"])) for one, two in pairs]
        if seconds and min(seconds) <= 0:
            raise Missing("the frames are too fast: two runs differ by more than a frame takes")
        return seconds

    def compared(self):
        return jobs.compare_pictures(self.jobs, self.devices)

    def all_failures(self):
        return self.failures | jobs.failures(self.jobs)

    def tried(self, measure, *arguments, **named):
        """Returns the call's result, or the reason why it failed; a failure counts unless something is missing."""
        try:
            return measure(*arguments, **named)
        except Problem as problem:
            if problem.code != 3:
                self.failures.add(str(problem))
            return str(problem)

    # ---- one run

    def render(self, job):
        with tempfile.TemporaryDirectory(dir=self.folder) as empty:
            variables = {name: str(Path(empty, name)) for name in CACHES} if job["cold"] else None
            return self.program.render(self.devices[job["device"]], self.scenes[job["scene"]], job["frames"], job["options"],
                                       self.folder, output=job["output"], variables=variables,
                                       cores=self.cores if job.get("few_cores") else None)

    def measure(self, job, repeat):
        """Runs a job; of several tries the least disturbed one counts."""
        try:
            run = self.render(job)
        except Interrupted as interrupted:
            if self.keeps_parts and interrupted.run["frames"]:
                self.keep(job, jobs.kept_run(job, repeat, interrupted.run))
            raise
        if run["code"] == 2:
            words = ' '.join([job['scene'], *job['options']])
            raise Problem(2, f"{job['device']}, {words}: {run['said'].strip().removeprefix('hedron: ')}")
        if run["code"] != 0:
            job["reason"], job["failed"] = run["message"], run["code"] != 3
        elif not run["frames"]:
            job["reason"], job["failed"] = "it wrote no statistics", True
        else:
            job["renderer"] = run["frames"][0]["renderer"]
            self.keep(job, jobs.kept_run(job, repeat, run))
        self.save()

    @staticmethod
    def keep(job, run):
        before = run_of(job, run["repeat"])
        if before is None:
            job["runs"].append(run)
            return
        better, worse = sorted((before, run), key=lambda each: (each["noisy"], each["others"] or 0))
        job["runs"][job["runs"].index(before)] = better
        job["rejected"].append({**{key: worse[key] for key in ("repeat", "others", "load")}, "trace_ms": jobs.run_ms(job, worse)})

    # ---- rounds

    def is_wanted(self, job, repeat):
        if job["reason"] or run_of(job, repeat):
            return False
        if job.get("slow") or (job["runs"] and self.once_seconds and median(self.medians(job)) > self.once_seconds):
            return repeat < 1
        return not job["runs"] or job["runs"][0]["wall"] <= self.slow_seconds or repeat < self.slow_rounds

    def turn(self, repeat, repeats, words, wanted):
        for place, job in enumerate(self.jobs):
            if wanted(job):
                seconds_left = self.seconds_left(repeat, repeats)
                unknown = "; the time left is known after this run" if seconds_left is None else ""
                self.news(f"{words}, run {place + 1} of {len(self.jobs)}: {job['device']}, "
                          f"{job.get('part') or ' '.join([job['scene'], *job['options']])}{unknown}", seconds_left)
                self.measure(job, repeat)

    def is_disturbed(self, job, repeat, repeats, tries):
        """Returns whether its run of that round is still disturbed and may be repeated."""
        rejected, run = sum(len(each["rejected"]) for each in self.jobs), run_of(job, repeat)
        return (rejected < MOST_REJECTED * len(self.jobs) * repeats and run is not None and run["noisy"]
                and sum(each["repeat"] == repeat for each in (*job["runs"], *job["rejected"])) == tries)

    def run_all(self, repeats, is_good=lambda: True):
        """Runs every job once a round, so that a slow minute meets all of them, and repeats disturbed jobs at the end
        of the round. Stops if the rounds so far are not good; returns whether all are."""
        for repeat in range(repeats):
            words = f"round {repeat + 1} of {repeats}"
            self.turn(repeat, repeats, words, lambda job: self.is_wanted(job, repeat))
            for tries in range(1, AGAIN + 1):
                self.turn(repeat, repeats, f"{words}, again what was disturbed",
                          lambda job: self.is_disturbed(job, repeat, repeats, tries))
            if not is_good():
                return False
        return True

    def seconds_left(self, now, repeats):
        """Returns the seconds left, by the runs so far; None: unknown."""
        walls = {id(job): min(run["wall"] for run in job["runs"]) for job in self.jobs if job["runs"]}
        if not walls:
            return None
        usual = median(walls.values())
        return sum(walls.get(id(job), usual) for job in self.jobs for repeat in range(now, repeats)
                   if self.is_wanted(job, repeat))
