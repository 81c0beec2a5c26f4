# SPDX-License-Identifier: GPL-2.0-or-later
"""The motion of a body as a run recorded it: the outline of its cross-section over time, from the
files of structure.pvd, and the box of fluid that it moved in. A plane flow only: the body spans the
box along one axis, whose sides are periodic or slip."""
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import plotting, runs
from magfsi.report import data

AXES = "xyz"
# Of a hexahedron in the order of VTK.
FACES = [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
CORNER_RAD = np.radians(45)  # the outline turns by more there; of a strip's corners about 90 degrees
# Shares of the thickness, and of the largest displacement: beyond them the motion is not plane, and
# the files are too far apart in time for a spline.
OUT_OF_PLANE, BETWEEN_FILES = 0.02, 0.01
# What is asked of a fluid beside box, density and viscosity would be missing in the witness.
MISSING = {"body_force": [0, 0, 0], "initial_velocity": [0, 0, 0], "taylor_green": None, "obstacles": {}}


class Refused(Exception):
    """A run of which there can be no witness: why, and what to do."""


def _cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def area(outline):
    """Of polygons (..., points, 2), counter-clockwise."""
    return 0.5 * _cross(outline, np.roll(outline, -1, axis=-2)).sum(axis=-1)


def centre(outline):
    """Centre of area of polygons (..., points, 2)."""
    ahead = np.roll(outline, -1, axis=-2)
    twice = _cross(outline, ahead)[..., None]
    return ((outline + ahead) * twice).sum(axis=-2) / (3 * twice.sum(axis=-2))


def _side(value):
    """no_slip, free_slip or periodic, whether a word or a map; None for others, and walls that move."""
    if isinstance(value, dict):
        kind, more = next(iter(value.items()))
        return kind if kind == "no_slip" and not any((more or {}).get("velocity", [0])) else None
    return value if value in ("no_slip", "free_slip", "periodic") else None


class Box:
    """The fluid of a run: axes of the plane and across it, size in the plane [m], kinds of sides
    {x_min: no_slip}, density [kg/m3], kinematic viscosity [m2/s]."""

    def __init__(self, scene):
        fluid = scene.get("fluid")
        if not fluid:
            raise Refused("found no fluid in the scene; allowed are runs of a body in a fluid")
        for key, none in MISSING.items():
            if fluid.get(key, none) != none:
                raise Refused(f"found fluid.{key}; allowed is a fluid at rest that the body alone moves")
        if not isinstance(fluid["viscosity"], float):
            raise Refused("found a viscosity that depends on the rate of shear; allowed is a constant one")
        self.density, self.viscosity = fluid["density"], fluid["viscosity"]
        sides = {name: _side(value) for name, value in fluid["boundaries"].items()}
        for name, kind in sides.items():
            if kind is None:
                raise Refused(f"found fluid.boundaries.{name}: {fluid['boundaries'][name]}; allowed are "
                              "no_slip walls at rest, free_slip, and periodic across the plane")
        across = [i for i, name in enumerate(AXES)
                  if all(sides[f"{name}_{end}"] != "no_slip" for end in ("min", "max"))]
        if len(across) != 1:
            raise Refused(f"found {len(across)} axes between sides that are periodic or free_slip; allowed "
                          "is one: a plane flow, in a box with walls around")
        self.normal = across[0]
        self.plane = [i for i in range(3) if i != self.normal]
        self.sides = [[sides[f"{AXES[i]}_{end}"] for end in ("min", "max")] for i in self.plane]
        self.size = np.array([fluid["box"][i] for i in self.plane])
        self.depth = fluid["box"][self.normal]
        # The moment about the normal is that of the plane's first axis to its second, or its opposite.
        self.right_handed = 1 if self.normal != 1 else -1

    def words(self):
        return [AXES[i] for i in self.plane]


def _loop(cells, points, normal):
    """The outline as one loop of node numbers, counter-clockwise in the plane."""
    low = points[:, normal].min()
    at_end = points[:, normal] < low + 1e-6 * np.ptp(points)
    plane = [i for i in range(3) if i != normal]
    faces = cells[:, FACES]
    edges = set()
    for face in faces.reshape(-1, 4):
        if not at_end[face].all():
            continue
        if area(points[face][:, plane]) < 0:
            face = face[::-1]
        edges.update(zip(face.tolist(), np.roll(face, -1).tolist()))
    outer = dict(edge for edge in edges if edge[::-1] not in edges)
    if not outer:
        raise Refused("found no even end of the body across the plane; allowed are straight ones, as of "
                      "a block")
    loop = [min(outer)]
    while outer[loop[-1]] != loop[0]:
        loop.append(outer[loop[-1]])
    if len(loop) != len(outer):
        raise Refused("found a cross-section of several parts or with a hole; allowed is a strip")
    return loop


def _corners(outline):
    """Indices of the four corners of a strip; the first begins a long side."""
    edge = np.roll(outline, -1, axis=0) - outline
    before = np.roll(edge, 1, axis=0)
    turn = np.arctan2(_cross(before, edge), (before * edge).sum(axis=1))
    corners = np.flatnonzero(turn > CORNER_RAD)
    if len(corners) != 4:
        raise Refused(f"found a cross-section with {len(corners)} corners; allowed is a strip, with four")
    lengths = np.linalg.norm(edge, axis=1)
    sides = [lengths[np.arange(a, b) % len(outline)].sum()
             for a, b in zip(corners, [*corners[1:], corners[0] + len(outline)])]
    return np.roll(corners, 0 if sides[0] >= sides[1] else -1)


class Recorded:
    """time [s] and outline (times, points, 2) in the plane of the box, counter-clockwise from a
    corner; corners: their indices; the sides between them are long, short, long, short."""

    def __init__(self, folder, end=None, period=None):
        self.folder, self._period = Path(folder), period
        self.scene = data.read_json(self.folder / "scene.json", None)
        if self.scene is None:
            raise Refused("found no scene.json; allowed are folders that ./magfsi run has written")
        if len(self.scene.get("bodies", {})) != 1:
            raise Refused(f"found {len(self.scene.get('bodies', {}))} bodies; allowed is one, which alone "
                          "moves the fluid")
        self.body = next(iter(self.scene["bodies"]))
        self.box = Box(self.scene)
        self._read(end)
        self._check_files()
        self.spline = CubicSpline(self.time, self._of_constant_area(), axis=0)

    def _read(self, end):
        try:
            frames = runs.frames(self.folder)
        except (OSError, SyntaxError):
            frames = []
        frames = [(t, file) for t, file in frames if end is None or t <= end * (1 + 1e-9)]
        if len(frames) < 9:
            raise Refused(f"found {len(frames)} recorded shapes; allowed are at least 9: take a smaller "
                          "output: {structure: {every: ...}}, about a hundredth of a period")
        self.time = np.array([t for t, _ in frames])
        first = plotting.read_grid(frames[0][1])
        cells = vtk_to_numpy(first.GetCells().GetConnectivityArray()).reshape(-1, 8)
        points = [vtk_to_numpy(plotting.read_grid(file).GetPoints().GetData()) for _, file in frames]
        loop = _loop(cells, points[0], self.box.normal)
        plane = np.array(points)[:, :, self.box.plane]
        corners = _corners(plane[0, loop])
        loop = np.roll(loop, -corners[0])
        self.outline = plane[:, loop]
        self.corners = np.sort((corners - corners[0]) % len(loop))
        self.thickness = np.linalg.norm(self.outline[0, self.corners[2]] - self.outline[0, self.corners[1]])
        self._check_plane(np.array(points), loop)

    def _check_plane(self, points, loop):
        """The body spans the box, and its other end moves as this one."""
        c = self.box.normal
        extent = np.ptp(points[0][:, c])
        gap = 0.51 * self.scene["fluid"]["spacing"]
        if extent < self.box.depth - gap:
            raise Refused(f"found a body of {1e3 * extent:.4g} mm along {AXES[c]} in a box of "
                          f"{1e3 * self.box.depth:.4g} mm; allowed is one that spans the box: the flow is plane")
        far = np.flatnonzero(points[0][:, c] > points[0][:, c].max() - 1e-6 * np.ptp(points[0]))
        start = points[0][:, self.box.plane]
        partner = [far[np.linalg.norm(start[far] - start[node], axis=1).argmin()] for node in loop]
        moved = points - points[0]
        apart = np.abs(moved[:, loop] - moved[:, partner]).max()
        along = np.abs(moved[:, loop, c]).max()
        if max(apart, along) > OUT_OF_PLANE * self.thickness:
            raise Refused(f"found a motion that is not plane (by {1e6 * max(apart, along):.3g} um across the "
                          "plane); allowed are plane ones: hold the faces across the depth by rollers")

    def _check_files(self):
        """Every second shape left out tells how well a spline knows what lies between the files; with
        all of them its error, of fourth order, is a sixteenth."""
        coarse = CubicSpline(self.time[::2], self.outline[::2], axis=0)
        inside = self.time[:len(self.time[::2]) * 2 - 1][1::2]
        wrong = np.abs(coarse(inside) - self.outline[1::2][:len(inside)]).max() / 16
        self.stroke = np.linalg.norm(self.outline - self.outline[0], axis=2).max()
        if not self.stroke > 0:
            raise Refused("found a body that does not move; allowed is one that does")
        self.between = wrong / self.stroke
        if self.between > BETWEEN_FILES:
            raise Refused(f"found shapes {1e3 * np.diff(self.time).max():.3g} ms apart, between which the "
                          f"motion is known to {100 * self.between:.2g} % only; allowed is "
                          f"{100 * BETWEEN_FILES:.0f} %: take a smaller output: {{structure: {{every: ...}}}}")

    def _of_constant_area(self):
        """The outline with the area of the start: no fluid enters an incompressible flow. Points
        move along the normals, all by the same distance."""
        outline = self.outline
        ahead, before = np.roll(outline, -1, axis=1), np.roll(outline, 1, axis=1)
        along = ahead - before
        normal = np.stack([along[..., 1], -along[..., 0]], axis=-1)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        gained = 1e-3 * self.thickness
        rate = (area(outline + gained * normal) - area(outline)) / gained
        shift = (area(outline[0]) - area(outline)) / rate
        self.shift = np.abs(shift).max()
        return outline + shift[:, None, None] * normal

    def at(self, time, derivative=0):
        """Outlines (points, 2) at a time, their velocities or accelerations."""
        return self.spline(time, derivative)

    def share(self):
        """Of each point of the outline: the number of its side plus the share of that side's length
        at the start; corners begin their side."""
        edge = np.linalg.norm(np.roll(self.outline[0], -1, axis=0) - self.outline[0], axis=1)
        out, ends = np.zeros(len(edge)), [*self.corners, len(edge)]
        for k, (a, b) in enumerate(zip(ends[:-1], ends[1:])):
            out[a:b] = k + np.concatenate([[0], np.cumsum(edge[a:b - 1])]) / edge[a:b].sum()
        return out

    def places(self, shares, values):
        """Values (points of the outline, 2) at places of the outline by their share, linear between
        its points, as the run's own surface is."""
        own = np.append(self.share(), 4.0)
        closed = np.concatenate([values, values[:1]])
        return np.stack([np.interp(shares, own, closed[:, k]) for k in (0, 1)], axis=1)

    def rigid(self):
        """Centre, angle [rad] at the recorded times, and the largest distance of a point from where
        the best rigid motion brings it, as a share of the stroke."""
        middle = centre(self.outline)
        arm = self.outline - middle[:, None]
        first = arm[0][None]
        angle = np.unwrap(np.arctan2(_cross(first, arm).sum(axis=1), (first * arm).sum(axis=(1, 2))))
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        rigid = np.stack([c * arm[0, :, 0] - s * arm[0, :, 1], s * arm[0, :, 0] + c * arm[0, :, 1]], axis=-1)
        return middle, angle, np.linalg.norm(rigid - arm, axis=2).max() / self.stroke

    def period(self):
        """Given, of the field or of the body's motion [s]; None without."""
        from magfsi.cost.variants import period_of
        return self._period or period_of(self.scene)
