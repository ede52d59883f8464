# SPDX-License-Identifier: MIT
"""Checks the bound of --max-error: the stated error of random scenes against a deep truth."""
import json
import math
import random
import subprocess
from statistics import median

from harness.command.bench import Bench
from harness.command.options import whole_number
from harness.measure.numbers import number
from harness.measure.rows import NONE
from harness.page.section import Part
from harness.run import pfm
from harness.run.program import Problem, message_in

CUBE = """v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""
KINDS = ("tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron")
# The truth omits its own truncation; so it shows too little error, never too much.
TRUTHS = ((1000, 1e-5), (1000, 1e-4), (20, 1e-3), (12, 0))
LIMIT, TRUTH_LIMIT = 20, 8  # seconds
ROUNDING = 1e-3  # steps of 255: float radiance
COUNTS = {True: 100, False: 2000}
HEAD = ["scenes", "judged in time", "more missing than stated", "missing / stated, median", "largest"]


class Maker:
    """Makes a random scene, and the options to render it with."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def around(self, reach):
        return self.random.uniform(-reach, reach)

    def power(self, low, high):
        return 10 ** self.random.uniform(low, high)

    def tint(self):
        return self.random.choice(([1, 1, 1], [0, 0, 0], [0.01] * 3, [self.random.random() for _ in range(3)]))

    def shares(self, inner=""):
        share = self.random.random()
        reflection, transmission = self.random.choice(((1, 0), (0, 1), (share, 1 - share), *[
            (share, self.random.random() * (1 - share))] * 4))
        return {f"{inner}reflection": reflection, f"{inner}transmission": transmission}

    def opaque(self):
        choose, one = self.random.choice, self.random.random()
        return {**self.shares(), "transmission": 0, "colour": self.tint(), "mirror_tint": self.tint(), "ambient": choose((0, one)),
                "diffuse": choose((0, one)), "specular": choose((0, one, self.power(0, 3))),
                "shininess": choose((1, 2, 10, 200, 5000))}

    def glass(self):
        material = {**self.opaque(), **self.shares(), "lit_from_behind": self.random.random() < 0.2}
        if self.random.random() < 0.5:
            material.update(self.shares("inner_"))
        if self.random.random() < 0.3:
            material["index_of_refraction"] = self.random.choice((1.5, 10, 0.5, 1.01))
        return material

    def solid(self, brightest):
        solid = {"kind": self.random.choice(KINDS), "centre": [self.around(2), self.around(2), self.around(1)],
                 "circumradius": self.random.uniform(0.4, 1.5), "rotation": [self.around(180) for _ in range(3)],
                 "material": self.random.choice(("one", "other"))}
        if self.random.random() < 0.4:
            solid["rim"] = {"width": 0.05, "material": "frame"}
        if self.random.random() < 0.5:
            solid["edge_lights"] = {"per_edge": self.random.randint(1, 3), "colours": [self.tint()],
                                    "intensity": self.power(-2, brightest - 2), "disc_radius": self.random.uniform(0.01, 0.2),
                                    "disc_radiance": self.power(-1, brightest - 1)}
        return solid

    def scene(self):
        choose, brightest = self.random.choice, self.random.choice((1, 6))
        scene = {
            "hedron": 1, "background": [choose((0, self.random.random()))] * 3,
            "camera": {"field_of_view": choose((30, 60, 100)), "eye": [self.random.uniform(3, 5), self.around(4), 2]},
            "image": {"exposure": choose((1, 1, 1, self.power(-3, 2)))},
            "output": {"curve": choose(("srgb", "linear")), "bits": choose((8, 16))},
            "materials": {"one": self.glass(), "other": self.glass(), "frame": self.opaque(), "ground": self.opaque()},
            "solids": [self.solid(brightest) for _ in range(self.random.randint(1, 4))],
            "lights": [{"position": [self.around(5) for _ in range(3)], "colour": [self.random.random() for _ in range(3)],
                        "intensity": self.power(-1, brightest)} for _ in range(self.random.randint(1, 3))]}
        if self.random.random() < 0.5:
            scene["floor"] = {"corners": [[-6, 6, -1.6], [6, 6, -1.6], [6, -6, -1.6], [-6, -6, -1.6]], "material": "ground"}
        if self.random.random() < 0.3:
            scene["meshes"] = [{"file": "cube.obj", "position": [self.around(2), self.around(2), 1], "rotation": [20, 30, 40],
                                "scale": self.random.uniform(0.3, 1), "material": "one"}]
        return scene

    def bright_in_few_samples(self, samples):
        """Returns a mirror about as large as a sample, bright enough to show in its pixel, that sees something as bright."""
        value, away, view = self.power(-1.5, 0.3) * samples ** 2, self.random.uniform(3, 8), self.random.uniform(1, 20)
        step = 2 * away * math.tan(math.radians(view / 2)) / 3 / samples
        share = self.random.choice((1, 0.9, 0.5))
        mirror = {"reflection": share, "transmission": 1 - share, "specular": 1, "shininess": 1, "mirror_tint": self.tint()}
        return {"hedron": 1, "camera": {"field_of_view": view, "eye": [0, -away, 0]},
                "output": {"curve": self.random.choice(("srgb", "linear"))},
                "materials": {"mirror": mirror, "glow": {"ambient": value * self.power(-2, 1)}},
                "solids": [{"kind": self.random.choice(KINDS[1:]), "circumradius": step * self.random.uniform(0.4, 1.5),
                            "centre": [self.around(step * samples), 0, self.around(step * samples)], "material": "mirror"},
                           {"kind": "cube", "centre": [0, -3 * away, 0], "circumradius": away, "material": "glow"}],
                "lights": [{"position": [0, -away - 0.01, 0], "intensity": value * self.power(-1, 1)}]}

    def make(self):
        """Returns (scene, options of both pictures, options of the bounded one)."""
        choose = self.random.choice
        is_thin, samples = self.random.random() < 0.4, choose((1, 2, 4, 8))
        if is_thin:
            samples *= 4
        scene = self.bright_in_few_samples(samples) if is_thin else self.scene()
        common = ["--samples", samples, "--size", "3x3" if is_thin else choose(("12x9", "10x10")),
                  "--precision", choose(("float", "float", "double"))]
        if not is_thin and self.random.random() < 0.2:
            common += ["--crop", "3x3+2+1"]
        bounded = ["--max-error", f"{self.power(-1.3, 2.2):.6g}"]
        depth, cutoff = choose((None, None, 0, 0, 1, 2, 5, 1000)), choose((None, None, None, 0.01, 0.3))
        bounded += [] if depth is None else ["--depth", depth]
        bounded += [] if cutoff is None else ["--cutoff", cutoff]
        return scene, common, bounded


