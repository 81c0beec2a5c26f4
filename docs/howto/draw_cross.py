# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws docs/howto/cross.png: the cross at rest, in half and in all of its field.

    ./magfsi python docs/howto/draw_cross.py runs/cross [cross.png]
"""
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from magfsi import plotting

run, file = sys.argv[1], (sys.argv + ["cross.png"])[2]
figure = plt.figure(figsize=(7.2, 2.4))
for column, (time_s, path) in enumerate(plotting.frames(run)):
    axes = figure.add_subplot(1, 3, column + 1, projection="3d", computed_zorder=False)
    surface = plotting.vtk.vtkGeometryFilter()
    reader = plotting.vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    surface.SetInputConnection(reader.GetOutputPort())
    surface.Update()
    data = surface.GetOutput()
    faces = [np.array([data.GetPoint(data.GetCell(c).GetPointId(i)) for i in range(4)]) * 1e3
             for c in range(data.GetNumberOfCells())]
    axes.add_collection3d(Poly3DCollection(faces, facecolor="#9ec5e8", edgecolor="#274b6d",
                                           linewidth=0.3))
    axes.set(xlim=(-3, 3), ylim=(-3, 3), zlim=(0, 2.6))
    # At rest it is widest: the whole of it is within the frame.
    axes.set_box_aspect((6, 6, 2.6), zoom=1.35)
    axes.set_axis_off()
    axes.view_init(28, -60)
    axes.set_title(f"{8 * time_s:g} mT", y=0.9, fontsize=9)
figure.subplots_adjust(0, 0, 1, 1, 0, 0)
figure.savefig(file, dpi=160)
