# SPDX-License-Identifier: GPL-2.0-or-later
"""What a picture is made of: solids, lines, vortices, light."""
import base64

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from magfsi.plotting import read_grid
from magfsi.report import shapes
from magfsi.report.colours import colour_table

SHARES_OF_MAXIMUM = (0.12, 0.3, 0.6)
OPACITIES = (0.13, 0.22, 0.4)
WATER = ((0.62, 0.80, 0.93), (0.25, 0.58, 0.82), (0.07, 0.31, 0.60))
STONE, MAGNET = (0.62, 0.63, 0.66), (0.55, 0.1, 0.1)
GLASSY = 0.16  # obstacles that one looks through
GLASS = 0.85  # of a slice, as the page's
BODIES = np.array([[219, 115, 51], [0, 114, 178], [0, 158, 115], [204, 121, 167], [86, 180, 233],
                   [230, 159, 0]])


def unpacked(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


def actor(source, colour, opacity=1.0, ambient=0.15, diffuse=0.85, specular=0.0):
    """Of a filter, or of data itself."""
    mapper = vtk.vtkPolyDataMapper()
    if isinstance(source, vtk.vtkPolyData):
        mapper.SetInputData(source)
    else:
        mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    shape = vtk.vtkActor()
    shape.SetMapper(mapper)
    look = shape.GetProperty()
    look.SetColor(colour)
    look.SetOpacity(opacity)
    look.SetAmbient(ambient)
    look.SetDiffuse(diffuse)
    look.SetSpecular(specular)
    look.SetSpecularPower(40)
    return shape


def lines(some, colour, width=1.5, opacity=1.0):
    """Each a list of points."""
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    for line in some:
        cells.InsertNextCell(len(line))
        for point in line:
            cells.InsertCellPoint(points.InsertNextPoint(point))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetLines(cells)
    shape = actor(data, colour, opacity, ambient=1, diffuse=0)
    shape.GetProperty().SetLineWidth(width)
    return shape


def edges(low, high):
    """Of a box."""
    corner = [[(high if n >> d & 1 else low)[d] for d in range(3)] for n in range(8)]
    return [[corner[n], corner[n | bit]] for n in range(8) for bit in (1, 2, 4) if not n & bit]


class Robot:
    """The bodies of a run at any time between its frames."""

    def __init__(self, bodies):
        self.times, self.count = np.array(bodies["times"]), bodies["nodes"]
        self.low, self.step = np.array(bodies["low"]), bodies["step"]
        self.stored = unpacked(bodies["points"], "<u2").reshape(-1, self.count, 3)
        self.quads = unpacked(bodies["faces"], "<u4").reshape(-1, 4).astype(np.int64)
        self.body = unpacked(bodies["body"], "u1")
        self.colours = bodies["colours"]
        self.data = vtk.vtkPolyData()
        cells = vtk.vtkCellArray()
        rows = np.column_stack([np.full(len(self.quads), 4), self.quads]).ravel()
        cells.SetCells(len(self.quads), numpy_to_vtkIdTypeArray(rows, deep=True))
        self.data.SetPoints(vtk.vtkPoints())
        self.data.SetPolys(cells)

    def frame(self, time):
        return max(0, int(np.searchsorted(self.times, time * (1 + 1e-9) + 1e-12, "right")) - 1)

    def points(self, time):
        i = self.frame(time)
        j = min(i + 1, len(self.times) - 1)
        part = (time - self.times[i]) / (self.times[j] - self.times[i]) if j > i else 0.0
        both = self.stored[[i, j]].astype(float)
        return self.low + self.step * (both[0] + np.clip(part, 0, 1) * (both[1] - both[0]))

    def chosen(self, name):
        """The quantity whose name begins so; None without."""
        return next((c for c in self.colours if name and c["name"].startswith(name)), None)

    def face_colours(self, time, name):
        """(faces, 3) from 0 to 255: of the chosen quantity, or of the bodies."""
        chosen = self.chosen(name)
        if chosen is None:
            return BODIES[self.body % len(BODIES)].astype(float)
        values = unpacked(chosen["values"], "u1").reshape(chosen["frames"], -1)
        values = values[min(self.frame(time), chosen["frames"] - 1)].astype(int)
        if chosen["of"] == "nodes":
            values = (values[self.quads].sum(axis=1) + 2) // 4
        return colour_table("signed" if chosen["signed"] else "magnitude")[values]

    def move(self, time, colours):
        """Puts the polygons where the bodies are, with these colours of faces."""
        self.data.GetPoints().SetData(numpy_to_vtk(self.points(time), deep=True))
        scalars = numpy_to_vtk(np.clip(colours, 0, 255).astype(np.uint8), deep=True)
        self.data.GetCellData().SetScalars(scalars)
        self.data.Modified()


def slice_actor(flow):
    """A rectangle with a texture: what show_slice changes."""
    across = [a for a in range(3) if a != flow["axis"]]
    place = vtk.vtkPlaneSource()
    corners = []
    for u, v in ((0, 0), (1, 0), (0, 1)):
        corner = [0.0] * 3
        corner[flow["axis"]] = flow["at"]
        for a, share, origin, size in zip(across, (u, v), flow["origin"], flow["size"]):
            corner[a] = origin + share * size
        corners.append(corner)
    place.SetOrigin(corners[0])
    place.SetPoint1(corners[1])
    place.SetPoint2(corners[2])
    shape = actor(place, (1, 1, 1), ambient=1, diffuse=0)
    shape.ForceTranslucentOn()
    texture = vtk.vtkTexture()
    texture.InterpolateOn()
    shape.SetTexture(texture)
    return shape


def quantity(flow, name):
    """The one whose name begins so, or the first."""
    return next((q for q in flow["quantities"] if q["name"].startswith(name)), flow["quantities"][0])


def show_slice(shape, flow, name, time):
    q = quantity(flow, name)
    values = unpacked(q["values"], "u1").reshape(-1, flow["rows"], flow["columns"])
    frame = max(0, int(np.searchsorted(flow["times"], time * (1 + 1e-9) + 1e-12, "right")) - 1)
    values = values[frame].astype(int)
    rgb = colour_table("signed" if q["signed"] else "flow")[values]
    rgba = np.dstack([rgb, np.full(values.shape, 255 * GLASS)]).astype(np.uint8)
    image = vtk.vtkImageData()
    image.SetDimensions(flow["columns"], flow["rows"], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(rgba.reshape(-1, 4), deep=True))
    shape.GetTexture().SetInputData(image)


def vortex_strength(image):
    """|curl u| in the cells; from the velocity where no vorticity was stored; None without."""
    name = "vorticity[1/s]"
    if not image.GetCellData().HasArray(name):
        if not image.GetCellData().HasArray("velocity[m/s]"):
            return None
        gradient = vtk.vtkGradientFilter()
        gradient.SetInputData(image)
        gradient.SetInputScalars(vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "velocity[m/s]")
        gradient.ComputeGradientOff()
        gradient.ComputeVorticityOn()
        gradient.SetVorticityArrayName(name)
        gradient.Update()
        image = gradient.GetOutput()
    return np.linalg.norm(vtk_to_numpy(image.GetCellData().GetArray(name)), axis=1)


def strengths(files):
    """[(image, |curl u| in its cells)] of an instant's grids, the finest last; none of files without a flow."""
    images = sorted(map(read_grid, files), key=lambda image: -image.GetSpacing()[0])
    return [(image, strength) for image in images if (strength := vortex_strength(image)) is not None]


def outside(source, bounds):
    """What is left of a surface outside of a box."""
    box = vtk.vtkBox()
    box.SetBounds(bounds)
    cut = vtk.vtkClipPolyData()
    cut.SetInputConnection(source.GetOutputPort())
    cut.SetClipFunction(box)
    return cut


def vortex_surfaces(files, values):
    """A filter that makes the surface of each of these strengths, each part of it on the finest grid that is
    there; none without a flow."""
    grids = strengths(files)
    if not grids or not max(strength.max() for _, strength in grids):
        return
    at_points = []
    for image, strength in grids:
        scalar = numpy_to_vtk(strength, deep=True)
        scalar.SetName("strength")
        image.GetCellData().SetScalars(scalar)
        points = vtk.vtkCellDataToPointData()
        points.SetInputData(image)
        at_points.append(points)
    for value in values:
        whole = vtk.vtkAppendPolyData()
        for i, points in enumerate(at_points):
            surface = vtk.vtkContourFilter()
            surface.SetInputConnection(points.GetOutputPort())
            surface.SetInputArrayToProcess(0, 0, 0, 0, "strength")
            surface.SetValue(0, value)
            for finer, _ in grids[i + 1:]:
                surface = outside(surface, finer.GetBounds())
            whole.AddInputConnection(surface.GetOutputPort())
        yield whole


def vortices(files, levels):
    """A translucent surface for each level."""
    for surface, (_, colour, opacity) in zip(vortex_surfaces(files, [value for value, _, _ in levels]), levels):
        yield actor(surface, colour, opacity, ambient=0.35, diffuse=0.7, specular=0.15)


def levels_of(files, asked):
    """[(level in 1/s, colour, opacity)]: those that are asked for, or shares of the largest in these
    files."""
    if not asked:
        found = [strength.max() for _, strength in strengths(files)]
        asked = [float(f"{share * max(found):.2g}") for share in SHARES_OF_MAXIMUM] if found and max(found) else []
    return list(zip(asked, WATER, OPACITIES))


def solid(shape, box):
    """The source of an obstacle of the scene; None for a surface whose file is gone, and for a
    shape that is not drawn."""
    kind, of = next(iter(shape.items()))
    if kind == "sphere":
        source = vtk.vtkSphereSource()
        source.SetCenter(of["centre"])
        source.SetRadius(of["diameter"] / 2)
        source.SetThetaResolution(64)
        source.SetPhiResolution(48)
        return source
    if kind == "box":
        source = vtk.vtkCubeSource()
        source.SetBounds([v for pair in zip(*of) for v in pair])
        return source
    if kind == "cylinder":
        axis, centre = "xyz".index(of["axis"]), list(of["centre"])
        if "length" not in of:
            centre[axis] = box[axis] / 2
        source = vtk.vtkCylinderSource()  # along y, at the origin
        source.SetRadius(of["diameter"] / 2)
        source.SetHeight(of.get("length", box[axis]))
        source.SetResolution(64)
        turn = vtk.vtkTransform()
        turn.Translate(centre)
        if axis != 1:
            turn.RotateWXYZ(90, *((0, 0, 1) if axis == 0 else (1, 0, 0)))
        moved = vtk.vtkTransformPolyDataFilter()
        moved.SetInputConnection(source.GetOutputPort())
        moved.SetTransform(turn)
        return moved
    return stl(of) if kind == "stl" else None


def stl(of):
    try:
        open(of["file"], "rb").close()
    except OSError:
        return None
    reader = vtk.vtkSTLReader()
    reader.SetFileName(of["file"])
    place = vtk.vtkTransform()
    place.Translate(of.get("shift", [0, 0, 0]))
    place.Scale([of.get("unit", 1.0)] * 3)
    moved = vtk.vtkTransformPolyDataFilter()
    moved.SetInputConnection(reader.GetOutputPort())
    moved.SetTransform(place)
    return moved


def cut_open(source, towards, course):
    """What is left of a surface that encloses the bodies or stands before them: the half behind a
    plane through the middle of their course, closed there; None of others. towards: the viewer."""
    source.Update()
    bounds = np.array(source.GetOutput().GetBounds()).reshape(3, 2)
    axis = int(np.abs(towards).argmax())
    sign = 1 if towards[axis] > 0 else -1
    low, high = course
    middle = (low + high) / 2
    beside = [bounds[a, 1] < low[a] or bounds[a, 0] > high[a] for a in range(3) if a != axis]
    if any(beside) or (sign * (bounds[axis] - middle[axis])).max() <= 0:
        return None
    whole = vtk.vtkCleanPolyData()  # the triangles of an STL file share no corners
    whole.SetInputConnection(source.GetOutputPort())
    plane = vtk.vtkPlane()
    plane.SetOrigin(middle)
    plane.SetNormal([-sign if a == axis else 0 for a in range(3)])
    planes = vtk.vtkPlaneCollection()
    planes.AddItem(plane)
    cut = vtk.vtkClipClosedSurface()
    cut.SetInputConnection(whole.GetOutputPort())
    cut.SetClippingPlanes(planes)
    return cut


def sharp_edges(source):
    found = vtk.vtkFeatureEdges()
    found.SetInputConnection(source.GetOutputPort())
    found.SetFeatureAngle(shapes.SHARP_DEG)
    found.ColoringOff()
    shape = actor(found, (0.1, 0.1, 0.1), 0.6, ambient=1, diffuse=0)
    shape.GetProperty().SetLineWidth(1)
    return shape


def solids(scene, look, towards, course):
    """(actors of the obstacles, whether one is cut open). look: cut, glass or whole."""
    fluid, found, opened = scene.get("fluid", {}), [], False
    for shape in fluid.get("obstacles", {}).values():
        source = solid(shape, fluid["box"])
        if source is None:
            continue
        half = cut_open(source, towards, course) if look == "cut" and course is not None else None
        opened = opened or half is not None
        source = half or source
        found += [actor(source, STONE, GLASSY if look == "glass" else 1.0, ambient=0.3, diffuse=0.7),
                  sharp_edges(source)]
    return found, opened


class Source:
    """Outlines of a magnet or a coil of the run, where it is at a time."""

    def __init__(self, found):
        self.times = unpacked(found["times"], "<f4")
        self.matrices = unpacked(found["matrices"], "<f4").reshape(-1, 12)
        self.outlines = [np.array(line) for line in found["lines"]]
        self.actor = lines([[(0, 0, 0)] * len(line) for line in self.outlines], MAGNET, 2.5)

    def move(self, time):
        row = np.array([np.interp(time, self.times, c) for c in self.matrices.T])
        points = np.concatenate([line @ row[:9].reshape(3, 3).T + row[9:] for line in self.outlines])
        data = self.actor.GetMapper().GetInput()
        data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
        data.Modified()


def floor(low, high):
    place = vtk.vtkPlaneSource()
    place.SetOrigin(*low)
    place.SetPoint1(high[0], low[1], low[2])
    place.SetPoint2(low[0], high[1], low[2])
    return actor(place, (0.90, 0.93, 0.95), 0.8, ambient=0.6, diffuse=0.4)
