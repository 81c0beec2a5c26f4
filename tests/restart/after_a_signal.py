# SPDX-License-Identifier: GPL-2.0-or-later
"""Told to end, a run with checkpoints writes one at the end of a coupled step, on both sides the
same, ends in order, and goes on from there as if nothing had been."""

import os
import signal
import time
import unittest

import scenes
from scenes import COUPLED, FLUID, STRUCTURE, EVERY, testing

# No checkpoint but the one that the signal asks for.
NEVER = {"checkpoint.every": "1 s"}
ROWS = 4  # the signal comes after so many probe rows


class Told(unittest.TestCase):
    def told(self, scene, settings, ranks):
        whole = scenes.good(scene, settings, testing.new_folder(), ranks)
        process, folder = testing.get_going(scene, settings, ranks, ROWS)
        process.send_signal(signal.SIGTERM)  # to the launcher
        stopped = testing.finish(process, time.monotonic(), folder, 120)
        self.assertEqual(stopped.code, 1, stopped.err)
        self.assertIn("stopped on request", stopped.err)
        summary = stopped.summary()
        self.assertEqual(summary["outcome"], "stopped")
        step = summary["steps"]
        self.assertIn(f"checkpoint of step {step}", summary["cause"])
        self.assertEqual({name.split("_")[1] for name in scenes.checkpoints(folder)},
                         {f"{step:010d}"})
        rows = stopped.probes()["t[s]"]
        self.assertLess(len(rows), len(whole.probes()["t[s]"]))  # it did not run to the end

        after = scenes.good(scene, settings, folder, ranks, restart="latest")
        self.assertEqual(scenes.restarted_at(after), step)
        testing.check_same_files(self, scenes.results(folder), scenes.results(whole.folder))
        testing.report(f"{ranks}: stopped after step {step} of {after.summary()['steps']}")

    # Long enough that this process, on a busy machine, is not late with its signal.
    def test_swimmer(self):
        self.told(testing.SMALL, {**COUPLED, **NEVER, "time.end": "12 ms"},
                  "structure=1,fluid=1")

    def test_swimmer_on_several_ranks(self):
        self.told(testing.SMALL, {**COUPLED, **NEVER, "time.end": "12 ms"},
                  "structure=2,fluid=2")

    def test_solid(self):
        self.told(EVERY, {**STRUCTURE, **NEVER, "time.end": "50 ms"}, "structure=1")

    def test_fluid(self):
        self.told(testing.SMALL, {**FLUID, **NEVER, "time.end": "10 ms"}, "fluid=2")


class WithoutTheLauncher(unittest.TestCase):
    """mpirun hands SIGTERM on and kills a second later: time enough for a small run."""

    def test_swimmer(self):
        settings = {**COUPLED, **NEVER, "time.end": "1 s", "coupling.overlap": "allow"}
        folder = testing.new_folder()
        words = ["mpirun", "-n", "1", testing.BIN / "magfsi-structure", testing.SMALL, "--out",
                 folder, *testing.overrides(settings), ":", "-n", "1",
                 testing.BIN / "magfsi-fluid-lbm", testing.SMALL, "--out", folder,
                 *testing.overrides(settings)]
        process = testing.start(words)
        testing.wait_for_rows(folder, process, ROWS)
        process.send_signal(signal.SIGTERM)
        stopped = testing.finish(process, time.monotonic(), folder, 120)
        self.assertEqual(stopped.summary()["outcome"], "stopped", stopped.err)
        self.assertEqual(len(scenes.checkpoints(folder)), 2)
        soon = f"{stopped.summary()['steps'] * 25 + 1000} us"  # 40 steps later
        after = scenes.good(testing.SMALL, {**settings, "time.end": soon}, folder,
                            "structure=1,fluid=1", restart="latest")
        self.assertEqual(after.summary()["outcome"], "completed")


class Lost(unittest.TestCase):
    """A partner that is gone still ends the run at once, though mpirun's signal is postponed."""

    def test_fluid_killed(self):
        process, folder = testing.get_going(testing.SMALL, {
            **COUPLED, **NEVER, "time.end": "10 s", "coupling.overlap": "allow"}, rows=ROWS)
        os.kill(testing.process_of(folder, "magfsi-fluid-lbm"), signal.SIGKILL)
        began = time.monotonic()
        result = testing.finish(process, began, folder, 120)
        testing.check_prompt(self, result)
        self.assertEqual(result.code, 4, result.err)
        self.assertIn("fluid rank 0 was killed by signal 9", result.err)
        self.assertEqual(result.summary()["outcome"], "lost_partner")


if __name__ == "__main__":
    unittest.main()
