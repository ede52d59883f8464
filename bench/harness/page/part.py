# SPDX-License-Identifier: MIT
"""A part of bench/study. Each is a file of harness/parts, which declares what is measured and what the page makes of it."""
import importlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from harness.page.section import Section, scaled_note

FOLDER = Path(__file__).resolve().parent.parent / "parts"


@dataclass(frozen=True)
class Part:
    """Either `add` puts points into the plan, or `measure` does something else and returns why it did not, if so."""
    place: int  # in the order of the parts
    title: str
    about: str  # what was measured, in a sentence or two
    add: Callable = None
    scenes: Callable = None  # {name: file, or the reason why there is none} of those that it makes
    measure: Callable = None
    fill: Callable = None  # a section, from the results
    failures: Callable = lambda result: []


def load():
    """{name: part}, in their order."""
    found = {file.stem: importlib.import_module(f"harness.parts.{file.stem}").PART for file in FOLDER.glob("[a-z]*.py")}
    return dict(sorted(found.items(), key=lambda each: each[1].place))


def sections(parts, sources):
    """One for each part that anybody measured or that has a reason why not."""
    found = []
    for name, part in parts.items():
        if not part.fill:
            continue
        section = Section(name, part.title, part.about)
        for result in sources.results:
            reason = result["left_out"].get(name)
            if reason:
                section.notes.append(reason if len(sources.results) == 1 else f"{result['machine']['name']}: {reason}")
        if part.measure or sources.measured(name):
            part.fill(sources, section)
            section.notes += scaled_note(sources.measured(name))
        if section.charts or section.notes:
            found.append(section)
    return found
