# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene of one cell of depth pays for one cell: an eighth of the instructions and of the
memory of eight cells."""

import re
import subprocess
import unittest
from pathlib import Path

from magfsi import instructions
from magfsi import testing

SCENE = Path(__file__).resolve().parent / "still_fluid.yaml"


def settings(depth):
    sides = ", ".join(f"{axis}_{end}: periodic" for axis in "xyz" for end in ("min", "max"))
    return {"fluid.box": f"[64 mm, 64 mm, {depth} mm]", "fluid.boundaries": f"{{{sides}}}",
            "time.end": "5 ms"}


def populations(depth):
    text = subprocess.run([testing.BIN / "magfsi", "explain", SCENE,
                           *testing.overrides(settings(depth))],
                          check=True, capture_output=True, text=True).stdout
    return float(re.search(r"memory: ([\d.]+) MB of populations", text)[1])


class QuasiTwoDimensional(unittest.TestCase):
    def test_pays_for_one_cell(self):
        counts = [instructions.of_steps(testing.BIN / "magfsi-fluid-lbm", SCENE, settings(depth))
                  for depth in (1, 8)]
        work = counts[1] / counts[0]
        memory = populations(8) / populations(1)
        testing.report(f"8 cells of depth over 1: instructions {work:.2f}, memory {memory:.2f}")
        # All rows of a thin box are at its sides, where pointers are found row by row; and
        # arrays end on pages of 4 KiB.
        self.assertGreater(work, 8 * 0.85)
        self.assertGreater(memory, 8 * 0.95)


if __name__ == "__main__":
    unittest.main()
