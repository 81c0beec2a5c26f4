# SPDX-License-Identifier: GPL-2.0-or-later
"""Two settings of one scene, each with the error bars that magfsi cost gives it: where the bars hold, both
contain the limit, and so overlap. The beam without a fluid: equilibria are compared over the field."""
import sys
import unittest
from pathlib import Path

from command import called

from magfsi import runs, testing

sys.path.append(str(testing.ROOT / "tests/cost"))
from scenes import BEAM, Scene  # noqa: E402

FINER = BEAM.replace("[12, 4, 1]", "[20, 6, 1]")


class WithCost(unittest.TestCase):
    def test_bars_of_two_settings_overlap(self):
        found = []
        for text in (BEAM, FINER):
            scene = Scene(text)
            scene.good_cost("--budget", "20 s", "--probe", "tip_uz")
            found.append((testing.good_run(scene.file).folder, scene.out))
        out = Path(testing.new_folder()) / "out"
        (first, bars_first), (second, bars_second) = found
        done = called(first, second, "--bars-first", bars_first, "--bars-second", bars_second,
                      "--names", "coarse,finer", "--out", out)
        self.assertEqual(done.code, 0, done.err)
        testing.report(done.out)
        row, = [row for row in runs.read_rows(out / "compare.csv") if row["probe"] == "tip_uz[m]"]
        self.assertGreater(abs(float(row["difference"])), 0)
        for bar in ("first_bar", "second_bar"):
            self.assertGreater(float(row[bar]), 0)
        self.assertEqual(row["within bars"], "yes", row)
        self.assertTrue(done.out.startswith("They agree within their error bars: of 1 probe "), done.out)


if __name__ == "__main__":
    unittest.main()
