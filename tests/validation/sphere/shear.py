# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere of the fluid's density follows a shear flow without drift: it moves with the flow
around its centre, turns at half the shear rate and keeps its height.

Shear rate G = 0.48 1/s, radius a = 0.5 mm, Reynolds number G a^2 / nu = 0.12; 8 cells a diameter.
"""

import math
import unittest
from pathlib import Path

from magfsi import testing

import ball_mesh

SCENE = Path(__file__).resolve().parent / "shear.yaml"
WALL, HEIGHT, RADIUS = 0.96e-3, 4e-3, 0.5e-3
SHEAR = 2 * WALL / HEIGHT
# The flow needs some 0.5 HEIGHT^2 / nu = 8 s to become linear (e^-40 of its start is left).
FROM_S = 8


class Course:
    """What a sphere does that starts at a height above the middle [m]."""

    def __init__(self, above, forcing="penalty"):
        folder = testing.new_folder()
        scene = Path(folder) / "shear.yaml"
        scene.write_text(SCENE.read_text())
        ball_mesh.write(Path(folder) / "ball.msh", ball_mesh.ball(4, 2, 2 * RADIUS))
        place = f"[3 mm, 2 mm, {1e3 * (HEIGHT / 2 + above)} mm]"
        run = testing.good_run(scene, {"bodies.ball.initial.position": place,
                                       "coupling.immersed_boundary.forcing": forcing},
                               ranks="structure=1,fluid=1")
        p = run.probes()
        t = p["t[s]"]
        i = next(n for n, s in enumerate(t) if s >= FROM_S)
        span = t[-1] - t[i]
        self.speed = (p["ball.com_x[m]"][-1] - p["ball.com_x[m]"][i]) / span
        self.drift = p["ball.com_z[m]"][-1] - p["ball.com_z[m]"][0]
        turn = [math.atan2(p["high_x[m]"][n] - p["low_x[m]"][n],
                           p["high_z[m]"][n] - p["low_z[m]"][n]) for n in range(len(t))]
        turned = sum((b - a + math.pi) % (2 * math.pi) - math.pi
                     for a, b in zip(turn[i:], turn[i + 1:]))
        self.spin = turned / span
        testing.report(
            f"{1e3 * above:.2f} mm above the middle: speed {1e3 * self.speed:.4f} mm/s, the flow's "
            f"{1e3 * SHEAR * above:.4f}; spin {self.spin / (SHEAR / 2):.4f} of G / 2; drift "
            f"{1e3 * self.drift:.5f} mm; no-slip error "
            f"{run.summary()['immersed_boundary']['no_slip_error']:.3f}")


class Shear(unittest.TestCase):
    def test_in_the_middle(self):
        sphere = Course(0)
        # By symmetry nothing moves it, to the asymmetry of mesh and grid.
        self.assertLess(abs(sphere.speed), 2e-3 * WALL)
        self.assertLess(abs(sphere.drift), 2e-3 * RADIUS)
        # Inertia takes 0.154 Re^1.5 = 0.6 % (Lin, Peery, Schowalter 1970), two walls at 4 radii
        # 2 * 3/16 / 4^3 = 0.6 % (Goldman, Cox, Brenner 1967); the grid some per cent.
        self.assertAlmostEqual(sphere.spin / (SHEAR / 2), 0.988, delta=0.03)

    def test_without_slip(self):
        sphere = Course(0, "no_slip")
        self.assertLess(abs(sphere.speed), 2e-3 * WALL)
        # Its markers, thinned out to a cell, are less symmetric than those of the penalty, which
        # are those of the mesh: 0.4 % of the radius while the walls move by 23 radii each.
        self.assertLess(abs(sphere.drift), 5e-3 * RADIUS)
        self.assertAlmostEqual(sphere.spin / (SHEAR / 2), 0.988, delta=0.01)

    def test_beside_the_middle(self):
        above = 0.75e-3
        sphere = Course(above)
        flow = SHEAR * above
        # A wall at h drags it along by 5/16 (a / h)^3 of G h (Goldman, Cox, Brenner 1967), the
        # upper one, at 2.5 radii, forwards, the lower one, at 5.5, backwards: +2.6 % of the flow.
        # (The flow's curvature, a^2 / 6 times its Laplacian after Faxen, is zero.)
        near, far = HEIGHT / 2 - above, HEIGHT / 2 + above
        walls = 5 / 16 * RADIUS**3 * SHEAR * (near**-2 - far**-2)
        self.assertAlmostEqual(sphere.speed / (flow + walls), 1, delta=0.02)
        # 3/16 (a / h)^3 each, and inertia: 0.98.
        self.assertAlmostEqual(sphere.spin / (SHEAR / 2), 0.98, delta=0.03)
        # Inertia moves it towards the middle (Ho, Leal 1974) by a lift below rho G^2 a^4, which
        # is Re G a / (6 pi) in speed: 18 um in 12 s.
        reynolds = SHEAR * RADIUS**2 / 1e-6
        self.assertLess(sphere.drift, 0)
        self.assertGreater(sphere.drift,
                           -reynolds * SHEAR * RADIUS / (6 * math.pi) * 12)


if __name__ == "__main__":
    unittest.main(verbosity=2)
