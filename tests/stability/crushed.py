#!/usr/bin/python3
"""Elements that are crushed: right as long as they have a volume, then named."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import magfsi_runs as magfsi  # noqa: E402

SCENE = Path(__file__).resolve().parent / "crushed.yaml"
RAMP = "bodies.cube.prescribed_motion.0.ramp."


def pressed(by_mm, **more):
    return magfsi.run(SCENE, {RAMP + "displacement": f"[-{by_mm} mm, 0 mm, 0 mm]", **more})


class Crushed(unittest.TestCase):
    def test_right_to_half_its_length(self):
        for by_mm, kind in ((0.3, "3 : 1"), (0.5, "2 : 1")):
            run = pressed(by_mm)
            self.assertEqual(run.code, 0, run.err)
            audit = run.summary()["energy_audit"]
            magfsi.report(f"pressed by {by_mm} mm: {audit}")
            self.assertLess(audit["residual"], 0.01, kind)

    def test_through_itself_is_named(self):
        run = pressed(1.1)
        magfsi.report(run.err.strip())
        self.assertEqual(run.code, 3, run.err)
        self.assertRegex(run.err, r"element \d+ is inverted at step \d+.*body cube")
        self.assertEqual(run.summary()["outcome"], "diverged")


if __name__ == "__main__":
    unittest.main()
