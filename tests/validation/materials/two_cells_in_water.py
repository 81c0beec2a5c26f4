# SPDX-License-Identifier: GPL-2.0-or-later
"""In a fluid each material has its own density, and a heavy half sinks first."""

import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "two_cells_in_water.yaml"
CELL_M3 = 2e-3 * 2e-3 * 0.2e-3


class InWater(unittest.TestCase):
    def test_each_material_has_its_mass_and_the_heavy_one_sinks_first(self):
        run = testing.good_run(SCENE)
        probes = run.probes()
        lines = (run.folder / "bodies.data").read_text().splitlines()
        first = next(i for i, line in enumerate(lines) if line.startswith("Atoms"))
        atoms = [line.split() for line in lines[first + 1:] if line.strip()]
        # atom_style sphere: ID, type, diameter 0, mass (as density), x, y, z
        mass = sum(float(words[3]) for words in atoms)
        # Of the fluid inside, two thirds of the lighter material's density come off the nodes.
        off = 2 / 3 * 1300
        com_x = sum(float(words[3]) * float(words[4]) for words in atoms) / mass
        # Rounding.
        self.assertAlmostEqual(mass / (CELL_M3 * (1860 + 1300 - 2 * off)), 1, places=12)
        centre = 4e-3
        expected = centre + (1300 - 1860) / (1300 + 1860 - 2 * off) * 1e-3
        self.assertAlmostEqual(com_x / expected, 1, places=9)
        expected = centre + (1300 - 1860) / (1300 + 1860) * 1e-3  # the probe's: all of it
        self.assertAlmostEqual(probes["sheet.com_x[m]"][0] / expected, 1, places=9)
        sunk = {name: probes[name + "_z[m]"][0] - probes[name + "_z[m]"][-1]
                for name in ("heavy", "light")}
        testing.report(f"sunk by {sunk}")
        self.assertGreater(sunk["heavy"], 1.2 * max(sunk["light"], 0))


if __name__ == "__main__":
    unittest.main(verbosity=2)
