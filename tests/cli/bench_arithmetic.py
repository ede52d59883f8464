# SPDX-License-Identifier: MIT
"""Tests the figures of bench/ on made-up numbers. Its arguments are the project's folder and hedron; it runs in an empty
folder. Every function test_... is a test."""
import math
import re
import struct
import sys
import traceback
from pathlib import Path
from types import SimpleNamespace as Some

PROJECT, HEDRON = map(Path, sys.argv[1:])
sys.path.insert(0, str(PROJECT / "bench"))

from harness.accuracy.front import cheapest, front, ratios, time_at  # noqa: E402
from harness.accuracy.truth import SAMPLE_ERROR  # noqa: E402
from harness.measure.jobs import job, summarize  # noqa: E402
from harness.measure.plan import Plan  # noqa: E402
from harness.measure.rows import NONE, Target, judge  # noqa: E402
from harness.measurements import compare  # noqa: E402
from harness.run import pfm  # noqa: E402
from harness.run.program import Program  # noqa: E402
from harness.stability import methods  # noqa: E402
from harness.triangles import leaks  # noqa: E402


def same(found, expected):
    assert found == expected, f"{found!r}, expected {expected!r}"


# ---- rows, rounds and pictures

def test_verdicts_of_targets():
    for target, value, expected in ((Target(12, 30), 24, (2.0, 0.8, "least")), (Target(20, 5, False), 5, (4.0, 1.0, "aim")),
                                    (Target(20, 40), 10, (0.5, 0.25, "missed")), (NONE, 0, (None, None, "aim")),
                                    (NONE, 1, (None, None, "missed"))):
        same(judge(target, value), expected)


def test_disturbed_runs_are_done_again_and_the_least_disturbed_counts():
    for noise, repeats, points, runs, expected in (
            ([0], 2, 1, [[[0, 0], []]], [(1500, False)]),
            ([0, 0.5, 0, 0], 2, 2, [[[0, 0], []], [[0, 0], [0.5]]], [(2500, False), (4000, False)]),
            ([0.5, 0.3, 0.4], 8, 1, [[[0.3, *[0] * 7], [0.5, 0.4]]], [(7000, False)]),  # no more than twice again
            # A disturbed run does not count beside one that was not; half as many again are enough.
            ([0.5, 0, 0, 0.5, 0.6, 0.7], 2, 2, [[[0, 0.5], [0.5, 0.7]], [[0, 0.6], []]], [(3000, False), (2000, False)]),
            ([0.5] * 99, 2, 2, [[[0.5, 0.5], [0.5]], [[0.5, 0.5], [0.5]]], [(3000, True), (4000, True)])):
        made, saved = [], []

        def render(*_, **__):
            others = noise[len(made)] if len(made) < len(noise) else 0
            made.append(others)
            return {"code": 0, "message": "", "wall": 1, "cpu": 1, "load": 0, "others": others, "noisy": others > 0.1, "digests": {},
                    "frames": [{"frame": 0, "seconds": {"prepare": 0, "trace": len(made), "copy": 0}, "renderer": "x"}]}
        plan = Plan({"c:0": {"strict": True}}, {"s": None}, Some(render=render), None, lambda *_: None, lambda: saved.append(1))
        entries = plan.jobs = [job("c:0", "s", "0", part="lights", x=x) for x in range(points)]
        same(plan.run_all(repeats), True)
        same(len(saved), len(made))
        same([[[run["others"] for run in each[key]] for key in ("runs", "rejected")] for each in entries], runs)
        summarize(entries)
        same([(each["summary"]["trace_ms"]["median"], each["summary"]["noisy"]) for each in entries], expected)


