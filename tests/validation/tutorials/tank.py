# SPDX-License-Identifier: GPL-2.0-or-later
"""The swimmer's tank runs on four levels with its mass kept, and the robot rises in it as in a narrow box."""
import unittest

import numpy as np
from magfsi import testing

TANK = testing.ROOT / "tutorials/tank"
# Of tutorials/swimmer, at the same cells.
BOX = {"fluid.box": "[16 mm, 8 mm, 16 mm]", "bodies.robot.initial.position": "[8 mm, 4 mm, 4 mm]"}
QUICK = {"output": "null", "probes.every": "0.4 ms"}


class Tank(unittest.TestCase):
    def rise(self, settings):
        probes = testing.good_run(TANK, {**QUICK, **settings}, "structure=1,fluid=1").probes()
        mass = np.array(probes["mass[kg]"])
        self.assertLess(np.abs(mass / mass[0] - 1).max(), 1e-12)
        height = np.array(probes["robot.com_z[m]"])
        return height[-1] - height[0]

    def test_keeps_its_mass_on_four_levels(self):
        self.rise({"time.end": "0.8 ms"})

    # With cells of 0.2 mm at the robot, or it takes minutes: at 0.1 mm the rises are in README.md.
    def test_rises_as_in_a_narrow_box(self):
        coarse = {"time.end": "40 ms"}
        tank = self.rise({**coarse, "fluid.refinement.levels": "2"})
        box = self.rise({**coarse, **BOX, "fluid.spacing": "0.4 mm", "fluid.refinement.levels": "1"})
        testing.report(f"first period: {1e3 * tank:.3f} mm in the tank, {1e3 * box:.3f} mm in the box")
        # Grids and margins of patches change a rise by 2 % (docs/refinement.md), each.
        self.assertLess(abs(tank / box - 1), 0.04)


if __name__ == "__main__":
    unittest.main()
