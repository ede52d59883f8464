# SPDX-License-Identifier: MIT
"""The reference for other pictures' errors, and its own error."""
from harness.run import pfm
from harness.run.program import Problem, digest

# Error of 32 x 32 dense samples on an edge between black and white, in steps of 255: tests/unit/render/test_samples.c.
SAMPLE_ERROR, SAMPLE_SIDE = 2.2, 32
SIDE_QUICKLY = 16
# Truncation errors of the reference, in steps of 255: the first affordable one counts, or the last.
LIMITS = ("0.015625", "0.25", "2")
SECONDS, SECONDS_QUICKLY = 150, 12
PART = 16  # divisor of the picture's rows: the middle ones predict the time of the whole


def own_error(facts):
    """Returns the RMSE of the reference itself, by its distance to a picture of a quarter of the samples. Four times
    as many samples leave a third of the error (tests/unit/render/test_samples.c), and both errors are independent."""
    return facts["to_quarter_of_samples"]["rmse"] / 10 ** 0.5


def render(plan, device, scene, options, file):
    """Renders frame 0 as a PFM and returns its statistics."""
    done = plan.program.render(device, scene, "0", (*options, *plan.options), file.parent, output=str(file))
    if done["code"] != 0:
        raise Problem(done["code"], done["message"])
    return done["frames"][0]


class Truth:
    """Renders a reference. `file` has the picture after `make`, `facts` describes it. The scene is one of the plan's."""

    def __init__(self, plan, device, scene, size, file):
        self.plan, self.device, self.scene, self.size, self.file = plan, device, plan.scenes[scene], size, file
        self.side = SIDE_QUICKLY if plan.quick else SAMPLE_SIDE
        self.facts = None

    def is_made(self, facts):
        """Returns whether the file belongs to these facts; if so, takes them."""
        self.facts = facts if facts and self.file.is_file() and digest(self.file) == facts["sha256"] else None
        return self.facts is not None

    def render(self, side, limit, file, *more):
        return render(self.plan, self.device, self.scene, ("--reference", "--samples", str(side), "--max-error", limit,
                                                     "--size", f"{self.size[0]}x{self.size[1]}", *more), file)

    def limit(self):
        """Returns the affordable truncation error, by the time of the middle rows, which take longer than the others."""
        width, height = self.size
        rows = max(1, height // PART)
        for limit in LIMITS[:-1]:
            frame = self.render(self.side, limit, self.plan.folder / "estimate.pfm", "--crop",
                                f"{width}x{rows}+0+{(height - rows) // 2}")
            seconds = frame["seconds"]["trace"] * height / rows
            self.plan.news(f"the reference with --max-error {limit} takes some {seconds:.0f} s")
            if seconds <= (SECONDS_QUICKLY if self.plan.quick else SECONDS):
                return limit
        return LIMITS[-1]

    def make(self):
        limit, coarse = self.limit(), self.plan.folder / "coarse.pfm"
        self.plan.news(f"the reference, {self.side} x {self.side} samples, --max-error {limit}")
        frame = self.render(self.side, limit, self.file)
        self.plan.news("a second reference of a quarter of the samples")
        self.render(self.side // 2, limit, coarse)
        between = pfm.errors(self.plan.program, coarse, self.file)
        self.facts = {
            "device": self.device["label"], "samples": self.side, "max_error": float(limit),
            "seconds": frame["seconds"]["trace"], "depth": frame["depth"], "missing": frame["missing"],
            "edge_error": SAMPLE_ERROR if self.side == SAMPLE_SIDE else None,
            "to_quarter_of_samples": {key: between[key] for key in ("rmse", "largest")},
            "not_finite": pfm.not_finite(self.file), "sha256": digest(self.file),
        }
