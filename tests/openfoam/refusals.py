# SPDX-License-Identifier: GPL-2.0-or-later
"""What fluid.solver: openfoam cannot do is refused before anything is written, with what to do
instead; so is a machine without OpenFOAM."""

import os
import unittest
from pathlib import Path

from magfsi import testing


class Refusals(unittest.TestCase):
    def refused(self, settings, *words):
        folder = Path(testing.new_folder()) / "run"
        run = testing.run(testing.SMALL, {"fluid.solver": "openfoam", **settings}, folder=folder,
                         limit_s=60)
        self.assertEqual(run.code, 2, run.err)
        self.assertEqual(len(run.err.strip().splitlines()), 1, run.err)
        for word in words:
            self.assertIn(word, run.err)
        self.assertFalse(folder.exists())

    def test_openfoam_is_missing(self):
        os.environ["WM_PROJECT_DIR"] = "/nonexistent"
        try:
            self.refused({}, "OpenFOAM", "apt-get install openfoam")
        finally:
            del os.environ["WM_PROJECT_DIR"]

    def test_an_obstacle_across_a_periodic_side(self):
        self.refused({"fluid.boundaries": "{y_min: periodic, y_max: periodic}", "fluid.obstacles":
                      "{ball: {sphere: {centre: [1 mm, 0.2 mm, 1 mm], diameter: 1 mm}}}"},
                     "ball", "y_min")

    def test_obstacles_on_two_ranks(self):
        folder = Path(testing.new_folder()) / "run"
        run = testing.run(testing.SMALL, {
            "fluid.solver": "openfoam",
            "fluid.obstacles": "{ball: {sphere: {centre: [1 mm, 1 mm, 1 mm], diameter: 1 mm}}}"},
            "fluid=2", folder=folder, limit_s=60)
        self.assertEqual(run.code, 2, run.err)
        self.assertIn("fluid=2", run.err)
        self.assertFalse(folder.exists())

    def test_a_dictionary_that_breaks_the_coupling(self):
        file = Path(testing.new_folder()) / "mine"
        file.write_text("ddtSchemes { default steadyState; }\n")
        self.refused({"fluid.openfoam.schemes": str(file)}, "mine:1", "steadyState", "Euler")
        file.write_text("a { type coded; }\n")
        self.refused({"fluid.openfoam.functions": str(file)}, "mine:1", "coded")
        self.refused({"fluid.openfoam.solution": str(file) + "_lost"}, "cannot be read")

    def test_a_uniform_part_beyond_the_box(self):
        self.refused({"fluid.grading.uniform": "[[1 mm, 1 mm, 1 mm], [9 mm, 3 mm, 5 mm]]"},
                     "uniform", "along x")

    def test_an_inlet_behind_an_obstacle(self):
        self.refused({"fluid.boundaries.x_min": "{velocity_inlet: {velocity: [1 mm/s, 0 m/s, 0 m/s]}}",
                      "fluid.boundaries.x_max": "pressure_outlet",
                      "fluid.obstacles": "{plug: {box: [[-1 mm, -1 mm, -1 mm], [0.3 mm, 9 mm, 9 mm]]}}"},
                     "x_min", "behind fluid.obstacles", "opening beside")

    @unittest.skipUnless((testing.BIN.parent / "lib/libmagfsi_openfoam_engine.so").exists(),
                         "this build has no OpenFOAM")
    def test_an_opening_between_the_centres_of_faces(self):
        self.refused({"fluid.boundaries.x_min": "{velocity_inlet: {velocity: [1 mm/s, 0 m/s, 0 m/s], "
                                                "disc: {centre: [2 mm, 2 mm], diameter: 0.3 mm}}}",
                      "fluid.boundaries.x_max": "pressure_outlet"}, "x_min", "holds the centre of no")


if __name__ == "__main__":
    unittest.main()
