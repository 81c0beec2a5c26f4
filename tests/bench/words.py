# SPDX-License-Identifier: GPL-2.0-or-later
"""Each word of `magfsi bench` and each program that measures runs for a moment and prints figures."""
import json
import os
import subprocess
import unittest

from magfsi import runs, testing

ENVIRONMENT = {**os.environ, "MAGFSI_PRESET": runs.BIN.parent.name, "MAGFSI_INSTALL": "no",
               "XDG_CACHE_HOME": testing.new_folder()}


def output(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False,
                          env=ENVIRONMENT, timeout=300)
    if done.returncode != 0:
        raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Words(unittest.TestCase):
    def test_bench_lbm(self):
        report = json.loads(output(testing.ROOT / "magfsi", "bench", "lbm", "--json", "--cells", 16, 16, 16,
                                   "--seconds", 0.01, "--repetitions", 1))
        self.assertGreater(len(report["results"]), 3)
        for result in report["results"]:
            self.assertGreater(result["mlups"]["median"], 0, result)

    def test_bench_structure(self):
        report = json.loads(output(testing.ROOT / "magfsi", "bench", "structure", "--json", "--rounds", 1))
        for name, result in report.items():
            self.assertGreater(min(result["times_faster"]), 0, name)

    def test_newton(self):
        self.assertRegex(output(runs.BIN / "magfsi-bench-newton", 8, 4, 1), r"\d")

    def test_refined_grid(self):
        text = output(runs.BIN / "magfsi-bench-refined", "--levels", 1, "--repetitions", 1)
        self.assertIn("times less", text)


if __name__ == "__main__":
    unittest.main()
