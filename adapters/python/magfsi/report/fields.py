# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies and flow of a run folder at each instant, as the page holds them."""
import base64
import time

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import runs
from magfsi.plotting import read_grid

MOST_SIDE = 160  # pixels of a slice
LESS_SIDE = 80  # of those in the planes that are not shown at first
MOST_SLICES = 60
MOST_ARROWS = 28  # along a side of a slice
READING_S = 1.0  # of bodies, and of a slice, in one answer of a page that is made again and again
IN_PLANE = ("first", "second")  # components of the velocity along the axes of a slice
AXES = "xyz"
DECIMALS = 80  # characters of an instant and of a place


def packed(array, kind):
    """Numbers as text that a page holds."""
    return base64.b64encode(np.ascontiguousarray(array, kind).tobytes()).decode()


def spread(count, most):
    """Indices of at most so many of them, first and last among them."""
    return sorted({round(i) for i in np.linspace(0, count - 1, min(count, most))})


def stored_frames(folder, collection):
    """[(time, [file ...])] that are there: an instant of a refined grid has a file a level."""
    try:
        listed = runs.frames(folder, collection)
    except (OSError, SyntaxError):  # of XML: a file that is being written
        return []
    instants = {}
    for time, file in listed:
        if file.exists():
            instants.setdefault(time, []).append(file)
    return list(instants.items())


def flow_frames(folder):
    """Those of the flow on grids."""
    stored = [(time, [file for file in files if file.suffix in (".vti", ".pvti")])
              for time, files in stored_frames(folder, "fluid.pvd")]
    return [(time, files) for time, files in stored if files]


_remembered = None  # {(file, of what): what was read of it}, where frames are kept
_left = False  # some of them to the next call


def remember_frames():
    """From now on a file is read once: for a page that is made again and again."""
    global _remembered
    _remembered = {}


def chosen(stored, most):
    """At most so many of the frames, first and last among them. Of a run that goes on every second, fourth ...
    one: those that were read before are read on."""
    most = max(2, int(most))
    if _remembered is None:
        return [stored[i] for i in spread(len(stored), most)]
    step = 1
    while len(stored) > step * (most - 1):
        step *= 2
    return stored[:-1:step] + stored[-1:]


def read(frames, what, make):
    """The frames with what make() has of the files of each. Where frames are remembered, those that are
    new are read for a limited time, the last one before all others; the rest is left to the next
    call, so that a page of a run that writes faster than it is read answers all the same."""
    global _left
    if _remembered is None:
        return [(frame, make(frame[1])) for frame in frames]
    until, found = time.monotonic() + READING_S, []
    for frame in frames[-1:] + frames[:-1]:
        key = (str(frame[1][0]), *what)
        if key not in _remembered:
            if found and time.monotonic() > until:
                _left = True
                continue
            _remembered[key] = make(frame[1])
        found.append((frame, _remembered[key]))
    return found[1:] + found[:1]


def some_left():
    """Whether frames have been left to the next call since this was asked last."""
    global _left
    left, _left = _left, False
    return left


def surface(grid):
    """Outer faces of the bodies (faces, 4) by the numbers of their nodes, their elements, and
    the nodes that they have."""
    filter_ = vtk.vtkGeometryFilter()
    filter_.SetInputData(grid)
    filter_.PassThroughPointIdsOn()
    filter_.PassThroughCellIdsOn()
    filter_.Update()
    skin = filter_.GetOutput()
    faces = vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    nodes = vtk_to_numpy(skin.GetPointData().GetArray("vtkOriginalPointIds"))
    elements = vtk_to_numpy(skin.GetCellData().GetArray("vtkOriginalCellIds"))
    # VTK's threads find the faces in another order each time.
    places = nodes[faces]
    turned = (places.argmin(axis=1)[:, None] + np.arange(4)) % 4
    places = np.take_along_axis(places, turned, axis=1)
    order = np.lexsort((*places.T[::-1], elements))
    nodes, faces = np.unique(places[order], return_inverse=True)
    return faces.reshape(-1, 4), elements[order], nodes


def array(data, *names):
    """The first of these arrays of points or cells that is there; None without."""
    for name in names:
        if data.GetArray(name) is not None:
            return vtk_to_numpy(data.GetArray(name))
    return None


def bodies_of(grid, elements):
    """Number of the body of each face, and names of the bodies."""
    number = array(grid.GetCellData(), "body")
    number = np.zeros(len(elements), int) if number is None else number[elements].astype(int)
    names = grid.GetFieldData().GetAbstractArray("body_names")
    count = number.max(initial=0) + 1
    return number, [names.GetValue(i) if names else f"body {i + 1}" for i in range(count)]


def magnetization(grid, elements):
    """Of each face the component that varies most over the bodies (the largest, where none varies),
    and which; None without."""
    values = array(grid.GetCellData(), "magnetization_at_rest[A/m]", "magnetization")
    if values is None or not np.abs(values).max():
        return None
    varies, largest = np.ptp(values, axis=0), np.abs(values).max(axis=0)
    axis = int((varies if varies.max() > 1e-9 * largest.max() else largest).argmax())
    return values[elements, axis], AXES[axis]


