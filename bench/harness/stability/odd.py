# SPDX-License-Identifier: MIT
"""Renders odd scenes: each must come to its end or be refused with an error that says why."""
from harness.measure.scenes import write_scene
from harness.run import pfm
from harness.stability import pictures

REFUSED = 2


def outcome(odd, runs):
    """(words, whether it is as it should be)"""
    codes = {run["code"] for run in runs}
    if codes == {0}:
        return "rendered", not odd.refused
    if codes == {REFUSED}:  # the first problem that hedron tells, without the file's name
        first, *others = runs[0]["said"].strip().splitlines()
        words = first.rpartition(".json: ")[2]
        return f"refused: {others[0].strip()} ({words})" if others else f"refused: {words}", odd.refused
    return f"failed: {next(run['message'] for run in runs if run['code'])}", False


class OddScenes:
    """In float and in double, of solids and of triangles."""

    def __init__(self, program, folder, options):
        self.program, self.folder, self.options = program, folder, options
        self.truths = {}  # pictures in double, by scene and geometry
        self.entries = []

    def render(self, scene, geometry, kind):
        file = write_scene(scene, self.folder / "odd.json")
        return pictures.render(self.program, file, "0", ("--geometry", geometry, *pictures.KINDS[kind], *self.options),
                               self.folder)

    def near_beside(self, odd, geometry, picture):
        """Pixels like those with the odd thing a hair to the one or the other side; None: it has none."""
        beside = [self.render(scene, geometry, "double")["pictures"] for scene in odd.beside]
        if not beside or not picture or not all(beside):
            return None
        return pfm.near_pixels(picture[0], *(each[0] for each in beside))

    def run(self, odd):
        for geometry in pictures.GEOMETRIES:
            runs = [self.render(odd.scene, geometry, kind) for kind in ("double", "float")]
            truth = self.truths.setdefault((odd.name, geometry), runs[0])
            if odd.like:
                truth = self.truths[odd.like, geometry]
            words, good = outcome(odd, runs)
            self.entries.append({"scene": odd.name, "geometry": geometry, "outcome": words, "as_it_should": good,
                                 "like": odd.like, "nan": pictures.odd_numbers(runs), "clamps": runs[1]["clamps"],
                                 **pictures.compare(runs[1], truth),
                                 "beside_near": self.near_beside(odd, geometry, runs[1]["pictures"]),
                                 "double_near": pictures.compare(runs[0], truth)["near"] if odd.like else None})


def failures(entries):
    wrong = [(each, each["outcome"]) for each in entries if not each["as_it_should"]]
    wrong += [(each, f"{each['nan']} pixels are no numbers") for each in entries if each["nan"]]
    return [f"{each['scene']}, {each['geometry']}: {words}" for each, words in wrong]
