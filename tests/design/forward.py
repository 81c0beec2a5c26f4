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


if __name__ == "__main__":
    sys.exit(unittest.main())
