# SPDX-License-Identifier: GPL-2.0-or-later
"""summary.json tells waiting from working, on one rank a side and on more."""

import unittest

from magfsi import testing


class WhoWaits(unittest.TestCase):
    def check(self, ranks):
        summary = testing.good_run(testing.SMALL, {}, ranks).summary()
        for side in ("structure", "fluid"):
            tasks, waiting = summary["tasks"][side], summary["waiting"][side]
            for task, seconds in waiting.items():
                self.assertGreater(seconds, 0)
                self.assertLessEqual(seconds, tasks[task])
            load = summary["load"][side]
            self.assertGreater(load["working_s"], 0)
            self.assertGreaterEqual(load["imbalance"], 1)
            if summary["ranks"][side] == 1:
                self.assertEqual(load["imbalance"], 1)
                # All that is no waiting is work, but for what the fluid waits for neighbours:
                # none on one rank. The rest is rounding.
                self.assertAlmostEqual(load["working_s"] + load["waiting_s"],
                                       sum(tasks.values()), places=6)
        self.assertIn("wait for fluid", summary["waiting"]["structure"])
        self.assertIn("wait for structure", summary["waiting"]["fluid"])
        self.assertGreater(summary["coupling_overhead"], 0)
        self.assertLess(summary["coupling_overhead"], 1)

    def test_on_one_rank_a_side(self):
        self.check("structure=1,fluid=1")

    def test_on_more_ranks(self):
        self.check("structure=2,fluid=2")


if __name__ == "__main__":
    unittest.main()
