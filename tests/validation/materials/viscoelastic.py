# SPDX-License-Identifier: GPL-2.0-or-later
"""Maxwell branches in runs: a pulled bar whose force relaxes, a bent strip that rings down, their
energy audit, restarts to the byte and other ranks; a start in equilibrium that stays there."""

import unittest
from pathlib import Path

import numpy as np

from magfsi import testing

HERE = Path(__file__).resolve().parent
RELAXING, BUCKLED = HERE / "relaxing.yaml", HERE / "buckled.yaml"
BRANCHES = ((30e3, 20e-3), (15e3, 150e-3))


def ramped(t, time, tau):
    """The response at t of exp(-t/tau) to (1 - cos(pi t / time)) / 2, then held."""
    w, ended = np.pi / time, np.minimum(t, time)
    # The integral of w/2 sin(w s) exp(-(t - s)/tau) over s from 0 to the end of the ramp.
    rate = 1 / tau
    top = np.exp(-(t - ended) * rate) * (rate * np.sin(w * ended) - w * np.cos(w * ended))
    return w / 2 * (top + w * np.exp(-t * rate)) / (rate**2 + w**2)


class Relaxing(unittest.TestCase):
    def test_force_is_that_of_the_branches(self):
        run = testing.good_run(RELAXING)
        probes = run.probes()
        t = np.array(probes["t[s]"])
        force = np.array(probes["bar.x_max.reaction_x[N]"])
        # E = 2 G at Poisson's ratio 0; the strain is 1e-3.
        share = (1 - np.cos(np.pi * np.minimum(t, 10e-3) / 10e-3)) / 2
        expected = 30e3 * share
        for modulus, tau in BRANCHES:
            expected = expected + modulus * ramped(t, 10e-3, tau)
        expected = 2 * expected * 1e-3 * 1e-6
        late = t > 20e-3  # the waves of the pull have had twenty passes
        error = np.abs(force - expected)[late].max() / expected.max()
        testing.report(f"relaxation {force[late][0] * 1e6:.2f} to {force[-1] * 1e6:.2f} uN, off by "
                      f"{100 * error:.2f} % of the largest")
        self.assertLess(error, 0.005)
        audit = run.summary()["energy_audit"]
        testing.report(f"audit {audit}")
        self.assertLess(audit["residual"], 1e-3)
        lost = probes["audit.lost_viscosity[J]"]
        self.assertGreater(lost[-1], 0.1 * max(probes["bar.energy_elastic[J]"]))
        self.assertTrue(all(a <= b for a, b in zip(lost, lost[1:])))

    def test_other_ranks_agree(self):
        one, three = (testing.good_run(RELAXING, {"time.end": "30 ms"}, f"structure={n}").probes()
                      for n in (1, 3))
        for name in ("bar.x_max.reaction_x[N]", "bar.energy_elastic[J]",
                     "audit.lost_viscosity[J]"):
            largest = max(map(abs, one[name]))
            for a, b in zip(one[name], three[name]):
                self.assertAlmostEqual(a / largest, b / largest, places=9)


class StartsAtRest(unittest.TestCase):
    def test_buckled_strip_stays_where_it_starts(self):
        probes = testing.good_run(BUCKLED).probes()
        rise = np.array(probes["middle_z[m]"]) - 0.05e-3
        testing.report(f"buckled by {1e3 * rise[0]:.4f} mm, moves by "
                      f"{1e3 * np.ptp(rise):.2e} mm")
        # pi^2 w^2 / (4 L) = shortening: 0.1 mm of 10 mm without the strip's own compression.
        self.assertAlmostEqual(abs(rise[0]) / (2 / np.pi * np.sqrt(10e-3 * 0.1e-3)), 1, delta=0.03)
        self.assertLess(np.ptp(rise), 1e-5 * abs(rise[0]))

    def test_loads_of_time_0_are_borne(self):
        still = testing.good_run(BUCKLED, {
            "bodies.strip.prescribed_motion": "null", "bodies.strip.magnetization":
                "{uniform: [60 kA/m, 0 A/m, 0 A/m]}",
            "magnetic_field": "{plane: xz, constant: {magnitude: 2 mT, direction: 90 deg}}",
            "gravity": "{acceleration: 9.81 m/s2}"}).probes()
        z = np.array(still["end_z[m]"])
        testing.report(f"end at {1e3 * z[0]:.4f} mm, moves by {1e3 * np.ptp(z):.2e} mm")
        self.assertGreater(abs(z[0] - 0.05e-3), 0.5e-3)
        self.assertLess(np.ptp(z), 1e-5 * abs(z[0] - 0.05e-3))


if __name__ == "__main__":
    unittest.main(verbosity=2)
