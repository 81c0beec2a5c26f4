# SPDX-License-Identifier: GPL-2.0-or-later
"""Magnetisation as the bodies carry it: arrows, and a colour for each direction in a plane, as
micromagnetics draws it (OOMMF, mumax3): the hue is the direction, paler is weaker or out of the plane."""
import matplotlib
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from magfsi.drawing import actors
from magfsi.plotting import read_grid
from magfsi.report import fields

CARRIED, AT_REST = "magnetization[A/m]", "magnetization_at_rest[A/m]"
ARROWS_ALONG = 11  # of the largest extent of the bodies
LONG = 0.95  # of the distance of arrows, where the magnetisation is largest
BRIGHT = 0.92


def colours(first, second, largest):
    """(..., 3) from 0 to 255 of vectors with these components in the plane."""
    hue = np.arctan2(second, first) / (2 * np.pi) % 1
    strong = np.clip(np.hypot(first, second) / largest, 0, 1)
    hsv = np.stack([hue, 0.9 * strong, np.full_like(hue, BRIGHT)], axis=-1)
    return 255 * matplotlib.colors.hsv_to_rgb(hsv)


class Magnetisation:
    """Of the faces of a run's bodies. `plane`: two of the letters x, y, z; `largest` [A/m];
    `carried`: turned with the bodies, or, where the files lack that, as it was at rest."""

    def __init__(self, folder, scene, field):
        """field: over time (instants, 3); None without one."""
        self.stored = fields.stored_frames(folder, "structure.pvd")
        self.times = np.array([t for t, _ in self.stored])
        self.elements, self.known, self.largest = None, {}, 0.0
        if not self.stored:
            return
        grid = read_grid(self.stored[0][1][0])
        self.carried = grid.GetCellData().HasArray(CARRIED) == 1
        self.elements = fields.surface(grid)[1]
        first = self.of_faces(self.times[0])
        if first is None:
            return
        self.largest = float(np.linalg.norm(first, axis=1).max())
        # The plane in which the field turns, or else that of the field, or that of the magnetisation.
        known = scene.get("magnetic_field", {}).get("plane", "")
        weight = (np.ptp(first, axis=0) + 0.1 * np.abs(first).max(axis=0)) / max(self.largest, 1e-300)
        weight += [0.5 * (axis in known) for axis in "xyz"]
        if field is not None:
            weight += 3 * np.ptp(field, axis=0) / np.abs(field).max()
        self.across = sorted(np.argsort(weight)[1:])
        self.plane = "".join("xyz"[a] for a in self.across)

    def of_faces(self, time):
        """(faces, 3) of the last frame that is not after the time [A/m]; None without."""
        i = max(0, int(np.searchsorted(self.times, time * (1 + 1e-9) + 1e-12, "right")) - 1)
        if i not in self.known:
            data = read_grid(self.stored[i][1][0]).GetCellData()
            values = fields.array(data, CARRIED, AT_REST, "magnetization")
            self.known = {i: None if values is None else values[self.elements]}
        return self.known[i]

    def face_colours(self, time):
        found = self.of_faces(time)[:, self.across]
        return colours(found[:, 0], found[:, 1], self.largest)


def apart(points, distance):
    """Numbers of points of which no two are nearer to each other."""
    chosen = []
    for i, point in enumerate(points):
        if all(np.linalg.norm(points[chosen] - point, axis=1) > distance) if chosen else True:
            chosen.append(i)
    return np.array(chosen)


class Arrows:
    """One on some of the faces; drawn over all that lies before it."""

    def __init__(self, centres):
        self.distance = np.ptp(centres, axis=0).max() / ARROWS_ALONG
        self.chosen = apart(centres, self.distance)
        self.data = vtk.vtkPolyData()
        self.data.SetPoints(vtk.vtkPoints())
        shape = vtk.vtkArrowSource()
        shape.SetTipLength(0.4)
        shape.SetTipRadius(0.17)
        shape.SetShaftRadius(0.055)
        self.glyphs = vtk.vtkGlyph3D()
        self.glyphs.SetInputData(self.data)
        self.glyphs.SetSourceConnection(shape.GetOutputPort())
        self.glyphs.SetVectorModeToUseVector()
        self.glyphs.SetScaleModeToScaleByVector()
        self.glyphs.OrientOn()
        self.actor = actors.actor(self.glyphs, (0.08, 0.08, 0.1), ambient=0.7, diffuse=0.3)

    def move(self, centres, vectors, largest):
        """The middle of an arrow is where its face is."""
        shown = vectors[self.chosen] * (LONG * self.distance / largest)
        self.glyphs.SetScaleFactor(1.0)
        self.data.GetPoints().SetData(numpy_to_vtk(centres[self.chosen] - shown / 2, deep=True))
        self.data.GetPointData().SetVectors(numpy_to_vtk(np.ascontiguousarray(shown, float), deep=True))
        self.data.Modified()
