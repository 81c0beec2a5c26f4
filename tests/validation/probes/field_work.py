# SPDX-License-Identifier: GPL-2.0-or-later
"""The work of the field on a path of equilibria: the elastic energy that it leaves, whichever
method finds the equilibria."""

import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "field_work.yaml"


def work_and_energy(**settings):
    probes = testing.good_run(SCENE, settings).probes()
    return probes["beam.work_magnetic[J]"][-1], probes["beam.energy_elastic[J]"][-1]


class FieldWork(unittest.TestCase):
    # Nothing is lost on a path without jumps. The trapezium rule's error falls with the square
    # of the steps.
    def test_is_the_elastic_energy_on_a_refined_path(self):
        work, elastic = work_and_energy(**{"probes.every": "10 ms"})
        testing.report(f"100 points: work over elastic energy {work / elastic:.6f}")
        self.assertAlmostEqual(work / elastic, 1, delta=1e-3)

    def test_does_not_depend_on_the_method(self):
        newton, _ = work_and_energy()
        dynamics, _ = work_and_energy(**{"time.equilibrium.method": "dynamics"})
        testing.report(f"newton {newton:.6g} J, dynamics {dynamics:.6g} J")
        # A residual of 1e-5 of the load, times the beam's softness.
        self.assertAlmostEqual(dynamics / newton, 1, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
