# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies for tests: a file in a folder of its own, and its command."""

import csv
import sys
import time
from pathlib import Path

from magfsi import testing
from magfsi.study.marked import InputError


class Study:
    program = "magfsi.study"

    def __init__(self, text):
        self.folder = Path(testing.new_folder())
        self.file = self.folder / "study.yaml"
        self.file.write_text(text)
        self.out = self.folder / "out"

    def command(self, *more):
        return [sys.executable, "-m", self.program, self.file, "--out", self.out, *more]

    def run(self, *more, limit_s=600):
        return testing.finish(testing.start(self.command(*more)), time.monotonic(), self.out,
                             limit_s)

    def called(self, *more):
        """The command in this process."""
        return testing.called(self.program, InputError, *self.command(*more)[3:])

    def good_run(self, *more):
        done = self.run(*more)
        if done.code != 0:
            raise AssertionError(f"exit code {done.code}\n{done.out}\n{done.err}")
        return done

    def rows(self):
        with open(self.out / "runs.csv", newline="") as file:
            return list(csv.DictReader(file))

    def records(self):
        """When each run that is done was done, by its folder."""
        return {path.parent.name: path.stat().st_mtime_ns
                for path in self.out.glob("runs/*/study.json")}
