# SPDX-License-Identifier: GPL-2.0-or-later
"""The magnetic strip: free, it takes the shapes of 3D finite elements
(tutorials/strip/reference.csv) by Newton's method and by damped motion; on the ground under its
weight it is a V in the directions near 45 degrees and a C near 225."""

import csv
import math
import unittest

from magfsi import testing

FOLDER = testing.ROOT / "tutorials/strip"
LENGTH_M, THICKNESS_M = 3.7e-3, 0.185e-3
DIRECTION = "magnetic_field.table.direction"
# Two layers: with one the rise of the V at 20 mT is 3 to 4 % off. Little damping: the free
# strip turns as a whole, slowly under the drag that suits its bending.
FREE = {"gravity": "null", "platform": "null", "output": "null",
        "bodies.strip.mesh.box.elements": "[40, 8, 2]", "damping.rate": "100 1/s",
        "time.end": "3 s", "probes.every": "1 s",
        "magnetic_field.table.time": "[0 s, 1 s, 2 s, 3 s]",
        "magnetic_field.table.magnitude": "[0 mT, 1 mT, 5 mT, 20 mT]"}


def shapes(settings):
    """{field in mT: (end to end / L, rise / L, bend in degrees)}."""
    probes = testing.good_run(FOLDER, settings).probes()
    columns = zip(probes["field[T]"], probes["strip.end_to_end[m]"],
                  probes["strip.mid_rise[m]"], probes["strip.bend[rad]"])
    return {round(1e3 * field, 6): (ends / LENGTH_M, rise / LENGTH_M, math.degrees(bend))
            for field, ends, rise, bend in columns}


def reference():
    """{(direction, field in mT): shape} of the coarser mesh, that has all the fields."""
    with open(FOLDER / "reference.csv", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {(int(row["theta_B_deg"]), float(row["B_mT"])):
            tuple(float(row[name]) for name in ("end_to_end/L", "mid_rise/L", "total_bend_deg"))
            for row in rows if row["source"] == "fem3D 40x4x2"}


class FreeStrip(unittest.TestCase):
    def compare(self, direction):
        newton = shapes({**FREE, DIRECTION: f"{direction} deg",
                         "time.equilibrium.method": "newton"})
        motion = shapes({**FREE, DIRECTION: f"{direction} deg",
                         "time.equilibrium.method": "dynamics"})
        for field in (1.0, 5.0, 20.0):
            wanted = reference()[direction, field]
            errors = [a / b - 1 for a, b in zip(newton[field], wanted)]
            apart = max(abs(a / b - 1) for a, b in zip(motion[field], newton[field]))
            text = ", ".join(f"{100 * e:+.2f} %" for e in errors)
            testing.report(f"{direction} degrees, {field:g} mT: ends, rise, bend {text}; "
                          f"damped motion differs by {apart:.1e}")
            # The reference's own two meshes differ by 0.1 %; two percent is what the
            # tutorial promises.
            self.assertLess(max(map(abs, errors)), 0.02)
            # The force tolerance of 1e-6 leaves less than this of the softest shape.
            self.assertLess(apart, 1e-3)

    def test_v_as_finite_elements(self):
        self.compare(45)

    def test_c_as_finite_elements(self):
        self.compare(225)


class StripOnTheGround(unittest.TestCase):
    def bend_deg(self, direction):
        return shapes({DIRECTION: f"{direction} deg", "output": "null",
                       "probes.every": "500 ms"})[20.0][2]

    def test_v_near_45_degrees(self):
        # The free V turns its ends by 75 degrees, the free C by -257: half of each tells
        # them from a flat strip.
        for direction in (0, 45, 90):
            self.assertGreater(self.bend_deg(direction), 37)

    def test_c_near_225_degrees(self):
        for direction in (180, 225, 270):
            self.assertLess(self.bend_deg(direction), -128)

    def test_contact_keeps_the_ends_apart(self):
        strong = {DIRECTION: "225 deg", "output": "null",
                  "magnetic_field.table.magnitude": "[0 mT, 60 mT]"}
        through = shapes(strong)[60.0][0] * LENGTH_M
        held = shapes({**strong, "contact": "{}"})[60.0][0] * LENGTH_M
        testing.report(f"C at 60 mT: ends {1e3 * held:.3f} mm apart with contact, "
                      f"{1e3 * through:.3f} mm without")
        # Mid-planes of ends that face each other are a thickness apart or more.
        self.assertLess(through, THICKNESS_M)
        self.assertGreater(held, THICKNESS_M)


if __name__ == "__main__":
    unittest.main()
