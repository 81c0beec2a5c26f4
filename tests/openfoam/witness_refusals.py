# SPDX-License-Identifier: GPL-2.0-or-later
"""What magfsi witness reads of a run: it refuses one of which there can be no witness (exit code 2, why,
what is allowed, and nothing written), and finds its work. OpenFOAM is not needed for that."""
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

from magfsi import testing
from magfsi.witness import compare, recorded
from magfsi.witness.recorded import Box, Refused

STRIP = Path(__file__).parent / "strip.yaml"


def refusal(folder, *words):
    """(exit code, what it says)."""
    done = testing.called("magfsi.witness", Refused, folder, *words)
    return done.code, done.err.strip()


def refusal_of_a_process(folder, *words):
    done = subprocess.run([sys.executable, "-P", "-m", "magfsi.witness", str(folder), *words],
                          capture_output=True, text=True, timeout=120)
    return done.returncode, done.stderr.strip()


class Refusals(unittest.TestCase):
    def says(self, settings, words):
        run = testing.good_run(STRIP, {"time.end": "2 ms", **settings})
        code, text = refusal(run.folder)
        self.assertEqual(code, 2, text)
        self.assertIn(words, text)
        self.assertIn("allowed", text)
        self.assertEqual(len(text.splitlines()), 1, text)
        self.assertFalse((run.folder / "witness").exists())

    def test_few_shapes(self):
        self.says({"output.structure.every": "0.5 ms"}, "found 5 recorded shapes")

    def test_a_body_that_ends_in_the_flow(self):
        self.says({"fluid.box": "[16 mm, 2 mm, 16 mm]", "output.structure.every": "0.1 ms"}, "allowed is one that spans the box")

    def test_shapes_too_far_apart(self):
        self.says({"output.structure.every": "0.2 ms", "bodies.plate.prescribed_motion.0.oscillation":
                   "{amplitude: [0 mm, 0 mm, 0.02 mm], frequency: 1.5 kHz}"}, "the motion is known to")

    def test_no_run(self):
        """By a process of its own, too, as a shell starts it."""
        for call in (refusal, refusal_of_a_process):
            code, text = call(testing.new_folder())
            self.assertEqual(code, 2, text)
            self.assertIn("found no scene.json", text)

    def test_words(self):
        for words in (["--end", "5"], ["--cells", "9,6"], ["--run-bar", "5"]):
            code, text = refusal(testing.new_folder(), *words)
            self.assertEqual(code, 2, text)
            self.assertIn("allowed", text)


SCENE = {"fluid": {"viscosity": 1e-6, "density": 1000.0, "box": [1.0, 2.0, 3.0],
                   "boundaries": {"x_min": "no_slip", "x_max": "free_slip", "y_min": "periodic", "y_max": "periodic",
                                  "z_min": {"no_slip": {"velocity": [0.0, 0.0, 0.0]}}, "z_max": "no_slip"}}}


class Boxes(unittest.TestCase):
    def test_plane_and_sides(self):
        box = Box(SCENE)
        self.assertEqual((box.normal, box.plane, box.depth, box.right_handed), (1, [0, 2], 2.0, -1))
        self.assertEqual(box.sides, [["no_slip", "free_slip"], ["no_slip", "no_slip"]])

    def refused(self, key, value, words):
        fluid = {**SCENE["fluid"], **({key: value} if key in ("body_force", "obstacles", "viscosity") else
                                      {"boundaries": {**SCENE["fluid"]["boundaries"], key: value}})}
        with self.assertRaisesRegex(Refused, words):
            Box({"fluid": fluid})

    def test_refused(self):
        self.refused("x_min", {"velocity_inlet": {"velocity": [1.0, 0.0, 0.0]}}, "boundaries.x_min")
        self.refused("z_max", {"no_slip": {"velocity": [1.0, 0.0, 0.0]}}, "boundaries.z_max")
        self.refused("y_min", "no_slip", "found 0 axes")
        self.refused("body_force", [0.0, 1.0, 0.0], "body_force")
        self.refused("obstacles", {"ball": {}}, "obstacles")
        self.refused("viscosity", {"carreau": {}}, "rate of shear")
        with self.assertRaisesRegex(Refused, "no fluid"):
            Box({})


class Work(unittest.TestCase):
    def test_by_the_audit_is_force_times_velocity(self):
        run = testing.good_run(STRIP, {"time.end": "12 ms", "probes.energy_audit": "true"})
        moved = recorded.Recorded(run.folder)
        found = compare.OfRun(moved)
        middle, angle, off = moved.rigid()
        self.assertLess(off, 1e-6)
        expected = compare.cumulative(found.time, found.rigid_power(moved, middle, angle))
        apart = np.abs(found.work - expected).max() / np.abs(expected).max()
        testing.report(f"work by the audit and by force times velocity: {100 * apart:.2f} % apart")
        # Rows 0.1 ms apart: forces of single steps, with sound in them, for work that is summed over all.
        # Without the energy of what is inside they are 4 % apart.
        self.assertLess(apart, 0.01)


class Outlines(unittest.TestCase):
    def test_area_and_centre(self):
        shape = np.array([[1.0, 1.0], [4.0, 1.0], [4.0, 3.0], [1.0, 3.0]])
        self.assertEqual(recorded.area(shape), 6.0)
        self.assertTrue(np.allclose(recorded.centre(shape), [2.5, 2.0]))

    def test_corners_begin_a_long_side(self):
        shape = np.array([[0.0, 0.0], [0.0, -1.0], [2.0, -1.0], [4.0, -1.0], [4.0, 0.0], [2.0, 0.0]])
        self.assertEqual(list(recorded._corners(shape)), [1, 3, 4, 0])
        with self.assertRaisesRegex(Refused, "with 3 corners"):
            recorded._corners(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))


if __name__ == "__main__":
    unittest.main()
