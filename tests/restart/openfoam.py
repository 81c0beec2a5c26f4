# SPDX-License-Identifier: GPL-2.0-or-later
"""pimpleFoam goes on from a checkpoint: the same bytes on one rank, the same within the
solver's tolerance on others; and it repeats steps in the implicit scheme."""

import unittest

import scenes
from scenes import testing

GRADED = {"fluid.grading.uniform": "[[2 mm, 1 mm, 3 mm], [6.2 mm, 3 mm, 5.2 mm]]"}
SETTINGS = {"fluid.solver": "openfoam", **GRADED, "time.end": "2 ms",
            "checkpoint.every": "0.4 ms", "probes.every": "0.2 ms",
            "output.fluid.every": "0.4 ms"}
# An outlet's velocity follows the flux; the ramp of the inlet is longer than the run.
OPEN = {**SETTINGS,
        "fluid.boundaries.x_min": "{velocity_inlet: {velocity: [0.1 m/s, 0 m/s, 0 m/s], "
                                  "ramp: 4 ms}}",
        "fluid.boundaries.x_max": "{pressure_outlet: {}}"}
# As for runs on different ranks: the pressure's tolerance, ten times over.
BOUND = 1e-5


COLUMNS = ("robot.end_to_end[m]", "robot.mid_rise[m]", "robot.energy_kinetic[J]",
           "kinetic_energy[J]", "max_speed[m/s]")


class Restart(unittest.TestCase):
    def same_bytes(self, settings, ranks):
        whole = scenes.good(testing.SMALL, settings, testing.new_folder(), ranks)
        parts = scenes.interrupted(testing.SMALL, settings, "1 ms", ranks)
        scenes.assert_same_bytes(self, whole, parts, 2)
        self.assertGreater(scenes.restarted_at(parts), 0)
        return whole

    def test_same_bytes_on_one_rank_and_the_same_on_two(self):
        whole = self.same_bytes(SETTINGS, "structure=1,fluid=1")
        other = scenes.interrupted(testing.SMALL, SETTINGS, "1 ms", "structure=1,fluid=1",
                                   "structure=1,fluid=2")
        a, b = whole.probes(), other.probes()
        for name in COLUMNS:
            scale = max(map(abs, a[name]))
            worst = max(abs(x - y) for x, y in zip(a[name], b[name], strict=True)) / scale
            testing.report(f"gone on with on 2 ranks: {worst:.1e} in {name}")
            self.assertLess(worst, BOUND, name)

    def test_same_bytes_with_openings(self):
        self.same_bytes(OPEN, "structure=1,fluid=1")

    def test_another_mesh_is_refused(self):
        folder = testing.new_folder()
        scenes.good(testing.SMALL, {**SETTINGS, "time.end": "0.4 ms"}, folder)
        other = scenes.run(testing.SMALL, {**SETTINGS, "fluid.spacing": "0.5 mm"}, folder,
                           restart="latest")
        self.assertEqual(other.code, 2, other.err)
        self.assertIn("another scene", other.err)


class Implicit(unittest.TestCase):
    def test_steps_are_repeated(self):
        settings = {**SETTINGS, "checkpoint": "", "coupling.scheme": "implicit",
                    "time.end": "1 ms"}
        run = scenes.good(testing.SMALL, settings, testing.new_folder(), "structure=1,fluid=2")
        iterations = run.summary()["iterations"]
        testing.report(f"implicit: {iterations}")
        self.assertGreater(iterations["mean"], 1)
        testing.check_interface_balance(self, run, "implicit")


if __name__ == "__main__":
    unittest.main()
