# SPDX-License-Identifier: GPL-2.0-or-later
"""--trace: every rank's tasks and waits as Chrome's trace events, which agree with the run's own sums;
a run without it writes none, and its results are the same bytes."""
import json
import unittest

from magfsi import testing
from magfsi.report import waits


class Timeline(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = testing.good_run(testing.SMALL, {"time.end": "2 ms"}, ranks="structure=1,fluid=2",
                                    more=("--trace",))
        cls.events = json.loads((cls.run_.folder / "trace.json").read_text())

    def test_all_ranks_in_one_file(self):
        self.assertEqual(list(self.run_.folder.glob("trace_*")), [])
        names = {e["args"]["name"] for e in self.events if e["name"] == "process_name"}
        self.assertEqual(names, {"structure", "fluid"})
        lanes = {(e["pid"], e["tid"]) for e in self.events if e["ph"] == "X"}
        self.assertEqual(len(lanes), 3)
        self.assertTrue(all(e["ph"] in "MX" for e in self.events))

    def test_tasks_of_a_rank_follow_each_other_and_hold_their_waits(self):
        for pid, tid in {(e["pid"], e["tid"]) for e in self.events if e["ph"] == "X"}:
            lane = [e for e in self.events if e["ph"] == "X" and (e["pid"], e["tid"]) == (pid, tid)]
            end, task = 0.0, None
            for event in lane:
                if event["cat"] == "waiting":
                    self.assertGreaterEqual(event["ts"], task["ts"] - 0.6)
                    self.assertLessEqual(event["ts"] + event["dur"], task["ts"] + task["dur"] + 0.6)
                    continue
                self.assertGreaterEqual(event["ts"], end - 0.6)  # us: of the clocks' rounding
                task, end = event, event["ts"] + event["dur"]

    def test_sums_are_those_of_the_summary(self):
        """Counts of steps exactly; seconds of the structure, which is one rank, within what the
        second look at the clock takes."""
        summary = self.run_.summary()
        steps = summary["steps"]
        structure = next(e["pid"] for e in self.events
                         if e["name"] == "process_name" and e["args"]["name"] == "structure")
        mine = [e for e in self.events if e["ph"] == "X" and e["pid"] == structure]
        for name, seconds in summary["tasks"]["structure"].items():
            lengths = [e["dur"] for e in mine if e["name"] == name]
            self.assertEqual(len(lengths), steps, name)
            self.assertAlmostEqual(1e-6 * sum(lengths), seconds, delta=0.02 * seconds + 5e-5 * steps)

    def test_who_waits_for_whom(self):
        told = waits.of_trace(self.run_.folder)
        self.assertEqual([(r["side"], r["rank"]) for r in told["ranks"]],
                         [("structure", 0), ("fluid", 0), ("fluid", 1)])
        waited = self.run_.summary()["waiting"]["structure"]
        self.assertAlmostEqual(told["ranks"][0]["waiting_s"], sum(waited.values()),
                               delta=0.02 * sum(waited.values()) + 1e-3)
        lanes = told["piece"]["lanes"]
        self.assertEqual([lane["lane"] for lane in lanes], ["structure 0", "fluid 0", "fluid 1"])
        self.assertTrue(all(lane["events"] for lane in lanes))

    def test_without_it_there_is_none_and_results_are_the_same(self):
        plain = testing.good_run(testing.SMALL, {"time.end": "2 ms"}, ranks="structure=1,fluid=2")
        self.assertEqual([*plain.folder.glob("trace*")], [])
        self.assertEqual((plain.folder / "probes.csv").read_bytes(),
                         (self.run_.folder / "probes.csv").read_bytes())
        self.assertIsNone(waits.of_trace(plain.folder))

    def test_of_equilibria_and_of_a_run_that_diverges(self):
        beam = testing.good_run(testing.ROOT / "tutorials/beam",
                                {"time.end": "100 ms", "output": "null"}, more=("--trace",))
        events = json.loads((beam.folder / "trace.json").read_text())
        self.assertEqual(sum(e["name"] == "find equilibrium" for e in events),
                         beam.summary()["steps"])
        diverged = testing.run(testing.SMALL, {"magnetic_field.constant.magnitude": "9 T"},
                               more=("--trace",))
        self.assertEqual(diverged.code, 3)
        self.assertGreater(len(json.loads((diverged.folder / "trace.json").read_text())), 4)


if __name__ == "__main__":
    unittest.main()
