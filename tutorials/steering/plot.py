# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the steered strip: where it is against where it is to be, the field that does it, its shapes.

    plot.py RUN [--out figure.png]
"""
import importlib.util
import pathlib

import matplotlib.pyplot as plt
import numpy as np

from magfsi import curves, plot, plotting
from magfsi.report import data

HERE = pathlib.Path(__file__).resolve().parent
COLOURS = {"x": "#d55e00", "y": "#777777", "z": "#0072b2"}
ABOVE = {"frameon": False, "loc": "lower left", "bbox_to_anchor": (-0.05, 1.0), "borderaxespad": 0, "ncols": 4,
         "columnspacing": 0.8, "handlelength": 1.3, "handletextpad": 0.4, "fontsize": plotting.SMALL_PT}


def controller():
    spec = importlib.util.spec_from_file_location("steer", HERE / "steer.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.Controller()


def draw_course(axes, probes, time_ms):
    target = np.array([controller().target(1e-3 * t) for t in time_ms])
    for i, axis in enumerate("xz"):
        axes.plot(time_ms, 1e3 * probes[f"strip.com_{axis}[m]"], color=COLOURS[axis], lw=1.4, label=axis)
    # Both aims are one course: a wide dash under a narrow one.
    for i, (axis, width) in enumerate((("x", 2.2), ("z", 0.9))):
        axes.plot(time_ms, 1e3 * target[:, i], color=COLOURS[axis], lw=width, ls="--", alpha=0.7, label=f"aim of {axis}")
    axes.set(xlabel="time [ms]", ylabel="centre of mass [mm]")
    axes.legend(**ABOVE)
    plotting.clean(axes)


def draw_field(axes, probes, time_ms):
    for axis in "xyz":
        axes.step(time_ms, 1e3 * probes[f"field_{axis}[T]"], color=COLOURS[axis], lw=1.2,
                  label=f"B{axis}")
    axes.set(xlabel="time [ms]", ylabel="field [mT]")
    axes.legend(**ABOVE)
    plotting.clean(axes)


def main():
    chosen = plotting.figure_options(__doc__)
    probes = plotting.read_columns(chosen.folder / "probes.csv")
    time_ms = 1e3 * probes["t[s]"]
    plt.rcParams.update({"font.size": plotting.LETTERS_PT, "font.family": "DejaVu Sans"})
    figure = plt.figure(figsize=(plotting.WIDTH_IN, 6.4), constrained_layout=True)
    figure.get_layout_engine().set(wspace=0.05, hspace=0.06)
    rows = figure.add_gridspec(2, 1, height_ratios=(1, 1.15))
    course, field = rows[0].subgridspec(1, 2).subplots()
    shapes = figure.add_subplot(rows[1])
    draw_course(course, probes, time_ms)
    draw_field(field, probes, time_ms)
    found, faces, body = plot.views(chosen.folder)
    scene = data.read_json(chosen.folder / "scene.json", {})
    scene.setdefault("magnetic_field", {})["plane"] = "xz"
    across = plot.draw_shapes(shapes, scene, found, faces, body)
    plot.draw_instants(shapes, curves.Probes(chosen.folder), found, across, field=False)
    shapes.plot([6], [6], "+", color="k", ms=9, zorder=9)
    shapes.annotate("start", (6, 6), xytext=(8, -14), textcoords="offset points",
                    bbox={"color": "white", "pad": 1.5, "alpha": 0.85}, zorder=9)
    figure.savefig(chosen.out, dpi=200)
    print(chosen.out)


if __name__ == "__main__":
    main()
