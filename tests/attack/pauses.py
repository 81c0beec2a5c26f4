# SPDX-License-Identifier: GPL-2.0-or-later
"""A pause is no death: a side that is suspended, or the whole job, goes on to the same bytes."""

import argparse
import signal
import sys
import time
import unittest

import attack
from attack import SETTINGS, testing

SECONDS = 3  # a suspension is told from a slow step after one
SIDES = ("magfsi-structure", "magfsi-fluid-lbm")
EVERYBODY = ("mpirun", "magfsi", *SIDES)


class Pauses(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.settings = {**SETTINGS, "time.end": "20 ms"}
        whole = testing.new_folder()
        assert attack.run(whole, cls.settings).code == 0
        cls.expected = attack.results(whole)

    def goes_on(self, names, settings=None):
        folder = testing.new_folder()
        process = attack.start(folder, {**self.settings, **(settings or {})})
        testing.wait_for_rows(folder, process, 3)
        pids = [attack.all_at_work(folder)[name] for name in names]
        for pid in pids:
            self.assertTrue(attack.send(pid, signal.SIGSTOP))
        attack.wait_for(lambda: all(attack.state(pid) == "T" for pid in pids), "their pause")
        time.sleep(SECONDS)
        self.assertIsNone(process.poll(), "a pause was taken for an end")
        for pid in pids:
            attack.send(pid, signal.SIGCONT)
        ended = testing.finish(process, 0, folder, attack.PATIENCE_S)
        self.assertEqual(ended.code, 0, ended.err)
        testing.check_same_files(self, attack.results(folder), self.expected)
        return (ended.folder / "run.log").read_text()

    def test_of_each_side(self):
        for name, side in zip(SIDES, ("structure", "fluid")):
            log = self.goes_on([name])
            lines = [line for line in log.splitlines() if f"waiting for the {side} since" in line]
            testing.report(f"{name} for {SECONDS} s: " + (lines or ["no word in the log"])[-1])
            # A word each minute, of which the last may come too late.
            self.assertGreaterEqual(len(lines), SECONDS // 60 - 1)
            self.assertTrue(all("is stopped" in line for line in lines), log)

    def test_of_all(self):
        self.goes_on(EVERYBODY)

    def test_of_all_is_not_the_partners_delay(self):
        """With a limit that is shorter than the pause, for users who set one."""
        limit_s = 30  # far above a step on a busy machine
        if SECONDS <= limit_s:
            self.skipTest("takes a longer pause")
        self.goes_on(EVERYBODY, {"coupling.timeout": f"{limit_s} s"})


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=SECONDS)
    arguments, rest = parser.parse_known_args()
    SECONDS = int(arguments.seconds)
    unittest.main(argv=sys.argv[:1] + rest)
