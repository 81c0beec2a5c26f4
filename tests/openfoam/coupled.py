# SPDX-License-Identifier: GPL-2.0-or-later
"""Real pimpleFoam and real LAMMPS in one job: the same on 1 and 2 OpenFOAM ranks, nothing lost at
the interface, fields for ParaView, and an end in order when a side is killed."""

import os
import signal
import time
import unittest

from magfsi import testing

SETTINGS = {"fluid.solver": "openfoam", "time.end": "1 ms",
            "fluid.grading.uniform": "[[2 mm, 1 mm, 3 mm], [6.2 mm, 3 mm, 5.2 mm]]"}
# The pressure's tolerance, 1e-6, ten times over: ten steps, of which each starts from the
# last; other ranks agglomerate other cells, so the remaining errors are not the same.
BOUND = 1e-5


class Coupled(unittest.TestCase):
    def test_same_on_1_and_2_ranks(self):
        settings = {**SETTINGS, "output.fluid.every": "1 ms",
                    "output.fluid.fields": "[velocity, vorticity]"}
        one, two = (testing.good_run(testing.SMALL, settings, f"structure=1,fluid={n}")
                    for n in (1, 2))
        for run in (one, two):
            self.assertTrue((run.folder / "fields" / "fluid_000001.pvti").exists())
            self.assertIn("fluid_000001.pvti", (run.folder / "fluid.pvd").read_text())
            self.assertEqual(run.summary()["outcome"], "completed")
            self.assertLess(run.summary()["fluid"]["cells"], 32 * 16 * 32)  # graded
        a, b = one.probes(), two.probes()
        for name in ("robot.end_to_end[m]", "robot.com_z[m]", "robot.mid_rise[m]",
                     "robot.energy_kinetic[J]", "kinetic_energy[J]", "max_speed[m/s]"):
            scale = max(map(abs, a[name]))
            worst = max(abs(x - y) for x, y in zip(a[name], b[name], strict=True)) / scale
            testing.report(f"1 and 2 ranks: {worst:.1e} in {name}")
            self.assertGreater(scale, 0)
            self.assertLess(worst, BOUND, name)
        for run in (one, two):
            testing.check_interface_balance(self, run, f"{run.summary()['ranks']}")

    def test_the_body_moves_the_fluid(self):
        probes = testing.good_run(testing.SMALL, SETTINGS).probes()
        self.assertGreater(probes["kinetic_energy[J]"][-1],
                           0.1 * probes["robot.energy_kinetic[J]"][-1])


class Killed(unittest.TestCase):
    def kill(self, name):
        process, folder = testing.get_going(testing.SMALL, {
            **SETTINGS, "time.end": "1 s"}, rows=2)
        began = time.monotonic()
        os.kill(testing.process_of(folder, name), signal.SIGKILL)
        run = testing.finish(process, began, folder, 120)  # s: the machine may be busy
        testing.report(f"{name} killed: ended after {run.seconds:.2f} s: {run.err.strip()}")
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 4, run.err)
        self.assertIn("was killed by signal 9", run.err)
        self.assertEqual(run.summary()["outcome"], "lost_partner")

    def test_fluid(self):
        self.kill("magfsi-fluid-openfoam")

    def test_structure(self):
        self.kill("magfsi-structure")


if __name__ == "__main__":
    unittest.main()
