#!/usr/bin/python3
"""Draws the stability map from the results of its studies, and counts.

    for study in tests/stability/map/*.yaml; do
        ./magfsi study "$study" --out runs/map/$(basename "$study" .yaml)
    done
    tests/stability/draw_map.py runs/map [--figure docs/stability.png]
"""
import argparse
import collections
import csv
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

KINDS = {"right": ("o", "#3b7dd8", "right"),
         "stopped": ("s", "0.65", "stopped, with its cause"),
         "refused": ("_", "0.4", "refused before the start"),
         "wrong": ("X", "#c00000", "wrong")}


def kind(row):
    if row["verdict"] in ("right", "wrong"):
        return row["verdict"]
    if row["outcome"] == "refused":
        return "refused"
    return "stopped" if row["cause"] else "wrong"


class Panel:
    """One study: columns are the first axis, rows the product of the others."""

    def __init__(self, folder):
        self.name = folder.name
        with open(folder / "runs.csv", newline="") as file:
            self.rows = list(csv.DictReader(file))
        names = list(self.rows[0])
        self.axes = names[:next(i for i, n in enumerate(names) if n.startswith("error"))]
        self.across = list(dict.fromkeys(self.label(r, self.axes[0]) for r in self.rows))
        self.down = list(dict.fromkeys(self.side(r) for r in self.rows))

    @staticmethod
    def label(row, axis):
        text = row[axis]
        unit = axis.partition("[")[2].rstrip("]")
        if axis.startswith(("direction", "angle")):
            return f"{math.degrees(float(text)):.0f} deg"
        return f"{float(text):g} {unit}" if unit and unit != "1" else text

    def side(self, row):
        return ", ".join(self.label(row, axis) for axis in self.axes[1:])

    def counts(self):
        return collections.Counter(kind(row) for row in self.rows)

    def draw(self, axes):
        for what, (marker, color, _) in KINDS.items():
            at = [(self.across.index(self.label(r, self.axes[0])), self.down.index(self.side(r)))
                  for r in self.rows if kind(r) == what]
            if at:
                axes.scatter(*zip(*at), marker=marker, color=color, s=26, lw=1.2)
        axes.set_xticks(range(len(self.across)), self.across, rotation=90)
        axes.set_yticks(range(len(self.down)), self.down)
        axes.set_xlim(-0.6, len(self.across) - 0.4)
        axes.set_ylim(len(self.down) - 0.4, -0.6)
        title = " / ".join(axis.partition("[")[0].replace("_", " ") for axis in self.axes)
        axes.set_title(f"{self.name}: {title}", fontsize=7, loc="left")
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)


def draw(panels, out):
    plt.rcParams.update({"font.size": 5.5, "font.family": "DejaVu Sans", "axes.linewidth": 0.5})
    columns = [[], []]
    for panel in sorted(panels, key=lambda p: -len(p.down)):
        min(columns, key=lambda c: sum(len(p.down) + 6 for p in c)).append(panel)
    heights = [[len(p.down) + 2 for p in column] for column in columns]
    total = max(sum(h) + 7 * len(h) for h in heights) + 3
    figure = plt.figure(figsize=(11, 0.13 * (total + 5)))
    for x, column in zip((0.13, 0.64), columns):
        top = 1 - 5 / (total + 5)
        for panel in column:
            height = (len(panel.down) + 1) / (total + 5)
            panel.draw(figure.add_axes([x, top - height, 0.34, height]))
            top -= height + 8.5 / (total + 5)
    handles = [plt.Line2D([], [], ls="", marker=m, color=c, label=text)
               for m, c, text in KINDS.values()]
    figure.legend(handles=handles, loc="upper center", ncol=4, frameon=False, fontsize=8)
    figure.savefig(out, dpi=150)
    print(out)


def report(panels):
    total = collections.Counter()
    print(f"| study | cells | {' | '.join(KINDS)} |\n|{'---|' * (2 + len(KINDS))}")
    for panel in panels:
        counts = panel.counts()
        total.update(counts)
        print(f"| {panel.name} | {len(panel.rows)} | "
              f"{' | '.join(str(counts[k]) for k in KINDS)} |")
    print(f"| all | {total.total()} | {' | '.join(str(total[k]) for k in KINDS)} |")


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("results", type=pathlib.Path)
    options.add_argument("--figure", type=pathlib.Path, default=pathlib.Path("stability.png"))
    chosen = options.parse_args()
    panels = [Panel(file.parent) for file in sorted(chosen.results.glob("*/runs.csv"))]
    report(panels)
    draw(panels, chosen.figure)


if __name__ == "__main__":
    main()
