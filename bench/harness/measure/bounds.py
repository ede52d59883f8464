# SPDX-License-Identifier: MIT
"""What a frame of the official example cannot be faster than: its shadow tests alone, at the arithmetic peak. The
operations of one test are counted in the machine code, as bench/study speed does; those of a GPU are an estimate, for they are
counted in the CPU's code of one lane."""
from statistics import mean, median

from harness.measure import jobs, kernel_rates
from harness.measure.points import OFFICIAL
from harness.run.devices import lane_rate
from harness.run.program import ROOT

SECONDS, ROUNDS = 0.1, 3
LIMIT = 120  # seconds; a few are usual
NAME = "bound: its shadow tests at the arithmetic peak"
PER_LANE = 2  # operations of a fused multiply-add
LANES, ONE_LANE = f"light:{OFFICIAL}", f"light_one_lane:{OFFICIAL}"


def measure(program):
    """What is written as `bounds`. Raises Problem with the reason where it cannot be."""
    scene = ROOT / f"scenes/{OFFICIAL}.json"
    found = kernel_rates.run(program, [scene, scene], SECONDS, ROUNDS, counts=True, limit=LIMIT)
    peaks = [max(both) for both in zip(found["rates"]["peak:fma"], found["rates"]["peak:mul_add"])]
    return {"instruction_set": found["instruction_set"], "lanes": found["lanes"],
            "instructions_per_core_second": median(peaks),
            "operations_per_test": found["counted"].get(LANES, {}).get("operations_each"),
            "operations_per_test_one_lane": found["counted"].get(ONE_LANE, {}).get("operations_each")}


def peak(result, device):
    """(operations a second at most, operations of a test), or None where one of them is not known."""
    bounds = result.get("bounds")
    if not bounds:
        return None
    if device["is_cpu"]:
        rate = bounds["instructions_per_core_second"] * bounds["lanes"] * PER_LANE * result["machine"]["cores"]
        each = bounds["operations_per_test"]
    else:
        lanes = lane_rate(device, result["devices"])
        rate, each = lanes and lanes * PER_LANE, bounds["operations_per_test_one_lane"]
    return (rate, each) if rate and each else None


def milliseconds(result, device, entry):
    """For the frames that count, scaled as their times are; or None."""
    known = peak(result, device)
    if known is None:
        return None
    rate, each = known
    tests = mean(frame["shadow_tests"] for run in jobs.chosen_runs(entry) for frame in jobs.counted(run))
    return 1e3 * entry["scale"] * tests * each / rate or None
