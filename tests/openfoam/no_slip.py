# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies without slip in OpenFOAM, where each step is repeated until the fluid moves with the body:
a plate that swings broadside against the exact force, a wall across a duct, and a strip in a field
that runs, stops and goes on."""

import math
import sys
import unittest
from pathlib import Path

from magfsi import testing

FOLDER = testing.ROOT / "tests/validation/no_slip"
sys.path.insert(0, str(FOLDER))
import plate  # noqa: E402

OPENFOAM = {"fluid.solver": "openfoam", "coupling.immersed_boundary.kernel": "3-point"}
STRIP = testing.ROOT / "tests/scenes/small_swimmer.yaml"
STRIP_SETTINGS = {**OPENFOAM, "coupling.immersed_boundary.forcing": "no_slip", "fluid.courant": 0.1}


class NoSlip(unittest.TestCase):
    def test_a_plate_that_swings_broadside_moves_as_much_fluid_as_the_exact_one(self):
        moved, boundary = plate.measured({**OPENFOAM, "fluid.spacing": "0.2 mm"})
        # The rim is known to 0.1 spacings; of 7.5 that is 5 % of the mass.
        self.assertAlmostEqual(moved.real / plate.exact(True).real, 1, delta=0.05)
        self.assertLess(boundary["no_slip_error"], 0.01)

    def test_a_wall_across_a_duct_leaks_little(self):
        run = testing.good_run(FOLDER / "duct.yaml", {
            **OPENFOAM, "fluid.spacing": "0.2 mm", "time.end": "0.1 s", "time.step": "50 us"})
        flow = run.probes()["far.flow[m3/s]"][-1]
        part = abs(flow) / 1.6e-3**2 / math.sqrt(8 / 1000)
        testing.report(f"leaks {100 * part:.2f} % of sqrt(pressure / density)")
        # Velocities in cells and fluxes on faces differ where pressure jumps from cell to cell.
        self.assertLess(part, 0.025)

    def test_the_iterations_find_the_force_of_a_strip(self):
        run = testing.good_run(STRIP, {**STRIP_SETTINGS, "checkpoint.every": "2 ms"}, "fluid=1")
        summary = run.summary()
        iterations = summary["iterations"]
        testing.report(f"{iterations['mean']:.2f} iterations a step, "
                       f"{summary['immersed_boundary']['no_slip_error']:.4f}")
        self.assertEqual(iterations["unconverged_steps"], 0)
        # A step is repeated up to 1 % of the largest of its velocities; the penalty slips by 15 %.
        self.assertLess(summary["immersed_boundary"]["no_slip_error"], 0.05)
        # A run that goes on from half of it gives the same bytes.
        half = testing.good_run(STRIP, {**STRIP_SETTINGS, "checkpoint.every": "2 ms",
                                        "time.end": "2 ms"}, "fluid=1")
        testing.good_run(STRIP, {**STRIP_SETTINGS, "checkpoint.every": "2 ms"}, "fluid=1",
                         folder=half.folder, restart="latest")
        self.assertEqual((half.folder / "probes.csv").read_bytes(),
                         (run.folder / "probes.csv").read_bytes())

    def test_with_a_single_correction_of_the_pressure_whole_steps_are_repeated(self):
        folder = Path(testing.new_folder())
        (folder / "strip.yaml").write_text(STRIP.read_text())
        (folder / "single").write_text("PIMPLE { nCorrectors 1; }\n")
        run = testing.good_run(folder / "strip.yaml", {
            **STRIP_SETTINGS, "fluid.openfoam.solution": "single", "time.end": "1 ms"})
        self.assertEqual(run.summary()["iterations"]["unconverged_steps"], 0)
        self.assertLess(run.summary()["immersed_boundary"]["no_slip_error"], 0.05)


if __name__ == "__main__":
    unittest.main()
