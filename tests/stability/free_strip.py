# SPDX-License-Identifier: GPL-2.0-or-later
"""A free strip in vacuum rings at its first bending mode and keeps its energy.

The frequency of a free slender beam is 22.373 / (2 pi L^2) sqrt(E I / (rho A)): 100.6 Hz here.
The nodes' lumped masses give a layered lattice 1 + 2 / n^2 times the rotary inertia of n layers,
which slows one layer by 1 % more than two."""

import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "free_strip.yaml"
BEAM_HZ = 100.6
PULSE_S = 5e-3


def crossings(times, values):
    """Instants at which the values rise through their mean."""
    mean = sum(values) / len(values)
    return [t0 + (t1 - t0) * (mean - v0) / (v1 - v0)
            for t0, t1, v0, v1 in zip(times, times[1:], values, values[1:])
            if v0 < mean <= v1]


class Ringing:
    def __init__(self, elements):
        run = testing.good_run(SCENE, {"bodies.strip.mesh.box.elements": elements})
        self.audit = run.summary()["energy_audit"]
        probes = run.probes()
        free = [i for i, t in enumerate(probes["t[s]"]) if t > PULSE_S]
        rises = crossings([probes["t[s]"][i] for i in free],
                          [probes["strip.mid_rise[m]"][i] for i in free])
        self.periods = len(rises) - 1
        self.frequency_hz = self.periods / (rises[-1] - rises[0])
        work = probes["strip.work_magnetic[J]"]
        self.residual = max(abs(elastic + kinetic - w) for elastic, kinetic, w in zip(
            probes["strip.energy_elastic[J]"], probes["strip.energy_kinetic[J]"], work))
        self.residual /= work[-1]
        testing.report(f"{elements} elements: {self.frequency_hz:.2f} Hz, energy residual "
                      f"{self.residual:.1e} of the work over {self.periods} periods")


class FreeStrip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.coarse, cls.fine = Ringing("[20, 8, 1]"), Ringing("[40, 8, 2]")

    def test_rings_at_the_beams_frequency(self):
        # Seen: -1.6 and -0.3 %.
        errors = [abs(run.frequency_hz / BEAM_HZ - 1) for run in (self.coarse, self.fine)]
        self.assertLess(errors[1], 0.01)
        self.assertLess(errors[1], errors[0] / 2)

    def test_keeps_its_energy(self):
        for run in (self.coarse, self.fine):
            self.assertGreaterEqual(run.periods, 10)
            # Seen: 2e-6. The work is summed with the velocities of the half steps, whose
            # error oscillates and does not grow.
            self.assertLess(run.residual, 1e-4)
            self.assertLess(run.audit["residual"], 1e-4)


if __name__ == "__main__":
    unittest.main()
