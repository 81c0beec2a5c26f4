# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes whose error does not fall are told so, with the parameter at fault, and nothing is
promised."""
import unittest

from scenes import BEAM, Scene, testing


class DoesNotSettle(unittest.TestCase):
    def test_the_penalty_in_the_step(self):
        """Its drag coefficient 2 rho h / dt is numerical: values go on as the step is halved."""
        scene = Scene(testing.SMALL.read_text())
        done = scene.good_cost("--budget", "40 s", "--probe", "robot.mid_rise", "--error", "3 %",
                               "--set", "coupling.immersed_boundary.forcing=penalty")
        self.assertIn("step: the values do not settle", scene.probe("robot.mid_rise[m]")["doubt"])
        self.assertIn("within 10 %, 5 %, 3 %, 2 %, 1 %: none is promised. step:", done.out)

    def test_no_run_is_promised(self):
        scene = Scene(testing.SMALL.read_text())
        done = scene.run("--error", "3 %", "--set", "time.end=2 ms")
        self.assertEqual((done.code, len(done.err.strip().splitlines())), (1, 1), done.err)
        self.assertIn("no tolerance of 3 % is promised", done.err)
        self.assertFalse((scene.folder / "runs/small_swimmer").exists())

    def test_a_sheet_below_a_cell(self):
        scene = Scene(testing.SMALL.read_text().replace("0.185 mm]", "0.08 mm]"))
        done = scene.good_cost("--budget", "30 s", "--probe", "robot.mid_rise", "--set",
                               "time.end=1 ms", "--set", "probes.points=")
        self.assertRegex(done.out, r"spacing: robot is 0\.\d+ cells thick in the finest run")
        self.assertIn("none is promised", done.out)

    def test_elements_of_two_kinds_have_one_limit(self):
        scene = Scene(BEAM)
        done = scene.good_cost("--budget", "30 s", "--probe", "tip_uz", "--models")
        self.assertRegex(done.out, r"bodies.beam.element=full: .*; agrees within the bars")
        self.assertNotIn("FAULT", done.out)


if __name__ == "__main__":
    unittest.main()
