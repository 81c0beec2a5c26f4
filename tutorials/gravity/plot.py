# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the figure of the strip that stands up against its weight, from a folder of runs.

    plot.py --run FOLDER               makes the runs in it
    plot.py FOLDER [--out figure.png]  draws them, and prints what it finds

(a) side views at 20 mT; (b) heading of the strip against the field for four weights; (c) heading
of its middle under 1 g with other meshes, friction and field directions.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy as np

from magfsi import plotting, runs
from magfsi.plotting import GREY, INK, clean, draw_faces, heading_deg

HERE = pathlib.Path(__file__).resolve().parent
WEIGHTS = {"0g": "0 g", "half": "g/2", "1g": "1 g", "2g": "2 g"}
COARSE = ["probes.every=1 s", "output="]
RUNS = {
    "0g": ["weightless.yaml"],
    "half": ["scene.yaml", "gravity.acceleration=4.905 m/s2"],
    "1g": ["scene.yaml"],
    "2g": ["scene.yaml", "gravity.acceleration=19.62 m/s2"],
    "fine": ["scene.yaml", "bodies.strip.mesh.box.elements=[40, 4, 1]", *COARSE],
    "wide": ["scene.yaml", "bodies.strip.mesh.box.elements=[20, 8, 1]", *COARSE],
    "smooth": ["scene.yaml", "platform.friction=", *COARSE],
    "at130": ["scene.yaml", "magnetic_field.table.direction=130 deg", *COARSE],
    "at140": ["scene.yaml", "magnetic_field.table.direction=140 deg", *COARSE],
}
STANDING_DEG = 30  # the heading jumps from about 13 to 50 degrees or more


class Path:
    """Headings along a path of rising field."""

    def __init__(self, run):
        self.probes = plotting.read_columns(run / "probes.csv")
        self.field_mt = 1e3 * self.probes["field[T]"]
        self.heading = heading_deg(self.probes)
        self.middle = heading_deg(self.probes, "before", "after")

    def stands_between_mt(self):
        """Last field at which it lies, and first at which it stands."""
        standing = np.flatnonzero(self.heading > STANDING_DEG)
        if standing.size == 0:
            return None
        first = standing[0]
        return (self.field_mt[first - 1] if first else 0.0), self.field_mt[first]


def side_view_mm(run):
    """Outer faces of the last state in the x-z plane, its middle at x = 0: (faces, 4, 2)."""
    return plotting.centred(plotting.side_view_mm(plotting.frames(run)[-1][1]), [0])


def draw_views(axes, folder):
    for k, (name, label) in enumerate(WEIGHTS.items()):
        faces = side_view_mm(folder / name)
        if name == "0g":
            faces = faces - [0, faces[:, :, 1].min() - 0.4]
        x = 3.6 * k
        draw_faces(axes, faces + [x, 0])
        axes.text(x, -0.55, label, ha="center", va="top", fontsize=8)
        if name != "0g":
            axes.plot([x - 1.5, x + 1.5], [-0.03, -0.03], color=GREY, lw=1.5)
    plotting.arrow(axes, (-2.9, 2.1), (-2.2, 1.4))
    axes.text(-2.55, 2.4, "field", ha="center", fontsize=7, color=GREY)
    axes.plot([-3.0, -2.0], [0, 0], color=INK, lw=2, solid_capstyle="butt")
    axes.text(-2.5, 0.15, "1 mm", ha="center", fontsize=7)
    axes.set(xlim=(-3.3, 12.9), ylim=(-1.2, 3.2), aspect="equal")
    axes.axis("off")


