# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks of the documents that need whole runs, done in full: scripts that draw a tutorial's figure,
with the runs they draw; the calibration; what a scene costs. An hour of two cores, so it is run by
name (label long):

    ./magfsi test -R documentation_figures
    ./magfsi python tests/docs/figures.py cost models     those lines with both words
"""
import shlex
import shutil
import sys
import time
import unittest
from pathlib import Path

import blocks
from magfsi import testing

# Of another machine's night: each as little as there can be of it.
LESS = {"tests/bench/effects/costs.py": ["fluid"]}
MAP_CELL = ["tests/stability/map/lattice.yaml", "--only", "relaxation_time=0.51", "--only",
            "lattice_speed=0.03", "--only", "collision=trt"]


class Whole(blocks.Folder):
    """With copies in place of links: what is drawn anew is not to replace what is shipped."""

    def __init__(self):
        super().__init__()
        for name in ("docs", "tutorials"):
            (self.path / name).unlink()
            shutil.copytree(blocks.ROOT / name, self.path / name)
        self.environment["XDG_CACHE_HOME"] = str(self.path / "cache")  # where the calibration is kept
        self.limit_s = 3600

    def runs_for(self, words, page):
        """Those that a script draws, as the page makes them."""
        for run in blocks.runs_of(words):
            if words[2].endswith("draw_map.py"):
                self.good(["./magfsi", "study", *MAP_CELL, "--out", f"{run}/lattice"])
            elif not (self.path / run / "summary.json").exists():
                self.good(blocks.maker_of(run, page))

    def pictures(self):
        return {file: file.stat().st_mtime_ns for part in (".", "runs", "docs", "tutorials")
                for file in (self.path / part).rglob("*.png") if "build" not in file.parts}


def lines():
    """(page, words) of each line that blocks.py only looks at, without where its output goes."""
    found = {}
    for page, kind, text, why in blocks.blocks():
        for line in blocks.commands(text) if kind == "sh" and not why else ():
            words = shlex.split(line.partition(" > ")[0], comments=True)
            if words[0] == "./magfsi" and words[1:2] in (["python"], ["bench"], ["cost"]):
                found.setdefault(tuple(words), page)
    return [(page, list(words)) for words, page in found.items()]


class Figures(unittest.TestCase):
    def test_every_line_is_done(self):
        folder = Whole()
        self.assertGreater(len(lines()), 15)
        for page, words in lines():
            if any(part not in shlex.join(words) for part in sys.argv[1:]):
                continue
            with self.subTest(f"{page}: {shlex.join(words)}"):
                began, before = time.monotonic(), folder.pictures()
                folder.runs_for(words, page)
                said = folder.good([*words, *LESS.get(words[2], [])])
                testing.report(f"{time.monotonic() - began:6.0f} s  {shlex.join(words)}")
                if words[1] == "python" and "costs.py" not in words[2]:
                    self.assertNotEqual(folder.pictures(), before, said)
                else:
                    self.assertTrue(said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
