# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the gripper as it closes, lifts and lets go, and its arms in the field beside the elastica.

    plot.py RUN [--out figure.png]

Dashed is reference.csv, a run with cells of half the size; the arms alone (arm.yaml) are run here, a second.
"""
import argparse
import pathlib
import tempfile

import matplotlib.pyplot as plt
import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

import theory
from magfsi import plotting

HERE = pathlib.Path(__file__).resolve().parent
INSTANTS = (0, 0.02, 0.12, 0.52, 0.6, 0.7)
SHOWN = (1.5e-3, 3e-3, 6e-3, 15e-3)  # T
BLUE, ORANGE = "#0072b2", "#d55e00"
SIDES = np.array([[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])


def corners_mm(file):
    """Of each body's elements, by its name's place in the alphabet: arrays (elements, 8, 3)."""
    grid = plotting.read_grid(file)
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 8)
    places = 1e3 * vtk_to_numpy(grid.GetPoints().GetData())[cells]
    body = vtk_to_numpy(grid.GetCellData().GetArray("body"))
    return [places[body == i] for i in np.unique(body)]


def draw_instants(axes, run):
    frames = plotting.nearest_frames(plotting.frames(run), INSTANTS)
    for i, (time, file) in enumerate(frames):
        shift = np.array([6.6 * i - 4, 0])
        ball, gripper = corners_mm(file)
        middle = gripper[np.abs(gripper.mean(axis=1)[:, 1] - 4) < 0.5]  # the hub and the arms along x
        for elements, shade in ((ball, "0.8"), (middle, plotting.INK)):
            faces = elements[:, SIDES][..., [0, 2]].reshape(-1, 4, 2) + shift
            plotting.draw_faces(axes, faces, shade)
        axes.text(shift[0] + 4, -0.55, f"{1e3 * time:.0f} ms", ha="center", va="top")
    axes.axhline(0, color=plotting.GREY, lw=1)
    axes.set(xlim=(-3.3, 6.6 * len(frames) - 3.3), ylim=(-1.4, 5.8), aspect="equal")
    axes.axis("off")


def draw_course(axes, run):
    p = plotting.read_columns(run / "probes.csv")
    fine = plotting.read_columns(HERE / "reference.csv")
    for columns, style in ((p, {"lw": 1.4}), (fine, {"lw": 1, "ls": "--", "color": plotting.INK})):
        for name, colour in (("ball.com_z[m]", BLUE), ("east_tip_z[m]", ORANGE)):
            axes.plot(1e3 * columns["t[s]"], 1e3 * columns[name], **{"color": colour, **style})
    axes.text(300, 3.05, "ball's middle", color=BLUE, ha="right")
    axes.text(330, 1.75, "tip of an arm", color=ORANGE)
    axes.set(xlabel="time [ms]", ylabel="height [mm]", xlim=(0, 700), ylim=(0, 6))
    on = p["t[s]"][np.abs(p["field_z[T]"]) > 1e-3]
    axes.plot(1e3 * on[[0, -1]], [5.7, 5.7], color=plotting.GREY, lw=3, solid_capstyle="butt")
    axes.text(1e3 * on.mean(), 5.45, "field", color=plotting.GREY, ha="center", va="top")
    plotting.clean(axes)


def draw_arms(axes, arm):
    p = plotting.read_columns(arm / "probes.csv")
    for field in SHOWN:
        at = p["t[s]"][np.abs(-p["field_z[T]"] - field).argmin()]
        _, file = plotting.nearest_frames(plotting.frames(arm), [at])[0]
        x, z, _ = theory.shape(field)
        axes.plot(0.5 + 1e3 * x, 1e3 * z, color=ORANGE, lw=1.2)
        grid = plotting.read_grid(file)
        now = 1e3 * vtk_to_numpy(grid.GetPoints().GetData())
        rest = now - 1e3 * vtk_to_numpy(grid.GetPointData().GetArray("displacement[m]"))
        low, high = (now[(np.abs(rest[:, 1]) < 1e-6) & (rest[:, 0] > 0.49) & (np.abs(rest[:, 2] - level) < 1e-6)]
                     for level in (0, 0.2))
        mid = (low + high) / 2
        axes.plot(mid[:, 0], mid[:, 2] - 0.1, "o", ms=3, color=BLUE)
        axes.annotate(f"{1e3 * field:g} mT", (0.5 + 1e3 * x[-1], 1e3 * z[-1]), (0, -6), ha="center", va="top",
                      textcoords="offset points")
    axes.set(xlabel="from the axis [mm]", ylabel="height [mm]", aspect="equal", xlim=(0.2, 3.1), ylim=(-2.5, 0.2))
    axes.text(2.0, -0.25, "elastica", color=ORANGE)
    axes.text(2.0, -0.5, "simulated", color=BLUE)
    plotting.clean(axes)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("run", type=pathlib.Path)
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("figure.png"))
    chosen = options.parse_args()
    plt.rcParams.update({"font.size": 8, "font.family": "DejaVu Sans"})
    figure = plt.figure(figsize=(7.2, 4.4), constrained_layout=True)
    grid = figure.add_gridspec(2, 2, height_ratios=(1, 1.7), width_ratios=(1.5, 1))
    draw_instants(figure.add_subplot(grid[0, :]), chosen.run)
    draw_course(figure.add_subplot(grid[1, 0]), chosen.run)
    with tempfile.TemporaryDirectory() as arm:
        plotting.run(HERE / "arm.yaml", pathlib.Path(arm) / "arm")
        draw_arms(figure.add_subplot(grid[1, 1]), pathlib.Path(arm) / "arm")
    figure.savefig(chosen.out, dpi=150)
    print(chosen.out)


if __name__ == "__main__":
    main()
