# SPDX-License-Identifier: MIT
"""The rows of bench/study speed: what is run for each, and how its figure follows."""
from statistics import median

from harness.measure.kernel_rates import peaks
from harness.measure.rows import Missing, Target, known
from harness.run.devices import H200, is_h200, lane_rate

MODEL_OPTIONS = ["--set", "camera.frames=5"]  # of the runs that the rows of the model make
# Views that give a like number of pairs: the middle of one picture, always as fine as the whole of it
# in 640 x 360 with one sample, so that the rays of a bundle are as near to each other.
LIGHT_VIEWS = {200: ("160x90", 62), 1000: ("72x40", 30.3), 10000: ("24x14", 10.3)}
COUNTED_LIGHTS = 32
NO_C = "the C backend is left out"


def light_view(count):
    size, field = LIGHT_VIEWS[count]
    return "--samples", "4", "--size", size, "--set", f"camera.field_of_view={field}"


COMPARED = {"headline": (), "default": ("--samples", "1"), "official": ("--samples", "2"), "lights-1000": light_view(1000)}


class Rows:
    """`rates` and `counts` are filled with what kernel_rates gives, or with the reason why there is none; `film` with what
    film.alone gives, for CPU devices or not."""

    def __init__(self, plan):
        self.plan, self.row, self.absent = plan, plan.row, plan.absent
        self.rates = self.counts = None
        self.film = {}

    def job(self, device, scene, frames, *options, few_cores=False, **named):
        """`few_cores` is for targets of two cores, and nothing on a machine that has no more."""
        if few_cores and self.plan.cores:
            named["few_cores"] = True
        return self.plan.job(device, scene, frames, options, **named)

    def gpus(self):
        return [label for label, device in self.plan.runnable.items() if not device["is_cpu"]]

    def cpu(self, backend):
        return next((label for label, device in self.plan.runnable.items()
                     if device["backend"] == backend and device["is_cpu"]), None)

    # ---- frames

    def headline_film(self):
        what, target, device = "headline, frames going to an mp4", Target(12, 30), self.cpu("c")
        if device is None:
            self.absent("headline_film", what, "frames/s", target, NO_C)
            return
        short, long = [self.job(device, "headline", f"0-{count}", output="film.mp4", few_cores=True)
                       for count in self.film_lengths()]
        self.row("headline_film", what, "frames/s", lambda: [1 / seconds for seconds in self.plan.seconds_a_frame(short, long)],
                 device=device, target=target, note="steady state, from two lengths of the run")

    def film_lengths(self):
        return (3, 15) if self.plan.quick else (7, 55)

    def tracing(self, key, scene, what, options, target_gpu, target_cpu=None, frames="0-4", unit="ms", fewer=None):
        """A row for each device. `fewer` are options for CPUs in a quick run, and by what that has less to do."""
        for label, device in self.plan.runnable.items():
            note, scale, added, slow = None, 1e-3 if unit == "s" else 1, (), device["is_cpu"] and fewer is not None
            if slow and self.plan.quick:
                added, factor = fewer
                scale, note = scale * factor, f"SCALED: {factor} times the time with {' '.join(added)}"
            target = target_gpu if is_h200(device) else target_cpu if label == self.cpu("c") else None
            once = {"slow": True} if slow and not self.plan.quick else {}
            job = self.job(label, scene, "0,1" if slow else frames, *options, *added,
                           few_cores=target is not None and device["is_cpu"], **once)
            self.row(key, what, unit, lambda job=job, scale=scale: [scale * ms for ms in self.plan.trace_ms(job)],
                     device=label, target=target, note=note)
        if target_gpu is not None and not any(map(is_h200, self.plan.runnable.values())):
            self.absent(key, what, unit, target_gpu, f"no {H200} here")

    def headline(self):
        self.tracing("headline", "headline", "headline, tracing only", (), Target(1, 0.4, False),
                     frames="0-4" if self.plan.quick else "0-9")

    def fullhd(self):
        fewer = ("--size", "480x270", "--samples", "2"), 64
        self.tracing("fullhd", "fullhd", "fullhd, depth 6, tracing only", (), Target(20, 8, False), fewer=fewer)
        self.tracing("fullhd_8", "fullhd", "fullhd, depth 8, tracing only", ("--depth", "8"), None, fewer=fewer)

    def official(self):
        self.tracing("official", "official", "official, one frame", (), Target(0.8, 0.2, False),
                     Target(90, 30, False), unit="s", frames="0-2", fewer=(("--samples", "4"), 16))

    # ---- rates of the hot loops

    def pairs(self):
        """Of whole runs, by the processor's time, so that a busy machine changes little."""
        device, what, target = self.cpu("c"), "unculled (point, light) pairs a CPU-second", Target(200, 500)
        if device is None:
            self.absent("pairs", what, "M/s", target, NO_C)
            return
        for count in LIGHT_VIEWS:
            job = self.job(device, f"lights-{count}", "0,80,160", *light_view(count))
            self.row("pairs", f"{what}, {count} lights", "M/s", lambda job=job: [
                1e-6 * sum(frame["shadow_tests"] for frame in run["frames"]) / run["cpu"] for run in self.plan.done(job)],
                device=device, target=target, note="whole runs, by the processor's time")

    def rate(self, name):
        if name not in known(self.rates)["rates"]:
            raise Missing(f"the view has no {name}")
        return [1e-6 * value for value in self.rates["rates"][name]]

    def searches(self):
        device, what, target = self.cpu("c"), "closest-hit searches a CPU-second, coherent", Target(80, 150)
        if device is None:
            self.absent("searches", what, "M/s", target, NO_C)
            return
        self.row("searches", f"{what}, bundles that meet a solid", "M/s", lambda: self.rate("search:meeting"),
                 device=device, target=target, note="the function alone; the target is for AVX-512")
        others = {f"  {name.replace('_', ' ')}": f"search:{name}"
                  for name in ("primary", "missing", "mirrored", "inside", "solid_1", "solid_2", "solid_3")}
        others |= {f"  direct light alone, {count} lights, pairs a CPU-second": f"light:lights-{count}" for count in LIGHT_VIEWS}
        for words, name in others.items():
            self.row("searches", words, "M/s", lambda name=name: self.rate(name), device=device)

    def counted(self, name):
        if name not in known(self.counts)["counted"]:
            raise Missing("the system lets no process be stepped through, so nothing was counted")
        return self.counts["counted"][name]

    def cpu_share(self, name, key):
        """Of the vector instructions that the machine was seen to do in independent chains of them in the
        same run, were they fused multiply-adds."""
        each = self.counted(name)[f"{key}_each"] / (self.counts["lanes"] * 2 if key == "operations" else 1)
        return [100 * each * rate / peak for rate, peak in zip(self.counts["rates"][name], peaks(self.counts))]

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
                    self.row("share", f"{what}, {loop}", "%", lambda name=name, key=key: self.cpu_share(name, key), device=device,
                             target=goal, note="operations counted in the machine code, on the same bundles")
        for label in self.gpus():
            for scene in ("default", "lights-1000"):
                job = self.job(label, scene, "0-3")
                for key, what, goal in (("operations", "share of the arithmetic peak", target),
                                        ("slots", "  share of the issue slots", None)):
                    self.row("share", f"{what}, both loops, {scene}", "%", lambda job=job, key=key: self.gpu_share(job, key),
                             device=label, target=goal, note="an estimate: operations of one lane, counted on a CPU")

    # ---- one against the other

    def against(self, key, what, label, base, target, more=(), base_more=()):
        """A row for each scene: one device by another, or with more options by itself with others."""
        for scene, options in COMPARED.items():
            job, other = self.job(label, scene, "0-3", *options, *more), self.job(base, scene, "0-3", *options, *base_more)
            self.row(key, f"{what}, {scene}", "times", lambda job=job, other=other: self.plan.ratios(job, other), device=label,
                     target=target)

    def pocl(self):
        target, plain, pocl = Target(1.25, 1, False), self.cpu("c"), self.cpu("opencl")
        what = "time on OpenCL's CPU against C"
        if plain is None or pocl is None:
            self.absent("pocl", what, "times", target, "one of the two is not here")
        else:
            self.against("pocl", what, pocl, plain, target)

    def math(self):
        for label in self.plan.runnable:
            self.against("math", "time of strict against fast arithmetic", label, label, Target(1.15, 1.02, False),
                         base_more=("--math", "fast"))

    def pipelines(self):
        for label in self.plan.runnable:
            self.against("pipelines", "time of wavefront against mega", label, label, None, ("--pipeline", "wavefront"),
                         ("--pipeline", "mega"))

    # ---- whole runs

    def stage(self):
        """A run, frame by frame in steady state, against its slowest stage alone: tracing without
        pictures to encode, or encoding without tracing."""
        for label in [device for device in (self.cpu("c"), *self.gpus()) if device]:
            counts, is_cpu = self.film_lengths(), self.plan.runnable[label]["is_cpu"]
            trace = self.job(label, "headline", f"0-{counts[0]}", few_cores=is_cpu)
            for kind, output in (("PNG", "#######.png"), ("film", "film.mp4")):
                lengths = [self.job(label, "headline", f"0-{count}", output=output, few_cores=is_cpu) for count in counts]
                alone = [self.job(label, "headline", str(number), output=output, few_cores=is_cpu)
                         for number in (0, 5) if kind == "PNG"]

                def figure(lengths=lengths, trace=trace, alone=alone, is_cpu=is_cpu):
                    tracing = median(self.plan.trace_ms(trace)) / 1e3
                    slowest = max(tracing, self.png_seconds(alone) if alone else known(self.film.get(is_cpu))[0])
                    return [seconds / slowest for seconds in self.plan.seconds_a_frame(*lengths)]
                self.row("stage", f"a run of {kind} against its slowest stage alone, headline", "times", figure,
                         device=label, target=Target(1.2, 1.05, False))

    def png_seconds(self, jobs):
        """For one frame; of runs of one frame, in which nothing else is at work."""
        return median(value for job in jobs for value in
                      self.plan.each_frame(job, lambda frame: frame["seconds"]["convert"] + frame["seconds"]["store"]))

    # ---- for the model of other GPUs

    def model(self):
        for label in self.gpus():
            for scene in self.plan.scenes:
                job = self.job(label, scene, "0-2", *MODEL_OPTIONS, slow=True)
                self.row("model", f"{scene}, as it stands", "ms", lambda job=job: self.plan.trace_ms(job), device=label)


ROWS = ("headline_film", "headline", "fullhd", "official", "pairs", "searches", "share", "pocl", "math", "pipelines",
        "stage", "model")
