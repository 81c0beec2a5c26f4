# SPDX-License-Identifier: GPL-2.0-or-later
"""Magnetisations that are known in closed form are found back from shapes.

The inverse problem of the elastica: a beam with the heading th(s), clamped at s = 0 and free at the other
end, in a field B at the angle b, balances E I th'' = -m B sin(b - th) for a magnetisation m along it (per
length); the mirror image in the field at -b has the same m, and the two shapes leave no freedom. (Lum et
al. 2016 and Li et al. 2026 start from this equation of moments.) The beam neither stretches nor shears; a
solid of length over thickness 80 does both by its strain, some 1e-3.

Two derivatives of a shape raise its errors: the weight of the magnetisation is such that what it smooths
away and what it lets through are about alike. A torque next to the clamp turns hardly anything, and there
the weight ends the magnetisation, which of a letter and an arch is largest there. These have no lateral
contraction, which the clamp would hold back; a sine, whose magnetisation ends by itself, has it."""
import math
import sys
import unittest

import numpy as np

from designs import Strip, folder_with, letter, write_curve
from magfsi import testing
from magfsi.design import manufacture
from magfsi.design.design_file import read_design
from magfsi.design.problem import Problem
from magfsi.design.search import Options

WITHIN = 0.02
ANGLE, TURN = math.radians(144), math.radians(90)
FILE = """scene: scene.yaml
poses:
  one: {{field: [{x} mT, 0 mT, {z} mT], curve: {{file: one.csv}}}}
  other: {{field: [{x} mT, 0 mT, -{z} mT], curve: {{file: other.csv}}}}
magnetization: {{strength: {strength} kA/m, plane: xz, constant_along: [y, z]}}
"""
SHAPES = {
    "letter": (letter(TURN), lambda s: TURN * 2 * math.pi**2 * np.cos(2 * math.pi * s)),
    "sine": (lambda s: TURN * (s + np.sin(math.pi * s) / math.pi), lambda s: -TURN * math.pi * np.sin(math.pi * s)),
    "arch": (lambda s: TURN * (1 - (1 - s)**3), lambda s: -TURN * 6 * (1 - s)),
}


def exact_to(prior):
    """Options of a search that goes on as long as it gains, with this weight of the magnetisation."""
    return Options(enough_rms=0, prior=prior, least_prior=prior)


def found(strip, heading, field_mt, strength):
    """Problem and state of the design of a shape and its mirror image."""
    folder = folder_with(scene_yaml=strip.text, design_yaml=FILE.format(
        x=f"{field_mt * math.cos(ANGLE):.6g}", z=f"{field_mt * math.sin(ANGLE):.6g}", strength=strength))
    line = strip.line(heading)
    write_curve(folder / "one.csv", line)
    line[:, 2] = strip.height_m - line[:, 2]
    write_curve(folder / "other.csv", line)
    problem = Problem(read_design(folder / "design.yaml"), options=exact_to(7e-6))
    return problem, problem.search.stages(problem.search.begin(problem.unknowns.start()))


class Elastica(unittest.TestCase):
    def profile(self, strip, shape, field_mt=5.0, strength=40.0):
        """Relative difference (root mean square) of the magnetisation from the closed form."""
        heading, second = SHAPES[shape]
        problem, state = found(strip, heading, field_mt, strength)
        with problem:
            search = problem.search
            m = search.unknowns.vectors(state.p)
            s = problem.program.centres[:, 0] / strip.length_m
            exact = (-strip.bending_nm2() * second(s) / strip.length_m**2
                     / (strip.area_m2() * 1e-3 * field_mt * np.sin(ANGLE - heading(s))))
            # A tenth of the length at either end is left out.
            within = (s > 0.1) & (s < 0.9)
            off = np.sqrt(np.mean(((m[:, 0] - exact)**2 + m[:, 2]**2)[within])
                          / np.mean(exact[within]**2))
            testing.report(f"{shape}, {strip.elements}: off by {100 * off:.2f} % (shapes by "
                           f"{[f'{100 * e:.3f} %' for e in search.errors(state)]})")
            return off

    def profile_of(self, shape, elements, ratio):
        strip = Strip(20, 0.5, 0.25, (elements, 1, 1), ratio=ratio)
        self.assertLess(self.profile(strip, shape), WITHIN)

    def test_small(self):
        self.profile_of("sine", 80, ratio=20)

    def test_letter(self):
        self.profile_of("letter", 80, ratio=0)

    def test_arch(self):
        self.profile_of("arch", 80, ratio=0)


