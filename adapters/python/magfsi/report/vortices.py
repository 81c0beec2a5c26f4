# SPDX-License-Identifier: GPL-2.0-or-later
"""Surfaces of equal |curl u| at stored instants, those of `render`, with as few triangles as a page has room for."""
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from magfsi.drawing import actors
from magfsi.report import fields
from magfsi.report.fields import packed

MOST_INSTANTS = 24
MOST_TRIANGLES = 2000  # of all levels of an instant
# A triangle has three numbers of two bytes, and half a point of three, more where surfaces end; base64 takes four
# characters for three bytes.
BYTES_A_TRIANGLE = (6 + 3.8) * 4 / 3


def thinned(surfaces):
    """[(points, triangles)] of VTK's surfaces, with the same share of the triangles of each."""
    count = sum(surface.GetNumberOfCells() for surface in surfaces)
    made = []
    for surface in surfaces:
        if count > MOST_TRIANGLES and surface.GetNumberOfCells():
            # Triangles without an area, which contours have at points of the grid, end decimation early.
            clean = vtk.vtkCleanPolyData()
            clean.SetInputData(surface)
            triangles = vtk.vtkTriangleFilter()
            triangles.SetInputConnection(clean.GetOutputPort())
            triangles.PassLinesOff()
            triangles.PassVertsOff()
            fewer = vtk.vtkQuadricDecimation()
            fewer.SetInputConnection(triangles.GetOutputPort())
            fewer.SetTargetReduction(1 - MOST_TRIANGLES / count)
            fewer.Update()
            surface = fewer.GetOutput()
        triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        # Decimation leaves points that no triangle has.
        used, triangles = np.unique(triangles, return_inverse=True)
        points = vtk_to_numpy(surface.GetPoints().GetData())[used] if len(used) else np.zeros((0, 3))
        made.append((points, triangles.reshape(-1, 3)))
    return made


def one_instant(files, levels):
    """Surfaces of each level in turn, all of them in one list of points."""
    surfaces = []
    for surface in actors.vortex_surfaces(files, [value for value, _, _ in levels]):
        surface.Update()
        surfaces.append(surface.GetOutput())
    made = thinned(surfaces) or [(np.zeros((0, 3)), np.zeros((0, 3), int))] * len(levels)
    before = np.cumsum([0] + [len(points) for points, _ in made])
    return (np.concatenate([points for points, _ in made]),
            np.concatenate([triangles + n for (_, triangles), n in zip(made, before)]),
            [len(triangles) for _, triangles in made])


def vortices(folder, most_bytes):
    """None without a flow that turns, and without room for two instants."""
    stored = fields.flow_frames(folder)
    most = min(MOST_INSTANTS, most_bytes / (MOST_TRIANGLES * BYTES_A_TRIANGLE))
    levels = actors.levels_of(stored[-1][1], None) if stored and most >= 2 else []
    if not levels:
        return None
    values = tuple(value for value, _, _ in levels)
    frames, made = zip(*fields.read(fields.chosen(stored, most), ("vortices", values),
                                    lambda files: one_instant(files, levels)))
    low, high = (end([end(points, axis=0) for points, _, _ in made if len(points)], axis=0)
                 for end in (np.min, np.max))
    step = max((high - low).max() / 65535, 1e-12)
    return {"times": [time for time, _ in frames], "low": low.tolist(), "step": step, "unit": "1/s",
            "levels": [{"value": value, "colour": colour, "opacity": opacity} for value, colour, opacity in levels],
            "frames": [{"points": packed(np.round((points - low) / step), "<u2"),
                        "triangles": packed(triangles, "<u2"), "counts": counts}
                       for points, triangles, counts in made]}
