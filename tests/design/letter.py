# SPDX-License-Identifier: GPL-2.0-or-later
"""A strip writes a letter: an S in one field and its mirror image in another.

The beam's equations say what is possible. With a heading th(s) and a field at the angle b from x, a
magnetisation m along x (per length: M times the section) balances the bending if
    B m sin(b - th) = -E I th'',
and the same m gives the mirror image in the field at -b. So b must be larger than every heading, or
the strip cannot get past the direction of the field; and the part of m along the field,
-E I th'' cot(b - th), makes the shape stable if b is above 90 degrees and b - th below it where th'' < 0.
For an S that turns by 108 degrees, 144 degrees from the strip fulfil both."""
import json
import math
import os
import sys
import time
import unittest

import numpy as np

from designs import Strip, folder_with, letter, mean_distance, run, write_curve
from magfsi import runs, testing
from magfsi.design.design_file import read_design
from magfsi.design.problem import Problem

TURN = math.radians(108)  # 0.6 of half a turn
FILE = """name: letter
scene: scene.yaml
poses:
  s: {{field: [{x} mT, 0 mT, {z} mT], curve: {{file: s.csv}}}}
  mirrored: {{field: [{x} mT, 0 mT, -{z} mT], curve: {{file: mirrored.csv}}}}
magnetization: {{strength: {strength} kA/m, plane: xz{more}}}
"""
FIELD_MT, ANGLE = 20.0, math.radians(144)
WITHIN = 0.01  # of the length: what the issue asks for
LIMIT_S = 120.0  # on two cores; the processor time of all processes together is less, on a busy machine, too


def folder_of(strip, strength, turn=TURN, more=""):
    folder = folder_with(
        scene_yaml=strip.text,
        letter_yaml=FILE.format(x=f"{FIELD_MT * math.cos(ANGLE):.6g}",
                                z=f"{FIELD_MT * math.sin(ANGLE):.6g}", strength=strength, more=more))
    line = strip.line(letter(turn))
    write_curve(folder / "s.csv", line)
    line[:, 2] = strip.height_m - line[:, 2]
    write_curve(folder / "mirrored.csv", line)
    return folder


def reached(folder, pose):
    table = runs.read_table(folder / f"shape_{pose}.csv", float)
    return (np.stack([table[f"{a}[m]"] for a in "xyz"], axis=1),
            np.stack([table[f"wanted_{a}[m]"] for a in "xyz"], axis=1))


class Letter(unittest.TestCase):
    def written(self, strip, strength, more=""):
        folder = folder_of(strip, strength, more=more)
        began = sum(os.times()[:4])
        done = run(folder / "letter.yaml", "--out", folder / "out")
        self.assertEqual(done.code, 0, done.err[-2000:])
        busy_s = sum(os.times()[:4]) - began  # of this process and those that have ended
        facts = json.loads((folder / "out/results.json").read_text())
        for pose in ("s", "mirrored"):
            distance = mean_distance(*reached(folder / "out", pose)) / strip.length_m
            testing.report(f"{pose}: mean distance {100 * distance:.3f} % of the length, risen "
                           f"{facts['poses'][pose]}")
            self.assertLess(distance, WITHIN)
        testing.report(f"{strip.elements}: {busy_s:.1f} s of processors, {facts['steps']} steps")
        return folder, facts, busy_s

    def test_small(self):
        _, facts, _ = self.written(Strip(elements=(30, 2, 1)), 60)
        for pose in facts["poses"].values():
            self.assertTrue(pose["reached_by_rise"], facts)

    def test_whole(self):
        _, facts, busy_s = self.written(Strip(), 60)
        self.assertLess(busy_s, LIMIT_S)
        for pose in facts["poses"].values():
            self.assertTrue(pose["reached_by_rise"], facts)

    def seconds_of_a_step(self, strip, more, scene):
        """(unknowns, seconds of a trial in the mean) at the same early part of the search."""
        folder = folder_of(strip, 60, more=more)
        (folder / "scene.yaml").write_text(scene)
        with Problem(read_design(folder / "letter.yaml"), processes=1) as problem:
            search = problem.search
            state = search.begin(search.unknowns.start())
            began = time.monotonic()
            for i in range(4):
                state = search.improved(state, 0.05 * (i + 1))
            return search.unknowns.size, (time.monotonic() - began) / sum(s.trials for s in search.history)

    def test_cost_of_unknowns(self):
        """A thousand unknowns cost at most twice what ten do."""
        strip = Strip()
        fifths = ", ".join(f"r{i}: {{box: [[{4 * i} mm, 0 mm, 0 mm], [{4 * i + 4} mm, 4 mm, 1 mm]]}}"
                           for i in range(5))
        regions = strip.text.replace("    clamps:", f"    regions: {{{fifths}}}\n    clamps:")
        few, few_s = self.seconds_of_a_step(strip, ", by: region", regions)
        many, many_s = self.seconds_of_a_step(strip, ", constant_along: [z]", strip.text)
        testing.report(f"{few} unknowns: {few_s:.2f} s a step; {many}: {many_s:.2f} s")
        self.assertEqual(few, 10)
        self.assertGreater(many, 1000)
        self.assertLess(many_s, 2 * few_s)


if __name__ == "__main__":
    sys.exit(unittest.main())
