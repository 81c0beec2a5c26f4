# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that follow from the axes by a formula, weights of a sum that do, refusals as rows,
and a bound for each error of its own."""

import csv
import unittest

from studies import Study, testing

TEXT = f"""
scene: {testing.SMALL}
set: {{gravity: null, time.end: 2 ms}}
axes:
  relaxation_time: {{values: {{0.53: {{}}, 0.65: {{}}}}}}
  lattice_speed: {{key: fluid.lattice_speed, values: [0.1, 0.3]}}
derived:
  fluid.viscosity: {{formula: (relaxation_time - 0.5) / 3 * 0.5 * 0.25e-3 / lattice_speed, unit: m2/s}}
errors:
  weighted: {{probe: ["relaxation_time * 2 * mass[kg]"], norm: largest}}
  mass: {{probe: "mass[kg]", norm: largest}}
right_within: {{mass: 1 %}}
refusals: rows
"""


class WhatFollowsFromAxes(unittest.TestCase):
    def test_rows(self):
        study = Study(TEXT)
        study.good_run()
        rows = study.rows()
        self.assertEqual([row["outcome"] for row in rows], ["completed", "refused"] * 2)
        for row in rows[::2]:
            # 8 x 4 x 8 mm of water; the weighted sum has no bound, or all were wrong.
            self.assertAlmostEqual(float(row["error_mass[1]"]), 2.56e-4, delta=1e-9)
            self.assertAlmostEqual(
                float(row["error_weighted[1]"]),
                2 * float(row["relaxation_time[1]"]) * 2.56e-4, delta=1e-9)
            self.assertEqual(row["verdict"], "right")
        self.assertIn("lattice_speed", rows[1]["cause"])

    def test_the_scene_has_the_value(self):
        """Another relaxation time, another flow."""
        study = Study(TEXT)
        study.good_run()
        ends = []
        for folder in (study.out / "runs").iterdir():
            with open(folder / "probes.csv", newline="") as file:
                ends.append(float(list(csv.DictReader(file))[-1]["kinetic_energy[J]"]))
        self.assertEqual(len(ends), 2)
        self.assertGreater(max(ends) / min(ends), 1.05)  # five times the viscosity

    def test_a_formula_without_a_number(self):
        study = Study(TEXT.replace("/ lattice_speed,", "/ (lattice_speed - 0.1),"))
        done = study.run()
        self.assertEqual(done.code, 2, done.err)
        self.assertRegex(done.err, r":8:\d+: derived.fluid.viscosity.formula: .*no number for "
                         "0.53, 0.1;")
        self.assertFalse(study.out.exists())


if __name__ == "__main__":
    unittest.main()
