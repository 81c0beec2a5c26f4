# SPDX-License-Identifier: GPL-2.0-or-later
"""Integral probes: parts of a body add up to the body, and a plane sees the inlet's flow."""

import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "integrals.yaml"
MASS_KG = 1200 * 1e-3 * 8e-3 * 4e-3


class Integrals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.probes = testing.good_run(SCENE, ranks="structure=2,fluid=2").probes()

    def column(self, name):
        return self.probes[name][1:]  # the first row has no step behind it

    def assert_same(self, ones, others, scale, places):
        for one, other in zip(ones, others):
            self.assertAlmostEqual(one / scale, other / scale, places=places)

    def test_a_part_that_is_the_body_has_its_momentum_and_its_force(self):
        for axis in "xy":
            force = self.column(f"beam.fluid_force_{axis}[N]")
            self.assert_same(self.column(f"whole.fluid_force_{axis}[N]"), force,
                             max(map(abs, force)), 12)  # rounding
            momentum = [MASS_KG * v for v in self.column(f"beam.speed_{axis}[m/s]")]
            self.assert_same(self.column(f"whole.momentum_{axis}[kg m/s]"), momentum,
                             max(map(abs, momentum)), 12)
            com = self.probes[f"beam.com_{axis}[m]"]
            moved = [x - com[0] for x in com[1:]]
            # com is rounded to 1e-16 of its place, 10 mm; moved by some micrometres.
            self.assert_same(self.column(f"whole.u{axis}[m]"), moved, max(map(abs, moved)), 9)

    def test_parts_add_up(self):
        for name in ("fluid_force_x[N]", "momentum_x[kg m/s]"):
            whole = self.column(f"whole.{name}")
            parts = [a + b for a, b in zip(self.column(f"lower.{name}"),
                                           self.column(f"upper.{name}"))]
            self.assert_same(parts, whole, max(map(abs, whole)), 12)  # rounding

    def test_the_free_half_moves_more(self):
        self.assertGreater(self.column("upper.ux[m]")[-1],
                           1.2 * self.column("lower.ux[m]")[-1])
        self.assertGreater(self.column("lower.ux[m]")[-1], 0)

    def test_the_inflow_is_the_inlets(self):
        # 0.1 m/s through 16 mm x 4 mm, half a cell from the inlet; the sound that the
        # start leaves compresses by some per cent.
        flow = self.column("inflow.flow[m3/s]")[-1]
        self.assertAlmostEqual(flow / (0.1 * 16e-3 * 4e-3), 1, delta=0.05)
        self.assertGreater(self.column("inflow.pressure[Pa]")[-1],
                           self.column("outflow.pressure[Pa]")[-1])

    def test_means_are_those_of_all_steps_since_the_last_row(self):
        steps = {"time.step": "125 us", "probes.integrals.inflow": "", "probes.integrals.outflow": ""}
        every = testing.good_run(SCENE, {**steps, "probes.every": "125 us"}).probes()
        means = testing.good_run(SCENE, {**steps, "probes.mean_forces": "true"},
                                 "structure=2,fluid=1").probes()
        for name in ("beam", "upper"):
            force = every[f"{name}.fluid_force_x[N]"]
            mean = means[f"{name}.mean_fluid_force_x[N]"]
            self.assertNotIn(f"{name}.fluid_force_x[N]", means)
            self.assertEqual(mean[0], 0)
            rows = [sum(force[4 * i - 3:4 * i + 1]) / 4 for i in range(1, len(mean))]
            self.assert_same(mean[1:], rows, max(map(abs, rows)), 9)  # the ranks' rounding
            # They are no last steps.
            self.assertGreater(abs(mean[1] - force[4]), 1e-3 * abs(force[4]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
