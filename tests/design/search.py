# SPDX-License-Identifier: GPL-2.0-or-later
"""The search on a beam, whose equations it does not know: seconds."""
import math
import sys
import unittest

import numpy as np

from beam import Beam
from designs import Strip, letter
from magfsi import testing
from magfsi.design import curves, manufacture
from magfsi.design.objective import Points, PoseObjective
from magfsi.design.search import Options, Search
from magfsi.design.unknowns import Field, Magnetization, Unknowns, groups

STRIP, FIELD_T, AXES = Strip(), 0.02, (0, 2)


class Case:
    """A shape in the field at an angle and its mirror image in the field at minus that angle."""

    def __init__(self, heading, angle, strength=60e3, parts=1, free="", smoothing_m=0.0, mirrored=True,
                 enough_rms=1e-3):
        self.program = Beam(STRIP, parts=parts)
        line = STRIP.line(heading)
        other = line * [1, 1, -1] + [0, 0, STRIP.height_m]
        shares = np.linspace(0, 1, 41)
        nodes, weights = self.program.locate(curves.at_shares(self.program.rest, shares))
        signs = (1, -1) if mirrored else (1,)
        poses = [PoseObjective([Points(nodes, weights, curves.at_shares(goal, shares), AXES, 1.0,
                                       STRIP.length_m, True)]) for goal, _ in zip((line, other), signs)]
        fields = [Field(FIELD_T * np.array([math.cos(angle), 0, sign * math.sin(angle)]), free, axes=AXES)
                  for sign in signs]
        self.magnetization = Magnetization(groups(self.program), strength, AXES, smoothing_m)
        self.search = Search(Unknowns(self.magnetization, fields), poses, [self.program] * len(poses),
                             Options(enough_rms=enough_rms))
        self.state = self.search.stages(self.search.begin(self.search.unknowns.start()))

    def report(self, name):
        lost = sum(step.lost for step in self.search.history)
        testing.report(f"{name}: {[f'{100 * e:.3f} %' for e in self.search.errors(self.state)]}, "
                       f"{len(self.search.history)} steps, {self.program.moves} moves, {lost} lost, risen "
                       f"{[(f.share, round(1e3 * a, 3)) for f, a in self.search.risen(self.state)]}, "
                       f"{self.search.history[-1].seconds:.1f} s")


class Beams(unittest.TestCase):
    def test_gradient(self):
        case = Case(letter(1.0), math.radians(144))
        search, state = case.search, case.state
        way = np.random.default_rng(1).normal(size=state.p.size)
        j = search.jacobian(state) @ way
        h = 3e-5
        ahead, back = (search.residual(search.moved(state, state.p + s * h * way), 1.0) for s in (1, -1))
        self.assertLess(np.abs((ahead - back) / (2 * h) - j).max() / np.abs(j).max(), 1e-6)

    def test_letter(self):
        case = Case(letter(math.radians(108)), math.radians(144))
        case.report("S by 108 degrees, fields at 144")
        self.assertLess(max(case.search.errors(case.state)), 0.01)
        for found, away_m in case.search.risen(case.state):
            self.assertTrue(found.reached)
            self.assertLess(away_m, 0.01 * STRIP.length_m)

    def test_letter_in_opposite_fields_of_its_own_choice(self):
        """At 90 degrees the strip cannot turn past the field; free to turn them, the search does."""
        case = Case(letter(math.radians(108)), math.radians(90), free="direction")
        case.report("S by 108 degrees, fields free from 90")
        self.assertLess(max(case.search.errors(case.state)), 0.01)

    def test_closed_form(self):
        """E I th'' = -m B sin(b - th), of the order of the pieces."""
        turn, angle = math.radians(90), math.radians(144)
        case = Case(letter(turn), angle, enough_rms=2e-4)
        case.report("S by 90 degrees")
        m = case.search.unknowns.vectors(case.state.p)
        s = case.program.centres[:, 0] / STRIP.length_m
        second = turn * 2 * math.pi**2 * np.cos(2 * math.pi * s) / STRIP.length_m**2
        exact = -STRIP.bending_nm2() * second / (STRIP.area_m2() * FIELD_T * np.sin(angle - letter(turn)(s)))
        off = np.sqrt(np.mean((m[:, 0] - exact)**2 + m[:, 2]**2) / np.mean(exact**2))
        testing.report(f"profile off by {100 * off:.2f} %")
        self.assertLess(off, 0.02)

    def test_few_vectors(self):
        case = Case(letter(math.radians(90)), math.radians(144), parts=8)
        case.report("S of eight elements in a section")

        class Problem:
            search, program, magnetization = case.search, case.program, case.magnetization

        search, state = manufacture.quantized(Problem, case.state, 4)
        errors = search.errors(state)
        testing.report(f"four vectors: {[f'{100 * e:.3f} %' for e in errors]}")
        self.assertLess(max(errors), 0.02)
        self.assertLessEqual(len(np.unique(search.unknowns.vectors(state.p), axis=0)), 4)


if __name__ == "__main__":
    sys.exit(unittest.main())
