# SPDX-License-Identifier: MIT
"""Where methods fail, counted as bench/stability does; an interrupted study goes on where it was."""
from harness import stability_methods, stability_pictures

# Rays, paths or segments of each case, method and place; pixels.
COUNTS = {True: {"crossings": 1000, "paths": 250, "shadows": 1000, "sums": 100},
          False: {"crossings": 5000, "paths": 1250, "shadows": 5000, "sums": 500}}
SIZE = ("--size", "80x60", "--samples", "1")


def measure(result, program, root, folder, arguments, save, news):
    """Fills result["stability"]. It all runs on the CPU, and every number is the same each time. Raises Problem where
    it cannot be."""
    memory = result["stability"] = result["stability"] or {"steps": [], "counts": [], "precision": [], "odd": None}
    tool = program.path.parent / "bench/hedron_stability_methods"
    for study in stability_methods.STUDIES:
        if study not in memory["steps"]:
            news(f"stability, {study}")
            memory["counts"] += stability_methods.run(tool, study, COUNTS[arguments.quick][study])
            memory["steps"].append(study)
            save()
    for file in sorted((root / "scenes").glob("*.json")):
        step = f"precision {file.stem}"
        if step not in memory["steps"]:
            news(f"stability, {step}")
            memory["precision"] += stability_pictures.study_scene(program, file, (*SIZE, *arguments.options), folder)
            memory["steps"].append(step)
            save()


def failures(result):
    memory = result["stability"]
    return stability_methods.failures(memory["counts"]) if memory else []
