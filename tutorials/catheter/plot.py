# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the tip of the catheter as the magnet comes over it, and its height beside that of a slender rod.

    plot.py RUN [--out figure.png]

--reference FILE writes what is drawn there.
"""
import argparse
import pathlib

import matplotlib.pyplot as plt
import numpy as np
import theory
from matplotlib.collections import PolyCollection

from magfsi import plotting
from magfsi.plotting import GREY, INK, LETTERS_PT, WIDTH_IN

BLUE, ORANGE = "#0072b2", "#d55e00"
SHAPES_S = (0, 0.2, 0.25, 0.3, 1.0)
COLUMNS = ("t[s]", "flow[m3/s]", "height[m]", "still[m]", "in_flow[m]")


def draw_vessel(axes, folder):
    middle, radius = 1e3 * theory.BASE[1], 1e3 * theory.RADIUS
    for way in (-1, 1):
        axes.axhline(middle + way * radius, color=INK, lw=2)
    shaft = 1e3 * theory.SHAFT
    axes.fill_between([0, 1e3 * theory.BASE[0]], middle - shaft, middle + shaft, color="0.6", lw=0)
    axes.annotate("shaft", (0.3, middle + shaft), (0, 3), textcoords="offset points", color=GREY)
    for time, file in plotting.nearest_frames(plotting.frames(folder), SHAPES_S):
        early = time <= theory.RAMP
        axes.add_collection(PolyCollection(plotting.side_view_mm(file), facecolors="0.93" if early else BLUE,
                                           edgecolors="0.6" if early else BLUE, lw=0.3, zorder=2 + time))
    axes.annotate("as the magnet\ncomes over it", (10.2, middle + 0.1), va="center", color=GREY)
    axes.annotate("at 1 s", (10, middle + 1.7), va="center", color=BLUE)
    axes.annotate("", (6, middle - 1.6), (1, middle - 1.6), arrowprops={"arrowstyle": "->", "color": GREY})
    axes.annotate("blood", (3, middle - 1.6), (0, 3), textcoords="offset points", color=GREY)
    axes.set(xlabel="x [mm]", ylabel="z [mm]", xlim=(0, 13), ylim=(0, 5.6), aspect="equal")
    plotting.clean(axes)


def courses(probes):
    """Rows of COLUMNS."""
    rows = []
    for time, flow, up in zip(probes["t[s]"], probes["before.flow[m3/s]"], probes["end_uz[m]"]):
        magnet = theory.magnet_at(time)
        still, moved = theory.bent(magnet), theory.bent_in_flow(magnet, flow)
        rows.append((time, flow, up, *(places[1, -1] - theory.BASE[1] for places, _ in (still, moved))))
    return np.array(rows)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("folder", type=pathlib.Path)
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("figure.png"))
    options.add_argument("--reference", type=pathlib.Path)
    chosen = options.parse_args()
    probes = plotting.read_columns(chosen.folder / "probes.csv")
    table = courses({name: values[::4] for name, values in probes.items()})
    time, flow, height, still, in_flow = table.T
    plt.rcParams.update({"font.size": LETTERS_PT, "font.family": "DejaVu Sans"})
    figure = plt.figure(figsize=(WIDTH_IN, 6.2), constrained_layout=True)
    figure.get_layout_engine().set(w_pad=0.08, wspace=0.05, hspace=0.06)
    rows = figure.add_gridspec(2, 1, height_ratios=(0.95, 1))
    vessel = figure.add_subplot(rows[0])
    heights, flows = rows[1].subgridspec(1, 2, width_ratios=(1.5, 1)).subplots()
    draw_vessel(vessel, chosen.folder)
    held = time > theory.RAMP - 0.08
    late = np.searchsorted(time, 0.8)
    for values, style, colour, text, to in ((still, ":", INK, "slender rod, no flow", (0, 5)),
                                            (in_flow, "--", ORANGE, "with White's drag", (10, 4)),
                                            (height, "-", BLUE, "simulated", (-8, -14))):
        heights.plot(time[held], 1e3 * values[held], ls=style, color=colour, lw=1.4)
        heights.annotate(text, (time[late], 1e3 * values[late]), to, textcoords="offset points", color=colour,
                         ha="right" if colour == BLUE else "left")
    heights.set(xlabel="time [s]", ylabel="end of the tip above\nthe middle [mm]", ylim=(1.3, 1.7))
    flows.plot(time, 1e6 * flow, color=BLUE, lw=1.4)
    flows.set(xlabel="time [s]", ylabel="flow [ml/s]", ylim=(0, None))
    for axes in (heights, flows):
        plotting.clean(axes)
    figure.savefig(chosen.out, dpi=200)
    print(chosen.out)
    if chosen.reference:
        chosen.reference.write_text("# Of scene.yaml.\n" + ",".join(COLUMNS) + "\n"
                                    + "".join(",".join(f"{v:.5g}" for v in row) + "\n" for row in table))


if __name__ == "__main__":
    main()