def test_pictures_of_one_promise_are_compared():
    for expected, *jobs in (
            ((True, 1), ("c:0", "", "a"), ("opencl:0", "", "a")), ((False, 1), ("c:0", "", "a"), ("opencl:0", "", "b")),
            ((None, 0), ("c:0", "", "a"), ("c:0", "--samples 2", "b")), ((None, 0), ("c:0", "", "a"), ("c:0", "--math fast", "b")),
            ((False, 1), ("c:0", "--pipeline mega", "a"), ("c:0", "--pipeline wavefront --threads 2", "b")),
            ((False, 1), ("c:0", "--accel bvh", "a"), ("c:0", "--accel brute", "b"))):
        plan = Plan({"c:0": {"strict": True}, "opencl:0": {"strict": True}}, {})
        for device, options, picture in jobs:
            plan.job(device, "s", "0", options.split())["runs"].append({"frames": [{"frame": 0, "picture": picture}]})
        found = plan.compared()
        same((found["same"], found["compared"]), expected)


def test_comparison_of_two_studies():
    """Compares two studies: a tenth more is beyond the noise of quiet ones; 2 % are no difference; two equal runs are no proof
    of quiet."""
    def measured(*all_runs):
        entries = [job("c:0", "s", "0", part="lights", x=x) for x in range(len(all_runs))]
        for entry, times in zip(entries, all_runs):
            entry["runs"] = [{"noisy": False, "frames": [{"warm_up": False, "seconds": {"prepare": 0, "trace": ms, "copy": 0}}]}
                             for ms in times]
        summarize(entries)
        return {entry["x"]: entry for entry in entries}
    quiet, wild = [100, 100.5, 101, 99.5, 99], [50, 100, 150, 60, 140]
    old, new = measured(*[quiet] * 3, wild), measured([1.1 * each for each in quiet], [0.9 * each for each in quiet],
                                                      [1.02 * each for each in quiet], [1.1 * each for each in wild])
    same([(each["entry"]["x"], each["verdict"]) for each in compare.compare(old, new)],
         [(0, "slower"), (3, compare.SAME), (2, compare.SAME), (1, "faster")])
    same(round(compare.compare(old, new)[0]["limit"], 6), 0.03)
    few = measured([100, 100], [100, 120], [100, 80], [100, 110])
    assert all(each["verdict"] == compare.SAME for each in compare.compare(few, {**few, **measured([110, 110])}))


# ---- accuracy

def test_fronts_and_times_at_equal_error():
    def made(*pairs):
        return [{"name": f"{ms}", "ms": ms, "rmse": error} for ms, error in pairs]
    some = made((100, 1), (1, 100), (2, 100), (50, 200), (10, 30), (10, 10))
    same([each["ms"] for each in front(some)], [1, 10, 100])
    same([time_at(some, "rmse", error) for error in (200, 100, 10, 1, 0.5)], [1, 1, 10.0, 100.0, None])
    same(round(time_at(some, "rmse", 10 ** 0.5), 3), 31.623)  # a straight line of the logarithms
    same([round(ratio, 4) for _, ratio in ratios(some, made((1000, 0.5), (500, 10 ** 0.5), (20, 200), (30, 300)))], [0.05, 0.0632])
    same([cheapest(some, 30)["ms"], cheapest(some, 0.1), ratios([], some)], [10, None, []])


def test_pictures_are_read_and_compared():
    def write(name, numbers, order="<"):
        head = b"PF\n2 1\n%s1.0\n" % (b"-" if order == "<" else b"")
        Path(name).write_bytes(head + struct.pack(f"{order}6f", *numbers))
        return pfm.read(name)
    step = 1 / 255 / 12.92  # of the straight part of the curve
    one = write("a.pfm", [0, 0, 0, 0.5, 2, 0.25])
    same((one, one[:2]), (write("b.pfm", [0, 0, 0, 0.5, 2, 0.25], ">"), (2, 1)))
    same([pfm.near_pixels(one, write("b.pfm", [0.99 * step, 0, 0, 0.5, 9, 0.25])),
          pfm.near_pixels(one, write("b.pfm", [0, 0, 1.01 * step, 0.5, 9, 0.25]))], [2, 1])
    odd = write("odd.pfm", [0, math.nan, math.inf, 1, 1, -math.inf])
    same((pfm.odd_numbers(one), pfm.odd_numbers(odd), pfm.near_pixels(one, odd), pfm.not_finite("odd.pfm")), (0, 2, 0, 3))
    program = Program(HEDRON)
    same(pfm.errors(program, "a.pfm", "b.pfm")["above_1"], 0.5)
    # The error that the reference's samples leave is that of their unit test.
    stated = (PROJECT / "tests/unit/scene/test_sample_pattern.c").read_text(encoding="utf-8")
    assert f"#define REFERENCE_SAMPLE_ERROR {SAMPLE_ERROR}\n" in stated


