# SPDX-License-Identifier: GPL-2.0-or-later
"""What stands still around the robot, as lines: obstacles of the fluid and the platform."""
import itertools
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

AXES = "xyz"
ROUND = np.linspace(0, 2 * np.pi, 49)
MOST_LINES = 3000  # of an STL surface
SHARP_DEG = 30  # edges of an STL surface that are shown


def _circle(centre, radius, axis):
    points = np.tile(np.array(centre, float), (len(ROUND), 1))
    first, second = [a for a in range(3) if a != axis]
    points[:, first] += radius * np.cos(ROUND)
    points[:, second] += radius * np.sin(ROUND)
    return points


def sphere(shape):
    return [_circle(shape["centre"], shape["diameter"] / 2, axis) for axis in range(3)]


def cylinder(shape, box):
    axis, centre = AXES.index(shape["axis"]), np.array(shape["centre"], float)
    if "length" in shape:
        ends = centre[axis] - shape["length"] / 2, centre[axis] + shape["length"] / 2
    else:
        ends = 0.0, box[axis]
    circles = []
    for end in ends:
        at = centre.copy()
        at[axis] = end
        circles.append(_circle(at, shape["diameter"] / 2, axis))
    return circles + [np.array([circles[0][i], circles[1][i]]) for i in range(0, 48, 12)]


def block(corners):
    """The twelve edges."""
    places = [np.array([corners[n][d] for d, n in enumerate(which)])
              for which in itertools.product((0, 1), repeat=3)]
    return [np.array([a, b]) for a, b in itertools.combinations(places, 2)
            if np.count_nonzero(a != b) == 1]


def surface(shape):
    """Sharp edges of an STL file; none where it is gone."""
    if not Path(shape["file"]).is_file():
        return []
    reader = vtk.vtkSTLReader()
    reader.SetFileName(shape["file"])
    edges = vtk.vtkFeatureEdges()
    edges.SetInputConnection(reader.GetOutputPort())
    edges.SetFeatureAngle(SHARP_DEG)
    edges.Update()
    found = edges.GetOutput()
    if found.GetNumberOfCells() == 0:
        return []
    points = vtk_to_numpy(found.GetPoints().GetData()) * shape.get("unit", 1.0)
    points = points + np.array(shape.get("shift", [0, 0, 0]))
    ends = vtk_to_numpy(found.GetLines().GetConnectivityArray()).reshape(-1, 2)
    return list(points[ends[:: max(1, len(ends) // MOST_LINES)]])


def platform(plane, low, high):
    """A square of lines in the plane, as wide as what is shown."""
    normal, point = np.array(plane["normal"], float), np.array(plane["point"], float)
    middle, size = (np.array(low) + high) / 2, np.linalg.norm(np.array(high) - low)
    foot = middle - np.dot(middle - point, normal) * normal
    first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    lines = []
    for part in np.linspace(-0.6, 0.6, 9) * size:
        for along, across in (first, second), (second, first):
            lines.append(np.array([foot + part * across - 0.6 * size * along,
                                   foot + part * across + 0.6 * size * along]))
    return lines


def wires(scene, low, high):
    """Lines of all of them, each a list of points; low, high: of what is shown."""
    lines = []
    fluid = scene.get("fluid", {})
    for shape in fluid.get("obstacles", {}).values():
        kind, of = next(iter(shape.items()))
        if kind == "sphere":
            lines += sphere(of)
        elif kind == "cylinder":
            lines += cylinder(of, fluid["box"])
        elif kind == "box":
            lines += block(of)
        elif kind == "stl":
            lines += surface(of)
    if "platform" in scene and low is not None:
        lines += platform(scene["platform"], low, high)
    return [np.round(line, 9).tolist() for line in lines]
