# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the figure of the turning strip from a folder of runs.

    plot.py --run FOLDER               makes the four runs in it
    plot.py FOLDER [--out figure.png]  draws them, and prints what it finds

(a) side views: the C in the field's four directions, and the V that the last of them makes of a
flat strip; (b) heading of the strip against the field's direction.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy as np

from magfsi import plotting
from magfsi.plotting import GREY, INK, LETTERS_PT, SMALL_PT, WIDTH_IN, draw_faces, heading_deg

HERE = pathlib.Path(__file__).resolve().parent
RUNS = {
    "turned": ["scene.yaml"],
    "flat": ["scene.yaml", "magnetic_field.table.direction=90 deg",
             "time.end=1 s"],
    "motion": ["motion.yaml"],
    "platform": ["platform.yaml"],
}
NANO = 1e9


def side_view_mm(run, frame):
    """Outer faces in the x-z plane about their middle: (faces, 4, 2)."""
    return plotting.centred(plotting.side_view_mm(plotting.frames(run)[frame][1]), [0, 1])


def draw_views(axes, runs):
    views = [(side_view_mm(runs / "turned", k), angle)
             for k, angle in enumerate((225, 180, 135, 90))]
    views.append((side_view_mm(runs / "flat", -1), 90))
    names = ("C, released", "turned", "turned", "turned", "from flat")
    pitch = 3.2
    for k, (faces, angle) in enumerate(views):
        x = k * pitch + (0.5 if k == 4 else 0)
        draw_faces(axes, faces + [x, 0])
        step = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
        foot = np.array([x, 2.2])
        plotting.arrow(axes, foot + 0.45 * step, foot - 0.45 * step)
        axes.text(x, 2.85, f"{angle}\N{DEGREE SIGN}", ha="center", fontsize=LETTERS_PT)
        axes.text(x, -1.75, names[k], ha="center", fontsize=SMALL_PT, color=GREY)
    axes.axvline(3.5 * pitch + 0.25, color="0.8", lw=0.8)
    axes.text(-2.6, 2.2, "field", fontsize=SMALL_PT, color=GREY, va="center")
    axes.plot([-2.5, -1.5], [-1.65, -1.65], color=INK, lw=2, solid_capstyle="butt")
    axes.text(-2.0, -1.5, "1 mm", ha="center", fontsize=SMALL_PT)
    axes.set(xlim=(-2.9, 4 * pitch + 2.2), ylim=(-2.0, 3.3), aspect="equal")
    axes.axis("off")


def draw_heading(axes, found):
    turned = found["turned"]
    angle = np.interp(turned["t[s]"], [0, 1, 2, 3], [225, 180, 135, 90])
    axes.plot(angle, heading_deg(turned), color=INK, lw=1.2)
    axes.text(225, -80, "line: Newton", fontsize=SMALL_PT, ha="left")
    motion = found["motion"]
    rest = np.isin(np.round(motion["t[s]"], 4), (0.1, 0.25, 0.4, 0.6))
    axes.plot([225, 180, 135, 90], heading_deg(motion)[rest], "o", ms=7, mfc="none", mec=INK)
    axes.text(225, -100, "circles: motion in time, at rest", fontsize=SMALL_PT, ha="left")
    platform = found["platform"]
    held = platform["t[s]"] >= 1 - 1e-9
    angle = np.interp(platform["t[s]"], [1, 2, 3, 4], [225, 180, 135, 90])
    axes.plot(angle[held], heading_deg(platform)[held], "+", ms=6, color=INK)
    axes.text(225, -120, "crosses: on a platform, with weight", fontsize=SMALL_PT, ha="left")
    flat = heading_deg(found["flat"])[-1]
    axes.plot([90], [flat], "D", ms=5, mfc="white", mec=INK)
    axes.text(93, flat, "V from flat", fontsize=SMALL_PT, ha="right", va="center")
    axes.set(xlim=(232, 83), xticks=[225, 180, 135, 90], ylim=(-150, 60),
             yticks=[-135, -90, -45, 0, 45], xlabel="direction of the field [\N{DEGREE SIGN}]",
             ylabel="heading of the line\nbetween the ends [\N{DEGREE SIGN}]")
    plotting.clean(axes)


def report(found):
    for name, probes in found.items():
        heading, middle = heading_deg(probes), heading_deg(probes, "before", "after")
        for k in range(len(heading)):
            if name == "motion" and round(1e3 * probes["t[s]"][k]) not in (100, 250, 400, 600):
                continue
            elastic = NANO * probes["strip.energy_elastic[J]"][k]
            work = NANO * probes["strip.work_magnetic[J]"][k]
            print(f"{name:9s} t {probes['t[s]'][k]:5.3g} s: end to end "
                  f"{1e3 * probes['strip.end_to_end[m]'][k]:.4f} mm, bend "
                  f"{np.degrees(probes['strip.bend[rad]'][k]):8.2f}, heading {heading[k]:8.2f}, "
                  f"middle {middle[k]:8.2f} degrees, elastic {elastic:.1f} nJ, work of the "
                  f"field {work:.1f} nJ")


def main():
    chosen = plotting.figure_options(__doc__)
    if chosen.run:
        plotting.run_all(HERE, RUNS, chosen.folder)
    found = {name: plotting.read_columns(chosen.folder / name / "probes.csv") for name in RUNS}
    report(found)
    plt.rcParams.update({"font.size": LETTERS_PT, "axes.linewidth": 0.6})
    figure = plt.figure(figsize=(WIDTH_IN, 4.7))
    draw_views(figure.add_axes([0.02, 0.53, 0.97, 0.46]), chosen.folder)
    draw_heading(figure.add_axes([0.13, 0.1, 0.8, 0.4]), found)
    plotting.letters(figure, {"a": (0.01, 0.97), "b": (0.01, 0.52)})
    figure.savefig(chosen.out, dpi=200)
    print(chosen.out)


if __name__ == "__main__":
    main()
