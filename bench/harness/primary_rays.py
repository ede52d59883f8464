# SPDX-License-Identifier: MIT
"""Primary rays alone, of an object that fills the picture, by the time of whole frames."""
from harness import triangle_models
from harness.speed_plan import Target
from harness.speed_rows import H200, is_h200

TARGETS = {1000: Target(5, 20), 1000000: Target(2, 8)}
FEWER = ("--size", "480x270")  # for CPUs


def scene_name(count):
    return f"near-{count}"


class PrimaryRays:
    def __init__(self, plan, runnable, options):
        self.plan, self.runnable = plan, runnable
        self.jobs = {(label, count): plan.job(label, scene_name(count), "0-3", (
            *(FEWER if device["is_cpu"] else ()), "--accel", "bvh", *options))
            for label, device in runnable.items() for count in TARGETS if scene_name(count) in plan.scenes}

    def rates(self, job):
        return self.plan.each_frame(job, lambda frame: 1e-9 * frame["rays"]["primary"] / frame["seconds"]["trace"])

    def what(self, count):
        return f"primary rays of whole frames, {triangle_models.words(count)} triangles"

    def add_rows(self):
        for (label, count), job in self.jobs.items():
            device = self.runnable[label]
            self.plan.row("primary", self.what(count), "G/s", lambda job=job: self.rates(job), device=label,
                          target=TARGETS[count] if is_h200(device) else None,
                          note=f"on CPUs {FEWER[1]} instead of 1920x1080" if device["is_cpu"] else None)
        if not any(is_h200(device) for device in self.runnable.values()):
            for count, target in TARGETS.items():
                self.plan.absent("primary", self.what(count), "G/s", target, f"no {H200} here")
