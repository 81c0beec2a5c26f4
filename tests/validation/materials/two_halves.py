# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene with a material for each region of a Gmsh file, in Newton's method and in damped motion
in LAMMPS; and the regions that the mesh does not have."""

import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "two_halves.yaml"
LENGTH = 8e-3
DYNAMICS = {"time.equilibrium.method": "dynamics"}
ENTRY = "bodies.beam.material_regions"
POINTS = ["joint_x[m]", "joint_z[m]", "tip_x[m]", "tip_z[m]"]


class TwoHalves(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.newton = testing.good_run(SCENE).probes()

    def expect_same(self, probes):
        apart = max(abs(a - b) for name in POINTS
                    for a, b in zip(self.newton[name], probes[name]))
        testing.report(f"{apart / LENGTH:.2g} L apart")
        # Both stop at 1e-6 of the load; a beam of L/h = 16 answers a force of that size with
        # (L/h)^2 = 256 times it, and less.
        self.assertLess(apart / LENGTH, 1e-4)
        self.assertGreater(abs(probes["tip_z[m]"][-1] - probes["tip_z[m]"][0]), 0.1 * LENGTH)

    def test_newton_and_damped_motion_agree(self):
        motion = testing.good_run(SCENE, DYNAMICS).probes()
        self.expect_same(motion)
        name = "beam.energy_elastic[J]"
        # The tip is within 1e-4 L of 0.1 L or more.
        self.assertLess(abs(motion[name][-1] / self.newton[name][-1] - 1), 5e-3)

    def test_two_ranks_give_the_same(self):
        self.expect_same(testing.good_run(SCENE, DYNAMICS, ranks="structure=2").probes())

    def test_each_half_weighs_by_its_density(self):
        # Newton's first row is the undeformed beam.
        com = (1860 * 2e-3 + 930 * 6e-3) / (1860 + 930)
        # The file's coordinates have ten digits.
        self.assertAlmostEqual(self.newton["beam.com_x[m]"][0] / com, 1, places=8)

    def test_each_half_bends_by_its_stiffness(self):
        """Small deflections: the couple M B A on each length bends a section at x with the moment
        (L - x) M B A, so that the tip rises by the integral of (L - x)^2 M B A / (E I)."""
        weak = {"magnetic_field.table.magnitude": "[0 mT, 0.1 mT]"}  # 0.03 L
        both = testing.good_run(SCENE, weak).probes()
        soft = testing.good_run(SCENE, {ENTRY: "", **weak}).probes()
        rise = [p["joint_z[m]"][-1] - p["joint_z[m]"][0] for p in (both, soft)]
        tip = [p["tip_z[m]"][-1] - p["tip_z[m]"][0] for p in (both, soft)]
        testing.report(f"joint {rise[0] / rise[1]:.4f}, tip {tip[0] / tip[1]:.4f} of the soft beam")
        # The joint rises with the soft half alone. Left over: the joint's surroundings, a thickness
        # of L / 16 over which the stiff half holds the soft one, and slopes of 0.05 squared.
        self.assertAlmostEqual(rise[0] / rise[1], 1, delta=0.02)
        # Of the tip's rise the half beyond the joint has 1/8, and four times as stiff a quarter of
        # that.
        self.assertAlmostEqual(tip[0] / tip[1], 1 - 0.75 / 8, delta=0.02)

    def test_an_unknown_region_is_refused(self):
        run = testing.run(SCENE, {ENTRY + ".0.region": "stif half"})
        self.assertEqual(run.code, 2, run.err)
        self.assertIn("did you mean", run.err + run.out)
        self.assertIn("stiff half", run.err + run.out)


if __name__ == "__main__":
    unittest.main(verbosity=2)
