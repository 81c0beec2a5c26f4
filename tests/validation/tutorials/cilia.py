# SPDX-License-Identifier: GPL-2.0-or-later
"""The carpet of cilia pumps what the reciprocal theorem says of its forces, and about what slender-body theory
says of its motion; the theory's flow of a force beside a wall is Blake's."""
import sys
import unittest

import numpy as np
from magfsi import testing

CILIA = testing.ROOT / "tutorials/cilia"
sys.path.insert(0, str(CILIA))
import beat  # noqa: E402
import theory  # noqa: E402


def beside_a_wall(height, at):
    """Velocity at a place by a force at (0, 0, height), columns by its direction, viscosity 1: Blake, Proc. Camb.
    Phil. Soc. 70 (1971) 303, his derivative of the image by central differences."""
    def stokeslet(r):
        return np.eye(3) / np.linalg.norm(r) + np.outer(r, r) / np.linalg.norm(r)**3

    def doublet(r):
        return height * r / np.linalg.norm(r)**3 - stokeslet(r)[:, 2]

    image = at + [0, 0, height]
    flow = stokeslet(at - [0, 0, height]) - stokeslet(image)
    for j, way in enumerate((1, 1, -1)):
        step = 1e-4 * np.eye(3)[j]
        flow[:, j] += way * height * (doublet(image + step) - doublet(image - step)) / 1e-4
    return flow / (8 * np.pi)


class Theory(unittest.TestCase):
    # Blurred forces differ from points by the square of the blur over the distance; a cell of 20 lengths has a
    # mean flow of its own, of height / area.
    def test_flow_of_a_force_beside_a_wall(self):
        places, exact = np.array([[0, 0, 1], [1.3, 0.7, 1.6]]), beside_a_wall(1, np.array([1.3, 0.7, 1.6]))
        off = []
        for blur in (0.24, 0.12):
            found = theory._mobility(places, blur, np.array([20.0, 20, 20]))[3:, :3]
            off.append(np.abs(found - exact).max() / np.abs(exact).max())
        testing.report(f"off Blake's flow by {off[0]:.4f} and {off[1]:.4f}, forces blurred by 0.24 and 0.12")
        self.assertLess(off[1], 0.02)
        self.assertLess(off[1], 0.5 * off[0])

    # Turned about its middle: Tirado and Garcia de la Torre, J. Chem. Phys. 73 (1980) 1986.
    def test_resistance_of_a_cylinder(self):
        side, pieces = 0.1, 19
        for length in (0.8, 1.6):
            along = ((np.arange(pieces) + 0.5) / pieces - 0.5) * length
            places = np.stack([0 * along, 0 * along, 3 * length + along], 1)
            speeds = np.stack([along, 0 * along, 0 * along], 1)
            torque = along @ theory.forces(places, speeds, side, (6 * length,) * 3)[:, 0]
            slender = length / (2 * theory.SQUARE * side)
            right = np.pi * length**3 / 3 / (np.log(slender) - 0.662 + 0.917 / slender - 0.050 / slender**2)
            testing.report(f"{slender:.1f} widths long: {torque / right:.4f} of the right resistance")
            # Of the square of the radius over the length, and of the ends.
            self.assertAlmostEqual(torque / right, 1, delta=0.05)


class Cilia(unittest.TestCase):
    def test_pumps_as_its_forces_and_its_motion_say(self):
        # Cells as wide as a cilium; README.md has finer ones.
        run = testing.good_run(CILIA, {"fluid.spacing": "0.1 mm", "time.step": "78.125 us"},
                               ranks="structure=1,fluid=1")
        last = beat.last_beat(run.folder, 2)
        flow, forces, motion = (f.mean() for f in (last.flow, last.by_forces(), last.by_motion(4)))
        testing.report(f"mean flow {1e9 * flow:.4f} ul/s, by forces {1e9 * forces:.4f}, by motion {1e9 * motion:.4f}")
        self.assertGreater(flow, 0)
        # The mean is a twelfth of the flow's amplitude: a thousandth of the forces counts as 1 % of it.
        self.assertAlmostEqual(flow / forces, 1, delta=0.02)
        # A rod of one cell has the drag of a thicker one; the theory's own error is that of the cylinder above.
        self.assertAlmostEqual(flow / motion, 1, delta=0.1)


if __name__ == "__main__":
    unittest.main()
