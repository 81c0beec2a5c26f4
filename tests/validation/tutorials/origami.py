# SPDX-License-Identifier: GPL-2.0-or-later
"""A plate of oblique domains folds as Miura-ori: oblique lines are mountains and valleys in turn,
and so are the pieces of each straight line; finer meshes bring the fold nearer to its limit."""

import math
import unittest

from magfsi import testing

SCENE = testing.ROOT / "tutorials/origami/scene.yaml"
# Extrapolated from 8 and 12 elements a cell side (tutorials/origami/README.md).
LIMIT_DEG = 71.2
# The error falls with the square of the element: four elements leave 12.0 degrees, six 5.2.
ERROR_DEG = {4: 12.5, 6: 5.7}


class Folded:
    def __init__(self, elements, settings=None):
        run = testing.good_run(SCENE, {
            "output": "null", "bodies.plate.mesh.oblique.elements": f"[{elements}, {elements}, 1]",
            **(settings or {})})
        self.log = (run.folder / "run.log").read_text()
        self.last = {name: values[-1] for name, values in run.probes().items()}

    def point(self, name):
        return [self.last[f"{name}_{axis}[m]"] for axis in "xyz"]

    def cell(self, row, column):
        """Normal and centre of one of the four middle cells, rows and columns 1 and 2."""
        left, right = self.point(f"oblique_{row}{column}"), self.point(f"oblique_{row}{column + 1}")
        low, high = self.point(f"straight_{row}{column}"), self.point(f"straight_{row + 1}{column}")
        a, b = minus(right, left), minus(high, low)
        normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        size = math.sqrt(dot(normal, normal))
        return [n / size for n in normal], [0.5 * (p + q) for p, q in zip(left, right)]

    def fold_deg(self, one, other):
        """Positive for a mountain, negative for a valley."""
        (first, here), (second, there) = self.cell(*one), self.cell(*other)
        size = math.degrees(math.acos(dot(first, second)))
        return math.copysign(size, dot(minus(second, first), minus(there, here)))


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


class Origami(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.plate = Folded(4)

    def test_folds_as_miura_ori(self):
        oblique = [self.plate.fold_deg((row, 1), (row, 2)) for row in (1, 2)]
        straight = [self.plate.fold_deg((1, column), (2, column)) for column in (1, 2)]
        testing.report(f"oblique {oblique[0]:.2f}, {oblique[1]:.2f}, straight {straight[0]:.2f}, "
                      f"{straight[1]:.2f} degrees")
        # One line is one fold, and each straight line changes where it meets an oblique one.
        self.assertGreater(oblique[0] * oblique[1], 0)
        self.assertLess(straight[0] * straight[1], 0)
        self.assertGreater(min(map(abs, oblique)), 50)
        self.assertGreater(min(map(abs, straight)), 5)

    def test_stable_and_free_of_net_force(self):
        self.assertNotIn("unstable", self.plate.log)
        self.assertNotIn("could not be followed", self.plate.log)
        # Domains balance: the middle of the plate stays where it was, to the residual of 1e-6.
        centre = [self.plate.last[f"plate.com_{axis}[m]"] for axis in "xyz"]
        flat = [22.5e-3, 20e-3 * math.sin(math.pi / 3), 0.5e-3]
        self.assertLess(math.dist(centre, flat), 1e-8)

    def test_converges(self):
        error = {4: LIMIT_DEG - abs(self.plate.fold_deg((1, 1), (1, 2))),
                 6: LIMIT_DEG - abs(Folded(6, {"probes.every": "500 ms"})
                                    .fold_deg((1, 1), (1, 2)))}
        for elements, degrees in error.items():
            testing.report(f"{elements} elements a side: {degrees:.2f} degrees below the limit")
            self.assertGreater(degrees, 0)
            self.assertLess(degrees, ERROR_DEG[elements])


if __name__ == "__main__":
    unittest.main()
