# SPDX-License-Identifier: GPL-2.0-or-later
"""The search on a beam, whose equations it does not know: seconds."""
import math
import sys
import unittest
from unittest import mock

import numpy as np

from beam import Beam
from designs import Strip, letter, write_curve
from letter import folder_of
from magfsi import testing
from magfsi.design import curves, manufacture, problem, work
from magfsi.design.design_file import read_design
from magfsi.design.objective import Points, PoseObjective
from magfsi.design.search import Options, Search
from magfsi.design.unknowns import Field, Magnetization, Unknowns, groups
from magfsi.study.marked import InputError

STRIP, FIELD_T, AXES = Strip(), 0.02, (0, 2)


class Case:
    """A shape in the field at an angle and its mirror image in the field at minus that angle."""

    def __init__(self, heading, angle, strength=60e3, parts=1, free="", smoothing_m=0.0, mirrored=True,
                 prior=None):
        self.program = Beam(STRIP, parts=parts)
        line = STRIP.line(heading)
        other = line * [1, 1, -1] + [0, 0, STRIP.height_m]
        nodes, weights = self.program.centre_line()
        chords = np.full(self.program.pieces, self.program.piece_m)
        signs = (1, -1) if mirrored else (1,)
        poses = [PoseObjective([Points(nodes[::2], weights[::2], curves.walk(goal, chords)[::2], 1.0,
                                       STRIP.length_m, True)]) for goal, _ in zip((line, other), signs)]
        fields = [Field(FIELD_T * np.array([math.cos(angle), 0, sign * math.sin(angle)]), free, axes=AXES)
                  for sign in signs]
        self.magnetization = Magnetization(groups(self.program), strength, AXES, smoothing_m)
        self.search = Search(Unknowns(self.magnetization, fields), poses, [self.program] * len(poses),
                             Options(enough_rms=0, prior=prior, least_prior=prior) if prior
                             else Options())
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
        h = 1e-4  # differences of the fourth order: an error of some h^4
        f = {k: search.residual(search.moved(state, state.p + k * h * way), 1.0) for k in (-2, -1, 1, 2)}
        found = (8 * (f[1] - f[-1]) - (f[2] - f[-2])) / (12 * h)
        error = np.abs(found - j).max() / np.abs(j).max()
        testing.report(f"gradient: {error:.1e}")
        self.assertLess(error, 1e-6)

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
        """E I th'' = -m B sin(b - th). Next to the clamp the hinges bend otherwise than a beam, and near
        the free end a torque turns hardly anything: a tenth of the length at either end is left out."""
        turn, angle = math.radians(90), math.radians(144)
        case = Case(letter(turn), angle, prior=1e-5)
        case.report("S by 90 degrees")
        m = case.search.unknowns.vectors(case.state.p)
        s = case.program.centres[:, 0] / STRIP.length_m
        second = turn * 2 * math.pi**2 * np.cos(2 * math.pi * s) / STRIP.length_m**2
        exact = -STRIP.bending_nm2() * second / (STRIP.area_m2() * FIELD_T * np.sin(angle - letter(turn)(s)))
        within = (s > 0.1) & (s < 0.9)
        off = np.sqrt(np.mean(((m[:, 0] - exact)**2 + m[:, 2]**2)[within]) / np.mean(exact[within]**2))
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


class Work(unittest.TestCase):
    """Files, checks and results around the search, with the beam in the place of the program."""

    def setUp(self):
        self.folder = folder_of(STRIP, 60)
        self.patches = [mock.patch.object(problem, "Program", lambda *_: Beam(STRIP)),
                        mock.patch.object(work.page, "figure", lambda *_: b"")]
        for patch in self.patches:
            patch.start()
            self.addCleanup(patch.stop)

    def test_results(self):
        wanted = read_design(self.folder / "letter.yaml")
        done = work.design(wanted, self.folder / "out")
        testing.report(done.text)
        for name in ("magnetization.csv", "scene.yaml", "history.csv", "shape_s.csv", "design.html",
                     "results.json", "state.npz"):
            self.assertTrue((self.folder / "out" / name).exists(), name)
        for pose in done.summary["poses"].values():
            self.assertLess(pose["error"], 0.01)
            self.assertTrue(pose["reached_by_rise"])
        steps = done.summary["steps"]
        again = work.design(wanted, self.folder / "out")
        self.assertEqual(again.summary["steps"], steps, "it went on where it had ended")

    def refused(self, old, new, *words):
        file = self.folder / "letter.yaml"
        file.write_text(file.read_text().replace(old, new))
        with self.assertRaises(InputError) as caught:
            work.design(read_design(file), self.folder / "out")
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertFalse((self.folder / "out").exists())

    def test_wrong_length(self):
        write_curve(self.folder / "s.csv", 1.2 * STRIP.line(letter(1.0)))
        self.refused("", "", "letter.yaml:4:", "a curve 24 mm long", "20 mm")

    def test_begins_elsewhere(self):
        write_curve(self.folder / "s.csv", STRIP.line(letter(1.0)) + [0, 0, 5e-3])
        self.refused("", "", "letter.yaml:4:", "out of reach")


if __name__ == "__main__":
    sys.exit(unittest.main())
