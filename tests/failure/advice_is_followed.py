# SPDX-License-Identifier: GPL-2.0-or-later
"""Whoever does what a message says gets rid of it: each advice is provoked and followed to the letter.

advice/*.txt has a row a line: settings | words of the message | remedy | another remedy ... A
remedy is settings on top of the first ones (of several keys with ";" between them), "-" the scene
without them. A line "== NAME" starts the rows of the scene advice/NAME.yaml.
"""

import subprocess
import sys
import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).parent / "advice"


def rows(table):
    scene = None
    for line in (HERE / table).read_text().splitlines():
        if line.startswith("== "):
            scene = HERE / f"{line[3:]}.yaml"
        elif line and not line.startswith("#"):
            yield scene, *(part.strip() for part in line.split(" | "))


def told(command, scene, *settings):
    """Exit code of magfsi COMMAND, and what it says."""
    words = [testing.BIN / "magfsi", command, scene]
    for one in "; ".join(settings).split("; "):
        words += ["--set", one] if one else []
    if command == "run":
        words += ["--out", Path(testing.new_folder()) / "run"]
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=120, check=False)
    return done.returncode, done.stdout + done.stderr


class Advice(unittest.TestCase):
    def follow(self, table, command="check"):
        number = 0
        for scene, cause, message, *remedies in rows(table):
            with self.subTest(cause):
                self.assertTrue(remedies)
                self.assertIn(message, told(command, scene, cause)[1])
                for remedy in remedies:
                    number += 1
                    code, after = told(command, scene, *([] if remedy == "-" else [cause, remedy]))
                    self.assertEqual(code, 0, f"{remedy}: {after}")
                    self.assertNotIn(message, after, remedy)
        testing.report(f"{table}: {number} advices followed")


if __name__ == "__main__":
    unittest.main()
