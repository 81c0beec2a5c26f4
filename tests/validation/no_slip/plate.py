"""The added mass of a plate of finite thickness, swung broadside at 25 Hz: it must depend neither
on the time step nor, beyond the error of the grid, on spacing and kernel."""

import cmath
import math
import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "plate.yaml"
WIDTH, LENGTH = 1.5e-3, 0.4e-3
AMPLITUDE, FREQUENCY, DENSITY = 20e-6, 25, 1000
OMEGA = 2 * math.pi * FREQUENCY
PERIOD = 1 / FREQUENCY


def coefficient(settings):
    """Added mass and drag over omega, of rho pi (W/2)^2 length, from the second period."""
    run = testing.good_run(SCENE, settings, limit_s=900)
    probes = run.probes()
    time, force = probes["t[s]"], probes["plate.fluid_force_z[N]"]
    rows = round(PERIOD / (time[1] - time[0]))
    # Displacement -A cos(w t): velocity A w sin(w t), acceleration A w^2 cos(w t).
    found = sum(2 / rows * f * cmath.exp(1j * OMEGA * t)
                for t, f in zip(time[-rows:], force[-rows:], strict=True))
    scale = DENSITY * math.pi * (WIDTH / 2)**2 * LENGTH * AMPLITUDE * OMEGA**2
    boundary = run.summary()["immersed_boundary"]
    testing.report(f"{settings}: added mass {-found.real / scale:.4f}, drag "
                   f"{-found.imag / scale:.4f}, no-slip error {boundary['no_slip_error']:.4f}, "
                   f"leakage {boundary['leakage']:.4f}")
    return -found.real / scale, boundary


class SwungPlate(unittest.TestCase):
    def test_does_not_depend_on_the_step(self):
        masses = []
        for step in ("80 us", "40 us", "10 us"):
            mass, boundary = coefficient({"time.step": step})
            masses.append(mass)
            self.assertLess(boundary["no_slip_error"], 0.01)
            self.assertLess(boundary["leakage"], 0.01)
        # The step of 80 us is a fifth of the time in which sound crosses the box.
        self.assertLess(max(masses) / min(masses), 1.015)
        self.assertLess(max(masses[1:]) / min(masses[1:]), 1.005)

    def test_does_not_depend_on_spacing_and_kernel(self):
        # Fine grids of a plane prototype with other boundaries (interpolated bounce-back on
        # cut links) and collisions give 1.45 +- 0.04; the inviscid value is 1.161.
        for spacing in ("0.2 mm", "0.1333333333 mm", "0.1 mm"):
            for kernel in ("2-point", "3-point"):
                mass, _ = coefficient({"fluid.spacing": spacing,
                                       "coupling.immersed_boundary.kernel": kernel})
                self.assertAlmostEqual(mass, 1.45, delta=0.04)


if __name__ == "__main__":
    unittest.main()