def displayed(value, curve):
    return pfm.displayed(value) if curve == "srgb" else 255 * min(max(value, 0.0), 1.0)


def render(program, folder, output, options, limit):
    """Renders a picture; returns False if it takes too long."""
    words = ["render", "scene.json", "--quiet", "--backend", "c", "--frames", "0", *map(str, options), "-o", output]
    try:
        done = subprocess.run([program.path, *words], cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              timeout=limit)
    except subprocess.TimeoutExpired:
        return False
    if done.returncode != 0:
        raise Problem(1, f"hedron {' '.join(words)}: {message_in(done.stderr)}")
    return True


def write(program, folder, scene):
    (folder / "cube.obj").write_text(CUBE, encoding="utf-8")
    file = folder / "scene.json"
    file.write_text(json.dumps(scene), encoding="utf-8")
    if subprocess.run([program.path, "check", file], capture_output=True).returncode != 0:
        for material in scene["materials"].values():  # refracting solids overlap
            material.pop("index_of_refraction", None)
        file.write_text(json.dumps(scene), encoding="utf-8")


def try_scene(program, folder, seed, options=()):
    """Returns the stated and the measured error, in steps of 255; None if that took too long."""
    scene, common, bounded = Maker(seed).make()
    common += options
    write(program, folder, scene)
    each = {"seed": seed, "options": [*map(str, [*common, *bounded])], "stated": None, "missed": None}
    if render(program, folder, "bounded.pfm", [*common, *bounded, "--stats", "stats.jsonl"], LIMIT) and any(
            render(program, folder, "truth.pfm", [*common, "--depth", depth, "--cutoff", cutoff], TRUTH_LIMIT)
            for depth, cutoff in TRUTHS):
        curve = scene["output"]["curve"]
        pairs = zip(*(pfm.read(folder / f"{name}.pfm")[2] for name in ("truth", "bounded")))
        each["missed"] = max(displayed(truth, curve) - displayed(value, curve) for truth, value in pairs)
        each["stated"] = json.loads((folder / "stats.jsonl").read_text(encoding="utf-8"))["missing"]["largest"]
    return each


