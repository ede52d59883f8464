# SPDX-License-Identifier: MIT
"""Charts as SVG files."""
from harness.store.result import write_text


def remove_old(folder, patterns):
    """Removes charts of other numbers."""
    for file in (file for pattern in patterns for file in folder.glob(f"{pattern}.svg")):
        file.unlink()


def draw(wanted, folder):
    """Writes charts by their names; returns lines that report them."""
    for name, chart in wanted.items():
        write_text(folder / f"{name}.svg", chart.document())
    return [f"Chart: {folder / name}.svg" for name in wanted]
