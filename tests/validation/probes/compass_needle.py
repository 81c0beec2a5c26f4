# SPDX-License-Identifier: GPL-2.0-or-later
"""A magnetised block in a field swings as a compass needle of its moment of inertia does."""

import math
import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "compass_needle.yaml"


def rate_hz(settings):
    """From the crossings of zero: whole swings between the first one and the last."""
    probes = testing.good_run(SCENE, settings).probes()
    tilt = [b - a for a, b in zip(probes["back_z[m]"], probes["front_z[m]"])]
    times = probes["t[s]"]
    crossings = [times[i] + (times[i + 1] - times[i]) * tilt[i] / (tilt[i] - tilt[i + 1])
                 for i in range(len(tilt) - 1) if tilt[i] * tilt[i + 1] < 0]
    return (len(crossings) - 1) / (2 * (crossings[-1] - crossings[0]))


def theory_hz(length_m, height_m):
    """sqrt(M B V / I) / (2 pi), I = rho V (l^2 + h^2) / 12, at 5 degrees slower by
    theta^2 / 16."""
    inertia = 2000 * (length_m**2 + height_m**2) / 12
    return math.sqrt(50e3 * 2e-3 / inertia) / (2 * math.pi) * (1 - math.radians(5)**2 / 16)


class CompassNeedle(unittest.TestCase):
    def test_corrected_inertia_swings_within_a_percent(self):
        corrected = {"bodies.cube.inertia": "corrected"}
        bar = {"bodies.cube.mesh.box.size": "[2 mm, 1 mm, 1 mm]",
               "bodies.cube.mesh.box.elements": "[4, 2, 2]",
               "probes.points.front.at": "[2 mm, 0.5 mm, 0.5 mm]"}
        for name, settings, theory in (("cube of 2", {}, theory_hz(1e-3, 1e-3)),
                                       ("2 x 1 x 1 mm of 4 x 2 x 2", bar,
                                        theory_hz(2e-3, 1e-3))):
            ratio = rate_hz({**settings, **corrected}) / theory
            lumped = rate_hz(settings) / theory
            testing.report(f"{name}: corrected {ratio:.4f}, lumped {lumped:.4f} of theory")
            self.assertAlmostEqual(ratio, 1, delta=0.01)
            self.assertLess(lumped, 0.95)


if __name__ == "__main__":
    unittest.main()
