# SPDX-License-Identifier: GPL-2.0-or-later
"""An installation that was moved: it works, needs no checkout, and nothing is written into it."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

from magfsi import testing

BUILD = Path(sys.argv.pop(1))


def listing(folder):
    return sorted((str(path.relative_to(folder)), path.lstat().st_mtime_ns)
                  for path in folder.rglob("*"))


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = Path(testing.new_folder())
        subprocess.run(["cmake", "--install", BUILD, "--prefix", folder / "first"], check=True,
                       stdout=subprocess.DEVNULL)
        cls.prefix = folder / "moved"
        (folder / "first").rename(cls.prefix)
        cls.before = listing(cls.prefix)
        cls.work = folder / "work"
        cls.work.mkdir()

    def call(self, *words):
        """As a user has it: nothing of the checkout in the environment."""
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith(("MAGFSI", "PYTHON"))}
        return subprocess.run([self.prefix / "bin/magfsi", *words], capture_output=True, text=True,
                              cwd=self.work, env={**environment, "HOME": str(self.work)})

    def test_it_passes_its_own_checks(self):
        done = self.call("test", "--installed")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("OK", done.stderr)
        self.assertEqual(listing(self.prefix), self.before)

    def test_a_tutorial_runs_by_its_name_in_a_checkout(self):
        done = self.call("run", "tutorials/swimmer", "--set", "time.end=0.2 ms")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.work / "runs/swimmer/summary.json").exists())

    def test_it_has_no_path_of_the_checkout(self):
        """In scripts and Python; programs name source files in assertions of other libraries only."""
        for path in self.prefix.rglob("*"):
            if path.is_file() and path.suffix in (".py", ".bash", ".cmake", "") and path.stat().st_size < 1e5:
                self.assertNotIn(str(testing.ROOT), path.read_text(errors="replace"), path)

    def test_what_belongs_to_a_checkout_is_refused(self):
        for words in (["build"], ["bench", "lbm"], ["test"]):
            done = self.call(*words)
            self.assertEqual(done.returncode, 2, words)

    def test_a_scene_of_ones_own(self):
        self.assertEqual(self.call("new", "jelly").returncode, 0)
        self.assertIn("good", self.call("check", "jelly").stdout)


if __name__ == "__main__":
    unittest.main()
