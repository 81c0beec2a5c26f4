# SPDX-License-Identifier: GPL-2.0-or-later
"""A restart that cannot be right is refused: one line, exit code 2, nothing touched. A torn newest
checkpoint only costs the way back to the one before.

--every 5 takes each fifth of the damages to either side."""

import itertools
import os
import shutil
import unittest
from pathlib import Path

import scenes
from scenes import COUPLED, testing

EVERY = 1  # of the damages
NEWEST, OLDER = "checkpoint_0000000060", "checkpoint_0000000040"
SETTINGS = {**COUPLED, "time.end": "1.75 ms"}


def contents(folder):
    return {str(p): p.read_bytes() for p in Path(folder).rglob("*") if p.is_file()}


def cut_short(file):
    os.truncate(file, file.stat().st_size - 1000)


def flip_a_bit(file):
    data = bytearray(file.read_bytes())
    data[len(data) // 2] ^= 1  # deep in the numbers, which have a checksum
    file.write_bytes(data)


def fill_with_zeros(file):
    file.write_bytes(bytes(file.stat().st_size))


class Restart(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.start = testing.new_folder()
        scenes.good(testing.SMALL, SETTINGS, cls.start)
        cls.whole = scenes.good(testing.SMALL, COUPLED, testing.new_folder())

    def setUp(self):
        self.folder = Path(testing.new_folder()) / "run"
        shutil.copytree(self.start, self.folder)

    def refused(self, message, settings=COUPLED, restart="latest"):
        before = contents(self.folder)
        result = scenes.run(testing.SMALL, settings, self.folder, restart=restart)
        testing.check_refused(self, result, message)
        testing.check_same_files(self, contents(self.folder), before)

    def goes_on_from(self, step):
        result = scenes.good(testing.SMALL, COUPLED, self.folder, restart="latest")
        self.assertEqual(scenes.restarted_at(result), step)
        testing.check_same_files(self, scenes.results(self.folder), scenes.results(self.whole.folder))
        return result

    def test_another_scene(self):
        self.refused("is of another scene",
                     {**COUPLED, "gravity.acceleration": "9.8 m/s2"})

    def test_a_scene_without_checkpoints(self):
        self.refused("no key checkpoint", {**COUPLED, "checkpoint": ""})

    def test_an_end_before_the_checkpoint(self):
        self.refused("give a later time.end", {**COUPLED, "time.end": "1 ms"})

    def test_no_checkpoint(self):
        for file in self.folder.glob("checkpoint*"):
            file.unlink()
        self.refused("no complete checkpoint")

    def test_a_file_that_is_missing(self):
        file = self.folder / "checkpoint_0000000050_fluid.h5"
        self.refused("is missing", restart=file)

    def test_a_file_that_is_no_checkpoint(self):
        self.refused("allowed is latest", restart=self.folder / "probes.csv")

    def test_a_named_file_that_is_torn(self):
        file = self.folder / f"{NEWEST}_fluid.h5"
        cut_short(file)
        self.refused("is torn", restart=file)

    def test_all_torn(self):
        for file in self.folder.glob("checkpoint*_structure.h5"):
            cut_short(file)
        self.refused("no complete checkpoint")

    def test_a_torn_newest_is_skipped(self):
        damages = (cut_short, flip_a_bit, fill_with_zeros, os.remove)
        for damage, side in list(itertools.product(damages, ("structure", "fluid")))[::EVERY]:
            with self.subTest(damage=damage.__name__, side=side):
                shutil.rmtree(self.folder)
                shutil.copytree(self.start, self.folder)
                damage(self.folder / f"{NEWEST}_{side}.h5")
                self.assertIn("skipped", self.goes_on_from(40).out)

    def test_a_newest_that_is_whole_is_taken(self):
        self.goes_on_from(60)

    def test_a_named_older_one(self):
        result = scenes.good(testing.SMALL, COUPLED, self.folder,
                             restart=self.folder / f"{OLDER}_structure.h5")
        self.assertEqual(scenes.restarted_at(result), 40)
        testing.check_same_files(self, scenes.results(self.folder), scenes.results(self.whole.folder))

    def test_a_new_run_takes_the_old_checkpoints_away(self):
        scenes.good(testing.SMALL, {**COUPLED, "time.end": "0.4 ms"}, self.folder)
        self.assertEqual(scenes.checkpoints(self.folder), [])


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