def draw_weights(axes, paths):
    reference = runs.read_rows(HERE / "reference.csv")
    for g in ("0.5", "1", "2"):
        rows = [r for r in reference if r["g"] == g and r["source"] == "solid 40x4x2"]
        axes.plot([float(r["B_mT"]) for r in rows[1::2]],
                  [float(r["heading_deg"]) for r in rows[1::2]], "x", ms=3, color=GREY, mew=0.7,
                  zorder=3)
    places = {"0g": (20.3, 79), "half": (20.3, 71.5), "1g": (20.3, 64), "2g": (20.3, 48)}
    for name, label in WEIGHTS.items():
        axes.plot(paths[name].field_mt, paths[name].heading, color=INK, lw=1.3, zorder=2)
        axes.text(*places[name], label, va="center", fontsize=8)
    axes.plot([5, 6.25, 20], [90, 60, 0], "s", ms=5, mfc="white", mec=INK, zorder=3,
              clip_on=False)
    for x, y, text, ha, va in ((4.6, 95, "paper: 0 g", "left", "bottom"),
                               (7.0, 50, "paper: g/2", "left", "top"),
                               (19.5, 3, "paper: 1 g", "right", "bottom")):
        axes.text(x, y, text, ha=ha, va=va, fontsize=7)
    axes.set(xlim=(0, 20), ylim=(0, 105), xticks=range(0, 21, 5), yticks=range(0, 91, 30),
             xlabel="field [mT]", ylabel="heading, end to end [\N{DEGREE SIGN}]")
    axes.text(10.5, 18, "crosses: finite elements", fontsize=7, color=GREY)
    clean(axes)


def draw_variants(axes, paths):
    for name, style in (("1g", {"color": INK, "lw": 1.3}),
                        ("at130", {"color": GREY, "lw": 1, "ls": ":"}),
                        ("at140", {"color": GREY, "lw": 1, "ls": ":"})):
        axes.plot(paths[name].field_mt, paths[name].middle, **style)
    for name, mark in (("fine", "+"), ("smooth", "o")):
        axes.plot(paths[name].field_mt, paths[name].middle, mark, ms=4.5, mfc="none", mec=INK,
                  mew=0.8)
    axes.text(20.3, 47, "140\N{DEGREE SIGN}", va="center", fontsize=7.5)
    axes.text(20.3, 38, "135\N{DEGREE SIGN}", va="center", fontsize=7.5)
    axes.text(20.3, 29, "130\N{DEGREE SIGN}", va="center", fontsize=7.5)
    axes.text(8.2, 18, "crosses: 40 elements\ncircles: no friction\nall under 1 g",
              fontsize=7.5, va="center")
    axes.axhline(0, color="0.8", lw=0.6)
    axes.set(xlim=(0, 20), ylim=(-15, 90), xticks=range(0, 21, 5), yticks=range(0, 91, 30),
             xlabel="field [mT]", ylabel="heading of the middle [\N{DEGREE SIGN}]")
    clean(axes)


def report(paths):
    for name, path in paths.items():
        stands = path.stands_between_mt()
        where = f"stands between {stands[0]:g} and {stands[1]:g} mT" if stands else "lies"
        figures = "; ".join(f"{b} mT: {np.interp(b, path.field_mt, path.heading):.1f}, middle "
                            f"{np.interp(b, path.field_mt, path.middle):.1f}"
                            for b in (5, 10, 20))
        print(f"{name:7s} {where}; heading at {figures} degrees")


def main():
    chosen = plotting.figure_options(__doc__)
    if chosen.run:
        plotting.run_all(HERE, RUNS, chosen.folder)
    paths = {name: Path(chosen.folder / name) for name in RUNS}
    report(paths)
    plt.rcParams.update({"font.size": 8, "axes.linewidth": 0.6})
    figure = plt.figure(figsize=(7.2, 4.8))
    draw_views(figure.add_axes([0.03, 0.6, 0.94, 0.4]), chosen.folder)
    draw_weights(figure.add_axes([0.075, 0.1, 0.375, 0.46]), paths)
    draw_variants(figure.add_axes([0.575, 0.1, 0.375, 0.46]), paths)
    plotting.letters(figure, {"a": (0.01, 0.97), "b": (0.01, 0.59), "c": (0.51, 0.59)})
    figure.savefig(chosen.out, dpi=200)
    print(chosen.out)


if __name__ == "__main__":
    main()
