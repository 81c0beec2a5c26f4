# SPDX-License-Identifier: GPL-2.0-or-later
"""Stokes' second problem, a sheet that swings along its plane, against the theory of the lattice
and against the exact force 2 rho sqrt(i w nu) of a sheet whose fluid layers the grid resolves."""

import cmath
import math
import unittest
from pathlib import Path

from magfsi import testing

import lattice_response
import swung

SCENE = Path(__file__).resolve().parent / "sheet.yaml"
LENGTH, BOX, CENTRE = 1.2e-3, 4.8e-3, 2.433e-3
THICKNESS = 0.185e-3  # of the scene
KERNEL = {"2-point": lattice_response.two_point, "3-point": lattice_response.three_point}


def measured(settings):
    """The thickness of the fluid outside of the sheet that moves with it [m]."""
    moved, _ = swung.run(SCENE, "sheet", "x", settings)
    return moved / LENGTH


def carried(kernel, magic):
    """The layer of fluid that one layer of markers is known to carry, in spacings: the theory at a
    Stokes layer of 4 spacings, as in adapters/bodies/kernel_reach.cpp."""
    tau = 0.8
    frequency = 2 * (tau - 0.5) / 3 / 16
    outside = 2 * cmath.sqrt((tau - 0.5) / 3 / (1j * frequency))
    return sum((lattice_response.moved_fluid(KERNEL[kernel], [32 + place / 10], 64, tau, magic,
                                             frequency) - outside).real
               for place in range(10)) / 10


def exact(viscosity_m2_s, thickness_m=THICKNESS):
    rate = cmath.sqrt(1j * swung.OMEGA / viscosity_m2_s)
    return 2 / rate * cmath.tanh(rate * (BOX - thickness_m) / 2)


class SwungSheet(unittest.TestCase):
    def test_one_layer_moves_what_the_lattice_moves(self):
        # The fluid that is moved, less the layer that the coupling takes away again.
        for kernel, spacing_mm, step_us in (("3-point", 0.2, 40), ("3-point", 0.1, 40),
                                            ("3-point", 0.1, 10), ("2-point", 0.2, 40)):
            moved = measured({"coupling.immersed_boundary.kernel": kernel,
                              "fluid.spacing": f"{spacing_mm} mm", "time.step": f"{step_us} us",
                              "probes.every": "80 us"})
            h = 1e-3 * spacing_mm
            magic = min(0.75 / (500 * spacing_mm), 45 / (500 * spacing_mm)**2)
            tau = 0.5 + 3e-6 * 1e-6 * step_us / h**2
            theory = lattice_response.moved_fluid(
                KERNEL[kernel], [CENTRE / h - 0.5], round(BOX / h), tau, magic,
                swung.OMEGA * 1e-6 * step_us)
            found = moved / h + carried(kernel, magic)
            testing.report(f"{kernel}, {spacing_mm} mm, {step_us} us: moved {found:.4f}, theory "
                           f"{theory:.4f} spacings; exact {exact(1e-6) / h + carried(kernel, magic):.4f}")
            # Rows of markers 1 to 1.2 spacings apart are no plane.
            self.assertLess(abs(found - theory), 0.06)

    def test_resolved_layers_give_the_drag_of_a_wall(self):
        # A Stokes layer of 4 and 8 spacings; sheets as thick as the fluid that one layer of
        # markers carries in such flows (with the magic number 3/16), and much thinner, of which
        # the difference is taken away.
        for viscosity, thickness in ((12.6, 0.134e-3), (50.3, 0.134e-3), (12.6, 0.03e-3),
                                     (50.3, 0.03e-3)):
            layer = math.sqrt(2 * viscosity * 1e-6 / swung.OMEGA)
            moved = measured({
                "fluid.viscosity": f"{viscosity} mm2/s",
                "bodies.sheet.mesh.box.size": f"[1.2 mm, 0.4 mm, {1e3 * thickness} mm]"})
            right = exact(viscosity * 1e-6, thickness)
            testing.report(f"{1e3 * thickness} mm thick, Stokes layer of {layer / 1e-4:.1f} "
                           f"spacings: {moved / 1e-4:.4f}, exact "
                           f"{right / 1e-4:.4f} spacings: amplitude "
                           f"{100 * (abs(moved / right) - 1):+.2f} %, phase "
                           f"{math.degrees(cmath.phase(moved / right)):+.2f} degrees")
            self.assertAlmostEqual(abs(moved / right), 1, delta=0.01)
            self.assertLess(abs(math.degrees(cmath.phase(moved / right))), 1)


if __name__ == "__main__":
    unittest.main()
