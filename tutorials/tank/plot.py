# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the swimmer in its tank: the water's speed on all levels, and what the box does to the rise.

    plot.py TANK_RUN [--out figure.png]

The dashed course is the same robot in a box of 16 x 8 x 16 mm: box.csv beside this script, or
BOX_RUN of the second command in scene.yaml, given with --box.
"""
import argparse
import pathlib

import matplotlib.pyplot as plt
import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import plotting
from magfsi.plotting import GREY, INK, LETTERS_PT, WIDTH_IN

HERE = pathlib.Path(__file__).resolve().parent
INSTANT_S = 100e-3  # of the water
COLOUR, BOX_COLOUR = "#0072b2", "#d55e00"


def middle_plane(file):
    """Speed [mm/s] in the plane of the strip as an array [z][x], and its edges in mm."""
    image = plotting.read_grid(file)
    n, spacing, origin = [np.array(v) for v in (image.GetDimensions(), image.GetSpacing(), image.GetOrigin())]
    first = np.array(image.GetExtent()[::2])
    cells = n - 1
    velocity = vtk_to_numpy(image.GetCellData().GetArray("velocity[m/s]")).reshape(*cells[::-1], 3)
    low = origin + first * spacing
    edges = [1e3 * (low[d] + spacing[d] * np.arange(n[d])) for d in (0, 2)]
    y = int((20e-3 - low[1]) / spacing[1])
    return 1e3 * np.linalg.norm(velocity[:, y], axis=2), edges


def draw_water(axes, folder, time_s):
    """Each level over the one below, with its outline."""
    step = round(time_s / 20e-3)
    for level in range(4):
        name = f"fields/fluid_{step:06d}" + (f"_level{level}" if level else "")
        speed, (x, z) = middle_plane(folder / f"{name}.pvti")
        shown = axes.pcolormesh(x, z, speed, vmin=0, vmax=100, cmap="Blues", rasterized=True)
        axes.plot([x[0], x[-1], x[-1], x[0], x[0]], [z[0], z[0], z[-1], z[-1], z[0]], color=GREY, lw=0.5)
    time, frame = plotting.nearest_frames(plotting.frames(folder), [time_s])[0]
    plotting.draw_faces(axes, plotting.side_view_mm(frame), width=0.2)
    axes.set(aspect="equal", title=f"the tank at {1e3 * time:.0f} ms", xlabel="x [mm]", ylabel="z [mm]")
    axes.locator_params(nbins=6, steps=(1, 2, 5, 10))
    return shown


def draw_rise(axes, probes, label, **style):
    height = 1e3 * (probes["robot.com_z[m]"] - probes["robot.com_z[m]"][0])
    axes.plot(1e3 * probes["t[s]"], height, label=label, **style)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("folder", type=pathlib.Path)
    options.add_argument("--box", type=pathlib.Path, default=HERE / "box.csv")
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("figure.png"))
    chosen = options.parse_args()
    box = chosen.box / "probes.csv" if chosen.box.is_dir() else chosen.box
    plt.rcParams.update({"font.size": LETTERS_PT, "axes.titlesize": LETTERS_PT, "font.family": "DejaVu Sans"})
    figure = plt.figure(figsize=(WIDTH_IN, 6.2), constrained_layout=True)
    figure.get_layout_engine().set(wspace=0.05, hspace=0.06)
    rows = figure.add_gridspec(2, 1, height_ratios=(1.15, 1))
    whole, near = rows[0].subgridspec(1, 2).subplots()
    rise = figure.add_subplot(rows[1])
    probes = plotting.read_columns(chosen.folder / "probes.csv")
    shown = draw_water(whole, chosen.folder, INSTANT_S)
    draw_water(near, chosen.folder, INSTANT_S)
    height = 1e3 * probes["robot.com_z[m]"][-1]
    near.set(xlim=(14, 26), ylim=(height - 6, height + 6), title="at the robot")
    figure.colorbar(shown, ax=near, label="speed of the water [mm/s]", extend="max", shrink=0.92)
    draw_rise(rise, probes, "tank of 40 mm", color=COLOUR, lw=1.4)
    draw_rise(rise, plotting.read_columns(box), "box of 16 x 8 x 16 mm", color=BOX_COLOUR, lw=1.2, ls="--")
    for period in (40, 80, 120):
        rise.axvline(period, color="0.9", lw=0.8, zorder=0)
    rise.set(xlabel="time [ms]", ylabel="rise [mm]")
    rise.tick_params(colors=INK)
    rise.legend(frameon=False, loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=2, columnspacing=1, handlelength=1.6,
                borderaxespad=0)
    plotting.clean(rise)
    figure.savefig(chosen.out, dpi=200)
    print(chosen.out)


if __name__ == "__main__":
    main()
