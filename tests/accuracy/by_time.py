#!/usr/bin/python3
"""A time buys the finest mesh that is predicted to take no longer; less than the coarsest takes, or
an uncalibrated machine, is refused."""

import json
import math
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / folder) for folder in ("support", "cost")]
import magfsi_runs as magfsi  # noqa: E402
from sum_of_parts import PRICES, explain  # noqa: E402

BEAM = magfsi.ROOT / "tutorials/beam"
VORTEX = magfsi.ROOT / "docs/accuracy/taylor_green/scene.yaml"
ROW_S, VORTEX_STEP_S = 31.8309886e-3, 1.62974662  # a row of probes; the step at one cell
POINTS = 80
# n elements along and round(n W / L) across make (n + 1) (m + 1) 2 nodes, and a node costs 0.1 ms
# at each point.
NODE_S = 1e-4
WIDTH_BY_LENGTH = 5 / 17.5


def seconds(n):
    return POINTS * NODE_S * 2 * (n + 1) * (max(1, round(n * WIDTH_BY_LENGTH)) + 1)


class ByTime(unittest.TestCase):
    def setUp(self):
        cache = Path(magfsi.new_folder())
        os.environ["XDG_CACHE_HOME"] = str(cache)
        self.file = cache / "magfsi/calibration.json"
        self.file.parent.mkdir()

    def calibrate(self):
        known = explain(BEAM)
        self.file.write_text(json.dumps({"machine": known["machine"], "date": "today",
                                         "version": known["version"], **PRICES}))

    def choice(self, time, scene=BEAM, removed=("bodies.beam.mesh.box.elements",),
               ranks="structure=1"):
        words = [magfsi.BIN / "magfsi", "explain", scene, "--json", "--ranks", ranks, "--set",
                 f"accuracy.time={time}"]
        for key in removed:
            words += ["--set", f"{key}=null"]
        return subprocess.run(words, capture_output=True, text=True)

    def test_buys_the_finest(self):
        self.calibrate()
        for limit in (0.5, 1.0, 2.0):
            found = json.loads(self.choice(f"{limit} s").stdout)
            n = found["accuracy"]["resolution"]
            self.assertAlmostEqual(found["predicted"]["wall_s"], seconds(n), places=9)
            self.assertLessEqual(seconds(n), limit)
            self.assertGreater(seconds(n + 1), limit)

    def test_buys_the_finest_vortex(self):
        """The step falls with the square of the spacing: 30 rows of probes, of whole steps each."""
        self.calibrate()

        def vortex_s(n):
            steps = 30 * math.ceil(ROW_S / (VORTEX_STEP_S / n**2) * (1 - 1e-9))
            return steps * n**3 * (PRICES["fluid"][0]["s_per_cell_step"]
                                   + PRICES["s_per_cell_regularized"])

        for limit, expected in ((10, None), (60, None), (1e4, 48)):
            done = self.choice(f"{limit} s", VORTEX, ("fluid.spacing", "time.step"), "fluid=1")
            self.assertEqual(done.returncode, 0, done.stderr)
            found = json.loads(done.stdout)
            n = found["accuracy"]["resolution"]
            self.assertAlmostEqual(found["predicted"]["wall_s"] / vortex_s(n), 1, places=6)
            self.assertLessEqual(vortex_s(n), limit)
            if expected:  # the finest that was studied
                self.assertEqual(n, expected)
            else:
                self.assertGreater(vortex_s(n + 2), limit)

    def test_less_than_the_coarsest(self):
        self.calibrate()
        done = self.choice("0.1 s")
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"{seconds(6):.3g} s and more", done.stderr)

    def test_of_an_unknown_machine(self):
        done = self.choice("1 s")
        self.assertEqual(done.returncode, 2)
        self.assertIn("bench --calibrate", done.stderr)


if __name__ == "__main__":
    unittest.main()
