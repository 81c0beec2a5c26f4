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
from magfsi.plotting import GREY, LETTERS_PT, SMALL_PT, WIDTH_IN

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
    axes.text(0.8, 2.75, f"B at {direction}°", va="center")
    axes.text(4.3, 2.75, f"{shape.kind()}", fontsize=13, weight="bold", ha="right",
              va="center")
    minus = "\N{MINUS SIGN}"
    text = (f"ends {shape.end_to_end:.3f}   rise {shape.rise:+.3f}\n"
            f"bend {shape.bend_deg:+.0f}°").replace("-", minus)
    axes.text(1.85, -0.42, text, fontsize=SMALL_PT, ha="center", va="top", color="0.25")
    axes.set(aspect="equal", xlim=(-0.6, 4.3), ylim=(-1.35, 3.35))
    axes.set_axis_off()


def draw(folder, out):
    plt.rcParams.update({"font.size": LETTERS_PT, "font.family": "DejaVu Sans"})
    figure, axes = plt.subplots(3, 3, figsize=(WIDTH_IN, 7.0))
    print("direction  shape  end-to-end/L  rise/L  bend [deg]  line of ends [deg]")
    for room, direction in zip(axes.flat, DIRECTIONS):
        shape = Shape(folder / str(direction))
        draw_panel(room, direction, shape)
        print(f"{direction:9d}  {shape.kind():>5s}  {shape.end_to_end:12.4f}  "
              f"{shape.rise:+.4f}  {shape.bend_deg:+10.1f}  {shape.turn_deg:+.1f}")
    room = axes.flat[-1]
    room.set(aspect="equal", xlim=(-0.6, 4.3), ylim=(-1.35, 3.35))
    room.set_axis_off()
    room.plot([0, 1], [2.75, 2.75], color="0.1", lw=2, solid_capstyle="butt")
    room.text(1.2, 2.75, "1 mm", fontsize=SMALL_PT, va="center")
    room.text(0, 2.3, "dark: 20 mT, pale: 5 mT\nends: distance between\nthe ends, over the length\n"
              "rise: of the middle over\nthe line of the ends,\nover the length\n"
              "bend: turn from the left\nend to the right one", fontsize=SMALL_PT, color=GREY, va="top", linespacing=1.25)
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.99, wspace=0.04, hspace=0.04)
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
