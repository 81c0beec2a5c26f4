# SPDX-License-Identifier: GPL-2.0-or-later
"""The calibration of this machine predicts the memory of other runs within 10 %. (Time is left to
tests/bench/cost/tutorials.py: it takes an idle machine.)"""

import os
import subprocess
import sys
import unittest

from magfsi import testing

LARGEST = 0.10  # of the sum over both sides: what explain promises
CASES = [
    (testing.ROOT / "tutorials/beam", {"probes.every": "250 ms"}, "structure=1"),
    (testing.ROOT / "tutorials/turning", {"time.end": "1 s"}, "structure=1"),
    (testing.ROOT / "tests/scenes/every_structure_effect.yaml", {"time.end": "5 ms"},
     "structure=2"),
    (testing.SWIMMER, {"time.end": "4 ms"}, "structure=1,fluid=1"),
    (testing.SWIMMER, {"time.end": "4 ms", "fluid.precision": "float"}, "structure=1,fluid=2"),
]


class Memory(unittest.TestCase):
    def test_of_other_runs(self):
        os.environ["XDG_CACHE_HOME"] = testing.new_folder()
        subprocess.run([sys.executable, "-m", "magfsi.calibrate"], check=True,
                       stdout=subprocess.DEVNULL)
        for scene, settings, ranks in CASES:
            with self.subTest(f"{scene} {settings} {ranks}"):
                s = testing.good_run(scene, settings, ranks=ranks).summary()
                taken = sum(s["memory_bytes"].values())
                wanted = sum(s["predicted"]["memory_bytes"].values())
                testing.report(f"{scene.parent.name} {ranks}: {wanted / 1e6:.1f} MB predicted, "
                              f"{taken / 1e6:.1f} MB taken, {100 * (wanted / taken - 1):+.1f} %")
                self.assertLess(abs(wanted / taken - 1), LARGEST)


if __name__ == "__main__":
    unittest.main()
