# SPDX-License-Identifier: GPL-2.0-or-later
"""A sheet in a field that points against its magnetisation buckles at M B A L^2 / (E I) = pi^2 / 4,
the Euler load of a column that is clamped below and free above, in the thin limit."""

import math
import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "compressed_sheet.yaml"
G, LAMBDA, LENGTH, MAGNETIZATION = 33e3, 660e3, 20e-3, 1e5
YOUNG = G * (3 * LAMBDA + 2 * G) / (LAMBDA + G)


def slope(xs, ys):
    x0, y0 = sum(xs) / len(xs), sum(ys) / len(ys)
    return (sum((x - x0) * (y - y0) for x, y in zip(xs, ys))
            / sum((x - x0) ** 2 for x in xs))


def threshold(thickness, elements):
    """Over pi^2 / 4, by Southwell: deflection over load grows with the deflection as
    1 / threshold."""
    euler = math.pi ** 2 / 4 * YOUNG * thickness ** 2 / (12 * LENGTH ** 2 * MAGNETIZATION)
    probes = testing.good_run(SCENE, {
        "bodies.sheet.mesh.box.size.2": f"{thickness} m",
        "bodies.sheet.mesh.box.elements.0": elements,
        "magnetic_field.table.magnitude.1": f"{1.6 * euler} T"}).probes()
    bent = [(u, u / b) for u, b in zip(probes["tip_uz[m]"], probes["field[T]"])
            if 0.3 * euler < b < 0.9 * euler]
    found = 1 / slope([u for u, _ in bent], [c for _, c in bent]) / euler
    testing.report(f"thickness {1e3 * thickness} mm, {elements} elements: {found:.4f}, then "
                  f"{1e3 * probes['tip_uz[m]'][-1]:.1f} mm")
    return found, probes["tip_uz[m]"][-1]


class CompressedSheet(unittest.TestCase):
    def test_buckles_at_eulers_load(self):
        thick, far = threshold(0.5e-3, 40)
        thin, _ = threshold(0.25e-3, 40)
        fine, _ = threshold(0.25e-3, 80)
        self.assertGreater(far, LENGTH / 2)  # it bends away beyond
        # The clamp keeps the first millimetre of the width from contracting, which
        # stiffens a sheet of 20 mm by less than 1 %; elements along it add h^2.
        self.assertLess(abs(thick - 1), 0.015)
        self.assertLess(abs(fine - 1), 0.01)
        self.assertLess(abs(fine - 1), abs(thin - 1) + 1e-3)


if __name__ == "__main__":
    unittest.main()
