# SPDX-License-Identifier: MIT
"""Every target of speed on every device, and a timeline: the runs of each row, and its figure."""
import os
from statistics import median

from harness.command.bench import Bench
from harness.measure import kernel_rates
from harness.measure.rows import Missing, Target, known
from harness.measure.scenes import facts, write_lights
from harness.run import machine
from harness.run.devices import H200, is_h200, lane_rate
from harness.run.program import ROOT
from harness.speed import film, timeline

CORES = 2  # cores that the targets for two cores are measured on
MODEL_OPTIONS = ["--set", "camera.frames=5"]  # frames of the runs for the rows of the model
# Views that give a similar number of pairs: the middle of one picture, as fine as the whole of it in 640 x 360 with
# one sample, so that the rays of a packet are equally close.
LIGHT_VIEWS = {200: ("160x90", 62), 1000: ("72x40", 30.3), 10000: ("24x14", 10.3)}
COUNTED_LIGHTS = 32


def light_view(count):
    size, field = LIGHT_VIEWS[count]
    return "--samples", "4", "--size", size, "--set", f"camera.field_of_view={field}"


COMPARED = {"headline": (), "default": ("--samples", "1"), "official": ("--samples", "2"), "lights-1000": light_view(1000)}


class Speed(Bench):
    """Rows of speed. `rates` and `counts` are results of kernel_rates, or the reason why there are none; `film` that of
    film.alone, for CPU devices or not."""
    name = "speed"
    about = "Measure every target of speed on every device."
    quick = "few frames and repeats; large pictures on CPUs are smaller, and their times scaled"
    parts = ("headline_film", "headline", "fullhd", "official", "pairs", "searches", "share", "pocl", "math", "pipelines",
             "stage", "model")
    chart_files = ("timeline",)
    keys = ("kernel_rates", "counted", "film", "timeline", "scenes", "peaks", "few_cores")

    def prepare(self):
        files = [file for place in ("scenes", "bench/scenes") for file in sorted((ROOT / place).glob("*.json"))]
        self.plan.scenes = {**{file.stem: file for file in files}, **{
            f"lights-{count}": write_lights(self.arguments.out, count) for count in (4, *LIGHT_VIEWS)}}
        self.result["few_cores"] = min(CORES, machine.cores())
        usable = sorted(os.sched_getaffinity(0))
        self.plan.cores = set(usable[:CORES]) if len(usable) > CORES else None
        self.rates = self.counts = None
        self.film = {}
        for name in self.arguments.parts:
            getattr(self, name)()

    def job(self, device, scene, frames, *options, few_cores=False, **named):
        """Returns a job. `few_cores` is for targets of two cores; it changes nothing on a machine with no more."""
        if few_cores and self.plan.cores:
            named["few_cores"] = True
        return self.plan.job(device, scene, frames, options, **named)

    def gpus(self):
        return [label for label, device in self.runnable.items() if not device["is_cpu"]]

    def cpu(self, backend):
        return next((label for label, device in self.runnable.items()
                     if device["backend"] == backend and device["is_cpu"]), None)

    def demand_c(self, *row):
        """Returns the CPU with the C backend, or None after adding a row that says so."""
        if not self.cpu("c"):
            self.plan.absent(*row, "the C backend is left out")
        return self.cpu("c")

    # ---- frames

    def headline_film(self):
        what, target = "headline, frames going to an mp4", Target(12, 30)
        device = self.demand_c("headline_film", what, "frames/s", target)
        if device:
            jobs = [self.job(device, "headline", f"0-{count}", output="film.mp4", few_cores=True)
                    for count in self.film_lengths()]
            self.plan.row("headline_film", what, "frames/s",
                          lambda: [1 / seconds for seconds in self.plan.seconds_a_frame(*jobs)], device=device, target=target,
                          note="steady state, from two lengths of the run")

    def film_lengths(self):
        return (3, 15) if self.arguments.quick else (7, 55)

    def tracing(self, key, scene, what, options, target_gpu, target_cpu=None, frames="0-4", unit="ms", fewer=None):
        """Adds a row for each device. `fewer` are options for CPUs in a quick run, and the factor of their times."""
        for label, device in self.runnable.items():
            note, scale, added, once = None, 1e-3 if unit == "s" else 1, (), {}
            slow = device["is_cpu"] and fewer is not None
            if slow and self.arguments.quick:
                added, factor = fewer
                scale, note = scale * factor, f"SCALED: {factor} times the time with {' '.join(added)}"
            elif slow:
                once = {"slow": True}
            target = target_gpu if is_h200(device) else target_cpu if label == self.cpu("c") else None
            job = self.job(label, scene, "0,1" if slow else frames, *options, *added,
                           few_cores=target is not None and device["is_cpu"], **once)
            self.plan.row(key, what, unit, lambda job=job, scale=scale: [scale * ms for ms in self.plan.trace_ms(job)],
                          device=label, target=target, note=note)
        if target_gpu is not None and not any(map(is_h200, self.runnable.values())):
            self.plan.absent(key, what, unit, target_gpu, f"no {H200} here")

    def headline(self):
        self.tracing("headline", "headline", "headline, tracing only", (), Target(1, 0.4, False),
                     frames="0-4" if self.arguments.quick else "0-9")

    def fullhd(self):
        fewer = ("--size", "480x270", "--samples", "2"), 64
        self.tracing("fullhd", "fullhd", "fullhd, depth 6, tracing only", (), Target(20, 8, False), fewer=fewer)
        self.tracing("fullhd_8", "fullhd", "fullhd, depth 8, tracing only", ("--depth", "8"), None, fewer=fewer)

    def official(self):
        self.tracing("official", "official", "official, one frame", (), Target(0.8, 0.2, False),
                     Target(90, 30, False), unit="s", frames="0-2", fewer=(("--samples", "4"), 16))

    # ---- rates of the hot loops

    def pairs(self):
        """Adds rows of whole runs, by the processor's time, so that a busy machine changes little."""
        what, target = "unculled (point, light) pairs a CPU-second", Target(200, 500)
        device = self.demand_c("pairs", what, "M/s", target)
        for count in LIGHT_VIEWS if device else ():
            job = self.job(device, f"lights-{count}", "0,80,160", *light_view(count))
            self.plan.row("pairs", f"{what}, {count} lights", "M/s", lambda job=job: [
                1e-6 * sum(frame["shadow_tests"] for frame in run["frames"]) / run["cpu"] for run in self.plan.done(job)],
                device=device, target=target, note="whole runs, by the processor's time")

    def searches(self):
        what, target = "closest-hit searches a CPU-second, coherent", Target(80, 150)
        device = self.demand_c("searches", what, "M/s", target)
        if not device:
            return

        def row(words, name, **named):
            def figure():
                if name not in known(self.rates)["rates"]:
                    raise Missing(f"the view has no {name}")
                return [1e-6 * value for value in self.rates["rates"][name]]
            self.plan.row("searches", words, "M/s", figure, device=device, **named)
        row(f"{what}, packets that meet a solid", "search:meeting", target=target,
            note="the function alone; the target is for AVX-512")
        for count in LIGHT_VIEWS:
            row(f"  direct light alone, {count} lights, pairs a CPU-second", f"light:lights-{count}")

    def counted(self, name):
        if name not in known(self.counts)["counted"]:
            raise Missing("the system does not allow stepping through a process, so nothing was counted")
        return self.counts["counted"][name]

    def cpu_share(self, name, key):
        """Returns the loop's rates in per cent of the arithmetic peak of the same run: all of its independent chains' vector
        instructions, as if they were fused multiply-adds."""
        each = self.counted(name)[f"{key}_each"] / (self.counts["lanes"] * 2 if key == "operations" else 1)
        return [100 * each * rate / peak for rate, peak in zip(self.counts["rates"][name], kernel_rates.peaks(self.counts))]

    def gpu_share(self, job, key):
        devices = self.plan.devices
        lanes = lane_rate(devices[job["device"]], list(devices.values()))
        if lanes is None:
            raise Missing("the architecture's lanes are not known")
        search = self.counted("search_one_lane:meeting")[f"{key}_each"]
        pair = self.counted(f"light_one_lane:lights-{COUNTED_LIGHTS}")[f"{key}_each"]
        most = lanes * (2 if key == "operations" else 1)
        return self.plan.each_frame(job, lambda frame: 100 * (search * sum(frame["rays"].values()) + pair * frame["shadow_tests"])
                                    / (most * frame["seconds"]["trace"]))

    def share(self):
        target, device = Target(40, 70), self.cpu("c")
        for name, loop in (("search:meeting", "search"), (f"light:lights-{COUNTED_LIGHTS}", "direct light")):
            for key, what, goal in (("operations", "share of the arithmetic peak", target),
                                    ("slots", "  share of the vector issue slots", None)):
                if device is not None:
                    self.plan.row("share", f"{what}, {loop}", "%", lambda name=name, key=key: self.cpu_share(name, key),
                                  device=device, target=goal, note="operations counted in the machine code, of the same packets")
        for label in self.gpus():
            for scene in ("default", "lights-1000"):
                job = self.job(label, scene, "0-3")
                for key, what, goal in (("operations", "share of the arithmetic peak", target),
                                        ("slots", "  share of the issue slots", None)):
                    self.plan.row("share", f"{what}, both loops, {scene}", "%", lambda job=job, key=key: self.gpu_share(job, key),
                                  device=label, target=goal, note="an estimate: operations of one lane, counted on a CPU")

    # ---- one against the other

    def against(self, key, what, label, base, target, more=(), base_more=()):
        """Adds a row for each scene: one device against another, or more options against the device alone."""
        for scene, options in COMPARED.items():
            job, other = self.job(label, scene, "0-3", *options, *more), self.job(base, scene, "0-3", *options, *base_more)
            self.plan.row(key, f"{what}, {scene}", "times", lambda job=job, other=other: self.plan.ratios(job, other),
                          device=label, target=target)

    def pocl(self):
        target, plain, pocl = Target(1.25, 1, False), self.cpu("c"), self.cpu("opencl")
        what = "time on OpenCL's CPU against C"
        if plain is None or pocl is None:
            self.plan.absent("pocl", what, "times", target, "one of the two is not here")
        else:
            self.against("pocl", what, pocl, plain, target)

    def math(self):
        for label in (label for label, device in self.runnable.items() if device["backend"] != "c"):  # the device has one
            self.against("math", "time of strict against fast arithmetic", label, label, Target(1.15, 1.02, False),
                         base_more=("--math", "fast"))

    def pipelines(self):
        for label in self.runnable:
            self.against("pipelines", "time of wavefront against mega", label, label, None, ("--pipeline", "wavefront"),
                         ("--pipeline", "mega"))

    # ---- whole runs

    def stage(self):
        """Adds a run, frame by frame in steady state, against its slowest stage alone: tracing without pictures to encode, or
        encoding without tracing."""
        for label in [device for device in (self.cpu("c"), *self.gpus()) if device]:
            counts, is_cpu = self.film_lengths(), self.runnable[label]["is_cpu"]
            trace = self.job(label, "headline", f"0-{counts[0]}", few_cores=is_cpu)
            for kind, output in (("PNG", "#######.png"), ("film", "film.mp4")):
                lengths = [self.job(label, "headline", f"0-{count}", output=output, few_cores=is_cpu) for count in counts]
                alone = [self.job(label, "headline", str(number), output=output, few_cores=is_cpu)  # nothing else is running
                         for number in (0, 5) if kind == "PNG"]

                def figure(lengths=lengths, trace=trace, alone=alone, is_cpu=is_cpu):
                    tracing = median(self.plan.trace_ms(trace)) / 1e3
                    encoding = median(seconds for job in alone for seconds in self.plan.each_frame(
                        job, lambda frame: frame["seconds"]["convert"] + frame["seconds"]["store"])
                        ) if alone else known(self.film.get(is_cpu))[0]
                    return [seconds / max(tracing, encoding) for seconds in self.plan.seconds_a_frame(*lengths)]
                self.plan.row("stage", f"a run of {kind} against its slowest stage alone, headline", "times", figure,
                              device=label, target=Target(1.2, 1.05, False))

    # ---- for the model of other GPUs

    def model(self):
        for label in self.gpus():
            for scene in self.plan.scenes:
                job = self.job(label, scene, "0-2", *MODEL_OPTIONS, slow=True)
                self.plan.row("model", f"{scene}, as it stands", "ms", lambda job=job: self.plan.trace_ms(job), device=label)

    # ---- running

    def measure_loops(self, what, scenes, counts=False):
        seconds, rounds = (0.1, 3) if self.arguments.quick else (0.5, 5)
        return self.tried(what, kernel_rates.run, self.program, [self.plan.scenes["default"], *scenes], seconds, rounds,
                          counts=counts)

    def measure_timeline(self):
        label = self.cpu("c") or next(iter(self.runnable))
        self.news("timeline")
        run = self.program.render(self.plan.devices[label], None, f"0-{5 if self.arguments.quick else 23}",
                                  self.arguments.options, self.folder, output="film.mp4")
        self.result["timeline"] = {"device": label, "reason": run["message"]}
        if run["code"] == 0:
            self.result["scene"].update({key: run["frames"][0][key] for key in ("width", "height", "samples", "depth")})
            try:
                self.result["timeline"] = {"device": label, **timeline.measure(run["frames"])}
            except Missing as missing:
                self.result["timeline"]["reason"] = str(missing)

    def measure(self):
        if self.wants("searches"):
            self.rates = self.measure_loops("rates of the hot loops",
                                            [self.plan.scenes[f"lights-{count}"] for count in LIGHT_VIEWS])
        if self.wants("share"):
            self.counts = self.measure_loops("counting the operations of the hot loops",
                                             [write_lights(self.arguments.out, COUNTED_LIGHTS)], True)
        for is_cpu in {each["is_cpu"] for each in self.runnable.values()} if self.wants("stage", "headline_film") else ():
            self.news("FFmpeg alone")
            self.film[is_cpu] = film.alone(self.plan, self.plan.devices[self.cpu("c") or next(iter(self.runnable))],
                                           self.plan.scenes["headline"], self.film_lengths(), self.plan.cores if is_cpu else None)
        if self.runnable:
            self.measure_timeline()
        self.plan.run_all(self.arguments.repeats)

    def fill(self):
        for key, found in (("kernel_rates", self.rates), ("counted", self.counts)):
            self.result[key] = {"reason": found} if isinstance(found, str) else found
        settings = next((found[1] for found in self.film.values() if isinstance(found, tuple)), None)
        for row in self.plan.rows:
            if row["key"] == "headline_film" and settings:
                row["note"] += f"; x264 preset {settings['preset']}, crf {settings['crf']}"
        self.result.update(film=settings, scenes={name: facts(file) for name, file in self.plan.scenes.items()}, peaks={
            device["label"]: lane_rate(device, self.result["devices"]) for device in self.result["devices"]
            if device["is_cpu"] is False})

    def tables(self):
        found = self.result["timeline"]
        if found and "stages" not in found:
            return [("Stages of a run", [], [f"None: {found['reason']}."])]
        return [timeline.table(found)] if found else []

    def charts(self):
        return {"timeline": timeline.chart(self.result)} if "stages" in (self.result["timeline"] or {}) else {}


BENCH = Speed
