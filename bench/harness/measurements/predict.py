# SPDX-License-Identifier: MIT
"""Predicts the frame times of a GTX 1050 from those of a GPU that bench/study speed wrote.

The time of a frame is the sum of a fixed time and of work in proportion to the device's lanes times clock:

    t = fixed + (a rays x planes + b rays x lights + c shadow tests) / lane rate

The coefficients, none of them negative, are fitted on every other scene by least squares of the relative
error. The scenes in between show the error. The model has no caches and no ratio of integer to float lanes. It
excludes meshes, and pictures of so few samples that a GPU only waits for the deepest tree of rays."""
import math
from pathlib import Path
from statistics import median

from harness.command.options import Command
from harness.measure.jobs import counted_frames
from harness.measure.numbers import number, rays
from harness.measure.plan import OFFICIAL
from harness.page import tables
from harness.run.program import Problem
from harness.measurements.official import GPU, REPORT
from harness.measurements.speed import MODEL_OPTIONS
from harness.store.result import read

TERMS = ("fixed", "rays x planes", "rays x lights", "shadow tests")
LEAST_SAMPLES = 1 << 17  # counts of a frame
BYTES_A_PIXEL = 12 + 4  # bytes a pixel: written as floats, and read once more as a picture
GTX_1050 = {"name": "GTX 1050", "lane_rate": 5 * 128 * 1.455e9, "bytes_a_second": 112e9,
            "slowest": 1.354 / 1.455, "fastest": 1.5 / 1.455}
# Student's t for 90 % of the values, two-sided, by degrees of freedom.
STUDENT = {1: 6.31, 2: 2.92, 3: 2.35, 4: 2.13, 5: 2.02, 6: 1.94, 7: 1.89, 8: 1.86, 9: 1.83, 10: 1.81, 12: 1.78,
           15: 1.75, 20: 1.72, 30: 1.70}
HEAD = ["scene", "use", "measured ms", "model ms", "error", f"{GTX_1050['name']} ms", "90 % of"]


def features(point):
    return [1.0, point["rays"] * point["planes"], point["rays"] * point["lights"], point["shadow_tests"]]


def dot(one, other):
    return sum(a * b for a, b in zip(one, other))


def non_negative_fit(rows, wanted, rounds=20000):
    """Returns the coefficients, none below zero, that minimise the sum of squares of rows x coefficients - wanted; by
    coordinate descent on scaled columns."""
    scale = [math.hypot(*column) or 1.0 for column in zip(*rows)]
    columns = [[value / each for value in column] for column, each in zip(zip(*rows), scale)]
    products = [[dot(one, other) for other in columns] for one in columns]
    target = [dot(column, wanted) for column in columns]
    found = [0.0] * len(columns)
    for _ in range(rounds):
        for i, row in enumerate(products):
            if row[i] > 0:
                found[i] = max(0.0, found[i] + (target[i] - dot(row, found)) / row[i])
    return [value / each for value, each in zip(found, scale)]


def predict(coefficients, point, speed=1.0, bytes_a_second=None):
    """Returns seconds on a device with `speed` times the lane rate."""
    fixed, *work = [coefficient * value for coefficient, value in zip(coefficients, features(point))]
    seconds = fixed + sum(work) / speed
    return seconds if bytes_a_second is None else max(seconds, point["pixels"] * BYTES_A_PIXEL / bytes_a_second)


def points_of(result, device):
    """Returns a point for each scene that was run unchanged."""
    points = []
    for job in sorted(result["measurements"], key=lambda job: job["scene"]):
        frames = counted_frames(job)
        if (job["device"], job["options"]) == (device, MODEL_OPTIONS) and job["output"].endswith(".data") and frames:
            points.append({"scene": job["scene"], **result["scenes"][job["scene"]], "rays": median(map(rays, frames)),
                           "seconds": median(frame["seconds"]["trace"] for frame in frames),
                           "shadow_tests": median(frame["shadow_tests"] for frame in frames),
                           "pixels": frames[0]["width"] * frames[0]["height"], "samples": frames[0]["rays"]["primary"]})
    return [point for point in points if point["seconds"] > 0 and not point.get("meshes") and point["samples"] >= LEAST_SAMPLES]


def choose_device(result, selection):
    peaks = {label: rate for label, rate in (result.get("peaks") or {}).items() if rate}
    label = selection or next(iter(peaks), None)
    if label not in peaks:
        raise Problem(3, "the file has no GPU whose lanes are known" if selection is None else
                      f"--device is '{selection}', expected one of {', '.join(peaks) or 'none'}")
    return label, peaks[label]


