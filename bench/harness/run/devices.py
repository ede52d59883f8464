# SPDX-License-Identifier: MIT
"""The devices that hedron finds: the requested ones, and their arithmetic peak."""
import re

from harness.run.program import Problem

# Float lanes of a multiprocessor, by compute capability (CUDA C++ Programming Guide, throughput of arithmetic instructions).
LANES = {50: 128, 52: 128, 53: 128, 60: 64, 61: 128, 62: 128, 70: 64, 72: 64, 75: 64, 80: 64, 86: 128, 87: 128,
         89: 128, 90: 128, 100: 128, 103: 128, 120: 128}
H200 = "H200"  # the GPU that targets are for; an H100 has the same multiprocessors


def is_h200(device):
    return not device["is_cpu"] and (H200 in device["name"] or "H100" in device["name"])


def label(device):
    """Returns the device's name on the command line."""
    return device["backend"] if device["index"] is None else f"{device['backend']}:{device['index']}"


def entry(backend, device):
    """Returns the device's entry; of a backend without a device only the reason."""
    known = {"backend": backend["name"], "index": device.get("index"), "name": device.get("name"),
             "driver": device.get("driver"), "strict": device.get("not_strict") is None if device else None,
             "reason": device["unusable"] if device else backend["reason"] or "it has no device",
             **{key: device.get(key) for key in ("is_cpu", "compute_units", "clock_mhz", "has_double")}}
    return {"label": label(known), **known}


def chosen(backends, selections):
    """Returns the requested devices, or all."""
    found = [entry(backend, device) for backend in backends for device in backend["devices"] or [{}]]
    if not selections:
        return found
    picked = []
    for selection in selections:
        name, colon, number = selection.partition(":")
        names = [backend["name"] for backend in backends]
        if name not in names or (colon and not number.isdecimal()):
            raise Problem(2, f"--device is '{selection}', expected BACKEND or BACKEND:NUMBER with one of the backends "
                             f"{', '.join(names)}")
        matches = [each for each in found if each["backend"] == name
                   and (not colon or each["index"] is None or each["index"] == int(number))]
        if not matches:
            raise Problem(3, f"--device is '{selection}', which 'hedron devices' does not list")
        picked += [each for each in matches if each not in picked]
    return picked


def judge(devices):
    """Returns the device that renders references: a GPU if there is one; every strict one makes the same bytes. None: no
    strict device has double precision."""
    able = [device for device in devices if device["strict"] and device["has_double"]]
    return min(able, key=lambda device: (device["is_cpu"] is not False, device["backend"] != "c"), default=None)


# ---- the arithmetic peak

def architecture(device, devices):
    """Returns 60 for sm_60; an OpenCL device has that of the CUDA device of its name. None: unknown."""
    for each in [device, *[other for other in devices if other["name"] == device["name"]]]:
        found = re.search(r"sm_(\d+)", each["driver"] or "")
        if found:
            return int(found[1])
    return None


def lane_rate(device, devices):
    """Returns the float instructions of a GPU a second, one lane each; None if unknown."""
    lanes = LANES.get(architecture(device, devices))
    if lanes is None or not device["compute_units"] or not device["clock_mhz"]:
        return None
    return device["compute_units"] * lanes * device["clock_mhz"] * 1e6
