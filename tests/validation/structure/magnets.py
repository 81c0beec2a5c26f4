# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies near magnets: what holds them bears the force of the field, both methods find the same
equilibria, and in motion the work of the field is what bodies gain."""

import math
import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).resolve().parent
AXES = "xyz"


class NearAMagnet(unittest.TestCase):
    def test_both_methods_agree_and_the_clamp_bears_the_force(self):
        runs = {method: testing.good_run(HERE / "near_a_magnet.yaml", {
            "time.equilibrium.method": method, "time.equilibrium.tolerance": 1e-6}).probes()
            for method in ("newton", "dynamics")}
        for column in ("tip_x[m]", "tip_z[m]", "bar.work_magnetic[J]", "bar.energy_elastic[J]",
                       "bar.magnetic_force_z[N]", "bar.magnetic_torque_y[N m]"):
            newton, dynamics = (runs[m][column] for m in ("newton", "dynamics"))
            testing.report(f"{column}: newton {newton[-1]:.6g}, dynamics {dynamics[-1]:.6g}")
            # The residual times the bar's softness, as in supports.py.
            for a, b in zip(newton, dynamics):
                self.assertAlmostEqual(a, b, delta=1e-3 * max(map(abs, newton)))
        p = runs["newton"]
        largest = max(abs(f) for a in AXES for f in p[f"bar.magnetic_force_{a}[N]"])
        for axis in AXES:
            for held, drawn in zip(p[f"bar.x_min.reaction_{axis}[N]"],
                                   p[f"bar.magnetic_force_{axis}[N]"]):
                # 99 nodes, each with the tolerance.
                self.assertAlmostEqual(held, -drawn, delta=1e-4 * largest)

    # Let go near a magnet that turns, free of all else: kinetic and elastic energy are the work.
    def test_work_of_the_field_is_what_the_body_gains(self):
        for turning in ({}, {"magnetic_field.sources.magnet.turning":
                             "{axis: [0, 1, 0], frequency: 20 Hz}"}):
            run = testing.good_run(HERE / "near_a_magnet.yaml", turning | {
                "time": "{end: 10 ms}", "bodies.bar.clamps": "null",
                "magnetic_field.sources.magnet.motion": "null",
                "probes": "{every: 1 ms, bodies: [energy, speed], energy_audit: true}"})
            p = run.probes()
            work = p["bar.work_magnetic[J]"]
            gained = [e + k for e, k in zip(p["bar.energy_elastic[J]"],
                                            p["bar.energy_kinetic[J]"])]
            off = max(abs(w - g) for w, g in zip(work, gained)) / max(gained)
            testing.report(f"{'turning' if turning else 'at rest'}: work {work[-1]:.6g} J, off by {off:.2g}")
            # Second order in LAMMPS's step, of which the stiffest mode has some ten.
            self.assertLess(off, 2e-3)
            self.assertGreater(math.hypot(*(p[f"bar.speed_{a}[m/s]"][-1] for a in AXES)), 1e-3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