def evaluate(points):
    """Returns {"coefficients", "errors": of the scenes left out, as ln(measured / predicted), "spread"}."""
    if len(points) < 2 * len(TERMS):
        raise Problem(3, f"the file has {len(points)} scenes for the model, expected at least {2 * len(TERMS)}: "
                         "bench/study speed makes them on a GPU")
    ordered = sorted(points, key=lambda point: point["seconds"])
    fitted, checked = ordered[0::2], ordered[1::2]
    # Each point counts by its relative error.
    coefficients = non_negative_fit([[value / point["seconds"] for value in features(point)] for point in fitted],
                                    [1.0] * len(fitted))
    errors = {point["scene"]: math.log(point["seconds"] / predict(coefficients, point)) for point in checked}
    mean_square = sum(error ** 2 for error in errors.values()) / len(errors)
    student = STUDENT[max(each for each in STUDENT if each <= len(errors))]
    return {"coefficients": coefficients, "errors": errors,
            "spread": student * math.sqrt(mean_square * (1 + 1 / len(errors)))}


def table(points, model, lane_rate, target):
    """Returns [{"scene", "measured", "predicted", "error", "target", "low", "high"}], in seconds."""
    speed = target["lane_rate"] / lane_rate
    rows = []
    for point in points:
        usual, fastest, slowest = [predict(model["coefficients"], point, speed * factor, target["bytes_a_second"])
                                   for factor in (1, target["fastest"], target["slowest"])]
        rows.append({"scene": point["scene"], "measured": point["seconds"],
                     "predicted": predict(model["coefficients"], point), "error": model["errors"].get(point["scene"]),
                     "target": usual, "low": fastest * math.exp(-model["spread"]), "high": slowest * math.exp(model["spread"])})
    return rows


def cells(row):
    ms = [number(1e3 * row[key], 3) for key in ("measured", "predicted", "target", "low", "high")]
    error = "" if row["error"] is None else f"{100 * (math.exp(row['error']) - 1):+.0f} %"
    return [row["scene"], "fitted" if row["error"] is None else "checked", *ms[:2], error, ms[2], f"{ms[3]}..{ms[4]}"]


def beside_report(row):
    """Returns a sentence: the model's time of the official example, and its range, beside the time of the report's program."""
    report = REPORT[GPU] / 1e3
    usual, low, high = [number(row[key] / report, 2) for key in ("target", "low", "high")]
    slower = row["low"] > report, row["target"] > report, row["high"] > report
    verdict = {(True, True, True): "hedron is slower there than the report's program, over the whole range",
               (False, True, True): "hedron is likely slower there than the report's program; the range has both",
               (False, False, True): "hedron is likely faster there than the report's program; the range has both",
               (False, False, False): "hedron is faster there than the report's program, over the whole range"}[slower]
    return (f"{OFFICIAL}: the report's program took {number(1e3 * report, 3)} ms on its {GTX_1050['name']}, and the model predicts "
            f"{usual} times that, {low} to {high}: {verdict}")


class Predict(Command):
    name = "predict"
    about = "Predict the frame times of a GTX 1050 from those of another GPU."

    def add_options(self, parser):
        parser.add_argument("file", type=Path, metavar="speed.json", help="result of bench/study speed on a machine with a GPU")
        parser.add_argument("--device", metavar="BACKEND:NUMBER", help="GPU whose times the prediction uses (default: the first)")

    def run(self, arguments):
        result = read(arguments.file, "speed")
        device, lane_rate = choose_device(result, arguments.device)
        points = points_of(result, device)
        model = evaluate(points)
        name = next(each["name"] for each in result["devices"] if each["label"] == device)
        errors = [abs(math.exp(error) - 1) for error in model["errors"].values()]
        factors = [f"{coefficient:.3g} {term}" for coefficient, term in zip(model["coefficients"], TERMS)]
        rows = table(points, model, lane_rate, GTX_1050)
        print(f"From {device}, {name}: seconds = {' + '.join(factors)}",
              f"{len(points) - len(errors)} scenes fitted; error of the {len(errors)} others: median "
              f"{100 * median(errors):.0f} %, greatest {100 * max(errors):.0f} %", "",
              *tables.lines([HEAD, *map(cells, rows)]), *(beside_report(row) for row in rows if row["scene"] == OFFICIAL), sep="\n")
        return 0


BENCH = Predict
