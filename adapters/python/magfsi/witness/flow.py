# SPDX-License-Identifier: GPL-2.0-or-later
"""The witness's own solution on one mesh: how far the mesh can follow, then forces, moment and power
of a metre of strip."""
import shutil
from dataclasses import dataclass

import numpy as np

from magfsi.witness import foam
from magfsi.witness.case import Case
from magfsi.witness.recorded import centre

FOLLOWING_STEPS = 100
SAME_SHAPE = 1e-3  # of the thickness: the strip starts straight along an axis
# Sum over the faces against OpenFOAM's own sum of the forces: the same numbers, with 6 digits.
SAME_SUM = 1e-3


@dataclass
class Solution:
    """A metre deep. time [s]; force (times, 2) [N/m] of the fluid on the strip, in the plane; moment
    [N m/m] of it about the centre of the cross-section, from the plane's first axis to its second; power
    [W/m] of the strip on the fluid, at times of its own; cells: in the thickness; end [s]: how far the
    mesh could follow; fault: what stopped it, or None."""

    cells: int
    count: int
    end: float
    fault: str
    time: np.ndarray = None
    force: np.ndarray = None
    moment: np.ndarray = None
    power_time: np.ndarray = None
    power: np.ndarray = None


def prepare(folder, recorded, cells, end, say):
    """The case, ready for the flow, its end moved to what the mesh can follow."""
    case = Case(folder, recorded, cells, end)
    case.start()
    foam.run("blockMesh", case.folder)
    case.read_surface()
    if case.off_shape() > SAME_SHAPE:
        say(f"{cells} cells in the thickness: the mesh takes the shape of the start")
        case.write_shaping()
        _, fault = foam.followed(foam.run("moveDynamicMesh", case.folder))
        if fault:
            return case, 0.0, f"the shape of the start gives {fault}"
        shutil.copy(case.folder / "1/polyMesh/points", case.folder / "constant/polyMesh/points")
        shutil.rmtree(case.folder / "1")
        points, _ = foam.patch(case.folder, "body")
        case.on_strip = points[case.numbers]
    case.write_motion()
    case.control(end, end / FOLLOWING_STEPS)
    reached, fault = foam.followed(foam.run("moveDynamicMesh", case.folder))
    for left in case.folder.glob("[0-9]*"):
        if left.name != "0":
            shutil.rmtree(left)
    return case, reached, fault


def solve(case, reached, fault):
    """Runs the flow to `reached`."""
    case.steps = int(reached / case.step * (1 + 1e-9))
    case.control(case.steps * case.step, case.step, functions=True)
    foam.run("pimpleFoam", case.folder)
    return read(case, reached, fault)


def read(case, reached, fault):
    """The Solution from the files of the function objects."""
    recorded, depth = case.recorded, case.box.depth
    time, forces = foam.series(case.folder, "force")
    _, moments = foam.series(case.folder, "moment")
    force = forces[:, 0, :2] / depth
    middle = centre(recorded.at(time))
    moment = moments[:, 0, 2] / depth - middle[:, 0] * force[:, 1] + middle[:, 1] * force[:, 0]
    power_time, power = power_of(case, time, force)
    return Solution(case.cells, case.count, reached, fault, time, force, moment, power_time, power)


def power_of(case, time, force):
    """Sum over the faces of the strip of minus the traction on it times its velocity: pressure along
    the normal into the strip, and the wall's friction. Its forces are checked against OpenFOAM's."""
    times, pressure, shear = foam.traction(case.folder)
    power, total = np.zeros(len(times)), np.zeros((len(times), 2))
    first, second = case.shares[case.edges].T
    forward = np.sign((second - first + 2) % 4 - 2)
    for n, t in enumerate(times):
        ends = case.surface(t)[case.edges]
        velocity = case.surface(t, 1)[case.edges].mean(axis=1)
        along = ends[:, 1] - ends[:, 0]
        length = np.linalg.norm(along, axis=1)
        into = np.stack([-along[:, 1], along[:, 0]], axis=1)
        # Along the outline, counter-clockwise, the inside is on the left.
        into *= forward[:, None]
        # OpenFOAM's wall shear stress is that of the wall on the fluid.
        on_strip = case.box.density * (pressure[n][:, None] * into - shear[n][:, :2] * length[:, None])
        total[n] = on_strip.sum(axis=0)
        power[n] = -(on_strip * velocity).sum()
    of_foam = np.stack([np.interp(times, time, force[:, k]) for k in (0, 1)], axis=1)
    apart = np.abs(total - of_foam).max() / np.abs(of_foam).max()
    if apart > SAME_SUM:
        raise foam.Failed(f"the sum of the traction over the strip differs by {100 * apart:.2g} % from "
                          f"OpenFOAM's forces ({case.folder}); this OpenFOAM writes other files than 1912")
    return times, power
