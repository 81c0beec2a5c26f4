# SPDX-License-Identifier: GPL-2.0-or-later
"""Explicit direct forcing that is too strong fails, and is stopped with its cause.

A ball full of markers, held still. With strength 1 a pass removes about all of the slip: the forces of
neighbouring markers add up in the cells between them. With 2 it throws the fluid inside as far the
other way, further in every step.
"""

import unittest
from pathlib import Path

from magfsi import testing

import ball_mesh
import drag


class Strength(unittest.TestCase):
    def run_with(self, strength):
        folder = testing.new_folder()
        scene = Path(folder) / "drag.yaml"
        scene.write_text(drag.SCENE.read_text())
        ball_mesh.write(Path(folder) / "ball.msh", ball_mesh.ball(8, 3, drag.DIAMETER), hold=True)
        return testing.run(scene, {"fluid.spacing": f"{1 / 6} mm", "time.end": "60 ms",
                                  "coupling.immersed_boundary.strength": strength}, limit_s=300)

    def test_one_holds(self):
        self.assertEqual(self.run_with(1).code, 0)

    def test_two_is_stopped_with_cause_place_step_and_advice(self):
        result = self.run_with(2)
        self.assertEqual(result.code, 3)
        for words in ("diverged after step", "in cell (", "the force changes its speed by",
                      "a smaller coupling.immersed_boundary.strength", "after coupled step"):
            self.assertIn(words, result.err)


if __name__ == "__main__":
    unittest.main(verbosity=2)
