# SPDX-License-Identifier: GPL-2.0-or-later
"""A design is run by the solvers that know nothing of designs: Newton's equilibria of the scene that it
writes, and motion in air, slowed by a drag until the strip comes to rest."""
import json
import sys
import unittest

import numpy as np

from designs import Strip, mean_distance, run
from letter import WITHIN, folder_of
from magfsi import runs, testing

STRIP = Strip(elements=(30, 2, 1))


class Forward(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = folder_of(STRIP, 60)
        done = run(cls.folder / "letter.yaml", "--out", cls.folder / "out")
        assert done.code == 0, done.err[-2000:]
        cls.facts = json.loads((cls.folder / "out/results.json").read_text())

    def shape(self, folder, time_s):
        """The centre line at an instant: the middle rows of the nodes of a frame."""
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy

        file = min(runs.frames(folder), key=lambda frame: abs(frame[0] - time_s))[1]
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(file))
        reader.Update()
        points = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
        nx, ny, nz = (n + 1 for n in STRIP.elements)
        grid = points.reshape(nz, ny, nx, 3)
        return grid.mean(axis=(0, 1))

    def wanted(self, pose):
        table = runs.read_table(self.folder / f"out/shape_{pose}.csv", float)
        return np.stack([table[f"wanted_{a}[m]"] for a in "xyz"], axis=1)

    def check(self, result, stretch=1):
        self.assertEqual(result.code, 0, result.err)
        for pose, time_s in (("s", 2.0), ("mirrored", 5.0)):
            off = mean_distance(self.shape(result.folder, stretch * time_s),
                                self.wanted(pose)) / STRIP.length_m
            testing.report(f"{pose}: {100 * off:.2f} % of the length")
            self.assertLess(off, WITHIN)

    def test_equilibria(self):
        self.check(testing.run(self.folder / "out/scene.yaml"))

    def test_motion_in_air(self):
        # The lowest bending mode has 7.4 rad/s; with twice that as the rate of the damping what is
        # left of a lag falls by exp(-3.7) in a second, and the field stays for two.
        self.check(testing.run(self.folder / "out/scene.yaml", {
            "time": "{end: 10 s}", "damping": "{rate: 15 1/s}",
            "magnetic_field.vector_table.time":
                "[" + ", ".join(f"{2 * t} s" for t in range(6)) + "]",
            "output.structure.every": "1 s"}), 2)

    def test_motion_in_water(self):
        # The water that moves along is four times the strip's mass; what swings in it dies away in
        # seconds, so that the field takes six to rise, and stays for six.
        field = json.loads((self.folder / "out/results.json").read_text())["poses"]["s"]["field_t"]
        up = "[" + ", ".join(f"{b:.9g} T" for b in field) + "]"
        result = testing.run(self.folder / "out/scene.yaml", {
            "time": "{end: 12 s}", "bodies.strip.initial": "{position: [15 mm, 5 mm, 5.2 mm]}",
            "fluid": "{box: [32 mm, 10 mm, 28 mm], spacing: 1 mm, density: 1000 kg/m3, "
                     "viscosity: 1 mm2/s, expected_speed: 0.02 m/s}",
            "magnetic_field.vector_table": f"{{time: [0 s, 6 s, 12 s], vector: [[0 T, 0 T, 0 T], {up}, {up}]}}",
            "output.structure.every": "1 s"})
        self.assertEqual(result.code, 0, result.err)
        shift = np.array([5e-3, 3e-3, 5e-3])  # of the clamp in the box
        off = mean_distance(self.shape(result.folder, 12.0) - shift, self.wanted("s")) / STRIP.length_m
        testing.report(f"in water: {100 * off:.2f} % of the length")
        self.assertLess(off, WITHIN)


if __name__ == "__main__":
    sys.exit(unittest.main())
