# SPDX-License-Identifier: MIT
"""The CUDA programs of bench/cuda_studies: compiling, running, and the tables and charts of what they say."""
import json
import shutil
from pathlib import Path

from harness.chart.rows import Row, one_value, rows
from harness.measure.numbers import number
from harness.run.program import ROOT, Problem, run_tool

SOURCES = ROOT / "bench/cuda_studies"
FLAGS = ("-O3", "-std=c++17", "--fmad=false", "-DHD_LANES=1", "-DHD_DOUBLE=0")
SUMS = {"float_pixels": "float, each pixel a sum", "fixed_pixels": "fixed point, each pixel a sum",
        "float_samples": "float, each sample a sum", "fixed_samples": "fixed point, each sample a sum"}
NO_GPU = 3  # an exit code
LOOKUPS = {"none": "coordinates alone", "own": "the kernels' own", "hardware_8_bits": "texture unit, 8 bits",
           "hardware_16_bits": "texture unit, 16 bits", "hardware_floats": "texture unit, floats"}


def find_nvcc():
    found = shutil.which("nvcc") or shutil.which("nvcc", path="/usr/local/cuda/bin")
    return found and Path(found)


def run(name, program, folder, *words):
    """What the study prints; compiled for the GPU that is here. Raises Problem with the reason where none can be used."""
    cuda = next((backend for backend in program.backends() if backend["name"] == "cuda"), None)
    if cuda is None or not cuda["devices"]:
        raise Problem(3, (cuda and cuda["reason"]) or "there is no NVIDIA GPU")
    if all(device["unusable"] for device in cuda["devices"]):
        raise Problem(3, cuda["devices"][0]["unusable"])
    if find_nvcc() is None:
        raise Problem(3, "there is no nvcc, in PATH or in /usr/local/cuda/bin")
    study = Path(folder, name)
    run_tool(find_nvcc(), "-arch=native", *FLAGS, "-o", study, SOURCES / f"{name}.cu")
    done = run_tool(study, *(word() if callable(word) else word for word in words), accepted=(0, NO_GPU))
    if done.returncode == NO_GPU:
        raise Problem(3, f"{name}: {done.stderr.strip()}")
    try:
        return json.loads(done.stdout)
    except ValueError as error:
        raise Problem(1, f"{name} prints what is no JSON") from error


# ---- adding up

SUM_HEAD = ["sums", "ms", "ns each", "runs differ by 1/255: max", "rms", "ulps: max", "rms", "bytes that differ",
            "error 1/255: max"]


def sum_cells(found, name):
    each = found[name]
    units, ulps = each["runs_differ_by_255ths"], each["runs_differ_by_ulps"]
    return [SUMS[name], number(each["ms"]), number(each["ns_each"], 3), f"{units['max']:.3g}",
            f"{units['rms']:.3g}", f"{ulps['max']:g}", f"{ulps['rms']:.3g}",
            f"{each['runs_differ_by_bytes']['differing']:.3g}", f"{each['error_255ths']['max']:.3g}"]


def sum_chart(result):
    found = result["image_sums"]
    worst = found["float_pixels"]["runs_differ_by_255ths"]
    caption = (f"{found['device']}. What {found['contributions']:,} rays add to the headline picture, a launch for each "
               f"of {found['levels']} levels. {found['runs']} runs of float atomics differ by up to {worst['max']:.3g} "
               "of 1/255, those of fixed point by nothing." if fixed_is_exact(found) else "RUNS OF FIXED POINT DIFFER.")
    return rows(result, "Adding up the picture", caption, "nanoseconds for each ray", [
        Row(name, one_value(found[key]["ns_each"]), f"{number(found[key]['ns_each'], 3)} ns, {number(found[key]['ms'], 3)} ms",
            place) for place, (key, name) in enumerate(SUMS.items())])


def fixed_is_exact(found):
    return all(found[name]["runs_differ_by_ulps"]["max"] == 0 for name in ("fixed_pixels", "fixed_samples"))


# ---- looking up

LOOKUP_HEAD = ["lookup", "coherent ns", "random ns", "noise, 1/255: max", "rms", "smooth, 1/255: max", "rms"]


def lookup_cells(found, name):
    each = found[name]
    errors = [f"{each[f'error_{kind}'][key]:.3g}" for kind in ("noise", "smooth") for key in ("max", "rms")
              if f"error_{kind}" in each]
    return [LOOKUPS[name], *(number(each[key], 3) for key in ("coherent_ns", "random_ns")), *errors,
            *["-"] * (4 - len(errors))]


def lookup_chart(result):
    found = result["texture_lookups"]
    caption = (f"{found['device']}. Bilinear lookups in {found['side']} x {found['side']} texels. Of noise, the worst "
               f"case, the kernels' own is wrong by up to {found['own']['error_noise']['max']:.3g} of 1/255, the texture "
               f"unit with floats by {found['hardware_floats']['error_noise']['max']:.3g}, with 8 bits by "
               f"{found['hardware_8_bits']['error_noise']['max']:.3g}.")
    return rows(result, "Texture lookups", caption, "nanoseconds for each lookup, the whole GPU at work", [
        Row(name, one_value(found[key][f"{kind}_ns"]), f"{number(found[key][f'{kind}_ns'], 3)} ns", place,
            group=kind)
        for kind in ("coherent", "random") for place, (key, name) in enumerate(LOOKUPS.items())])
