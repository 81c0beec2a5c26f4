# SPDX-License-Identifier: GPL-2.0-or-later
"""What a refined grid cannot do is refused in one line, before anything is written, or ends the
run with a name."""

import subprocess
import unittest
from pathlib import Path

from magfsi import runs, testing

REFUSED = [
    ({"fluid.refinement": "{levels: 4}"}, "at most 3"),
    ({"fluid.refinement": "{margin: 0.1 mm}"}, "at least 750 um"),
    ({"fluid.refinement": "{box: [[1 mm, 1 mm, 1 mm], [9 mm, 3 mm, 7 mm]]}"},
     "within the fluid's box, from 0 m to 8 mm"),
    ({"fluid.refinement": "{margin: 1 mm, box: [[1 mm, 1 mm, 1 mm], [7 mm, 3 mm, 7 mm]]}"},
     "one of the two"),
    ({"fluid.refinement": "{levels: 1}", "fluid.solver": "openfoam"}, "fluid.solver: lbm"),
    ({"fluid.refinement": "{levels: 1, margin: 2 mm}",
      "fluid.boundaries.x_min": "{velocity_inlet: {velocity: [0.1 m/s, 0 m/s, 0 m/s]}}",
      "fluid.boundaries.x_max": "{pressure_outlet: {}}"},
     "keep the bodies and their margin, or fluid.refinement.box, 0.001 m from it"),
    ({"fluid.refinement": "{levels: 1}", "probes.fluid": "[obstacle_force]",
      "fluid.obstacles.ball.sphere": "{centre: [5 mm, 2 mm, 2.6 mm], diameter: 1 mm}"},
     'cuts the obstacle "ball" at ('),
]


class Refused(unittest.TestCase):
    def test_before_the_run(self):
        for settings, words in REFUSED:
            with self.subTest(settings):
                folder = Path(testing.new_folder())
                run = testing.run(testing.SMALL, settings, folder=folder / "out")
                testing.check_refused(self, run, words)
                self.assertFalse((folder / "out").exists())

    def test_a_body_that_leaves_a_patch_that_stays(self):
        """Begun outside of it, it is refused; driven out of it, the run ends."""
        words = "come to the sides of the refined patch"
        outside = {"fluid.refinement": "{box: [[3 mm, 1 mm, 3.3 mm], [8 mm, 3 mm, 5 mm]]}"}
        testing.check_refused(self, testing.run(testing.SMALL, outside), words)
        run = testing.run(testing.SMALL, {
            "fluid.refinement": "{box: [[1 mm, 0.5 mm, 2.5 mm], [7 mm, 3.5 mm, 5.5 mm]]}",
            "magnetic_field": "null", "bodies.robot.magnetization": "null",
            "bodies.robot.prescribed_motion": "[{face: [x_min, x_max], ramp: {displacement: "
                                              "[0 m, 0 m, -1.3 mm], duration: 4 ms}}]"})
        self.assertEqual(run.code, 3, run.err)
        self.assertIn(words, run.err)

    def test_an_interval_that_is_no_whole_step_is_warned_of(self):
        scene = [runs.BIN / "magfsi", "check", testing.SMALL, "--set", "fluid.refinement.levels=3",
                 "--set", "fluid.spacing=1 mm", "--set", "fluid.box=[16 mm, 8 mm, 16 mm]"]
        for every, words in (("0.12 ms", "probes.every: 0.12 ms becomes 0.1 ms, a whole number of "
                              "steps of 0.1 ms, those of the coarsest level"), ("0.2 ms", None)):
            with self.subTest(every):
                said = subprocess.run([*scene, "--set", f"probes.every={every}"], check=True,
                                      capture_output=True, text=True).stdout
                if words:
                    self.assertIn(words, said)
                else:
                    self.assertNotIn("becomes", said)


if __name__ == "__main__":
    unittest.main()
