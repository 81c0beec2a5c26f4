"""Studies for tests: a file in a folder of its own, and its command."""

import csv
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import magfsi_runs as magfsi  # noqa: E402

DRIVER = magfsi.ROOT / "adapters/magfsi/study"


class Study:
    def __init__(self, text):
        self.folder = Path(magfsi.new_folder())
        self.file = self.folder / "study.yaml"
        self.file.write_text(text)
        self.out = self.folder / "out"

    def command(self, *more):
        return ["/usr/bin/python3", DRIVER, self.file, "--out", self.out, *more]

    def run(self, *more, limit_s=120):
        return magfsi.finish(magfsi.start(self.command(*more)), time.monotonic(), self.out,
                             limit_s)

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
