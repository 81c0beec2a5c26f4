# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid parts that only the mesh shows to be wrong: one error with its place, exit code 2, from
check in the words of run."""

import subprocess
import unittest
from pathlib import Path

from magfsi import runs, testing

BEAM = Path(__file__).resolve().parent / "beam.yaml"
MAGNET = "magnet: {box: [[7 mm, 0 mm, 0 mm], [8 mm, 1 mm, 1 mm]]}"


class Refusals(unittest.TestCase):
    def refused(self, settings, words):
        result = testing.run(BEAM, settings)
        testing.check_refused(self, result, words)
        checked = subprocess.run(runs.command("check", BEAM, settings), capture_output=True,
                                 text=True, check=False)
        self.assertEqual(checked.returncode, runs.EXIT_INPUT, checked.stderr)
        self.assertIn(words, checked.stderr)
        return result.err

    def test_parts_that_touch(self):
        message = self.refused(
            {"bodies.beam.regions": f"{{{MAGNET}, next: {{box: [[5 mm, 0 mm, 0 mm], "
                                    "[7 mm, 1 mm, 1 mm]]}}",
             "bodies.beam.rigid": "[magnet, next]"}, "rigid parts that touch each other")
        self.assertIn("--set bodies.beam.rigid", message)

    def test_a_part_in_pieces(self):
        self.refused({"bodies.beam.regions": f"{{{MAGNET}, middle: {{box: [[3 mm, 0 mm, 0 mm], "
                                             "[5 mm, 1 mm, 1 mm]]}}",
                      "bodies.beam.rigid": "rest", "bodies.beam.clamps": ""},
                     "a rigid part in pieces")

    def test_a_clamp_on_its_nodes(self):
        self.refused({"bodies.beam.clamps": "[x_max]", "bodies.beam.rigid": "magnet"},
                     "a rigid part with a node that a clamp")

    def test_a_clamp_is_told_by_line_and_column(self):
        """The scene's own key rather than --set: the words begin with FILE:LINE:COLUMN."""
        scene = Path(testing.new_folder()) / "beam.yaml"
        for held in ("clamps: [x_max]", "rollers: [{face: x_max, axis: y}]",
                     "prescribed_motion: [{face: x_max, oscillation: {amplitude: "
                     "[1 mm, 0 m, 0 m], frequency: 10 Hz}}]"):
            text = BEAM.read_text().replace("clamps: [x_min]", f"{held}\n    rigid: magnet")
            scene.write_text(text)
            line = text.splitlines().index("    rigid: magnet") + 1
            result = testing.run(scene, {})
            testing.check_refused(self, result, f"beam.yaml:{line}:12: body 'beam': a rigid part "
                                                "with a node that a clamp, a roller or a")


if __name__ == "__main__":
    unittest.main()
