# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the stability map from the results of its studies, and counts.

    for study in tests/stability/map/*.yaml; do
        ./magfsi study "$study" --out runs/map/$(basename "$study" .yaml)
    done
    ./magfsi python tests/stability/draw_map.py runs/map --out docs/stability

Writes fluid.png, coupling.png, bodies.png, no_slip.png, refinement.png and contact.png, cells.csv with a row for
each run, and by_axis.md with the counts.
"""
import argparse
import csv
import pathlib

import map_tables
from map_panel import draw

PICTURES = {"fluid": ["lattice", "ranks"],
            "coupling": ["schemes", "boundary", "density", "substeps"],
            "bodies": ["elasticity", "thickness", "field", "elements", "reversal"],
            "no_slip": ["no_slip", "no_slip_bodies"],
            "refinement": ["refinement"],
            "contact": ["rotating", "contact", "rheology", "rheology_strong"]}
# Of what a run ended: a letter for the pictures, and words that its cause holds.
CAUSES = (("f", "the fluid diverges", "the fluid diverged"),
          ("m", "a marker moves more than 0.4 cells a step", "moves too fast for the fluid's grid"),
          ("e", "an element is inverted", "is inverted"),
          ("g", "energy is gained without a source", "gained energy"),
          ("b", "the body leaves the box", "left the fluid"),
          ("o", "a body passes through itself", "passes through itself"))


def kind(row):
    """right, wrong, refused or the letter of the cause: all that has none is wrong, and so is
    what did not end in time."""
    if row["outcome"] == "completed":
        return "right" if row["verdict"] in ("right", "reference") else "wrong"
    if row["outcome"] == "refused":
        return "refused"
    if row["outcome"] == "diverged":
        return next((letter for letter, _, words in CAUSES if words in row["cause"]), "wrong")
    return "wrong"


def label(row, axis):
    text, unit = row[axis], axis.partition("[")[2].rstrip("]")
    if unit == "rad":
        return f"{float(text) * 57.29577951308232:.0f}"
    scale = {"Pa": 1e-3, "T": 1e3, "s": 1e6}.get(unit, 1)
    return f"{float(text) * scale:.6g}" if unit else text


def title(axis):
    name, _, unit = axis.partition("[")
    unit = unit.rstrip("]")
    shown = {"Pa": "kPa", "T": "mT", "s": "us", "rad": "deg", "1/s": "Hz"}.get(unit, unit)
    words = name.replace("_over_", " / ").replace("k / g", "K / G").replace("_", " ")
    return words if shown in ("", "1") else f"{words} [{shown}]"


class Study:
    """The cells of one study: for each the values of its axes, how it ended, and the row."""

    def __init__(self, folder):
        self.name = folder.name
        with open(folder / "runs.csv", newline="") as file:
            self.rows = list(csv.DictReader(file))
        names = list(self.rows[0])
        axes = names[:next(i for i, n in enumerate(names) if n.startswith("error"))]
        self.axes = [title(axis) for axis in axes]
        self.cells = [([label(row, axis) for axis in axes], kind(row), row) for row in self.rows]

    def values(self, axis):
        return list(dict.fromkeys(values[axis] for values, _, _ in self.cells))


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("results", type=pathlib.Path)
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("docs/stability"))
    chosen = options.parse_args()
    studies = {file.parent.name: Study(file.parent)
               for file in sorted(chosen.results.glob("*/runs.csv"))}
    chosen.out.mkdir(parents=True, exist_ok=True)
    for name, members in PICTURES.items():
        there = [studies[m] for m in members if m in studies]
        if there:
            draw(there, CAUSES, chosen.out / f"{name}.png")
    map_tables.write_cells(studies.values(), chosen.out / "cells.csv")
    page = map_tables.page(studies.values(), CAUSES)
    (chosen.out / "by_axis.md").write_text(page)
    print(page)


if __name__ == "__main__":
    main()
