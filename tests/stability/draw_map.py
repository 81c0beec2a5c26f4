# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the stability map from the results of its studies, and counts.

    for study in tests/stability/map/*.yaml; do
        ./magfsi study "$study" --out runs/map/$(basename "$study" .yaml)
    done
    ./magfsi python tests/stability/draw_map.py runs/map --out docs/stability
    ./magfsi python tests/stability/draw_map.py docs/stability/cells.csv    # the pictures alone
    ./magfsi python tests/stability/draw_map.py docs/stability/cells.csv runs/map --out docs/stability

The last takes the studies that are not in runs/map from the table. Writes a picture for each entry of PICTURES,
cells.csv with a row for each run, and by_axis.md with the counts.
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
            "contact": ["rotating", "contact", "rheology", "rheology_strong"],
            "held": ["held", "slow"],
            "rigid": ["rigid", "rigid_contact"]}
# Of what a run ended: a letter for the pictures, and words that its cause holds.
CAUSES = (("f", "the fluid diverges", "the fluid diverged"),
          ("m", "a marker moves more than 0.4 cells a step", "moves too fast for the fluid's grid"),
          ("e", "an element is inverted", "is inverted"),
          ("g", "energy is gained without a source", "gained energy"),
          ("b", "the body leaves the box", "left the fluid"),
          ("o", "a body passes through itself", "passes through itself"),
          ("p", "a body passes through another", "passes through body"),
          ("s", "a body passes into a side of the box", "passes into the side"))


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
    shown = {"Pa": "kPa", "T": "mT", "s": "\u00b5s", "rad": "deg", "1/s": "Hz"}.get(unit, unit)
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


def common(texts):
    """The words that all texts begin with, but for their last."""
    words = [text.split() for text in texts]
    count = 0
    while all(len(w) > count + 1 and w[count] == words[0][count] for w in words):
        count += 1
    return " ".join(words[0][:count])


class Stored(Study):
    """Of rows of cells.csv, whose cells are "axis value; axis value"."""

    def __init__(self, name, rows):
        self.name, self.rows = name, rows
        cells = [row["cell"].split("; ") for row in rows]
        # An axis ends with its unit, or where the texts begin to differ.
        self.axes = [texts[0][:texts[0].index("] ") + 1] if "] " in texts[0] else common(texts)
                     for texts in zip(*cells)]
        lengths = list(map(len, self.axes))
        self.axes = [axis.replace("[us]", "[\u00b5s]") for axis in self.axes]
        self.cells = [([text[length + 1:] for length, text in zip(lengths, cell)], self.end(row), row)
                      for cell, row in zip(cells, rows)]

    @staticmethod
    def end(row):
        return row["end"] if row["end"] != "stopped" else kind({**row, "outcome": "diverged"})


def stored(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: Stored(name, [row for row in rows if row["study"] == name])
            for name in dict.fromkeys(row["study"] for row in rows)}


def draw_pictures(studies, out):
    for name, members in PICTURES.items():
        there = [studies[m] for m in members if m in studies]
        if there:
            draw(there, CAUSES, out / f"{name}.png")


def done(folder):
    return {file.parent.name: Study(file.parent) for file in sorted(folder.glob("*/runs.csv"))}


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("results", type=pathlib.Path, nargs="+", help="folders of studies, or tables of earlier ones")
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("docs/stability"))
    chosen = options.parse_args()
    studies = {}
    for results in chosen.results:
        studies |= stored(results) if results.suffix == ".csv" else done(results)
    studies = dict(sorted(studies.items()))
    chosen.out.mkdir(parents=True, exist_ok=True)
    draw_pictures(studies, chosen.out)
    if all(results.suffix == ".csv" for results in chosen.results):
        return
    map_tables.write_cells(studies.values(), chosen.out / "cells.csv")
    page = map_tables.page(studies.values(), CAUSES)
    (chosen.out / "by_axis.md").write_text(page)
    print(page)


if __name__ == "__main__":
    main()
