# SPDX-License-Identifier: MIT
"""The arithmetic peak of a GPU, from its architecture."""
import re

# Float lanes of a multiprocessor, by compute capability (CUDA C++ Programming Guide, throughput of
# arithmetic instructions).
LANES = {50: 128, 52: 128, 53: 128, 60: 64, 61: 128, 62: 128, 70: 64, 72: 64, 75: 64, 80: 64, 86: 128, 87: 128,
         89: 128, 90: 128, 100: 128, 103: 128, 120: 128}


def architecture(device, devices):
    """60 for sm_60; an OpenCL device has that of the CUDA device of its name. None: not known."""
    for each in [device, *[other for other in devices if other["name"] == device["name"]]]:
        found = re.search(r"sm_(\d+)", each["driver"] or "")
        if found:
            return int(found[1])
    return None


def lane_rate(device, devices):
    """Float instructions a second, one lane each; None where it is not known."""
    lanes = LANES.get(architecture(device, devices))
    if lanes is None or not device["compute_units"] or not device["clock_mhz"]:
        return None
    return device["compute_units"] * lanes * device["clock_mhz"] * 1e6
