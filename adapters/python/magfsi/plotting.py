# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs and their results for the figures of the tutorials, and for yours.

    from magfsi import plotting
    columns = plotting.read_columns("runs/strip/probes.csv")   # {"t[s]": array, ...}
    time_s, file = plotting.frames("runs/strip")[-1]           # of structure.pvd
    faces = plotting.side_view_mm(file)
"""
import argparse
import pathlib
import sys

import matplotlib
import numpy as np
import vtk
from matplotlib.collections import PolyCollection
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import runs, units
from magfsi.runs import ROOT, frames  # noqa: F401

matplotlib.use("Agg")
INK, GREY = "0.1", "0.45"
WIDTH_IN, LETTERS_PT, SMALL_PT = 7.2, 10, 9  # of figures: on a page of 740 pixels letters are 13 to 14 high


def run(scene, folder, settings=()):
    """A runs.Run with settings ("key=value"), whose last line is printed. Ends the script if it
    fails."""
    done = runs.run(scene, folder, dict(s.split("=", 1) for s in settings))
    if done.code != 0:
        sys.exit(f"{folder}: {done.out}{done.err}")
    print(f"{pathlib.Path(folder).name}: {done.out.splitlines()[-1]}", flush=True)
    return done


def run_all(scenes, table, folder):
    """table: {name of a run: [scene file below `scenes`, settings ...]}."""
    for name, (scene, *settings) in table.items():
        run(scenes / scene, folder / name, settings)


def needed(path):
    """The path; ends the script where nothing is there."""
    if not pathlib.Path(path).exists():
        sys.exit(f"{path}: not there; --help says which runs this figure is of; ./magfsi plot RUN "
                 "draws any one run")
    return path


def read_columns(path):
    """Columns of a CSV file by name, as arrays; lines of comment begin with #."""
    return {name: np.array(values) for name, values in runs.read_table(needed(path), float).items()}


def column(columns, name):
    if name not in columns:
        sys.exit(f"there is no column '{name}', but {', '.join(columns)}")
    return columns[name]


def read_grid(file):
    """The vtkUnstructuredGrid or vtkImageData of one of a run's frames."""
    kinds = {".vtu": vtk.vtkXMLUnstructuredGridReader, ".vti": vtk.vtkXMLImageDataReader,
             ".pvti": vtk.vtkXMLPImageDataReader}
    reader = kinds[pathlib.Path(file).suffix]()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def side_view_mm(file):
    """The outer faces of a body, projected on the x-z plane: an array (faces, 4, 2)."""
    surface = vtk.vtkGeometryFilter()
    surface.SetInputData(read_grid(file))
    surface.Update()
    skin = surface.GetOutput()
    faces = vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    return 1e3 * vtk_to_numpy(skin.GetPoints().GetData())[faces][:, :, [0, 2]]


def draw_faces(axes, faces, shade=INK, edge=None, width=0.3, **more):
    axes.add_collection(PolyCollection(faces, facecolors=shade, edgecolors=edge or shade,
                                       linewidths=width, **more))


def clean(axes, *hidden):
    for side in ("top", "right", *hidden):
        axes.spines[side].set_visible(False)


def arrow(axes, tip, foot, colour=GREY, width=1.3):
    axes.annotate("", tip, foot, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": width})


def letters(figure, places):
    """places: {letter: (x, y)} of the panels, in shares of the figure."""
    for letter, (x, y) in places.items():
        figure.text(x, y, f"({letter})", weight="bold", fontsize=LETTERS_PT, va="center")


def heading_deg(probes, start="left", end="right"):
    """Of the line between two probe points in the x-z plane, without jumps of a turn."""
    rise = probes[f"{end}_z[m]"] - probes[f"{start}_z[m]"]
    run = probes[f"{end}_x[m]"] - probes[f"{start}_x[m]"]
    return np.degrees(np.unwrap(np.arctan2(rise, run)))


def seconds(text):
    """'160 ms' or '0.16 s' as a number, for options of a script."""
    time = units.parse(text)
    if not time or time[1] != "s":
        raise argparse.ArgumentTypeError(f"'{text}': write a time as '160 ms' or '0.16 s'")
    return time[0]


def nearest_frames(series, wanted_s):
    """The stored frame nearest to each instant, each frame once."""
    times = np.array([time for time, _ in series])
    nearest = {int(np.abs(times - t).argmin()) for t in wanted_s}
    return [series[i] for i in sorted(nearest)]


def centred(faces, axes):
    """Faces with the middle of their extent at 0 along some axes."""
    points = faces.reshape(-1, 2)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    shift = np.zeros(2)
    shift[axes] = middle[axes]
    return faces - shift


def figure_options(description):
    """FOLDER [--run] [--out figure.png], parsed."""
    options = argparse.ArgumentParser(description=description.splitlines()[0])
    options.add_argument("folder", type=pathlib.Path)
    options.add_argument("--run", action="store_true", help="make the runs first")
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("figure.png"))
    return options.parse_args()
