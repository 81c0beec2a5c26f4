"""Runs and their results for the figures of the tutorials, and for yours.

    sys.path.insert(0, "tutorials")
    import results
    columns = results.read_columns("runs/strip/probes.csv")   # {"t[s]": array, ...}
    time_s, file = results.frames("runs/strip")[-1]           # of structure.pvd
    faces = results.side_view_mm(file)
"""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import xml.etree.ElementTree

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

TOP = pathlib.Path(__file__).resolve().parents[1]


def program():
    """./magfsi, or the magfsi of the folder $MAGFSI_BIN."""
    folder = os.environ.get("MAGFSI_BIN")
    return pathlib.Path(folder) / "magfsi" if folder else TOP / "magfsi"


def run(scene, folder, settings=()):
    """A run with settings ("key=value"); its last line of output. Ends the script if it fails."""
    words = [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run([program(), "run", scene, "--out", folder, *words],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{folder}: {done.stdout}{done.stderr}")
    return done.stdout.splitlines()[-1]


def read_columns(path):
    """Columns of a CSV file by name, as arrays; lines of comment begin with #."""
    with open(path, newline="") as file:
        names, *rows = list(csv.reader(line for line in file if not line.startswith("#")))
    values = np.array(rows, dtype=float).reshape(-1, len(names))
    return dict(zip(names, values.T))


def column(columns, name):
    if name not in columns:
        sys.exit(f"there is no column '{name}', but {', '.join(columns)}")
    return columns[name]


def frames(folder, collection="structure.pvd"):
    """[(time in s, file)] of a run's collection for ParaView."""
    path = pathlib.Path(folder) / collection
    entries = xml.etree.ElementTree.parse(path).iter("DataSet")
    return [(float(e.get("timestep")), path.parent / e.get("file")) for e in entries]


def side_view_mm(file):
    """The outer faces of a body, projected on the x-z plane: an array (faces, 4, 2)."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    surface = vtk.vtkGeometryFilter()
    surface.SetInputConnection(reader.GetOutputPort())
    surface.Update()
    skin = surface.GetOutput()
    faces = vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    return 1e3 * vtk_to_numpy(skin.GetPoints().GetData())[faces][:, :, [0, 2]]


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