def colour(name, unit, of, values, signed, share=1.0):
    """One byte a value, from low to high, which hold this share of the values; what is beyond has
    the colour of the end."""
    values = np.asarray(values, float)
    largest = float(np.quantile(np.abs(values), share)) if values.size else 0.0
    beyond = bool(values.size and largest < np.abs(values).max())
    high = largest or 1.0
    low = -high if signed else 0.0
    scaled = np.clip(np.round(255 * (values - low) / (high - low)), 0, 255)
    return {"name": name, "unit": unit, "of": of, "low": low, "high": high, "signed": signed,
            "beyond": beyond,
            "frames": 1 if values.ndim == 1 else len(values), "values": packed(scaled, "u1")}


def one_frame(file, nodes, elements):
    """Positions and speeds of the nodes, the largest strain of each face; None of what is not in
    the file."""
    grid = read_grid(file)
    points = vtk_to_numpy(grid.GetPoints().GetData())[nodes]
    velocity = array(grid.GetPointData(), "velocity[m/s]", "velocity")
    stretches = array(grid.GetCellData(), "stretches[1]")
    return (points, None if velocity is None else np.linalg.norm(velocity[nodes], axis=1),
            None if stretches is None else np.abs(stretches[elements] - 1).max(axis=1))


def begin(points, times):
    """The instant at which the bodies are furthest from where and how they started."""
    return times[int(np.abs(points - points[0]).max(axis=(1, 2)).argmax())]


def bodies(folder, most_bytes):
    """Positions of the surface in every frame, or in as many as there is room for."""
    stored = stored_frames(folder, "structure.pvd")
    if not stored:
        return None
    first = read_grid(stored[0][1][0])
    faces, elements, nodes = surface(first)
    # Base64 takes four characters for three bytes; the instant and the middle are written as decimals.
    each = (7 * len(nodes) + len(faces)) * 4 / 3 + DECIMALS
    found = read(chosen(stored, most_bytes / each), ("body",),
                 lambda files: one_frame(files[0], nodes, elements))
    frames, made = zip(*found)
    points = np.array([frame[0] for frame in made])
    speeds, strains = ([frame[i] for frame in made if frame[i] is not None] for i in (1, 2))
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    step = max(np.ptp(points, axis=(0, 1)).max() / 65535, 1e-12)
    number, names = bodies_of(first, elements)
    middle = (points[0].min(axis=0) + points[0].max(axis=0)) / 2
    colours = []
    moment = magnetization(first, elements)
    if moment:
        colours.append(colour(f"magnetisation along {moment[1]} at rest", "A/m", "faces",
                              moment[0], True))
    if len(strains) == len(frames):
        colours.append(colour("largest strain", "1", "faces", strains, False))
    if len(speeds) == len(frames) and np.max(speeds) > 0:
        colours.append(colour("speed", "m/s", "nodes", speeds, False))
    return {"times": [time for time, _ in frames], "stored": len(stored), "nodes": len(nodes),
            "low": low.tolist(), "high": high.tolist(), "step": step,
            "middle": np.round(middle, 9).tolist(),  # at first
            "centres": np.round((points.min(axis=1) + points.max(axis=1)) / 2, 9).tolist(),
            "size": float(np.ptp(points, axis=1).max()),
            "begin": begin(points, [time for time, _ in frames]),
            "points": packed(np.round((points - low) / step), "<u2"),
            "faces": packed(faces, "<u4"), "body": packed(number, "u1"), "names": names,
            "colours": colours}


class Level:
    """The layer of one level's cells that a plane cuts."""

    def __init__(self, file, axis, at):
        grid = read_grid(file)
        low = grid.GetExtent()[::2]
        self.spacing = grid.GetSpacing()
        self.low = [o + n * h for o, n, h in zip(grid.GetOrigin(), low, self.spacing)]
        self.cells = [n - 1 for n in grid.GetDimensions()]
        self.axis, self.data = axis, grid.GetCellData()
        self.layer = int(np.floor((at - self.low[axis]) / self.spacing[axis]))

    def cut(self):
        return 0 <= self.layer < self.cells[self.axis]

    def plane(self, *names):
        """(..., rows, columns) of the layer; None without the array."""
        values = array(self.data, *names)
        if values is None:
            return None
        values = values.reshape(*self.cells[::-1], -1).take(self.layer, axis=2 - self.axis)
        return np.moveaxis(values, -1, 0)

    def quantities(self):
        """{name: (rows, columns)} of what the files have, or what follows from it."""
        across = [a for a in range(3) if a != self.axis]
        found = {}
        velocity = self.plane("velocity[m/s]", "velocity")
        if velocity is not None:
            found.update(zip(IN_PLANE, velocity[across]))
            found["speed"] = np.linalg.norm(velocity, axis=0)
        vorticity = self.plane("vorticity[1/s]", "vorticity")
        if vorticity is not None:
            found["vorticity"] = vorticity[self.axis]
        elif velocity is not None and min(velocity.shape[1:]) > 1:
            first, second = across  # columns, rows
            by_row = np.gradient(velocity[first], self.spacing[second], axis=0)
            by_column = np.gradient(velocity[second], self.spacing[first], axis=1)
            # x, y, z in turn: the curl along y is that of z and x.
            found["vorticity"] = (by_column - by_row) * (-1 if self.axis == 1 else 1)
        pressure = self.plane("pressure[Pa]")
        if pressure is not None:
            found["pressure"] = pressure[0]
        return found


