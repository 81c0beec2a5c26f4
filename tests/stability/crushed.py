# SPDX-License-Identifier: GPL-2.0-or-later
"""Elements that are crushed: right as long as they have a volume, then named."""

import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "crushed.yaml"
RAMP = "bodies.cube.prescribed_motion.0.ramp."


def pressed(by_mm, **more):
    return testing.run(SCENE, {RAMP + "displacement": f"[-{by_mm} mm, 0 mm, 0 mm]", **more})


class Crushed(unittest.TestCase):
    def test_right_to_a_fifth_of_its_length(self):
        for by_mm in (0.3, 0.5, 0.8):
            run = pressed(by_mm)
            self.assertEqual(run.code, 0, run.err)
            audit = run.summary()["energy_audit"]
            testing.report(f"pressed by {by_mm} mm: {audit}")
            self.assertLess(audit["residual"], 0.01, by_mm)

    def test_through_itself_is_named(self):
        run = pressed(4)
        testing.report(run.err.strip())
        self.assertEqual(run.code, 3, run.err)
        # Whichever comes first.
        self.assertRegex(run.err, r"element \d+ is inverted at step \d+.*body cube|"
                                  r"the run has gained energy without a source")
        self.assertEqual(run.summary()["outcome"], "diverged")


if __name__ == "__main__":
    unittest.main()
