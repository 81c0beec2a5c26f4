# SPDX-License-Identifier: GPL-2.0-or-later
"""Files for ParaView: arrays with units, names of bodies, and values that agree with what else the
run tells: with its probes, with equilibrium, with the closed form of a rotation."""
import unittest

import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import plotting, runs, testing

BEAM = testing.ROOT / "tutorials/beam"
ALL = ("[displacement, velocity, magnetization, stretches, magnetic_force, elastic_force, stress, "
       "volume_ratio, energy_density]")


def arrays(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
            for i in range(data.GetNumberOfArrays())}


def last_frame(run, collection="structure.pvd"):
    return plotting.read_grid(runs.frames(run.folder, collection)[-1][1])


class Bodies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = testing.good_run(BEAM, {"probes.every": "100 ms", "output.structure.every": "1 s",
                                           "output.structure.fields": ALL})
        grid = last_frame(cls.run_)
        cls.grid = grid
        cls.nodes, cls.elements = arrays(grid.GetPointData()), arrays(grid.GetCellData())
        cls.rest = vtk_to_numpy(grid.GetPoints().GetData()) - cls.nodes["displacement[m]"]

    def test_names_with_units_and_bodies(self):
        self.assertEqual(set(self.nodes), {"displacement[m]", "velocity[m/s]", "magnetic_force[N]",
                                           "elastic_force[N]"})
        self.assertEqual(set(self.elements),
                         {"magnetization[A/m]", "magnetization_at_rest[A/m]", "stretches[1]",
                          "stress[Pa]", "volume_ratio[1]", "energy_density[J/m3]", "body"})
        names = self.grid.GetFieldData().GetAbstractArray("body_names")
        self.assertEqual([names.GetValue(i) for i in range(names.GetNumberOfValues())], ["beam"])

    def test_forces_of_an_equilibrium_balance(self):
        free = self.rest[:, 0] > 1e-6  # not clamped
        magnetic, elastic = self.nodes["magnetic_force[N]"], self.nodes["elastic_force[N]"]
        largest = np.abs(magnetic).max()
        self.assertGreater(largest, 0)
        # What Newton's method leaves: tolerance 1e-6 of the largest load by default.
        self.assertLess(np.abs((magnetic + elastic)[free]).max(), 1e-5 * largest)
        self.assertLess(np.abs(magnetic.sum(axis=0)).max(), 1e-12 * np.abs(magnetic).sum())

    def test_energy_densities_sum_to_the_energy_of_the_probes(self):
        volume = 17.5e-3 * 5e-3 * 1e-3 / len(self.elements["body"])
        found = volume * self.elements["energy_density[J/m3]"].sum()
        self.assertAlmostEqual(found / self.run_.probes()["beam.energy_elastic[J]"][-1], 1, 9)

    def test_magnetization_turns_with_the_body(self):
        before, now = (self.elements[f"magnetization{kind}[A/m]"] for kind in ("_at_rest", ""))
        np.testing.assert_allclose(before, [[1e5, 0, 0]] * len(before))
        # At the tip the beam has turned far, and its length has hardly changed.
        tip = self.rest[:, 0] > 17.4e-3
        root = np.argsort(self.rest[:, 0])[:12]
        self.assertGreater(np.abs(self.nodes["displacement[m]"][tip]).max(), 3e-3)
        self.assertLess(np.abs(self.nodes["displacement[m]"][root]).max(), 1e-9)
        lengths = np.linalg.norm(now, axis=1) / 1e5
        self.assertLess(np.abs(lengths - 1).max(), 0.05)
        centres = self.rest[vtk_to_numpy(self.grid.GetCells().GetConnectivityArray()).reshape(-1, 8)]
        last = centres.mean(axis=1)[:, 0].argmax()
        nodes = vtk_to_numpy(self.grid.GetCells().GetConnectivityArray()).reshape(-1, 8)[last]
        points = vtk_to_numpy(self.grid.GetPoints().GetData())[nodes]
        ahead = self.rest[nodes][:, 0] > self.rest[nodes][:, 0].mean()
        along = points[ahead].mean(axis=0) - points[~ahead].mean(axis=0)
        np.testing.assert_allclose(now[last] / np.linalg.norm(now[last]),
                                   along / np.linalg.norm(along), atol=1e-9)
        self.assertGreater(now[last][2], 5e4)  # it points up, along the field

    def test_stretches_volume_and_stress_belong_together(self):
        stretches, ratio = self.elements["stretches[1]"], self.elements["volume_ratio[1]"]
        np.testing.assert_allclose(stretches.prod(axis=1), ratio, rtol=1e-12)
        self.assertTrue((np.diff(stretches, axis=1) <= 0).all())
        # Traces: tr sigma = (G (sum of squares - 3) + 3 K ln J) / J.
        g, k = 330e3, 6.6e6
        expected = (g * ((stretches**2).sum(axis=1) - 3) + 3 * k * np.log(ratio)) / ratio
        np.testing.assert_allclose(self.elements["stress[Pa]"][:, :3].sum(axis=1), expected,
                                   rtol=1e-9, atol=1e-6)

    def test_only_what_is_asked_for_is_written(self):
        run = testing.good_run(BEAM, {"time.end": "100 ms", "probes.every": "100 ms",
                                      "output.structure": "{every: 100 ms, fields: [stress]}"})
        grid = last_frame(run)
        self.assertEqual((set(arrays(grid.GetPointData())), set(arrays(grid.GetCellData()))),
                         (set(), {"stress[Pa]", "body"}))


class Flow(unittest.TestCase):
    def test_pressure_and_obstacles(self):
        """Water at rest in a box, pulled by a force along z: p rises by rho g h, as hydrostatics
        says; a ball is marked where it is."""
        run = testing.good_run(testing.SMALL, {
            "bodies": "", "magnetic_field": "", "gravity": "", "time.end": "160 ms",
            "fluid.body_force": "[0 N/m3, 0 N/m3, -10 N/m3]", "fluid.spacing": "0.5 mm",
            "fluid.viscosity": "20 mm2/s",
            "fluid.obstacles": "{ball: {sphere: {centre: [4 mm, 2 mm, 4 mm], diameter: 2 mm}}}",
            "probes": "null",
            "output": "{fluid: {every: 160 ms, fields: [pressure, obstacle, velocity]}}"})
        grid = last_frame(run, "fluid.pvd")
        found = arrays(grid.GetCellData())
        self.assertEqual(set(found), {"pressure[Pa]", "obstacle[1]", "velocity[m/s]"})
        cells = [n - 1 for n in grid.GetDimensions()][::-1]
        pressure, solid = (found[name].reshape(cells) for name in ("pressure[Pa]", "obstacle[1]"))
        rise = pressure[0, 0, 0] - pressure[-1, 0, 0]
        # Over 15 cells of 0.5 mm; at 80 ms the sound of the start has 0.4 % of it left.
        self.assertAlmostEqual(rise / (10 * 7.5e-3), 1, delta=0.005)
        z, y, x = (0.5e-3 * (np.indices(cells) + 0.5))
        inside = (x - 4e-3)**2 + (y - 2e-3)**2 + (z - 4e-3)**2 < 1e-6
        np.testing.assert_array_equal(solid == 1, inside)

    def test_an_obstacle_field_without_obstacles_is_refused(self):
        refused = testing.run(testing.SMALL,
                              {"output": "{fluid: {every: 1 ms, fields: [obstacle]}}"})
        testing.check_refused(self, refused, "obstacles")


if __name__ == "__main__":
    unittest.main()
