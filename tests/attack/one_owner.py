# SPDX-License-Identifier: GPL-2.0-or-later
"""A run folder has one owner, and what an earlier run left there is neither mixed nor lost."""

import json
import os
import shutil
import signal
import unittest
from pathlib import Path

import attack
from attack import SETTINGS, testing

# It falls to the floor and into it before the slower of these tests is through.
ENDLESS = {**SETTINGS, "time.end": "1000 s", "coupling.overlap": "allow"}


class Doubles(unittest.TestCase):
    def setUp(self):
        self.folder = Path(testing.new_folder())
        self.process = attack.start(self.folder, ENDLESS)
        self.addCleanup(attack.end, self.process, self.folder)
        testing.wait_for_rows(self.folder, self.process, 3)

    def test_leaves_every_core_to_runs_beside_it(self):
        pids = testing.processes_of(self.folder, "magfsi-structure", "magfsi-fluid-lbm")
        self.assertEqual(len(pids), 2)
        for pid in pids:
            self.assertEqual(os.sched_getaffinity(pid), os.sched_getaffinity(0))

    def test_a_second_run_is_refused(self):
        for more in ((), ("--overwrite",)):
            ended = attack.run(self.folder, more=more)
            attack.one_line(self, ended, 1, f"belongs to a run that goes on: magfsi run, "
                                            f"process {self.process.pid} on")
        self.assertIsNone(self.process.poll(), "the first one goes on")

    def test_one_without_the_launcher_is_refused(self):
        words = ["mpirun", "-n", "1", testing.BIN / "magfsi-structure", testing.SMALL, "--out",
                 self.folder, ":", "-n", "1", testing.BIN / "magfsi-fluid-lbm", testing.SMALL,
                 "--out", self.folder]
        ended = attack.finish(testing.start(words), self.folder)
        self.assertEqual(ended.code, 1, ended.err)
        self.assertIn("belongs to a run that goes on", ended.err)
        self.assertIsNone(self.process.poll(), "the first one goes on")

    def test_a_job_without_the_launcher_is_an_owner_too(self):
        folder = testing.new_folder() + "/run"
        words = ["mpirun", "-n", "1", testing.BIN / "magfsi-structure", testing.SMALL, "--out",
                 folder, *testing.overrides(ENDLESS), ":", "-n", "1",
                 testing.BIN / "magfsi-fluid-lbm", testing.SMALL, "--out", folder,
                 *testing.overrides(ENDLESS)]
        process = testing.start(words)
        self.addCleanup(attack.end, process, folder)
        testing.wait_for_rows(folder, process, 3)
        ended = attack.run(folder)
        self.assertEqual(ended.code, 1, ended.err)
        self.assertIn("belongs to a run that goes on: an MPI job", ended.err)
        self.assertIsNone(process.poll(), "the first one goes on")

    def test_the_next_begins_when_the_killed_one_is_gone(self):
        self.process.kill()
        self.process.wait()
        ended = attack.run(self.folder)
        self.assertEqual(ended.code, 0, ended.err)
        self.assertEqual(ended.summary()["steps"], 80)
        self.assertTrue((self.folder / "earlier-1/probes.csv").exists())
        self.assertEqual(attack.at_work(self.folder), {})


class Earlier(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.earlier = Path(testing.new_folder())
        first = attack.run(cls.earlier)
        assert first.code == 0, first.err

    def setUp(self):
        self.folder = Path(testing.new_folder())
        shutil.copytree(self.earlier, self.folder, dirs_exist_ok=True)
        self.before = attack.results(self.folder)
        (self.folder / "figure.png").write_text("of the user")

    def test_results_are_set_aside(self):
        other = {**SETTINGS, "gravity.acceleration": "9.8 m/s2"}
        for n in (1, 2):
            ended = attack.run(self.folder, other)
            self.assertEqual(ended.code, 0, ended.err)
            self.assertIn(f"earlier-{n}", ended.out)
        testing.check_same_files(self, attack.results(self.folder / "earlier-1"), self.before)
        testing.check_same_files(self, attack.results(self.folder / "earlier-2"), attack.results(self.folder))
        self.assertTrue((self.folder / "figure.png").exists())

    def test_overwrite_drops_them(self):
        self.assertEqual(attack.run(self.folder, more=["--overwrite"]).code, 0)
        self.assertEqual(list(self.folder.glob("earlier-*")), [])
        testing.check_same_files(self, attack.results(self.folder), self.before)

    def test_a_forgotten_restart_loses_no_checkpoint(self):
        longer = {**SETTINGS, "time.end": "3 ms"}
        whole = testing.new_folder()
        self.assertEqual(attack.run(whole, longer).code, 0)
        process = attack.start(self.folder, longer)  # without --restart
        attack.wait_for((self.folder / "earlier-1/summary.json").exists, "the earlier results")
        testing.wait_for_rows(self.folder, process, 1)
        process.send_signal(signal.SIGKILL)
        process.wait()
        newest = max((self.folder / "earlier-1").glob("checkpoint*_fluid.h5"))
        ended = attack.run(self.folder, longer, restart=str(newest))
        self.assertEqual(ended.code, 0, ended.err)
        self.assertEqual(ended.summary()["extra"]["restarted_at_step"], 80)

    def test_what_was_run_is_kept(self):
        ended = attack.run(self.folder, {**SETTINGS, "time.end": "3 ms"}, restart="latest")
        self.assertEqual(ended.code, 0, ended.err)
        self.assertEqual((self.folder / "scene_as_given.yaml").read_bytes(), testing.SMALL.read_bytes())
        self.assertIn("end: 3 ms\n", (self.folder / "scene.yaml").read_text())
        self.assertEqual(json.loads((self.folder / "scene.json").read_text())["time"]["end"],
                         0.003)
        first, second = json.loads((self.folder / "run.json").read_text())
        self.assertIn("time.end=2 ms", first["overrides"])
        self.assertIn("time.end=3 ms", second["overrides"])
        self.assertIn(f"--out {self.folder}", second["command"])
        self.assertEqual(second["restart"], "latest")
        self.assertEqual(second["ranks"], {"structure": 1, "fluid": 1})
        self.assertLessEqual({"magfsi", "MPI"}, set(second["versions"]))
        self.assertLessEqual({"magfsi", "MPI", "LAMMPS"}, set(ended.summary()["versions"]))


if __name__ == "__main__":
    unittest.main()
