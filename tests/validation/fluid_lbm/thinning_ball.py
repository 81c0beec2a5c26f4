# SPDX-License-Identifier: GPL-2.0-or-later
"""Drag of a ball that creeps through a fluid that thins, by a power law and by Carreau's: against Galerkin's method
(thinning_ball_theory.py), and that against published values.

A quarter of a ball at rest, in the middle of a duct whose walls move with the stream."""
import math
import sys
import unittest
from pathlib import Path

from magfsi import testing

import thinning_ball_theory as theory

DIAMETER, SPEED, REYNOLDS, TAU = 1e-3, 1e-3, 0.1, 0.6  # the last two at the rate SPEED / DIAMETER
VISCOSITY = SPEED * DIAMETER / REYNOLDS
# Gu (Dazhi) and Tanner, J. Non-Newtonian Fluid Mech. 17 (1985) 1, finite elements.
PUBLISHED = {0.9: 1.14, 0.8: 1.24, 0.7: 1.32, 0.6: 1.382, 0.5: 1.42, 0.4: 1.442, 0.3: 1.458}


def renaud(n):
    """Renaud, Mauret, Chhabra, Can. J. Chem. Eng. 82 (2004) 1066."""
    return 6**((n - 1) / 2) * (3 / (n * n + n + 1))**(n + 1)


def chhabra_uhlherr(n, number):
    """Fitted to measurements in polymer solutions, Rheol. Acta 19 (1980) 187."""
    return 1 + 0.65 * (n - 1) * number**0.2


def power_law(n):
    """Limits that the rate does not reach: 20 times the mean one, and a thousandth of it."""
    return (f"power_law: {{exponent: {n}, rate: {SPEED / DIAMETER} 1/s, least: {20**(n - 1) * VISCOSITY} m2/s, "
            f"most: {1e-3**(n - 1) * VISCOSITY} m2/s}}")


def carreau(n, number):
    """So that the viscosity at the rate SPEED / DIAMETER is about VISCOSITY, which sets the step."""
    return (f"carreau: {{exponent: {n}, time: {number * DIAMETER / 2 / SPEED} s, infinite_viscosity: "
            f"{1e-3 * VISCOSITY} m2/s}}")


def drag(rheology, cells, width, at_rest=VISCOSITY):
    """Over 3 pi mu d U, mu = density VISCOSITY. cells: a diameter; width: of the duct, in diameters."""
    spacing = DIAMETER / cells
    step = (TAU - 0.5) / 3 * spacing**2 / VISCOSITY
    # Where it shears less the fluid is thicker: in a wider duct it takes but little longer.
    steps = math.ceil(1.25 * (width / 5)**1.5 * cells**2 / ((TAU - 0.5) / 3))
    length, half = width * DIAMETER, width * DIAMETER / 2
    stream = f"[{SPEED} m/s, 0 m/s, 0 m/s]"
    scene = Path(testing.new_folder()) / "ball.yaml"
    scene.write_text(f"""
name: ball
time: {{end: {steps * step:.12g} s, step: {step:.12g} s}}
fluid:
  box: [{length:.12g} m, {half:.12g} m, {half:.12g} m]
  spacing: {spacing:.12g} m
  density: 1000 kg/m3
  viscosity: {at_rest:.12g} m2/s
  collision: trt
  magic_number: 0.1875
  initial_velocity: {stream}
  boundaries:
    x_min: {{velocity_inlet: {{velocity: {stream}}}}}
    x_max: {{pressure_outlet: {{}}}}
    y_min: free_slip
    z_min: free_slip
    y_max: {{no_slip: {{velocity: {stream}}}}}
    z_max: {{no_slip: {{velocity: {stream}}}}}
  rheology: {{{rheology}}}
  obstacles: {{ball: {{sphere: {{centre: [{half:.12g} m, 0 m, 0 m], diameter: {DIAMETER} m}}}}}}
probes: {{every: {steps // 20 * step:.12g} s, fluid: [obstacle_force]}}
""")
    force = testing.good_run(scene, ranks="fluid=1", limit_s=1500).probes()["ball.force_x[N]"]
    # In the last fifth it changes by a small part of what the test allows.
    assert abs(force[-1] / force[-5] - 1) < 2e-3, force
    return 4 * force[-1] / (3 * math.pi * 1000 * VISCOSITY * DIAMETER * SPEED)