HARMONIC = """name: strip
time: {end: 1 s, equilibrium: {method: newton}}
bodies:
  strip:
    mesh: {box: {size: [3.7 mm, 1.5 mm, 0.185 mm], elements: [20, 4, 1]}}
    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}
    clamps: [x_min]
"""
OF_HARMONIC = """scene: scene.yaml
poses:
  v: {field: [5 mT, 0 mT, 5 mT], curve: {file: v.csv, points: 41}}
  c: {field: [-5 mT, 0 mT, -5 mT], curve: {file: c.csv, points: 41}}
magnetization: {strength: 200 kA/m, plane: xz, constant_along: [y, z]}
"""


class Harmonic(unittest.TestCase):
    """The profile of the paper's strip from its own shapes at 45 and 225 degrees."""

    def test_is_found_back(self):
        from magfsi.design.program import Design, Program

        folder = folder_with(scene_yaml=HARMONIC)
        program = Program(folder / "scene.yaml")
        s = program.centres[:, 0] / 3.7e-3
        wave = 2 * math.pi * s + math.radians(45)
        exact = 62e3 * np.stack([np.cos(wave), 0 * s, np.sin(wave)], axis=1)
        nodes, weights = program.centre_line()
        shapes = []
        for name, sign in (("v", 1), ("c", -1)):
            risen = program.rise(Design(exact, sign * np.array([5e-3, 0, 5e-3])))
            self.assertTrue(risen.reached)
            shapes.append(np.einsum("pa,pad->pd", weights, risen.x[nodes]))
            write_curve(folder / f"{name}.csv", shapes[-1])
        program.close()
        (folder / "design.yaml").write_text(OF_HARMONIC)
        with Problem(read_design(folder / "design.yaml"), options=exact_to(1e-10)) as problem:
            search = problem.search
            # The very places: along a curve the chords would be those at rest, 0.1 % off.
            for objective, shape in zip(search.poses, shapes):
                objective.terms[0].goal = shape
            state = search.stages(search.begin(search.unknowns.start()))
            part = problem.magnetization
            m = part.vectors(search.unknowns.part(state.p))
            # What the fields see: directions of the vectors that change the shapes.
            by_vectors = manufacture._by_vectors(search, state)[..., [0, 2]]
            groups = np.stack([by_vectors[:, part.group.number == g].sum(axis=1)
                               for g in range(part.group.count)], axis=1)
            _, values, basis = np.linalg.svd(groups.reshape(len(groups), -1), full_matrices=False)
            seen = basis[values > 1e-3 * values[0]]
            first = [int(np.flatnonzero(part.group.number == g)[0]) for g in range(part.group.count)]
            off, whole = (m - exact)[first][:, [0, 2]].ravel(), exact[first][:, [0, 2]].ravel()
            share = np.linalg.norm(seen @ off) / np.linalg.norm(seen @ whole)
            testing.report(f"harmonic: {len(seen)} of {len(whole)} directions are seen; in these off by "
                           f"{100 * share:.2f} %, in all by "
                           f"{100 * np.linalg.norm(off) / np.linalg.norm(whole):.1f} %; shapes by "
                           f"{[f'{100 * e:.3f} %' for e in search.errors(state)]}")
            self.assertLess(share, WITHIN)


if __name__ == "__main__":
    sys.exit(unittest.main())
