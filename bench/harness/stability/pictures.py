# SPDX-License-Identifier: MIT
"""Pictures of one scene in float and in double; and of odd scenes, which must either finish or be refused with a clear
error."""
from harness.measure.scenes import read_scene, write_scene
from harness.run import pfm
from harness.run.program import Problem

DEVICE = {"backend": "c", "index": 0}
GEOMETRIES = ("solids", "triangles")
PICTURES = "#######.pfm"
KINDS = {"double": ("--precision", "double"), "float": ()}
REFUSED = 2  # an exit code
FLOAT = "float against double"


def render(program, scene, frames, options, folder):
    """Renders frames; returns {"code", "message": None or why there are no pictures, "said", "pictures": {frame: picture},
    "clamps"}."""
    run = program.render(DEVICE, scene, frames, list(options), folder, output=PICTURES, look=lambda place: {
        int(file.stem): pfm.read(file) for file in sorted(place.glob("*.pfm"))})
    failed = run["code"] != 0
    return {"code": run["code"], "message": run["message"] if failed else None, "said": run["said"],
            "pictures": {} if failed else run["seen"],
            "clamps": sum(frame["clamps"] for frame in run["frames"])}


def compare(one, other):
    """Returns {"pixels", "near"} of the frames that both have."""
    frames = one["pictures"].keys() & other["pictures"].keys()
    sizes = [one["pictures"][frame] for frame in frames]
    return {"pixels": sum(width * height for width, height, _ in sizes),
            "near": sum(pfm.near_pixels(one["pictures"][frame], other["pictures"][frame]) for frame in frames)}


def odd_numbers(runs):
    return sum(pfm.odd_numbers(picture) for run in runs for picture in run["pictures"].values())


def study_scene(program, file, options, folder):
    """Returns an entry for each geometry and comparison, of the first frame and the middle one."""
    entries, name = [], file.stem
    count = read_scene(file)["camera"].get("frames", 1)
    frames = "0" if count < 2 else f"0,{count // 2}"
    for geometry in GEOMETRIES:
        runs = {}
        for kind, own in KINDS.items():
            runs[kind] = render(program, file, frames, ("--geometry", geometry, *own, *options), folder)
            if runs[kind]["message"]:
                raise Problem(runs[kind]["code"], f"{name}: {runs[kind]['message']}")
        entries.append({"scene": name, "geometry": geometry, "what": FLOAT, "nan": odd_numbers(runs.values()),
                        **compare(runs["float"], runs["double"])})
    return entries


def total(entries, what, geometry=None):
    """Returns (near, pixels)."""
    these = [each for each in entries if each["what"] == what and geometry in (None, each["geometry"])]
    return sum(each["near"] for each in these), sum(each["pixels"] for each in these)


def share(entries):
    pixels = sum(each["pixels"] for each in entries)
    return sum(each["near"] for each in entries) / pixels if pixels else None


# ---- odd scenes

def outcome(odd, runs):
    """Returns (words, whether the outcome is correct)."""
    codes = {run["code"] for run in runs}
    if codes == {0}:
        return "rendered", not odd.refused
    if codes == {REFUSED}:  # the first problem that hedron reports, without the file's name
        first, *others = runs[0]["said"].strip().splitlines()
        words = first.rpartition(".json: ")[2]
        return f"refused: {others[0].strip()} ({words})" if others else f"refused: {words}", odd.refused
    return f"failed: {next(run['message'] for run in runs if run['code'])}", False


class OddScenes:
    """Renders the scene in float and in double, of solids and of triangles."""

    def __init__(self, program, folder, options):
        self.program, self.folder, self.options = program, folder, options
        self.truths = {}  # pictures in double, by scene and geometry
        self.entries = []

    def render(self, scene, geometry, kind):
        file = write_scene(scene, self.folder / "odd.json")
        return render(self.program, file, "0", ("--geometry", geometry, *KINDS[kind], *self.options), self.folder)

    def near_beside(self, odd, geometry, picture):
        """Returns the number of pixels near those with the odd thing a hair to either side; None: it has none."""
        beside = [self.render(scene, geometry, "double")["pictures"] for scene in odd.beside]
        if not beside or not picture or not all(beside):
            return None
        return pfm.near_pixels(picture[0], *(each[0] for each in beside))

    def run(self, odd):
        for geometry in GEOMETRIES:
            runs = [self.render(odd.scene, geometry, kind) for kind in ("double", "float")]
            truth = self.truths.setdefault((odd.name, geometry), runs[0])
            if odd.like:
                truth = self.truths[odd.like, geometry]
            words, good = outcome(odd, runs)
            self.entries.append({"scene": odd.name, "geometry": geometry, "outcome": words, "as_it_should": good,
                                 "like": odd.like, "nan": odd_numbers(runs), "clamps": runs[1]["clamps"],
                                 **compare(runs[1], truth),
                                 "beside_near": self.near_beside(odd, geometry, runs[1]["pictures"]),
                                 "double_near": compare(runs[0], truth)["near"] if odd.like else None})


def failures(entries):
    wrong = [(each, each["outcome"]) for each in entries if not each["as_it_should"]]
    wrong += [(each, f"{each['nan']} pixels are no numbers") for each in entries if each["nan"]]
    return [f"{each['scene']}, {each['geometry']}: {words}" for each, words in wrong]
