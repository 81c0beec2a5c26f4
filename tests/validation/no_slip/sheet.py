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
    Stokes layer of 4 spacings, as in adapters/solvers/bodies/kernel_reach.cpp."""
    tau = 0.8
    frequency = 2 * (tau - 0.5) / 3 / 16
    outside = 2 * cmath.sqrt((tau - 0.5) / 3 / (1j * frequency))
    return sum((lattice_response.moved_fluid(KERNEL[kernel], [32 + place / 10], 64, tau, magic,
                                             frequency) - outside).real
               for place in range(10)) / 10


def exact(viscosity_m2_s, thickness_m=THICKNESS):
    rate = cmath.sqrt(1j * swung.OMEGA / viscosity_m2_s)
    return 2 / rate * cmath.tanh(rate * (BOX - thickness_m) / 2)


def error_of_force(layer, thickness, tau, lattice_speed):
    """Force over the exact one: Stokes layer and thickness in spacings, whole steps in a period."""
    h = 0.1e-3
    viscosity = (layer * h)**2 * swung.OMEGA / 2
    rows = 100
    per_row = max(1, round(3 * viscosity / ((tau - 0.5) * h**2 * swung.FREQUENCY * rows)))
    step = 1 / (swung.FREQUENCY * rows * per_row)
    speed = lattice_speed * h / step
    motion = (f"oscillation: {{amplitude: [{speed / swung.OMEGA} m, 0 m, 0 m], "
              f"frequency: {swung.FREQUENCY} Hz, phase: -90 deg}}")
    moved = measured({
        "fluid.viscosity": f"{1e6 * viscosity} mm2/s", "time.step": f"{step} s",
        "probes.every": f"{per_row * step} s",
        # The scene's, or what its step allows. The magic number that follows from it is 3/16,
        # 0.05 at the relaxation time 0.51.
        "fluid.expected_speed": f"{max(min(0.5, 0.2 * h / step), speed)} m/s",
        "bodies.sheet.prescribed_motion": f"[{{face: z_min, {motion}}}, {{face: z_max, {motion}}}]",
        "bodies.sheet.mesh.box.size": f"[1.2 mm, 0.4 mm, {1e3 * thickness * h} mm]"})
    error = moved * swung.AMPLITUDE * swung.OMEGA / speed / exact(viscosity, thickness * h)
    testing.report(f"{thickness} spacings thick, Stokes layer {layer}, relaxation time "
                   f"{0.5 + 3 * viscosity * step / h**2:.3f}, lattice speed {lattice_speed}: "
                   f"amplitude {100 * (abs(error) - 1):+.2f} %, phase "
                   f"{math.degrees(cmath.phase(error)):+.2f} degrees")
    return error


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
        # Sheets as thick as the fluid that one layer of markers carries in such flows (with the
        # magic number 3/16), and much thinner, of which the difference is taken away; at any
        # relaxation time, lattice speed and stroke (0.2 to 120 spacings).
        for layer, thickness, tau, speed in (
                (4, 1.34, 0.65, 0.00125), (8, 1.34, 1, 0.00125), (4, 0.3, 0.65, 0.00125),
                (8, 0.3, 1, 0.00125), (4, 1.34, 1, 0.01), (4, 1.34, 1, 0.1), (4, 1.34, 0.51, 0.05),
                (8, 1.34, 0.55, 0.01), (8, 1.34, 0.8, 0.1), (16, 1.34, 1, 0.05)):
            error = error_of_force(layer, thickness, tau, speed)
            self.assertAlmostEqual(abs(error), 1, delta=0.01)
            self.assertLess(abs(math.degrees(cmath.phase(error))), 1)


if __name__ == "__main__":
    unittest.main()
