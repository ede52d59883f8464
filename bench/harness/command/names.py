# SPDX-License-Identifier: MIT
"""The measurements by their names: each is a file of harness/benches."""
import importlib

from harness.run.program import ROOT

FOLDER = ROOT / "bench/harness/benches"


def names():
    """Those that bench/study takes as its first word; the others are programs of their own."""
    return sorted(file.stem for file in FOLDER.glob("[a-z]*.py") if not (ROOT / "bench" / file.stem).is_file())


def main(study, words):
    if words and words[0] in names():
        return importlib.import_module(f"harness.benches.{words[0]}").BENCH.main(words[1:])
    return study.main(words)
