# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the steered strip: where it is against where it is to be, the field that does it, its shapes.

    plot.py RUN [--out figure.png]
"""
import importlib.util
import pathlib

import matplotlib.pyplot as plt
import numpy as np

from magfsi import plot, plotting
from magfsi.plotting import GREY
from magfsi.report import data

HERE = pathlib.Path(__file__).resolve().parent
COLOURS = {"x": "#d55e00", "y": "#009e73", "z": "#0072b2"}


def controller():
    spec = importlib.util.spec_from_file_location("steer", HERE / "steer.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.Controller()


def draw_course(axes, probes, time_ms):
    target = np.array([controller().target(1e-3 * t) for t in time_ms])
    for i, axis in enumerate("xz"):
        axes.plot(time_ms, 1e3 * probes[f"strip.com_{axis}[m]"], color=COLOURS[axis], lw=1.4, label=axis)
        axes.plot(time_ms, 1e3 * target[:, i], color=COLOURS[axis], lw=0.8, ls="--")
    axes.set(xlabel="time [ms]", ylabel="centre of mass [mm], dashed: aim")
    axes.legend(frameon=False)
    plotting.clean(axes)


def draw_field(axes, probes, time_ms):
    for axis in "xyz":
        axes.step(time_ms, 1e3 * probes[f"field_{axis}[T]"], color=COLOURS[axis], lw=1.2,
                  label=f"B{axis}")
    axes.set(xlabel="time [ms]", ylabel="field [mT]")
    axes.legend(frameon=False, loc=(0.03, 0.56))
    plotting.clean(axes)


def main():
    chosen = plotting.figure_options(__doc__)
    probes = plotting.read_columns(chosen.folder / "probes.csv")
    time_ms = 1e3 * probes["t[s]"]
    plt.rcParams.update({"font.size": 8, "font.family": "DejaVu Sans"})
    figure, (course, field, shapes) = plt.subplots(1, 3, figsize=(10.5, 3.4), constrained_layout=True)
    draw_course(course, probes, time_ms)
    draw_field(field, probes, time_ms)
    found, faces, body = plot.views(chosen.folder)
    scene = data.read_json(chosen.folder / "scene.json", {})
    scene.setdefault("magnetic_field", {})["plane"] = "xz"
    plot.draw_shapes(shapes, scene, found, faces, body)
    shapes.plot([6], [6], "+", color=GREY)
    figure.savefig(chosen.out, dpi=150)
    print(chosen.out)


if __name__ == "__main__":
    main()
