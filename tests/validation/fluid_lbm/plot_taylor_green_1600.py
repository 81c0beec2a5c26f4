# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws what fluid_taylor_green_1600 has written: the loss of kinetic energy over time.

  plot_taylor_green_1600.py FOLDER_OF_THE_CSV_FILES PICTURE.png
"""

import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

SPECTRAL_PEAK = (8.97, 0.01286)  # 512^3 modes
NAMES = {"trt": "two relaxation times", "recursive_regularized": "recursive regularised"}


def main() -> None:
    folder, picture = pathlib.Path(sys.argv[1]), sys.argv[2]
    figure, axes = plt.subplots(figsize=(6.4, 4.8), constrained_layout=True)
    for (name, label), colour in zip(NAMES.items(), ("#0072b2", "#d55e00")):
        with open(folder / f"taylor_green_1600_{name}.csv") as file:
            rows = [[float(v) for v in row] for row in list(csv.reader(file))[1:]]
        (line,) = axes.plot([r[0] for r in rows], [r[2] for r in rows],
                            label=f"{label}: $-dE/dt$", color=colour)
        axes.plot([r[0] for r in rows], [r[3] for r in rows], "--",
                  color=line.get_color(),
                  label=r"$2\nu\,\times$ enstrophy that the grid carries")
    axes.plot(*SPECTRAL_PEAK, "k*", markersize=11, label="peak, spectral solution")
    axes.set(xlabel="time / (length / speed)", ylabel="rate per mass / (speed³ / length)",
             title="Taylor-Green vortex, Re 1600, 128³ cells", xlim=(0, 10), ylim=(0, None))
    axes.legend(fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(0, -0.14), ncols=2)
    axes.grid(alpha=0.3)
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main()
