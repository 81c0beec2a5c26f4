# SPDX-License-Identifier: GPL-2.0-or-later
"""The norm gain: 0 for energies that only lose what is taken off, and what is missing where a
part of the balance is left out."""

import unittest

from studies import Study, testing

# The fluid inside the body is counted in the fluid's energy: 1 - 1000 / 1860 is left.
TEXT = f"""
scene: {testing.SMALL}
set: {{gravity: null}}
right_within: 0.1 %
axes:
  field: {{key: magnetic_field.constant.magnitude, values: [10 mT]}}
errors:
  all:
    probe: ["robot.energy_elastic[J]", "0.462366 * robot.energy_kinetic[J]",
            "kinetic_energy[J]", "- robot.work_magnetic[J]"]
    norm: gain
  later: {{probe: ["- mass[kg]", "robot.bend[rad]"], norm: rise}}
  part:
    probe: ["robot.energy_elastic[J]", "robot.energy_kinetic[J]"]
    norm: gain
"""


class WhatABalanceGains(unittest.TestCase):
    def test_whole_and_part(self):
        study = Study(TEXT)
        study.good_run()
        row, = study.rows()
        self.assertLess(float(row["error_all[1]"]), 1e-12)
        # It bends all the time, from 0, and the mass stays.
        self.assertAlmostEqual(float(row["error_later[1]"]), 1, delta=1e-6)
        # Nothing taken off: the sum rises by at least its largest term.
        self.assertGreaterEqual(float(row["error_part[1]"]), 1)
        self.assertEqual(row["verdict"], "wrong")


if __name__ == "__main__":
    unittest.main()