def one_slice(files, axis, at, most_side):
    """({name: (rows, columns)}, origin, size), on the whole box, each pixel from the finest level
    that has it."""
    levels = sorted((Level(file, axis, at) for file in files), key=lambda l: -l.spacing[axis])
    coarse = levels[0]
    coarse.layer = int(np.clip(coarse.layer, 0, coarse.cells[axis] - 1))
    across = [a for a in range(3) if a != axis]
    finest = min(level.spacing[axis] for level in levels)
    size = [coarse.cells[a] * coarse.spacing[a] for a in across]
    scale = max(1.0, max(size) / finest / most_side)
    places = []
    for a, length in zip(across, size):
        count = max(1, round(length / finest / scale))
        places.append(coarse.low[a] + (np.arange(count) + 0.5) * length / count)
    made = {}
    for level in levels:
        if not level.cut():
            continue
        inside, cells = [], []
        for a, at_ in zip(across, places):
            index = np.floor((at_ - level.low[a]) / level.spacing[a] + 1e-9).astype(int)
            inside.append((index >= 0) & (index < level.cells[a]))
            cells.append(index[inside[-1]])
        for name, values in level.quantities().items():
            whole = made.setdefault(name, np.zeros((len(places[1]), len(places[0]))))
            whole[np.ix_(inside[1], inside[0])] = values[np.ix_(cells[1], cells[0])]
    return made, [coarse.low[a] for a in across], size


def at_arrows(values):
    """(every how many, of a slice's values those at the places of arrows)."""
    stride = max(1, max(values.shape) // MOST_ARROWS)
    return stride, values[stride // 2::stride, stride // 2::stride]


def arrows(slices):
    """Velocities in the plane on so many places that arrows have room, a signed byte a component."""
    if IN_PLANE[0] not in slices[0]:
        return None
    stride, _ = at_arrows(slices[0][IN_PLANE[0]])
    values = np.array([[at_arrows(found.pop(name))[1] for name in IN_PLANE] for found in slices])
    largest = float(np.quantile(np.hypot(values[:, 0], values[:, 1]), SHARE_IN_COLOUR))
    if not largest:
        return None
    return {"stride": stride, "rows": values.shape[2], "columns": values.shape[3], "largest": largest,
            "values": packed(np.clip(np.round(127 * values / largest), -127, 127), "i1")}


SHARE_IN_COLOUR = 0.999  # a vortex at a sharp end would leave the rest without colour
UNITS = {"speed": "m/s", "vorticity": "1/s", "pressure": "Pa"}


def flows(folder, scene, at, most_bytes):
    """Slices through a place: in the plane of the field, or across y, then in the two other planes."""
    plane = scene.get("magnetic_field", {}).get("plane", "xz")
    first = next(a for a in range(3) if AXES[a] not in plane)
    stored = flow_frames(folder)
    if not stored:
        return []
    made = [flow(stored, axis, at, (0.6 if axis == first else 0.2) * most_bytes,
                 MOST_SIDE if axis == first else LESS_SIDE) for axis in (first, *{0, 1, 2} - {first})]
    return [found for found in made if found]


def flow(stored, axis, at, most_bytes, most_side):
    """Slices of the flow across an axis, through `at`."""
    at = at[axis]
    first, _, _ = one_slice(stored[-1][1], axis, at, most_side)
    if not first:
        return None
    each = sum((at_arrows(values)[1] if name in IN_PLANE else values).size for name, values in first.items()) * 4 / 3
    found = read(chosen(stored, min(MOST_SLICES, most_bytes / each)), ("slice", axis, at),
                 lambda files: one_slice(files, axis, at, most_side))
    frames, made = zip(*found)
    # What was read once is kept as it is.
    slices = [dict(found) for found, _, _ in made]
    shown_arrows = arrows(slices)
    shape = first["speed"].shape if "speed" in first else next(iter(first.values())).shape
    quantities = []
    for name in slices[0]:
        values = np.array([found[name] for found in slices])
        quantities.append(colour(name if name != "vorticity" else f"vorticity along {AXES[axis]}",
                                 UNITS[name], "pixels", values, name != "speed", SHARE_IN_COLOUR))
    return {"times": [time for time, _ in frames], "axis": axis, "at": at, "rows": shape[0],
            "columns": shape[1], "origin": made[0][1], "size": made[0][2],
            "arrows": shown_arrows, "quantities": quantities}
