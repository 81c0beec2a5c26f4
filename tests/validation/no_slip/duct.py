# SPDX-License-Identifier: GPL-2.0-or-later
"""A wall of markers across a closed duct holds a pressure of 8 Pa; a piston of markers takes the
fluid along. What passes is measured as flow through a plane far from the body."""

import math
import unittest
from pathlib import Path

from magfsi import testing

FOLDER = Path(__file__).resolve().parent
SECTION, PRESSURE, DENSITY = 1.6e-3**2, 8, 1000


def passing(run):
    """Mean velocity through the plane [m/s], by the row."""
    return [flow / SECTION for flow in run.probes()["far.flow[m3/s]"]]


def leak(settings):
    run = testing.good_run(FOLDER / "duct.yaml", settings)
    speed = passing(run)
    # The push is switched on at once; its sound fades for 0.1 s.
    late = speed[3 * len(speed) // 4:]
    part = abs(sum(late) / len(late)) / math.sqrt(PRESSURE / DENSITY)
    testing.report(f"{settings}: leaks {100 * part:.4f} % of sqrt(pressure / density)")
    return part


class Wall(unittest.TestCase):
    def test_holds_the_pressure(self):
        # What is left is sound. Wherever and however thick the wall is, up to the walls of the
        # duct, which it touches.
        for spacing in ("0.2 mm", "0.1 mm"):
            self.assertLess(leak({"fluid.spacing": spacing}), 1e-4)
        self.assertLess(leak({"coupling.immersed_boundary.kernel": "2-point",
                              "bodies.wall.initial.position.0": "1.98 mm"}), 1e-4)
        self.assertLess(leak({"bodies.wall.mesh.box.size.0": "0.5 mm"}), 1e-4)

    def test_of_penalties_does_not(self):
        self.assertGreater(leak({"coupling.immersed_boundary.forcing": "penalty"}), 0.01)


class Piston(unittest.TestCase):
    def test_takes_the_fluid_along(self):
        for settings in ({}, {"bodies.piston.mesh.box.size.0": "0.5 mm"},
                         {"coupling.immersed_boundary.kernel": "2-point"}):
            run = testing.good_run(FOLDER / "piston.yaml", settings)
            time, speed = run.probes()["t[s]"], passing(run)
            moved = sum((a + b) / 2 * (end - start) for a, b, start, end in
                        zip(speed, speed[1:], time, time[1:], strict=False))
            place = run.probes()["piston.com_x[m]"]
            testing.report(f"{settings}: the fluid moves {moved / (place[-1] - place[0]):.5f} of "
                           f"what the piston does; {run.summary()['immersed_boundary']}")
            self.assertAlmostEqual(moved / (place[-1] - place[0]), 1, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
