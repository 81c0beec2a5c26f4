#!/usr/bin/python3
"""The lid-driven cavity at Reynolds number 100 by both fluids on the same grid, from rest to
close to its steady state: the same energy and enstrophy, by two methods that share no code."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import magfsi_runs as magfsi  # noqa: E402

SCENE = """
name: cavity
time: {end: 6 s}
fluid:
  box: [10 mm, 1.25 mm, 10 mm]
  spacing: 0.3125 mm
  density: 1000 kg/m3
  viscosity: 1 mm2/s
  expected_speed: 10 mm/s
  boundaries:
    y_min: periodic
    y_max: periodic
    z_max: {no_slip: {velocity: [10 mm/s, 0 m/s, 0 m/s]}}
probes: {every: 1 s, fluid: [kinetic_energy, enstrophy, max_speed]}
"""
# Either fluid is within 1 to 2 % of its own finer grids here: energy of order h^2, and the
# corners under the lid, where the velocity jumps, of order h.
BOUND = 0.04


class Cavity(unittest.TestCase):
    def test_both_fluids_agree(self):
        scene = Path(magfsi.new_folder()) / "cavity.yaml"
        scene.write_text(SCENE)
        lbm, foam = (magfsi.good_run(scene, {"fluid.solver": solver}, "fluid=1").probes()
                     for solver in ("lbm", "openfoam"))
        for t in range(1, 7):
            a, b = lbm["kinetic_energy[J]"][t], foam["kinetic_energy[J]"][t]
            magfsi.report(f"t = {t} s: energy {a:.4e} J (lbm), {b / a - 1:+.2%} (openfoam)")
            self.assertAlmostEqual(b / a, 1, delta=BOUND)
        self.assertLess(max(foam["max_speed[m/s]"]), 0.01)  # nowhere faster than the lid


if __name__ == "__main__":
    unittest.main()
