# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the beam's figure from a folder of runs, and makes these runs when asked.

    plot.py FOLDER --run [--out figure.png]     makes the runs (a minute or two), then draws
    plot.py FOLDER [--out figure.png]           draws from the runs of an earlier --run

(a) side views of the beam at a few loads, to scale; (b) tip displacement against load, with
the reference; (c), (d) largest error of uz over all loads against the computing time of a run
and against its number of elements, for meshes and element variants. FOLDER/shapes is a run of
scene.yaml, FOLDER/sweep.csv has the rest. Seconds are processor time, so that a busy machine
counts little.
"""
import pathlib
import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from magfsi import plotting
from magfsi.plotting import GREY, INK, clean
from magfsi.runs import read_table

HERE = pathlib.Path(__file__).resolve().parent
LENGTH_M = 17.5e-3
GAMMA_END = 0.04  # at the end of the path
SHOWN = (0.0, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.04)
STYLES = {"full": ("s", "0.55"), "assumed_strain": ("o", "0.0")}
# The paper's element needs its elements about 1.41 times as long as thick: its meshes follow
# that line and leave it on both sides.
MESHES = {
    "full": ["12,2,1", "12,3,1", "11,4,1", "17,5,1", "25,8,2", "30,9,2", "32,9,2", "35,10,2",
             "36,10,3"],
    "assumed_strain": ["4,1,1", "6,1,1", "6,2,1", "7,2,1", "8,1,1", "8,2,1", "10,2,1",
                       "12,2,1", "14,3,1", "15,2,1", "18,5,1", "24,3,1", "36,5,1", "18,5,2"],
}


def numbers(table, name):
    if name not in table:
        sys.exit(f"no column '{name}'; there are {', '.join(table)}")
    return np.array(table[name], dtype=float)


class Path:
    """Tip displacements over the length against gamma."""

    def __init__(self, folder):
        probes = read_table(folder / "probes.csv")
        self.gamma = GAMMA_END * numbers(probes, "t[s]")
        self.uz = numbers(probes, "tip_uz[m]") / LENGTH_M
        self.ux = numbers(probes, "tip_ux[m]") / LENGTH_M

    def error_percent(self, reference):
        gamma, uz = numbers(reference, "gamma"), numbers(reference, "uz_tip/L")
        rows = [int(np.abs(self.gamma - g).argmin()) for g in gamma]
        return 100 * np.abs(self.uz[rows] / uz - 1).max()


def make_runs(folder, reference):
    plotting.run(HERE / "scene.yaml", folder / "shapes")
    with open(folder / "sweep.csv", "w") as file:
        file.write("element,mesh,elements,seconds,error_percent\n")
        for element, meshes in MESHES.items():
            for mesh in meshes:
                into = folder / f"{element}_{mesh.replace(',', 'x')}"
                done = plotting.run(HERE / "scene.yaml", into, [
                    f"bodies.beam.element={element}", "output=null",
                    f"bodies.beam.mesh.box.elements=[{mesh}]"])
                error = Path(into).error_percent(reference)
                count = done.summary()["structure"]["elements"]
                file.write(f"{element},{mesh.replace(',', ' x ')},{count},{done.core_s:.3g},"
                           f"{error:.3g}\n")
                print(f"{element} {mesh}: {error:.2f} %, {done.core_s:.2f} s", flush=True)


def draw_shapes(axes, folder):
    for gamma in SHOWN:
        time_s, file = plotting.nearest_frames(plotting.frames(folder), [gamma / GAMMA_END])[0]
        if abs(GAMMA_END * time_s - gamma) > 1e-6:
            sys.exit(f"{folder} has no frame at gamma {gamma:g}; see output in scene.yaml")
        faces = plotting.side_view_mm(file)
        plotting.draw_faces(axes, faces, "0.6", INK, 0.25)
        end = faces.reshape(-1, 2)
        tip = end[np.argmax(end[:, 0] + 2 * end[:, 1])]
        axes.annotate(f"{gamma:g}", tip, xytext=(4, 2), textcoords="offset points",
                      fontsize=7, va="center")
    axes.axvspan(-1.6, 0, color="0.85", lw=0)
    axes.text(-0.8, 9, "clamp", rotation=90, ha="center", va="center", fontsize=7,
              color=GREY)
    plotting.arrow(axes, (14, 17.6), (14, 13.6), INK)
    axes.text(14.6, 15.6, "field B", fontsize=8, va="center")
    plotting.arrow(axes, (8.5, -1.3), (4.5, -1.3), INK)
    axes.text(8.9, -1.3, "magnetisation M", fontsize=8, va="center")
    axes.set(aspect="equal", xlim=(-1.6, 21.5), ylim=(-2.2, 18.6), xlabel="x [mm]",
             ylabel="z [mm]")
    clean(axes)


def draw_path(axes, path, reference):
    gamma = numbers(reference, "gamma")
    ends = ((path.uz, "uz_tip/L", INK, "upwards, $u_z/L$", 0.945),
            (path.ux, "ux_tip/L", GREY, "back, $-u_x/L$", 0.62))
    for values, name, colour, text, height in ends:
        axes.plot(path.gamma, np.abs(values), color=colour, lw=1.1)
        axes.plot(gamma, np.abs(numbers(reference, name)), "o", ms=4, mfc="none", mec=INK,
                  mew=0.8, clip_on=False)
        axes.text(0.024, height, text, fontsize=8)
    axes.text(0.99, 0.05, "line: scene.yaml, 18 x 5 x 1 elements\ncircles: reference",
              transform=axes.transAxes, ha="right", va="bottom", fontsize=7, color=GREY)
    axes.set(xlim=(0, 0.04), ylim=(0, 1.02), xlabel=r"load $\gamma = M B / G$",
             ylabel="tip displacement / length")
    axes.set_xticks([0, 0.01, 0.02, 0.03, 0.04])
    clean(axes)


def cheapest(rows, percent):
    good = [row for row in rows if row["error"] <= percent]
    return min(good, key=lambda row: row["seconds"]) if good else None


def sweep_rows(folder):
    table = read_table(plotting.needed(folder / "sweep.csv"))
    columns = [table["element"], table["mesh"], numbers(table, "elements"),
               numbers(table, "seconds"), numbers(table, "error_percent")]
    names = ("element", "mesh", "count", "seconds", "error")
    return [dict(zip(names, row)) for row in zip(*columns)]


def draw_accuracy(axes, rows, cost, limits, label):
    """Errors against a cost ("seconds" or "count"), the cheapest good meshes ringed."""
    beside = {"full": (6, 7, "left"), "assumed_strain": (-2, -11, "center")}
    for element, (marker, colour) in STYLES.items():
        mine = [row for row in rows if row["element"] == element]
        axes.plot([r[cost] for r in mine], [r["error"] for r in mine], marker, ms=4,
                  color=colour, mew=0, label=element)
        bests = {b["mesh"]: b for b in (cheapest(mine, 3), cheapest(mine, 1)) if b}
        for best in bests.values():
            at = (best[cost], best["error"])
            axes.plot(*at, "o", ms=9, mfc="none", mec=INK, mew=0.8)
            x, y, side = beside[element]
            axes.annotate(best["mesh"].replace(" x ", "\N{MULTIPLICATION SIGN}"), at,
                          xytext=(x, y), textcoords="offset points", fontsize=7, ha=side,
                          va="center")
    for percent in (3, 1):
        axes.axhline(percent, color=GREY, lw=0.6, ls=":", zorder=0)
        axes.text(0.01, percent, f"{percent} %", fontsize=7, color=GREY, ha="left",
                  va="bottom", transform=axes.get_yaxis_transform())
    axes.legend(fontsize=7, frameon=False, loc="upper right", handletextpad=0.1)
    axes.set(xscale="log", yscale="log", ylim=(0.2, 100), xlim=limits, xlabel=label,
             ylabel="largest error of $u_z$ [%]")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    clean(axes)


def draw(folder, reference, out):
    plt.rcParams.update({"font.size": 8, "font.family": "DejaVu Sans", "axes.linewidth": 0.6,
                         "xtick.major.width": 0.6, "ytick.major.width": 0.6})
    figure, axes = plt.subplots(2, 2, figsize=(7.4, 6.6))
    axes = axes.flat
    rows = sweep_rows(folder)
    draw_shapes(axes[0], folder / "shapes")
    draw_path(axes[1], Path(folder / "shapes"), reference)
    draw_accuracy(axes[2], rows, "seconds", (0.02, 20),
                  "processor time of all 80 equilibria [s]")
    draw_accuracy(axes[3], rows, "count", (2, 3000), "elements")
    for room, letter in zip(axes, "abcd"):
        room.set_title(f"({letter})", loc="left", weight="bold", fontsize=9)
    figure.tight_layout(w_pad=1.5)
    figure.savefig(out, dpi=200)
    for element in STYLES:
        mine = [row for row in rows if row["element"] == element]
        for percent in (3, 1):
            best = cheapest(mine, percent)
            found = (f"{best['mesh']} ({best['count']:g} elements), {best['seconds']:g} s, "
                     f"error {best['error']:g} %" if best else "none of the meshes tried")
            print(f"{element}, {percent} %: {found}")


def main():
    chosen = plotting.figure_options(__doc__)
    reference = read_table(HERE / "reference.csv")
    if chosen.run:
        chosen.folder.mkdir(parents=True, exist_ok=True)
        make_runs(chosen.folder, reference)
    draw(chosen.folder, reference, chosen.out)
    print(chosen.out)


if __name__ == "__main__":
    main()
