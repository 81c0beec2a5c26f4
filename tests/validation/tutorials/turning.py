# SPDX-License-Identifier: GPL-2.0-or-later
"""A field that turns takes the C with it, through three turns of -45 degrees; from flat the last
field makes a V. Newton's method, the motion in time and the strip on a platform agree."""

import csv
import math
import unittest

from magfsi import testing

FOLDER = testing.ROOT / "tutorials/turning"
LENGTH_MM = 3.7
NJ = 1e9
# Rounding, and the residual of 1e-6 of the load times the strip's softness of about 1e3.
RIGID_DEG = 0.05
# The motion is damped critically and rests 100 ms, 60 decay times, before each figure.
MOTION_DEG = 0.05
# On the platform the weight bends the C: 20 nJ to lift it by its height, of 490 nJ that hold it
# in the field's direction, turn it by up to 20 / 490 rad = 2.3 degrees.
PLATFORM_DEG = 2.5


class Shapes:
    def __init__(self, scene, settings=None):
        run = testing.good_run(FOLDER / scene, {"output": "null", **(settings or {})})
        self.log = (run.folder / "run.log").read_text()
        probes = run.probes()
        self.t = probes["t[s]"]
        self.end_to_end_mm = [1e3 * e for e in probes["strip.end_to_end[m]"]]
        self.bend_deg = [math.degrees(b) for b in probes["strip.bend[rad]"]]
        self.energy_nj = [NJ * (e - w) for e, w in zip(probes["strip.energy_elastic[J]"],
                                                       probes["strip.work_magnetic[J]"])]
        ends = zip(probes["left_x[m]"], probes["left_z[m]"], probes["right_x[m]"],
                   probes["right_z[m]"])
        self.heading_deg = [math.degrees(math.atan2(zr - zl, xr - xl))
                            for xl, zl, xr, zr in ends]

    def row(self, time_s):
        return min(range(len(self.t)), key=lambda i: abs(self.t[i] - time_s))

    def describe(self, name, times):
        for k in map(self.row, times):
            testing.report(f"{name} {self.t[k]:.3g} s: end to end {self.end_to_end_mm[k]:.4f} mm, "
                          f"bend {self.bend_deg[k]:.2f}, heading {self.heading_deg[k]:.2f} deg, "
                          f"energy {self.energy_nj[k]:.1f} nJ")


def turn_deg(after, before):
    return math.remainder(after - before, 360)


def reference(shape):
    with open(FOLDER / "reference.csv", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [row for row in rows if row["shape"] == shape and row["theta_B_deg"] == "90"]


class Turning(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.turned = Shapes("scene.yaml")
        cls.turned.describe("turned", (0, 1, 2, 3))
        cls.flat = Shapes("scene.yaml", {"magnetic_field.table.direction": "90 deg",
                                         "time.end": "250 ms"})
        cls.flat.describe("from flat", (0,))

    def assert_keeps_the_c(self, shapes, times, tolerance_deg):
        rows = [shapes.row(t) for t in times]
        for one, other in zip(rows, rows[1:]):
            turn = turn_deg(shapes.heading_deg[other], shapes.heading_deg[one])
            self.assertAlmostEqual(turn, -45, delta=tolerance_deg)
            self.assertAlmostEqual(shapes.bend_deg[other], shapes.bend_deg[one],
                                   delta=tolerance_deg)
        for row in rows:
            self.assertLess(shapes.bend_deg[row], -200)

    def test_the_c_is_kept(self):
        self.assert_keeps_the_c(self.turned, (0, 1, 2, 3), RIGID_DEG)

    def test_in_motion_too(self):
        motion = Shapes("motion.yaml")
        times = (0.1, 0.25, 0.4, 0.6)
        motion.describe("motion", times)
        self.assert_keeps_the_c(motion, times, MOTION_DEG)
        self.assertAlmostEqual(motion.bend_deg[-1], self.turned.bend_deg[-1], delta=MOTION_DEG)
        # Let go in a field at full strength, both take the same work from it: to the
        # tolerance of rest.
        self.assertAlmostEqual(motion.energy_nj[motion.row(0.1)] / self.turned.energy_nj[0], 1,
                               delta=1e-3)

    def test_on_a_platform_too(self):
        platform = Shapes("platform.yaml")
        platform.describe("platform", (1, 2, 3, 4))
        self.assert_keeps_the_c(platform, (1, 2, 3, 4), PLATFORM_DEG)

    def test_from_flat_it_is_another(self):
        self.assertLess(self.turned.bend_deg[-1], -200)  # a C: ends down
        self.assertGreater(self.flat.bend_deg[-1], 60)   # a V: ends up
        self.assertGreater(self.flat.end_to_end_mm[-1], 3 * self.turned.end_to_end_mm[-1])
        self.assertLess(self.turned.energy_nj[0], 1.5 * self.flat.energy_nj[0])

    def test_both_are_stable(self):
        for shapes in (self.turned, self.flat):
            self.assertNotIn("unstable", shapes.log)
            self.assertNotIn("could not be followed", shapes.log)

    def test_between_the_rods(self):
        # A strip of width 0.4 L is between a narrow and a wide rod; 2 % more for the mesh, which
        # changes the energies by less than that when refined.
        for shape, found in (("C", self.turned), ("V", self.flat)):
            rows = reference(shape)
            energies = [float(r["elastic_nJ"]) + float(r["magnetic_nJ"]) for r in rows]
            self.assertGreater(found.energy_nj[0], 1.02 * min(energies))
            self.assertLess(found.energy_nj[0], 0.98 * max(energies))
            lengths = [LENGTH_MM * float(r["end_to_end/L"]) for r in rows]
            self.assertGreater(found.end_to_end_mm[0], 0.98 * min(lengths))
            self.assertLess(found.end_to_end_mm[0], 1.02 * max(lengths))


if __name__ == "__main__":
    unittest.main()
