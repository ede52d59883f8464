# SPDX-License-Identifier: MIT
"""Pictures of the built-in scene: a reference, and two settings with maps of their errors; and maps of where backends,
precisions and arithmetics differ."""
import base64

from harness.measure.numbers import number
from harness.page.section import Part, dagger
from harness.run import devices, pfm
from harness.run.program import Problem, run_tool

SIZES, REFERENCE_SIDES = {True: (192, 108), False: (320, 180)}, {True: 4, False: 8}
MISSING = "4"  # truncation error of the reference, in steps of 255
DRAFT, FINE = ("--samples", "2"), ("--samples", "8")
SETTINGS = {"A draft": DRAFT, "Fine": FINE}
REFERENCE = "Reference"
BLACK = 1  # steps of 255, hardly visible
LEGEND = "Colours of maps: black no difference, violet 1, red 4, orange 16, yellow 128 steps of 255."


class Gallery:
    def __init__(self, study, judge):
        self.study, self.judge, self.size = study, judge, SIZES[study.arguments.quick]
        self.entries, self.files = [], {}

    def render(self, name, label, *options):
        """Returns the picture's name."""
        study = self.study
        study.news(f"pictures: {name}")
        self.files[name] = study.folder / f"gallery-{len(self.files)}.png"
        done = study.program.render(study.plan.devices[label], None, "0",
                                    (*options, "--size", f"{self.size[0]}x{self.size[1]}", *study.arguments.options),
                                    study.folder, output=str(self.files[name]))
        if done["code"] != 0:
            raise Problem(done["code"], done["message"])
        return name

    def add(self, name, png, **more):
        self.entries.append({"name": name, **more, "png": base64.b64encode(png.read_bytes()).decode("ascii")})

    def compare(self, title, name, with_name, **more):
        """Adds a map of the differences of two pictures."""
        one, other = self.files[name], self.files[with_name]
        found, heat = pfm.compare(self.study.program, one, other), self.study.folder / "heat.png"
        run_tool(self.study.program.path, "compare", one, other, "--diff", heat)
        self.add(title, heat, **more, off={"rmse": found["display"]["rmse"], "largest": found["display"]["largest"],
                                           "above_1": found["above_1"]})

    def make(self):
        judge, runnable = self.judge["label"], self.study.runnable
        side = REFERENCE_SIDES[self.study.arguments.quick]
        self.render(REFERENCE, judge, "--reference", "--samples", str(side), "--max-error", MISSING)
        self.add(REFERENCE, self.files[REFERENCE], device=judge, options=["--reference", "--samples", str(side)])
        for name, options in SETTINGS.items():
            self.render(name, judge, *options)
            self.add(name, self.files[name], device=judge, options=list(options))
            self.compare(f"{name}: errors", name, REFERENCE, device=judge, options=list(options))
        draft = next(iter(SETTINGS))
        for label, device in runnable.items():
            if label != judge and device["strict"]:
                self.compare(f"{label} against {judge}", self.render(label, label, *DRAFT), draft, device=label,
                             options=list(DRAFT))
        self.compare("Float against double", draft, self.render("double", judge, *DRAFT, "--precision", "double"), device=judge,
                     options=[*DRAFT, "--precision", "double"])
        able = next((label for label, device in runnable.items() if device["backend"] != "c"), None)
        if able:
            self.compare("Fast against strict arithmetic", self.render("fast", able, *DRAFT, "--math", "fast"), draft, device=able,
                         options=[*DRAFT, "--math", "fast"])
        return {"size": list(self.size), "entries": self.entries}


def measure(study):
    """Returns the pictures; raises Problem if a run fails."""
    judge = devices.judge(study.runnable.values())
    if judge is None:
        return "No device that is strict has double precision, so there is no reference."
    if not study.result.get("gallery"):
        study.result["gallery"] = Gallery(study, judge).make()
        study.save()
    return None


def words(each):
    made = f"{' '.join(each['options'])}, on {each['device']}."
    off = each.get("off")
    return made if off is None else (f"RMSE {number(off['rmse'], 3)}, at most {number(off['largest'], 3)}; "
                                     f"{number(100 * off['above_1'], 3)} % of the pixels are off by more than 1. {made}")


def fill(section):
    """Shows the first machine's pictures, because all render the same; names maps that are black."""
    found = next((result for result in section.results if result.get("gallery")), None)
    if found is None:
        return
    entries = found["gallery"]["entries"]
    black = {each["name"]: each["off"]["largest"] for each in entries if each.get("off", {}).get("largest", BLACK + 1) <= BLACK}
    section.pictures = [(each["name"], words(each), each["png"]) for each in entries if each["name"] not in black]
    section.notes.append(LEGEND)
    if black:
        unseen = [f"{name}, {f'at most {number(most, 3)} of 255' if most else 'no pixel'}" for name, most in black.items()]
        section.notes.append(f"Maps that are all black are not shown: {'; '.join(unseen)}.")
    section.notes.append(f"Made on {found['machine']['name']}{dagger(found)}, {' x '.join(map(str, found['gallery']['size']))}.")


PART = Part(19, "Pictures, and where they differ", "The built-in scene is compared with a reference of dense samples, and "
            "backends, precisions and arithmetics with each other.", measure=measure, fill=fill, lead=1)
