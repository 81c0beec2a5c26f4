# SPDX-License-Identifier: GPL-2.0-or-later
"""The strip of the tutorial, with the magnetisation that a search found, writes an S and its mirror image."""
import csv
import unittest

from magfsi import testing

LETTER = testing.ROOT / "tutorials/letter"
LENGTH_MM = 20
# Of the length: the tip adds up what the curve is off by, which is 0.05 % in the mean.
WITHIN = 0.002


def end_mm(name):
    with open(LETTER / name, newline="") as file:
        return [float(c) for c in list(csv.reader(file))[-1]]


class Letter(unittest.TestCase):
    def test_tip_ends_where_the_letters_end(self):
        # Points are only as near as the path needs them: the field rises in steps of a tenth.
        run = testing.good_run(LETTER / "scene.yaml", {"probes.every": "100 ms", "output": "null"})
        rows = run.probes()
        for name, time_s in (("s.csv", 2.0), ("mirrored.csv", 5.0)):
            row = min(range(len(rows["t[s]"])), key=lambda i: abs(rows["t[s]"][i] - time_s))
            tip = [1e3 * rows[f"tip_{axis}[m]"][row] for axis in "xyz"]
            off = sum((a - b)**2 for a, b in zip(tip, end_mm(name)))**0.5 / LENGTH_MM
            testing.report(f"{name}: tip off by {100 * off:.3f} % of the length")
            self.assertLess(off, WITHIN)


if __name__ == "__main__":
    unittest.main()
