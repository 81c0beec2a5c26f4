# SPDX-License-Identifier: GPL-2.0-or-later
"""kill -9 of any process of a run, the launcher and mpirun among them, every second one while a
checkpoint is being written. The same command with --restart latest, at once, goes on to the same
bytes, and nothing is left running."""

import os
import random
import signal
import subprocess
import unittest
from pathlib import Path

import attack
from attack import SETTINGS, testing

KILLS = 8
SEED = 1
VICTIMS = ("magfsi", "mpirun", "magfsi-structure", "magfsi-fluid-lbm")
# What the launcher says of each, if it lives.
SAID = {"mpirun": "lost a partner: mpirun was killed by signal 9",
        "magfsi-structure": "lost a partner: structure rank 0 was killed by signal 9",
        "magfsi-fluid-lbm": "lost a partner: fluid rank 0 was killed by signal 9"}


def rows(folder):
    file = Path(folder) / "probes.csv"
    return file.read_text().count("\n") if file.exists() else 0


def is_writing(folder):
    return any(Path(folder).glob("checkpoint*.tmp"))


class Kills(unittest.TestCase):
    def kill_once(self, folder, victim, rng, inside):
        """False if the run ended before."""
        restart = "latest" if list(folder.glob("checkpoint*_fluid.h5")) else None
        process = testing.start(testing.run_command(testing.SMALL, folder, SETTINGS, attack.RANKS,
                                                    restart))
        wanted = rows(folder) + rng.randint(2, 12)
        if not testing.wait_until(lambda: rows(folder) >= wanted, process, 0.001):
            attack.finish(process, folder)
            return False
        pid = attack.at_work(folder).get(victim)
        if inside:
            testing.wait_until(lambda: is_writing(folder), process, 0.0002)
        hit = pid is not None and attack.send(pid, signal.SIGKILL)
        ended = attack.finish(process, folder)
        if hit and victim != "magfsi" and ended.code != 0:
            testing.check_prompt(self, ended)
            attack.one_line(self, ended, 4, SAID[victim])
            self.assertEqual(ended.summary()["outcome"], "lost_partner")
            self.assertEqual(attack.at_work(folder), {}, "left by the launcher")
        return hit and ended.code != 0

    def check_same(self, found, expected):
        """The last checkpoint and all else are the same. The one before may be of another step: a
        run whose launcher was killed near its end writes one where it stops."""
        def steady(files):
            last = max(name for name in files if name.startswith("checkpoint"))[:-len("structure.h5")]
            return [n for n in files if not n.startswith("checkpoint") or n.startswith(last)]
        self.assertEqual(steady(found), steady(expected))
        self.assertEqual(len(found), len(expected))
        for name in found.keys() & expected.keys():
            self.assertTrue(found[name] == expected[name], name)

    def test_each_goes_on_to_the_same_bytes(self):
        whole = testing.new_folder()
        self.assertEqual(attack.run(whole).code, 0)
        expected = attack.results(whole)
        rng = random.Random(SEED)
        kills = runs = inside = 0
        while kills < KILLS:
            folder = Path(testing.new_folder())
            runs += 1
            self.assertLessEqual(runs, 4 * KILLS, "runs end before they are killed")
            for _ in range(3):
                if kills < KILLS and self.kill_once(folder, VICTIMS[kills % 4], rng, kills // 4 % 2 == 1):
                    kills += 1
                    inside += is_writing(folder)
            restart = "latest" if list(folder.glob("checkpoint*_fluid.h5")) else None
            ended = attack.run(folder, restart=restart)
            self.assertEqual(ended.code, 0, ended.err)
            self.assertEqual(attack.at_work(folder), {})
            self.check_same(attack.results(folder), expected)
        testing.report(f"{kills} kills in {runs} runs, {inside} of them inside a checkpoint")

    def test_nothing_outlives_the_launcher(self):
        endless = {**SETTINGS, "time.end": "1000 s", "coupling.overlap": "allow"}
        without = {key: value for key, value in endless.items() if "checkpoint" not in key}
        for settings in (endless, without):
            folder = testing.new_folder()
            process = attack.start(folder, settings)
            testing.wait_for_rows(folder, process, 3)
            process.kill()
            process.wait()
            attack.wait_for(lambda folder=folder: not attack.at_work(folder), "their end")

    def test_nothing_of_a_job_of_many(self):
        """Beyond 31 processes there is no death signal: Open MPI's own watch ends them."""
        hosts = Path(testing.new_folder()) / "hosts"
        hosts.write_text("localhost slots=64\n")
        settings = {**SETTINGS, "time.end": "1000 s", "coupling.overlap": "allow"}
        for victim in ("magfsi", "mpirun", "magfsi-fluid-lbm"):
            with self.subTest(victim):
                folder = testing.new_folder()
                words = testing.run_command(testing.SMALL, folder, settings,
                                            "structure=1,fluid=40")
                process = subprocess.Popen(
                    [str(word) for word in words], stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    env={**os.environ, "OMPI_MCA_orte_default_hostfile": str(hosts)})
                testing.wait_for_rows(folder, process, 3)
                attack.send(attack.at_work(folder)[victim], signal.SIGKILL)
                process.wait()
                attack.wait_for(lambda folder=folder: not attack.at_work(folder), "their end")

    def test_not_even_what_is_stopped(self):
        """mpirun and the launcher are gone while the fluid is suspended."""
        folder = testing.new_folder()
        process = attack.start(folder, {**SETTINGS, "time.end": "1000 s", "coupling.overlap": "allow"})
        testing.wait_for_rows(folder, process, 3)
        pids = attack.all_at_work(folder)
        attack.send(pids["magfsi-fluid-lbm"], signal.SIGSTOP)
        attack.send(pids["magfsi"], signal.SIGKILL)
        attack.send(pids["mpirun"], signal.SIGKILL)
        process.wait()
        attack.wait_for(lambda: not attack.at_work(folder), "their end")


if __name__ == "__main__":
    testing.main(KILLS=KILLS, SEED=SEED)
