# SPDX-License-Identifier: GPL-2.0-or-later
"""A plate of finite thickness, swung broadside and edgewise at 25 Hz, against the exact force."""

import math
import unittest
from pathlib import Path

from magfsi import testing

import swung
import unsteady_stokes

SCENE = Path(__file__).resolve().parent / "plate.yaml"
WIDTH, THICKNESS, BOX = 1.5e-3, 0.185e-3, 9.6e-3
EDGEWISE = ("[{face: z_min, oscillation: &m {amplitude: [20 um, 0 m, 0 m], frequency: 25 Hz, "
            "phase: -90 deg}}, {face: z_max, oscillation: *m}]")
UNIT = math.pi / 4 * WIDTH**2


def exact(broadside, box=BOX):
    return unsteady_stokes.force_coefficient(WIDTH, THICKNESS, box, swung.OMEGA, 1e-6,
                                             broadside) / UNIT


def measured(settings, broadside=True, box=BOX):
    if not broadside:
        settings = {"bodies.plate.prescribed_motion": EDGEWISE, **settings}
    moved, boundary = swung.run(SCENE, "plate", "z" if broadside else "x", settings)
    moved /= UNIT
    right = exact(broadside, box)
    shown = {key: value for key, value in settings.items() if value is not EDGEWISE}
    testing.report(f"{'broadside' if broadside else 'edgewise'} {shown}: added mass "
                   f"{moved.real:.4f}, exact {right.real:.4f}; drag {-moved.imag:.4f}, exact "
                   f"{-right.imag:.4f}; no-slip error {boundary['no_slip_error']:.4f}, leakage "
                   f"{boundary['leakage']:.4f}")
    return moved, boundary


def in_layers(spacing_mm, broadside):
    """Error of added mass and drag of the plate on a finer grid, at the same relaxation time."""
    box_mm, depth = round(6.4 / spacing_mm) * spacing_mm, 4 * spacing_mm
    steps = round(1000 * (0.0923 / spacing_mm)**2 / 20) * 20  # of a period
    swung.LENGTH = 1e-3 * depth
    moved, _ = measured({
        "fluid.spacing": f"{spacing_mm} mm", "fluid.box": f"[{box_mm} mm, {depth} mm, {box_mm} mm]",
        "bodies.plate.mesh.box.size": f"[1.5 mm, {depth} mm, 0.185 mm]",
        "bodies.plate.initial.position": f"[{box_mm / 2 + 0.03} mm, {depth / 2} mm, "
                                         f"{box_mm / 2 + 0.02} mm]",
        "coupling.immersed_boundary.kernel": "3-point", "time.step": f"{40e3 / steps} us",
        "probes.every": f"{40e3 / steps * 20} us"}, broadside, 1e-3 * box_mm)
    swung.LENGTH = 0.4e-3
    right = exact(broadside, 1e-3 * box_mm)
    return moved.real / right.real - 1, moved.imag / right.imag - 1


class SwungPlate(unittest.TestCase):
    def test_does_not_depend_on_the_step(self):
        masses = []
        for step in ("80 us", "40 us", "10 us"):
            moved, boundary = measured({"time.step": step})
            masses.append(moved.real)
            self.assertLess(boundary["no_slip_error"], 0.01)
            self.assertLess(boundary["leakage"], 0.01)
        # The step of 80 us is a fifth of the time in which sound crosses the box.
        self.assertLess(max(masses) / min(masses), 1.015)
        self.assertLess(max(masses[1:]) / min(masses[1:]), 1.005)

    def test_moves_as_much_fluid_broadside_as_the_exact_one(self):
        right = exact(True).real
        for spacing in ("0.2 mm", "0.1333333333 mm", "0.1 mm"):
            moved, _ = measured({"fluid.spacing": spacing,
                                 "coupling.immersed_boundary.kernel": "3-point"})
            # The rim of one layer is known to 0.1 spacings; of 7.5 that is 5 %.
            self.assertAlmostEqual(moved.real / right, 1, delta=0.05)

    def test_edgewise_without_the_layer_that_markers_carry(self):
        right = exact(False).real
        error = {}
        for spacing in ("0.2 mm", "0.1 mm"):
            moved, _ = measured({"fluid.spacing": spacing,
                                 "coupling.immersed_boundary.kernel": "3-point"}, broadside=False)
            error[spacing] = moved.real / right - 1
        # At 0.2 mm the layer is twice as thick as the plate. With its inertia the error would be
        # +150 %. What is left of it is what its ends push, and what it carries more of in a
        # Stokes layer of half a spacing.
        self.assertLess(abs(error["0.1 mm"]), 0.08)
        self.assertLess(abs(error["0.2 mm"]), 1.1)

    def test_several_layers_are_as_thick_and_as_wide_as_the_plate(self):
        # 3.5 spacings thick, three layers. The rim is known to 0.1 spacings of 14, 1.4 % of the
        # mass broadside. Edgewise the mass is an eighth of that, and 0.1 spacings of thickness
        # are 3 % of it, the rim another 3 %.
        for broadside in (True, False):
            mass, drag = in_layers(0.0527, broadside)
            self.assertLess(abs(mass), 0.02 if broadside else 0.06)
            self.assertLess(abs(drag), 0.05)


if __name__ == "__main__":
    unittest.main()
