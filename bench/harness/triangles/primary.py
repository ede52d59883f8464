# SPDX-License-Identifier: MIT
"""Primary rays of an object that fills the picture, by the time of whole frames."""
from harness.measure.numbers import count_words
from harness.measure.rows import Target
from harness.run.devices import H200, is_h200

TARGETS = {1000: Target(5, 20), 1000000: Target(2, 8)}
FEWER = ("--size", "480x270")  # options for CPUs


def scene_name(count):
    return f"near-{count}"


def add(plan):
    """Adds jobs of the plan's scenes, and their rows."""
    what = {count: f"primary rays of whole frames, {count_words(count)} triangles" for count in TARGETS}
    for label, device in plan.runnable.items():
        for count in filter(lambda count: scene_name(count) in plan.scenes, TARGETS):
            fewer = FEWER if device["is_cpu"] else ()
            job = plan.job(label, scene_name(count), "0-3", (*fewer, "--accel", "bvh"))
            plan.row("primary", what[count], "G/s", lambda job=job: plan.each_frame(
                job, lambda frame: 1e-9 * frame["rays"]["primary"] / frame["seconds"]["trace"]), device=label,
                target=TARGETS[count] if is_h200(device) else None,
                note=f"on CPUs {FEWER[1]} instead of 1920x1080" if device["is_cpu"] else None)
    if not any(map(is_h200, plan.runnable.values())):
        for count, target in TARGETS.items():
            plan.absent("primary", what[count], "G/s", target, f"no {H200} here")
