# SPDX-License-Identifier: MIT
"""The rows of bench/study speed: what is run for each, and how its figure follows."""
from statistics import median

from harness.measure.rows import Missing, Target, known
from harness.run.devices import lane_rate
from harness.triangles.primary import H200, is_h200

MODEL_OPTIONS = ["--set", "camera.frames=5"]  # of the runs that the rows of the model make
# Views that give a like number of pairs: the middle of one picture, always as fine as the whole of it
# in 640 x 360 with one sample, so that the rays of a bundle are as near to each other.
LIGHT_VIEWS = {200: ("160x90", 62), 1000: ("72x40", 30.3), 10000: ("24x14", 10.3)}
COUNTED_LIGHTS = 32
PIPELINES = ("mega", "wavefront")


def light_view(count):
    size, field = LIGHT_VIEWS[count]
    return "--samples", "4", "--size", size, "--set", f"camera.field_of_view={field}"


class Rows:
    """`rates` and `counts` are filled with what kernel_rates gives, or with the reason why there is none; `film` with what
    film.alone gives, for CPU devices or not."""

    def __init__(self, plan, runnable, quick, extra):
        self.plan, self.runnable, self.quick, self.extra = plan, runnable, quick, tuple(extra)
        self.rates = self.counts = None
        self.film = {}

    def job(self, device, scene, frames, *options, few_cores=False, **named):
        """`few_cores` is for targets of two cores, and nothing on a machine that has no more."""
        if few_cores and self.plan.cores:
            named["few_cores"] = True
        return self.plan.job(device, scene, frames, (*options, *self.extra), **named)

    def gpus(self):
        return [label for label, device in self.runnable.items() if not device["is_cpu"]]

    def cpu(self, backend):
        return next((label for label, device in self.runnable.items()
                     if device["backend"] == backend and device["is_cpu"]), None)

    # ---- frames

    def headline_film(self):
        what, target = "headline, frames going to an mp4", Target(12, 30)
        device = self.cpu("c")
        if device is None:
            return self.plan.absent("headline_film", what, "frames/s", target, "the C backend is left out")
        short, long = [self.job(device, "headline", f"0-{count}", output="film.mp4", few_cores=True)
                       for count in self.film_lengths()]

        def figure():
            return [1 / seconds for seconds in self.plan.seconds_a_frame(short, long)]
        return self.plan.row("headline_film", what, "frames/s", figure, device=device, target=target,
                             note="steady state, from two lengths of the run")

    def film_lengths(self):
        return (3, 15) if self.quick else (7, 55)

    def tracing(self, key, scene, what, options, target_gpu, target_cpu=None, frames="0-4", unit="ms", fewer=None):
        """A row for each device. `fewer` are options for CPUs in a quick run, and by what that has less
        to do."""
        for label, device in self.runnable.items():
            note, scale, added, slow = None, 1e-3 if unit == "s" else 1, (), device["is_cpu"] and fewer is not None
            if slow and self.quick:
                added, factor = fewer
                scale, note = scale * factor, f"SCALED: {factor} times the time with {' '.join(added)}"
            target = target_gpu if is_h200(device) else target_cpu if label == self.cpu("c") else None
            once = {"slow": True} if slow and not self.quick else {}
            job = self.job(label, scene, "0,1" if slow else frames, *options, *added,
                           few_cores=target is not None and device["is_cpu"], **once)
            self.plan.row(key, what, unit, lambda job=job, scale=scale: [scale * ms for ms in self.plan.trace_ms(job)],
                          device=label, target=target, note=note)
        if target_gpu is not None and not any(is_h200(device) for device in self.runnable.values()):
            self.plan.absent(key, what, unit, target_gpu, f"no {H200} here")

    def headline(self):
        self.tracing("headline", "headline", "headline, tracing only", (), Target(1, 0.4, False),
                     frames="0-4" if self.quick else "0-9")

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
            return self.plan.absent("pairs", what, "M/s", target, "the C backend is left out")
        for count in LIGHT_VIEWS:
            job = self.job(device, f"lights-{count}", "0,80,160", *light_view(count))

            def figure(job=job):
                return [1e-6 * sum(frame["shadow_tests"] for frame in run["frames"]) / run["cpu"]
                        for run in self.plan.done(job)]
            self.plan.row("pairs", f"{what}, {count} lights", "M/s", figure, device=device, target=target,
                          note="whole runs, by the processor's time")
        return None

    def rate(self, name):
        if name not in known(self.rates)["rates"]:
            raise Missing(f"the view has no {name}")
        return [1e-6 * value for value in self.rates["rates"][name]]

    def searches(self):
        device, what, target = self.cpu("c"), "closest-hit searches a CPU-second, coherent", Target(80, 150)
        if device is None:
            return self.plan.absent("searches", what, "M/s", target, "the C backend is left out")
        self.plan.row("searches", f"{what}, bundles that meet a solid", "M/s", lambda: self.rate("search:meeting"),
                      device=device, target=target, note="the function alone; the target is for AVX-512")
        for name in ("primary", "missing", "mirrored", "inside", "solid_1", "solid_2", "solid_3"):
            self.plan.row("searches", f"  {name.replace('_', ' ')}", "M/s", lambda name=name: self.rate(f"search:{name}"),
                          device=device)
        for count in LIGHT_VIEWS:
            self.plan.row("searches", f"  direct light alone, {count} lights, pairs a CPU-second", "M/s",
                          lambda count=count: self.rate(f"light:lights-{count}"), device=device)
        return None

    def counted(self, name):
        if name not in known(self.counts)["counted"]:
            raise Missing("the system lets no process be stepped through, so nothing was counted")
        return self.counts["counted"][name]

    def cpu_share(self, name, key, per_instruction):
        """Of the vector instructions that the machine was seen to do in independent chains of them in the
        same run, were they fused multiply-adds."""
        each = self.counted(name)[f"{key}_each"]
        peaks = [max(both) for both in zip(self.counts["rates"]["peak:fma"], self.counts["rates"]["peak:mul_add"])]
        return [100 * each * rate / (peak * per_instruction) for rate, peak in zip(self.counts["rates"][name], peaks)]

    def gpu_share(self, job, device, per_instruction):
        lanes = lane_rate(device, list(self.plan.devices.values()))
        if lanes is None:
            raise Missing("the architecture's lanes are not known")
        key = "operations" if per_instruction == 2 else "slots"
        search = self.counted("search_one_lane:meeting")[f"{key}_each"]
        pair = self.counted(f"light_one_lane:lights-{COUNTED_LIGHTS}")[f"{key}_each"]
        return self.plan.each_frame(job, lambda frame: 100 * (search * sum(frame["rays"].values())
                                                               + pair * frame["shadow_tests"])
                                    / (lanes * per_instruction * frame["seconds"]["trace"]))

    def share(self):
        target, device = Target(40, 70), self.cpu("c")
        for name, loop in (("search:meeting", "search"), (f"light:lights-{COUNTED_LIGHTS}", "direct light")):
            for key, what, per_instruction, goal in (("operations", "share of the arithmetic peak", "lanes", target),
                                                     ("slots", "  share of the vector issue slots", 1, None)):
                def figure(name=name, key=key, per_instruction=per_instruction):
                    self.counted(name)
                    each = self.counts["lanes"] * 2 if per_instruction == "lanes" else 1
                    return self.cpu_share(name, key, each)
                if device is not None:
                    self.plan.row("share", f"{what}, {loop}", "%", figure, device=device, target=goal,
                                  note="operations counted in the machine code, on the same bundles")
        for label in self.gpus():
            for scene in ("default", "lights-1000"):
                job = self.job(label, scene, "0-3")
                for per_instruction, what, goal in ((2, "share of the arithmetic peak", target),
                                                    (1, "  share of the issue slots", None)):
                    self.plan.row("share", f"{what}, both loops, {scene}", "%",
                                  lambda job=job, label=label, each=per_instruction:
                                  self.gpu_share(job, self.plan.devices[label], each), device=label, target=goal,
                                  note="an estimate: operations of one lane, counted on a CPU")

    # ---- one against the other

    def against(self, key, what, device, scene, frames, options, base, base_options, target, note=None):
        job, other = self.job(device, scene, frames, *options), self.job(base, scene, frames, *base_options)
        self.plan.row(key, what, "times", lambda: self.plan.ratios(job, other), device=device, target=target, note=note)

    def compared_scenes(self):
        return {"headline": (), "default": ("--samples", "1"), "official": ("--samples", "2"),
                "lights-1000": light_view(1000)}

    def pocl(self):
        target, plain, pocl = Target(1.25, 1, False), self.cpu("c"), self.cpu("opencl")
        what = "time on OpenCL's CPU against C"
        if plain is None or pocl is None:
            return self.plan.absent("pocl", what, "times", target, "one of the two is not here")
        for scene, options in self.compared_scenes().items():
            self.against("pocl", f"{what}, {scene}", pocl, scene, "0-3", options, plain, options, target)
        return None

    def math(self):
        for label in self.runnable:
            for scene, options in self.compared_scenes().items():
                self.against("math", f"time of strict against fast arithmetic, {scene}", label, scene, "0-3", options,
                             label, (*options, "--math", "fast"), Target(1.15, 1.02, False))

    def pipelines(self):
        what = "time of wavefront against mega"
        for label in self.runnable:
            for scene, options in self.compared_scenes().items():
                mega, wave = [(*options, "--pipeline", name) for name in PIPELINES]
                self.against("pipelines", f"{what}, {scene}", label, scene, "0-3", wave, label, mega, None)

    # ---- whole runs

    def stage(self):
        """A run, frame by frame in steady state, against its slowest stage alone: tracing without
        pictures to encode, or encoding without tracing."""
        target = Target(1.2, 1.05, False)
        for label in [device for device in (self.cpu("c"), *self.gpus()) if device]:
            counts, is_cpu = self.film_lengths(), self.runnable[label]["is_cpu"]
            trace = self.job(label, "headline", f"0-{counts[0]}", few_cores=is_cpu)
            for kind, output in (("PNG", "#######.png"), ("film", "film.mp4")):
                short, long = [self.job(label, "headline", f"0-{count}", output=output, few_cores=is_cpu)
                               for count in counts]
                alone = [self.job(label, "headline", str(number), output=output, few_cores=is_cpu)
                         for number in (0, 5) if kind == "PNG"]

                def store(kind=kind, alone=alone, is_cpu=is_cpu):
                    return self.film_seconds(is_cpu) if kind == "film" else self.png_seconds(alone)

                def figure(short=short, long=long, trace=trace, store=store):
                    tracing = median(self.plan.trace_ms(trace)) / 1e3
                    slowest = max(tracing, store())
                    return [seconds / slowest for seconds in self.plan.seconds_a_frame(short, long)]
                self.plan.row("stage", f"a run of {kind} against its slowest stage alone, headline", "times", figure,
                              device=label, target=target)

    def png_seconds(self, jobs):
        """For one frame; of runs of one frame, in which nothing else is at work."""
        return median(value for job in jobs for value in
                      self.plan.each_frame(job, lambda frame: frame["seconds"]["convert"] + frame["seconds"]["store"]))

    def film_seconds(self, is_cpu):
        return known(self.film.get(is_cpu))[0]

    # ---- for the model of other GPUs

    def model(self):
        for label in self.gpus():
            for scene in self.plan.scenes:
                job = self.job(label, scene, "0-2", *MODEL_OPTIONS, slow=True)
                self.plan.row("model", f"{scene}, as it stands", "ms", lambda job=job: self.plan.trace_ms(job),
                              device=label)


ROWS = ("headline_film", "headline", "fullhd", "official", "pairs", "searches", "share", "pocl", "math", "pipelines",
        "stage", "model")
