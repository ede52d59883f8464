# SPDX-License-Identifier: MIT
"""The settings that bench/study accuracy tries, in families: each continues if the one before was affordable."""
from dataclasses import dataclass

# The deepest affordable grid without a cut-off. Deeper ones cost more, so ratios to it do not exaggerate.
FULL_DEPTH = 40
BOUNDED = ("--depth", "30", "--cutoff", "0.001")
LESS_BOUNDED = ("--depth", "30", "--cutoff", "0.003")
SIDE = 4  # grid of the families that vary something else
SIDES, SIDES_QUICKLY = (1, 2, 3, 4, 6, 8), (1, 2, 4)
DRAFT_USUAL_FINE = {2: "draft", 4: "usual", 8: "fine"}  # sides of the grids that set their error


@dataclass(frozen=True)
class Setting:
    family: str
    name: str
    options: tuple
    work: float  # in proportion within the family


FAMILIES = {
    "grid": "grid N x N, the scene's depth and cut-off",
    "multijitter": "N x N multi-jittered samples, the scene's depth and cut-off",
    "full": f"grid N x N, depth {FULL_DEPTH}, no cut-off",
    "deep": "N x N multi-jittered samples, depth 30, cut-off 0.001",
    "fine": "grid N x N, depth 30, cut-off 0.003",
    "depth": f"grid {SIDE} x {SIDE}, depth D",
    "cutoff": f"grid {SIDE} x {SIDE}, depth 30, cut-off W",
    "bound": f"grid {SIDE} x {SIDE}, --max-error E",
    "promise": "8 x 8 multi-jittered samples, --max-error E",
    "arithmetic": f"grid {SIDE} x {SIDE}, other arithmetic or geometry",
}
CHOSEN = "arithmetic"
OTHERS = {"double": ("--precision", "double"), "fast": ("--math", "fast"), "triangles": ("--geometry", "triangles"),
          "wavefront": ("--pipeline", "wavefront"), "mega": ("--pipeline", "mega")}
BASELINE, BOUNDED_FAMILIES = "full", ("multijitter", "deep", "promise")


def by_side(family, sides, *others):
    return [Setting(family, f"{family} {number}", ("--samples", str(number), *others), number * number)
            for number in sides]


def by_value(family, option, values, word, *others):
    """Returns settings of a value each; one value more takes some three times the work, at most."""
    return [Setting(family, f"{word}{value}", (*others, option, str(value)), 3 ** place)
            for place, value in enumerate(values)]


def settings(quick):
    """Returns {family: [Setting]}, each list by its work."""
    sides = SIDES_QUICKLY if quick else SIDES
    grid, multijitter = ("--aa", "grid"), ("--aa", "multijitter")
    at_side = ("--samples", str(SIDE), *grid)
    return {
        "grid": by_side("grid", sides, *grid),
        "multijitter": by_side("multijitter", sides[1:], *multijitter),
        "full": by_side("full", sides, *grid, "--depth", str(FULL_DEPTH), "--cutoff", "0"),
        "deep": by_side("deep", sides[1:], *BOUNDED, *multijitter),
        "fine": by_side("fine", sides[1:], *grid, *LESS_BOUNDED),
        "depth": by_value("depth", "--depth", (4, 30) if quick else (2, 4, 8, 20, 30), "depth ", *at_side),
        "cutoff": by_value("cutoff", "--cutoff", (0.03, 0.003) if quick else (0.1, 0.03, 0.01, 0.003, 0.001, 0.0003),
                           "cut-off ", *at_side, "--depth", "30"),
        "bound": by_value("bound", "--max-error", (64, 4) if quick else (64, 16, 4, 1, 0.25), "max-error ", *at_side),
        "promise": by_value("promise", "--max-error", (64,) if quick else (64, 16, 4, 1), "promise ", "--samples", "8",
                            *multijitter),
        CHOSEN: [Setting(CHOSEN, name, (*at_side, *options), 1) for name, options in OTHERS.items()],
    }
