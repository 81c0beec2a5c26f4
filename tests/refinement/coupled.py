# SPDX-License-Identifier: GPL-2.0-or-later
"""A robot in a patch of finer cells that follows it does as in cells as fine everywhere."""

import re
import unittest

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import testing

# One face is dragged through the box, and the patch must follow.
DRAGGED = {"time.end": "3 ms", "fluid.box": "[14 mm, 4 mm, 8 mm]",
           "bodies.robot.prescribed_motion":
               "[{face: x_min, oscillation: {amplitude: [1.4 mm, 0 m, 0.5 mm], "
               "frequency: 100 Hz, phase: -90 deg}}]"}
FINE = {"fluid.spacing": "0.125 mm"}
REFINED = {"fluid.refinement": "{levels: 1, margin: 0.75 mm}"}  # over cells of 0.25 mm


def extent(file):
    """Of a .pvti, in cells."""
    words = re.search(r'WholeExtent="([^"]*)"', file.read_text()).group(1).split()
    return [int(w) for w in words]


class Coupled(unittest.TestCase):
    def compare(self, settings, ranks):
        fine = testing.good_run(testing.SMALL, {**DRAGGED, **FINE, **settings}, ranks)
        refined = testing.good_run(
            testing.SMALL, {**DRAGGED, **REFINED, **settings, "output.fluid.every": "1 ms"}, ranks)
        first = extent(refined.folder / "fields/fluid_000000_level1.pvti")
        last = extent(refined.folder / "fields/fluid_000003_level1.pvti")
        self.assertNotEqual(first, last, "the patch has not moved")
        a, b = fine.probes(), refined.probes()
        # The robot's way, its bend, and what the water has of them: the bounds are three times
        # what was measured (0.009, 0.008, 0.04 %; with the penalty 0.02, 0.02, 0.7 %).
        for name, bound in (("robot.com_x[m]", 3e-4), ("robot.mid_rise[m]", 3e-4),
                            ("kinetic_energy[J]", 1.2e-3)):
            fine_values, values = np.array(a[name]), np.array(b[name])
            worst = np.max(np.abs(values - fine_values)) / np.ptp(fine_values)
            testing.report(f"{name}: {100 * worst:.3f} % of its change")
            self.assertLess(worst, bound, name)
        np.testing.assert_allclose(b["mass[kg]"], b["mass[kg]"][0], rtol=1e-13)
        return refined

    def test_serial(self):
        refined = self.compare({}, "structure=1,fluid=1")
        self.see_one_picture(refined, ("fluid_000003.pvti", "fluid_000003_level1.pvti"),
                             14e-3 * 4e-3 * 8e-3)

    def test_implicit_on_several_ranks(self):
        self.compare({"coupling.scheme": "implicit"}, "structure=2,fluid=2")

    def momentum_lost(self, settings):
        """Along x and z, where the robot pushes: the largest part of the impulse given that the
        fluid of a periodic box does not have."""
        sides = ", ".join(f"{axis}_{end}: periodic" for axis in "xyz" for end in ("min", "max"))
        run = testing.good_run(testing.SMALL, {
            **DRAGGED, **settings, "fluid.boundaries": f"{{{sides}}}",
            "probes.fluid": "[momentum]"}, "structure=1,fluid=1")
        probes = run.probes()
        lost = []
        for axis in "xz":
            momentum = np.array(probes[f"momentum_{axis}[kg m/s]"])
            given = np.cumsum(probes[f"interface.impulse_{axis}[N s]"])
            error = (momentum - momentum[0]) - (given - given[0])
            lost.append(np.max(np.abs(error)) / np.ptp(given))
        testing.report(f"momentum lost along x and z: {lost[0]:.1e}, {lost[1]:.1e} of that given")
        return lost

    def test_momentum_across_levels(self):
        # A uniform grid keeps what it is given to rounding. A refined one keeps mass, not momentum:
        # the interpolation between levels is of second order. The bounds are three times what was
        # measured (0.065 and 0.6 %).
        self.assertLess(max(self.momentum_lost(FINE)), 1e-12)
        along_x, along_z = self.momentum_lost(REFINED)
        self.assertLess(along_x, 0.002)
        self.assertLess(along_z, 0.018)

    def see_one_picture(self, run, files, box_m3):
        """The visible cells of all patches fill the box once."""
        volume = 0
        for name in files:
            reader = vtk.vtkXMLPImageDataReader()
            reader.SetFileName(str(run.folder / "fields" / name))
            reader.Update()
            image = reader.GetOutput()
            cells = image.GetNumberOfCells()
            hidden = image.GetCellData().GetArray("vtkGhostType")
            if hidden:
                cells -= np.count_nonzero(vtk_to_numpy(hidden))
            volume += cells * np.prod(image.GetSpacing())
        self.assertAlmostEqual(volume / box_m3, 1, places=9)

    # A nest of patches for each; they share one from 4 ms on.
    def test_two_bodies_that_come_near_each_other(self):
        settings = {**testing.SECOND, "time.end": "6 ms"}
        ranks = "structure=1,fluid=2"
        fine = testing.good_run(testing.SMALL, {**settings, **FINE}, ranks)
        refined = testing.good_run(
            testing.SMALL, {**settings, "fluid.refinement": "{levels: 1}",
                            "output.fluid.every": "3 ms"}, ranks)
        fields = refined.folder / "fields"
        self.assertEqual(
            [(fields / f"fluid_{i:06d}_level1_nest2.pvti").exists() for i in range(3)],
            [True, True, False])
        a, b = fine.probes(), refined.probes()
        # Three times what was measured (0.01, 0.08, 0.09 and 0.1 %).
        for name, bound in (("robot.mid_rise[m]", 3e-4), ("robot.com_z[m]", 2.5e-3),
                            ("second.mid_rise[m]", 2.5e-3), ("kinetic_energy[J]", 3e-3)):
            fine_values, values = np.array(a[name]), np.array(b[name])
            worst = np.max(np.abs(values - fine_values)) / np.ptp(fine_values)
            testing.report(f"{name}: {100 * worst:.3f} % of its change")
            self.assertLess(worst, bound, name)
        np.testing.assert_allclose(b["mass[kg]"], b["mass[kg]"][0], rtol=1e-13)
        for number, names in (("000000", ("", "_level1", "_level1_nest2")),
                              ("000002", ("", "_level1"))):
            self.see_one_picture(refined, [f"fluid_{number}{name}.pvti" for name in names],
                                 20e-3 * 4e-3 * 8e-3)

    # Two and three levels, all around a robot that starts elsewhere than the scene says.
    def test_more_levels_without_slip(self):
        for levels in (2, 3):
            run = testing.good_run(testing.SMALL, {
                "time.end": "0.2 ms", "probes.every": "0.1 ms", "fluid.spacing": "0.5 mm",
                "fluid.box": "[16 mm, 8 mm, 16 mm]",
                "coupling.immersed_boundary.forcing": "no_slip",
                "fluid.refinement.levels": levels})
            self.assertEqual(run.summary()["outcome"], "completed")


if __name__ == "__main__":
    unittest.main()
