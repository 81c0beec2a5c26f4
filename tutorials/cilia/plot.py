# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the beat of a cilium from two sides, and what it has pumped, beside theory.

    plot.py RUN [--out figure.png]

--reference FILE writes what is drawn there.
"""
import argparse
import json
import pathlib

import beat
import matplotlib.pyplot as plt
import numpy as np

from magfsi import plotting
from magfsi.plotting import GREY, INK

BLUE, ORANGE = "#0072b2", "#d55e00"
SHAPES = 20
COLUMNS = ("t[s]", "flow[m3/s]", "by_forces[m3/s]", "by_motion[m3/s]")


def draw_shapes(axes, axis, last, name):
    """The middle line over a beat; the way along x, upright, dark, and the way back pale."""
    every = len(last.time) // SHAPES
    tip_speed = np.gradient(last.line[:, -1, 0])
    for i in range(0, len(last.time), every):
        forth = tip_speed[i] > 0
        axes.plot(1e3 * last.line[i, :, axis], 1e3 * last.line[i, :, 2],
                  color=BLUE if forth else ORANGE, lw=1.3, ls="-" if forth else "--")
    axes.plot(1e3 * last.line[:, -1, axis], 1e3 * last.line[:, -1, 2], color=GREY, lw=0.6)
    axes.axhline(0, color=INK, lw=1.5)
    axes.set(xlabel=f"{name} [mm]", ylabel="z [mm]", aspect="equal", ylim=(-0.05, 0.95))
    plotting.clean(axes)


def draw_pumped(axes, last, by_motion):
    step = last.time[1] - last.time[0]
    since = step * (np.arange(len(last.time)) + 1)
    every = len(last.time) // len(by_motion)
    volume = np.cumsum(last.flow) * step * 1e12
    axes.plot(since, volume, color=BLUE, lw=1.5)
    theory = np.cumsum(by_motion) * step * every * 1e12
    axes.plot(since[every - 1::every], theory, color=ORANGE, lw=1.2, ls="--")
    axes.axhline(0, color="0.8", lw=0.8, zorder=0)
    late = np.searchsorted(since, 0.66 * since[-1])
    axes.annotate("measured", (since[late], volume[late]), (8, -4), textcoords="offset points", color=BLUE)
    low = theory.argmin()
    axes.annotate("slender-body theory\nfrom the motion", (since[every - 1::every][low], theory[low]), (0, -6),
                  textcoords="offset points", color=ORANGE, ha="center", va="top")
    axes.annotate(f"a beat\n{volume[-1]:.0f} nl", (since[-1], volume[-1]), (5, 0), textcoords="offset points",
                  color=BLUE, va="center")
    axes.margins(y=0.2)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("folder", type=pathlib.Path)
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("figure.png"))
    options.add_argument("--reference", type=pathlib.Path)
    chosen = options.parse_args()
    scene = json.loads((chosen.folder / "scene.json").read_text())
    frequency = scene["magnetic_field"]["precession"]["frequency"]
    last = beat.last_beat(chosen.folder, frequency)
    by_motion, by_forces = last.by_motion(), last.by_forces()
    for name, flow in (("measured", last.flow), ("by the forces on the fluid", by_forces),
                       ("by slender-body theory from the motion", by_motion)):
        print(f"mean flow {name}: {1e9 * flow.mean():.4f} ul/s")
    print(f"of a straight rod on the field's cone, by resistances: {1e9 * beat.straight_rod(frequency):.4f} ul/s")
    plt.rcParams.update({"font.size": plotting.LETTERS_PT, "font.family": "DejaVu Sans"})
    figure, places = plt.subplot_mosaic([["side", "front"], ["pumped", "pumped"]], constrained_layout=True,
                                        figsize=(plotting.WIDTH_IN, 6), width_ratios=(1, 1.2))
    side, front, pumped = (places[name] for name in ("side", "front", "pumped"))
    draw_shapes(side, 1, last, "y")
    draw_shapes(front, 0, last, "x")
    draw_pumped(pumped, last, by_motion)
    pumped.set(xlabel="time in the beat [s]", ylabel="pumped through the cell [nl]")
    plotting.clean(pumped)
    figure.savefig(chosen.out, dpi=200)
    print(chosen.out)
    if chosen.reference:
        rows = zip(last.time[::2], last.flow[::2], by_forces[::2], by_motion)
        chosen.reference.write_text("# The last beat of scene.yaml.\n" + ",".join(COLUMNS) + "\n"
                                    + "".join(",".join(f"{v:.5g}" for v in row) + "\n" for row in rows))


if __name__ == "__main__":
    main()
