# SPDX-License-Identifier: MIT
"""A lower bound of the official example's frame time: its shadow tests alone, at the arithmetic peak; charts mark it. The
operations of one test are counted in the machine code, as bench/study speed does. Those of a GPU are an estimate, counted in
the CPU's code of one lane."""
from statistics import mean, median

from harness.measure import jobs, kernel_rates
from harness.measure.plan import OFFICIAL
from harness.page.section import Part
from harness.run.devices import lane_rate
from harness.run.program import ROOT

SECONDS, ROUNDS = 0.1, 3
LIMIT = 120  # seconds; a few are usual
NAME = "bound: its shadow tests at the arithmetic peak"
PER_LANE = 2  # operations of a fused multiply-add
LANES, ONE_LANE = f"light:{OFFICIAL}", f"light_one_lane:{OFFICIAL}"


def measure(study):
    """Raises Problem with the reason if it fails."""
    if not study.result["bounds"]:
        study.news("the arithmetic peak")
        scene = ROOT / f"scenes/{OFFICIAL}.json"
        found = kernel_rates.run(study.program, [scene, scene], SECONDS, ROUNDS, counts=True, limit=LIMIT)
        study.result["bounds"] = {
            "instruction_set": found["instruction_set"], "lanes": found["lanes"],
            "instructions_per_core_second": median(kernel_rates.peaks(found)),
            "operations_per_test": found["counted"].get(LANES, {}).get("operations_each"),
            "operations_per_test_one_lane": found["counted"].get(ONE_LANE, {}).get("operations_each")}


def milliseconds(result, device, entry):
    """Returns the bound of the frames that count, scaled as their times are, or None if unknown."""
    bounds = result.get("bounds")
    if not bounds:
        return None
    if device["is_cpu"]:
        rate = bounds["instructions_per_core_second"] * bounds["lanes"] * PER_LANE * result["machine"]["cores"]
        each = bounds["operations_per_test"]
    else:
        rate, each = (lane_rate(device, result["devices"]) or 0) * PER_LANE, bounds["operations_per_test_one_lane"]
    if not rate or not each:
        return None
    tests = mean(frame["shadow_tests"] for run in jobs.chosen_runs(entry) for frame in jobs.counted(run))
    return 1e3 * entry["scale"] * tests * each / rate or None


PART = Part(14, "Bounds", "Marks in the charts of others.", measure=measure)