# ---- stability

def test_a_failure_of_hedrons_methods_is_a_failure():
    def counts(wrong, lost, blocked):
        return methods.parse(
            f"crossings edges pluecker 1 0 tried=9 missed=5 twice=5 wrong=8 misplaced=0\n"
            f"crossings edges ours_solids 1 0 tried=9 missed={wrong} twice=0 wrong={wrong} misplaced=0\n"
            f"paths inside ours_triangles 1 0 tried=9 completed={9 - lost} followed=5 tried_far=2 followed_far=1\n"
            f"shadows face_lights ours_double 1 0 tried=9 blocked=9 tried_shut=3 opened=0 nan=0\n"
            f"shadows edge_lights ours_double 1 0 tried=9 blocked={blocked} tried_shut=3 opened=0 nan=0\n"
            f"crossings t_junctions ours_triangles 1 0 tried=9 missed=1 twice=1 wrong=2 misplaced=0\n"
            f"shadows face_lights ours 1 0 tried=9 blocked={blocked} tried_shut=3 opened=0 nan=0\n")
    good = counts(0, 0, 0)
    same((methods.failures(good), methods.share(methods.select(good, "crossings", method="pluecker"), "crossings"),
          methods.tally(methods.select(good, "paths"), "paths"),
          methods.tally(methods.select(good, "shadows", method="ours_double"), "shadows")), ([], 8 / 9, (4, 9), (9, 24)))
    same(methods.failures(counts(1, 2, 3)), [
        "crossings, edges, hedron's half-spaces: 1 missed of 9", "paths, inside, hedron's triangles: 2 lost of 9",
        "shadows, face_lights, hedron: 3 blocked of 9", "shadows, edge_lights, hedron in double: 3 blocked of 9"])


# ---- triangles

def test_any_leak_is_a_failure():
    def total(holes, doubles):
        return leaks.parse(f"c float, a CPU\n  in all   9 rays, 9 leaks, 9 double hits\ntotal of 16 renderers:\n"
                           f"               2386960 rays, {holes} leaks, {doubles} double hits\n")
    plan = Plan({}, {})
    leaks.add_rows(plan, {"c": total(0, 0), "opencl": total(2, 1), "cuda": "no driver"})
    same([(row["figure"], row["verdict"], row["reason"]) for row in plan.finished()],
         [(0.0, "aim", None), (3.0, "missed", None), (None, None, "no driver")])
    same((sorted(plan.failures), leaks.parse("c float, a CPU\n")), (["opencl: 2 leaks and 1 double hits"], None))


# ---- the harness

def test_each_folder_takes_from_those_before_it_only():
    """Checks the imports against the order of bench/README.md."""
    bench = PROJECT / "bench"
    table = (bench / "README.md").read_text(encoding="utf-8").partition("| folder | what |")[2].partition("\n\n")[0]
    places = re.findall(r"`(\w+)`", "\n".join(line.split("|")[1] for line in table.splitlines()[2:]))
    files = sorted((bench / "harness").rglob("*.py"))
    same(sorted(places), sorted({file.parent.name for file in files}))
    same([(str(file), folder) for file in files
          for folder in re.findall(r"^from harness\.(\w+)", file.read_text(encoding="utf-8"), re.M)
          if places.index(folder) > places.index(file.parent.name)], [])


failed = False
for name, test in list(globals().items()):
    if name.startswith("test_"):
        try:
            test()
        except Exception:
            traceback.print_exc()
            failed = True
sys.exit(failed)
