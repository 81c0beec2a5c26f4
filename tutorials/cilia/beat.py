# SPDX-License-Identifier: GPL-2.0-or-later
"""The last beat of a run of this folder's scene, and what theory says of it. SI."""
import dataclasses
import math
import pathlib

import numpy as np
import theory
from scipy.interpolate import CubicSpline
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import plotting

LENGTH, SIDE, BOX = 0.8e-3, 0.1e-3, np.array([1.6e-3, 1.4e-3, 2.4e-3])
VISCOSITY, CONE, TILT = 0.02, math.radians(38), math.radians(38)


@dataclasses.dataclass
class Beat:
    time: np.ndarray
    flow: np.ndarray  # through x = 0
    nodes: np.ndarray  # (times, nodes, 3): where they are
    forces: np.ndarray  # of the same shape: what they do to the fluid
    along: np.ndarray  # heights at rest of the middle line's places
    line: np.ndarray  # (times, places, 3): where the middle line is, from the foot

    def by_forces(self):
        """The flow that the forces drive at each time in a fluid without inertia; its mean is that of any fluid in
        creeping flow."""
        return theory.pumped(self.forces[..., 0], self.nodes[..., 2], BOX) / VISCOSITY

    def by_motion(self, every=2):
        """The same by slender-body theory from the rod's motion, at every so many times."""
        count = math.ceil(LENGTH / (0.55 * SIDE))
        at = (np.arange(count) + 0.5) / count * LENGTH
        clamped = np.zeros((len(self.time), 3))
        clamped[:, 2] = 1
        places = CubicSpline(self.along, self.line.swapaxes(0, 1),
                             bc_type=((1, clamped), "not-a-knot"))(at).swapaxes(0, 1)
        rates = 2j * math.pi * np.fft.rfftfreq(len(self.time), self.time[1] - self.time[0])
        speeds = np.fft.irfft(np.fft.rfft(places, axis=0) * rates[:, None, None], len(self.time), axis=0)
        flow = []
        for place, speed in zip(places[::every], speeds[::every]):
            force = theory.forces(place, speed, SIDE, BOX)
            flow.append(theory.pumped(force[:, 0], place[:, 2], BOX))
        return np.array(flow)


def last_beat(folder, frequency):
    """Of a run whose rows and fields are as far apart, a whole part of a beat."""
    probes = plotting.read_columns(pathlib.Path(folder) / "probes.csv")
    rows = round(1 / (frequency * (probes["t[s]"][1] - probes["t[s]"][0])))
    nodes, forces = [], []
    for _, file in plotting.frames(folder)[-rows:]:
        grid = plotting.read_grid(file)
        data = grid.GetPointData()
        nodes.append(vtk_to_numpy(grid.GetPoints().GetData()).astype(float))
        # What the field and the springs leave over: the rod's own inertia is that of its volume of fluid, some
        # thousandths of it.
        forces.append(sum(vtk_to_numpy(data.GetArray(name)).astype(float)
                          for name in ("magnetic_force[N]", "elastic_force[N]")))
    nodes, forces = np.array(nodes), np.array(forces)
    at_rest = np.round(nodes[0] - vtk_to_numpy(
        plotting.read_grid(plotting.frames(folder)[-rows][1]).GetPointData().GetArray("displacement[m]")), 9)
    along = np.unique(at_rest[:, 2])
    layers = [at_rest[:, 2] == height for height in along]
    forces[:, layers[0]] = 0  # of the clamp
    line = np.stack([nodes[:, layer].mean(1) for layer in layers], 1)
    return Beat(probes["t[s]"][-rows:], probes["pumped.flow[m3/s]"][-rows:], nodes, forces, along - along[0],
                line - [*at_rest[layers[0]].mean(0)[:2], 0])


def straight_rod(frequency):
    """The mean flow of a straight rod that follows the field, by resistances alone."""
    return 2 * math.pi * frequency * theory.on_a_cone(LENGTH, SIDE, CONE, TILT, BOX)