class BallInThinningFluid(unittest.TestCase):
    def compare(self, label, rheology, in_shell, cells, widths, allowed, at_rest=VISCOSITY):
        """in_shell: theory's drag in a hollow ball of so many diameters. The spacing's error is that of second order
        of the last two spacings; what walls add falls with the width as in theory in a hollow ball."""
        narrow, wide = widths
        drags = [drag(rheology, n, narrow, at_rest) for n in cells]
        in_wide = drag(rheology, cells[0], wide, at_rest)
        free, near, far = (in_shell(w) for w in (300, narrow, wide))
        fine = (drags[-1] - drags[-2]) / ((cells[-1] / cells[-2])**2 - 1)
        walls = (in_wide - drags[0]) * (free - near) / (far - near)
        found = drags[-1] + fine + walls
        testing.report(f"{label}: " + ", ".join(f"{n} cells {d:.4f}" for n, d in zip(cells, drags, strict=True))
                       + f"; duct of {wide} in place of {narrow} diameters {in_wide:.4f}; limit {found:.4f}, theory "
                       f"{free:.4f}, {100 * (found / free - 1):+.2f} %")
        self.assertLess(abs(found / free - 1), allowed)
        return drags, fine, free

    def test_power_law(self):
        # 8 and 12 cells differ by 2 %, walls and a hollow ball of 5 diameters add 9 %: half of the one, a tenth of
        # the other.
        self.compare("power law 0.5", power_law(0.5), lambda w: theory.power_law(0.5, w), (8, 12), (5, 8), 0.02)

    def test_theory_and_published_values(self):
        ratio = 0.1  # a ball in a hollow ball in Stokes flow: Happel and Brenner 1983
        exact = (1 - ratio**5) / (1 - 9 / 4 * ratio + 5 / 2 * ratio**3 - 9 / 4 * ratio**5 + ratio**6)
        self.assertLess(abs(theory.power_law(1, 1 / ratio) / exact - 1), 1e-12)
        for n, published in PUBLISHED.items():
            found = theory.power_law(n)
            testing.report(f"power law {n}: theory {found:.4f}; Gu and Tanner {published}, "
                           f"{100 * (published / found - 1):+.1f} %; Renaud et al. {renaud(n):.3f}, "
                           f"{100 * (renaud(n) / found - 1):+.1f} %")
            # The published values differ from each other by as much.
            self.assertLess(abs(published / found - 1), 0.05)
            self.assertLess(abs(renaud(n) / found - 1), 0.05)


class Long(BallInThinningFluid):
    test_theory_and_published_values = None

    def test_power_law(self):
        for n in (0.5, 0.7, 0.8):
            drags, _, _ = self.compare(f"power law {n}", power_law(n), lambda w, n=n: theory.power_law(n, w),
                                       (8, 12, 16), (5, 10), 0.02)
            self.assertLess(abs(drags[2] - drags[1]), abs(drags[1] - drags[0]))

    def test_carreau(self):
        n, number = 0.5, 10
        # VISCOSITY is that at the rate SPEED / DIAMETER.
        at_rest = VISCOSITY * (1 + (number / 2)**2)**((1 - n) / 2)
        scale = at_rest / VISCOSITY
        _, _, free = self.compare(f"Carreau {n}, {number}", carreau(n, number),
                                  lambda w: scale * theory.carreau(n, number, w), (8, 12), (5, 10), 0.02, at_rest)
        measured = chhabra_uhlherr(n, number)
        testing.report(f"measured (Chhabra and Uhlherr) {measured:.3f}, theory {free / scale:.3f}")
        # The fit is a power of Lambda over four decades: right to 15 %, not more.
        self.assertLess(abs(measured * scale / free - 1), 0.15)


if __name__ == "__main__":
    names = ["Long" if word == "--long" else word for word in sys.argv[1:]] or ["BallInThinningFluid"]
    unittest.main(argv=[sys.argv[0], *names], verbosity=2)
