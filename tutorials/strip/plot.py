# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the strip's figure: its shapes on the platform for eight directions of the field.

    plot.py FOLDER --run [--out figure.png]     makes the eight runs (a minute or two), then draws
    plot.py FOLDER [--out figure.png]           draws from the runs of an earlier --run

The run of each direction is in FOLDER/DIRECTION, in degrees. Each panel has the shape at 20 mT
(dark) and at 5 mT (pale) on the ground, with the field's direction and the measures at 20 mT.
"""
import math
import pathlib

import matplotlib.pyplot as plt
import numpy as np

from magfsi import plotting
from magfsi.plotting import GREY

HERE = pathlib.Path(__file__).resolve().parent
LENGTH_MM = 3.7
DIRECTIONS = range(0, 360, 45)
SHADES = ((0.005, "0.78"), (0.02, "0.1"))  # fields in T, the last one measured


def make_runs(folder):
    for direction in DIRECTIONS:
        plotting.run(HERE / "scene.yaml", folder / str(direction),
                     [f"magnetic_field.table.direction={direction} deg"])


class Shape:
    """Side views of a run at the fields of SHADES and its measures at the last of them."""

    def __init__(self, folder):
        probes = plotting.read_columns(folder / "probes.csv")
        series = plotting.frames(folder)
        self.views = []
        for field, shade in SHADES:
            row = int(np.abs(probes["field[T]"] - field).argmin())
            time = probes["t[s]"][row]
            file = min(series, key=lambda entry: abs(entry[0] - time))[1]
            self.views.append((plotting.side_view_mm(file), shade))
        self.end_to_end = 1e3 * probes["strip.end_to_end[m]"][row] / LENGTH_MM
        self.rise = 1e3 * probes["strip.mid_rise[m]"][row] / LENGTH_MM
        self.bend_deg = math.degrees(probes["strip.bend[rad]"][row])
        middle = 0.5 * (probes["right_x[m]"] + probes["left_x[m]"])[row]
        self.shift_mm = 1e3 * middle - LENGTH_MM / 2
        self.turn_deg = plotting.heading_deg(probes)[row]

    def kind(self):
        return "V" if self.bend_deg > 0 else "C"


def draw_panel(axes, direction, shape):
    axes.fill_between([-0.6, 4.3], -0.3, 0, color="0.88", lw=0)
    axes.axhline(0, color=GREY, lw=0.8)
    for faces, shade in shape.views:
        plotting.draw_faces(axes, faces, shade)
    way = np.array([math.cos(math.radians(direction)), math.sin(math.radians(direction))])
    centre = np.array([0.05, 2.75])
    plotting.arrow(axes, centre + 0.5 * way, centre - 0.5 * way, "0.1", 1.2)
    axes.text(0.8, 2.75, f"B at {direction}°", fontsize=8, va="center")
    axes.text(4.3, 2.75, f"{shape.kind()}", fontsize=11, weight="bold", ha="right",
              va="center")
    minus = "\N{MINUS SIGN}"
    text = (f"ends {shape.end_to_end:.3f}   rise {shape.rise:+.3f}   "
            f"bend {shape.bend_deg:+.0f}°").replace("-", minus)
    axes.text(1.85, -0.62, text, fontsize=7, ha="center", va="center", color="0.25")
    axes.set(aspect="equal", xlim=(-0.6, 4.3), ylim=(-0.85, 3.35))
    axes.set_axis_off()


def draw(folder, out):
    plt.rcParams.update({"font.size": 8, "font.family": "DejaVu Sans"})
    figure, axes = plt.subplots(2, 4, figsize=(9.6, 4.6))
    print("direction  shape  end-to-end/L  rise/L  bend [deg]  line of ends [deg]")
    for room, direction in zip(axes.flat, DIRECTIONS):
        shape = Shape(folder / str(direction))
        draw_panel(room, direction, shape)
        print(f"{direction:9d}  {shape.kind():>5s}  {shape.end_to_end:12.4f}  "
              f"{shape.rise:+.4f}  {shape.bend_deg:+10.1f}  {shape.turn_deg:+.1f}")
    room = axes.flat[5]  # the 225 degrees leave most of theirs free
    room.plot([3.2, 4.2], [1.5, 1.5], color="0.1", lw=2, solid_capstyle="butt")
    room.text(3.7, 1.6, "1 mm", fontsize=7, ha="center", va="bottom")
    figure.text(0.01, 0.012, "dark: 20 mT, pale: 5 mT; ends: distance between the ends, "
                "rise: of the middle over the line of the ends, both over the length; "
                "bend: turn from the left end to the right one", fontsize=7, color=GREY)
    figure.subplots_adjust(0.01, 0.06, 0.99, 0.99, wspace=0.04, hspace=0.04)
    figure.savefig(out, dpi=200)


def main():
    chosen = plotting.figure_options(__doc__)
    if chosen.run:
        chosen.folder.mkdir(parents=True, exist_ok=True)
        make_runs(chosen.folder)
    draw(chosen.folder, chosen.out)
    print(chosen.out)


if __name__ == "__main__":
    main()
