# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi compare of real, short runs: a run and itself on other ranks are the same; another
kernel is not; every probe is in the table, and the flow of both in the picture."""
import unittest
from pathlib import Path

import numpy as np
from command import called
from PIL import Image

from magfsi import runs, testing

FIELDS = {"time.end": "1 ms", "output.structure.every": "0.2 ms",
          "output.fluid": "{every: 0.2 ms, fields: [velocity, pressure]}"}
OTHER = {**FIELDS, "coupling.immersed_boundary.kernel": "2-point"}


def compared(first, second, *words, drawn=True):
    out = Path(testing.new_folder()) / "out"
    done = called(first.folder, second.folder, "--out", out, *words, drawn=drawn, fields=drawn)
    if done.code:
        raise AssertionError(done.err)
    return runs.read_rows(out / "compare.csv"), done.out, out


class ShortRuns(unittest.TestCase):
    def test_other_kernels_differ_and_all_is_shown(self):
        first, second = (testing.shared_run(testing.SMALL, words) for words in (FIELDS, OTHER))
        rows, said, out = compared(first, second, "--names", "three,two", "--field", "pressure")
        found = {row["probe"]: row for row in rows}
        probes, others = first.probes(), second.probes()
        for column in ("robot.end_to_end[m]", "robot.energy_elastic[J]", "kinetic_energy[J]"):
            self.assertEqual(float(found[column]["first"]), float(f"{probes[column][-1]:.9g}"))
            # Both have rows at the same times: the norm written out.
            a, b = np.array(probes[column]), np.array(others[column])
            right = np.sqrt(((b - a)**2).sum() / (a**2).sum())
            self.assertGreater(right, 0)
            # Four digits are in the table.
            self.assertAlmostEqual(float(found[column]["l2[1]"]) / right, 1, places=3)
        self.assertIn("is not known: neither run has one", said)
        page = (out / "compare.html").read_text()
        self.assertIn("The pressure in the plane xz", page)
        self.assertIn("coupling.immersed_boundary.kernel", page.split("Where the scenes differ")[1])
        for name in ("curves.png", "fields.png"):
            with Image.open(out / name) as picture:
                # Something is to be seen.
                self.assertGreater(np.array(picture.convert("RGB")).std(), 10, name)

    def test_a_run_and_itself_on_other_ranks(self):
        """The same to rounding, which grows in a millisecond to less than a thousandth of a per
        cent."""
        first = testing.shared_run(testing.SMALL, FIELDS)
        second = testing.shared_run(testing.SMALL, FIELDS, "structure=1,fluid=2")
        rows, _, _ = compared(first, second, drawn=False)
        self.assertGreater(len(rows), 10)
        for row in rows:
            self.assertLess(float(row["l2[1]"] or 0), 1e-5, row["probe"])

    def test_processor_time_is_in_the_summary(self):
        """Of a process that works: at least a tenth of its working time, of which other programs
        may have had the rest on a busy machine; at most a minute."""
        summary = testing.shared_run(testing.SMALL, FIELDS).summary()
        self.assertEqual(set(summary["processor_s"]), {"structure", "fluid"})
        for side, seconds in summary["processor_s"].items():
            self.assertGreater(seconds, 0.1 * summary["load"][side]["working_s"], side)
            self.assertLess(seconds, 60, side)


if __name__ == "__main__":
    unittest.main()
