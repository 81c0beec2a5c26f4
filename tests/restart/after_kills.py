# SPDX-License-Identifier: GPL-2.0-or-later
"""kill -9 at random moments, every second one inside the writing of a checkpoint: each time the run
goes on from at most one interval before, and in the end its results are those of a run that nobody
killed."""

import os
import random
import re
import signal
import time
import unittest
from pathlib import Path

import scenes
from scenes import COUPLED, REFINED, testing

KILLS = 4
SEED = 1
STEP_S = 25e-6
PATCH = 0  # 1: on a refined grid
INTERVAL = 3  # steps of the coarsest grid between checkpoints, one between rows
SETTINGS = {**COUPLED, "checkpoint.every": "75 us", "probes.every": "25 us"}
# The face goes so fast that the patch moves again and again.
IN_A_PATCH = {**REFINED, **SETTINGS, "bodies.robot.prescribed_motion":
              "[{face: x_min, oscillation: {amplitude: [2.7 mm, 0 m, 0.5 mm], "
              "frequency: 100 Hz, phase: -90 deg}}]",
              "time.end": "3 ms"}


def settings():
    return IN_A_PATCH if PATCH else SETTINGS


def last_row(folder):
    """Step of the last complete row of probes.csv, -1 without any."""
    file = Path(folder) / "probes.csv"
    lines = file.read_text().split("\n")[1:-1] if file.exists() else []
    return round(float(lines[-1].split(",")[0]) / STEP_S) if lines else -1


def half_written(folder):
    return [p.name for p in Path(folder).glob("checkpoint*.h5.tmp")]


class Victim:
    """A run that is about to be killed."""

    def __init__(self, folder, restart):
        self.folder = Path(folder)
        self.process = testing.start(testing.run_command(
            testing.SMALL, folder, settings(), "structure=1,fluid=1", restart))

    def wait_for(self, condition):
        """False if the run ended before."""
        return testing.wait_until(condition, self.process, 0.0005)

    def kill(self, inside_a_write, rng):
        """All its participants at once; False if it ended before."""
        beyond = max(last_row(self.folder), INTERVAL)
        if not self.wait_for(lambda: last_row(self.folder) > beyond):
            return False
        pids = testing.processes_of(self.folder, "magfsi-structure", "magfsi-fluid-lbm")
        if inside_a_write:
            # One of the next few, at a random moment of it.
            time.sleep(rng.uniform(0, 0.1))
            if not self.wait_for(lambda: half_written(self.folder)):
                return False
            time.sleep(rng.uniform(0, 0.004))
        else:
            time.sleep(rng.uniform(0, 0.2))
        for pid in pids:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                return False
        return True

    def end(self):
        return testing.finish(self.process, time.monotonic(), self.folder, 60)


class Kills(unittest.TestCase):
    def test_each_costs_one_interval_at_most(self):
        whole = scenes.good(testing.SMALL, settings(), testing.new_folder())
        rng = random.Random(SEED)
        kills = inside = chains = 0

        def more():
            # Whether a kill meets the few milliseconds of a write is chance; one must.
            return kills < KILLS or (inside == 0 and kills < 5 * KILLS)

        while more():
            folder = Path(testing.new_folder())
            chains += 1
            restart, reached, restarts = None, 0, 0
            while more():
                victim = Victim(folder, restart)
                restarts += restart is not None
                hit = victim.kill(kills % 2 == 1 or kills >= KILLS, rng)
                ended = victim.end()
                if restart:
                    self.goes_on(folder, ended, reached, restarts)
                if not hit:
                    break
                kills += 1
                inside += bool(half_written(folder))
                self.assertEqual(ended.code, 4, ended.err)
                restart, reached = "latest", last_row(folder)
            if restart and ended.code != 0:
                ended = scenes.good(testing.SMALL, settings(), folder, "structure=1,fluid=1",
                                    restart="latest")
                restarts += 1
                self.goes_on(folder, ended, reached, restarts)
            self.assertEqual(ended.code, 0, ended.err)
            testing.check_same_files(self, scenes.results(folder), scenes.results(whole.folder))
            self.assertEqual(half_written(folder), [])
            self.assertEqual(len(scenes.checkpoints(folder)), 4)
        testing.report(f"{kills} kills, {inside} of them inside a write, {chains} run(s)")
        self.assertGreater(inside, 0)

    def goes_on(self, folder, result, reached, number):
        # Not from its output, which mpirun may drop when its processes are killed.
        restarts = re.findall(r"restart at step (\d+)", (folder / "run.log").read_text())
        self.assertEqual(len(restarts), number, result.err)
        step = int(restarts[-1]) // (1 + PATCH)
        self.assertLessEqual(step, reached)
        self.assertGreaterEqual(step, reached - INTERVAL, "more than an interval was lost")


if __name__ == "__main__":
    testing.main(KILLS=KILLS, SEED=SEED, PATCH=PATCH)