def judged(scenes):
    return [each for each in scenes if each["stated"] is not None]


def failures_of(scenes):
    return [f"--max-error, scene {each['seed']} ({' '.join(each['options'])}): {each['missed']:.4g} steps are missing, "
            f"{each['stated']:.4g} are stated" for each in judged(scenes) if each["missed"] > each["stated"] + ROUNDING]


def rows_of(scenes):
    shares = sorted(each["missed"] / each["stated"] for each in judged(scenes) if each["stated"] > 0)
    return [HEAD, [str(len(scenes)), str(len(judged(scenes))), str(len(failures_of(scenes))),
                   number(median(shares) if shares else None), number(shares[-1] if shares else None, 4)]]


class Promise(Bench):
    name = "promise"
    about = "Search random scenes for one whose error is larger than --max-error states."
    codes = "exit codes: 0 no such scene found, 1 one found or a run failed, 2 wrong usage or input, 130 interrupted"
    quick, repeats = "try 100 scenes", None
    scene = "random scenes"
    keys = ("scenes",)

    def add_options(self, parser):
        super().add_options(parser)
        parser.add_argument("--scenes", type=whole_number, metavar="N", help="number of scenes (default: 2000, with --quick 100)")
        parser.add_argument("--first", type=whole_number, default=1, metavar="SEED", help="seed of the first scene (default: 1)")

    def prepare(self):
        self.result["scenes"] = []

    def measure(self):
        count = self.arguments.scenes or COUNTS[self.arguments.quick]
        for seed in range(self.arguments.first, self.arguments.first + count):
            self.news(f"scene {seed - self.arguments.first + 1} of {count}")
            self.result["scenes"].append(try_scene(self.program, self.folder, seed, self.arguments.options))

    def fill(self):
        failures = failures_of(self.result["scenes"])
        self.plan.failures |= set(failures)
        self.plan.row("promise", "scenes whose error is larger than --max-error states", "scenes", lambda: [len(failures)],
                      target=NONE)

    def compared(self):
        return {"same": None, "sentence": "Pictures were compared with a deep truth."}

    def tables(self):
        return [("What is missing, as a part of what is stated", rows_of(self.result["scenes"]), [])]


BENCH = Promise


# ---- the study's part

def measure(study):
    """Measures what is missing from the result; raises Problem if a run fails."""
    found = study.result["promise"] = study.result.get("promise") or []
    for seed in range(len(found) + 1, COUNTS[study.arguments.quick] + 1):
        study.news(f"promise, scene {seed}")
        found.append(try_scene(study.program, study.folder, seed, study.arguments.options))
        if seed % 100 == 0:
            study.save()


def fill(section):
    """Shows the first machine's result, because all give the same numbers."""
    found = next((result for result in section.results if result.get("promise")), None)
    if found is not None:
        lies = len(failures_of(found["promise"]))
        section.notes.append(f"{lies or 'None'} of {len(judged(found['promise']))} random scenes misses more than --max-error states.")
        section.table = rows_of(found["promise"])


PART = Part(17, "What --max-error promises", "Random scenes with lights of up to a million, total reflection and depths of 0 to 1000. "
            "The error that --max-error states is compared with that against a deep reference.", measure=measure, fill=fill,
            failures=lambda result: failures_of(result.get("promise") or []))
