# SPDX-License-Identifier: GPL-2.0-or-later
"""FSI2: the flag's end against time, with the reference's band.

    plot.py FIGURE SPACING_MM=RUN_FOLDER ...
"""

import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.patches import Patch

COLOURS = ("#e69f00", "#0072b2", "#1a1a1a")  # from coarse to fine, also for colour-blind readers
REFERENCE = json.loads((Path(__file__).resolve().parent / "reference.json").read_text())


def column(folder, name):
    with open(Path(folder) / "probes.csv", newline="") as file:
        rows = list(csv.reader(file))
    at = rows[0].index(name)
    return [float(row[at]) for row in rows[1:]]


def main():
    runs = [word.split("=", 1) for word in sys.argv[2:]]
    figure, axes = plt.subplots(2, 2, figsize=(10, 5.5), sharey="row",
                                gridspec_kw={"width_ratios": [2, 1]}, layout="constrained")
    for row, (name, label) in enumerate((("uy", "up"), ("ux", "along"))):
        mean, amplitude, _ = REFERENCE["fsi2"][name]
        for ax in axes[row]:
            ax.axhspan(1e3 * (mean - amplitude), 1e3 * (mean + amplitude), color="0.9")
            ax.axhline(1e3 * mean, color="0.7", lw=0.8)
        for colour, (spacing, folder) in zip(COLOURS, runs):
            t = column(folder, "t[s]")
            u = [1e3 * v for v in column(folder, f"A_{name}[m]")]
            text = f"{float(spacing):.3g} mm, {20 / float(spacing):.3g} cells in the flag"
            axes[row][0].plot(t, u, lw=0.7, color=colour, label=text)
            end = t[-1]
            part = [(a - end, b) for a, b in zip(t, u) if a >= end - 1.2]
            axes[row][1].plot(*zip(*part), lw=1.2, color=colour)
        axes[row][0].set_ylabel(f"A, {label} [mm]")
    axes[1][0].set_xlabel("time [s]")
    axes[1][1].set_xlabel("time before the end [s]")
    handles, labels = axes[0][0].get_legend_handles_labels()
    handles.append(Patch(color="0.9"))
    figure.legend(handles, [*labels, "the reference's mean and band"], loc="outside upper left", fontsize=9, ncols=4,
                  frameon=False)
    figure.savefig(sys.argv[1], dpi=110)


if __name__ == "__main__":
    main()
