# SPDX-License-Identifier: GPL-2.0-or-later
"""Surfaces of equal |curl u| of a page are those of a vortex that is known in closed form; a run that has none
has nothing of them."""
import base64
import unittest
from pathlib import Path

import kinds
import numpy as np
import vtk
from magfsi import testing
from magfsi.report import data, vortices
from vtk.util.numpy_support import numpy_to_vtk

CELLS, SPACING, CORE, STRONGEST = 48, 0.25e-3, 2e-3, 400.0  # 1, m, m, 1/s
MIDDLE = CELLS * SPACING / 2


WHOLE = [(SPACING, CELLS, 0.0)]  # spacing, cells along a side, where they begin


def store(folder, strengths, grids=WHOLE):
    """An instant a strength, each on these grids: |curl u| = strength exp(-(r / CORE)^2) around the axis y."""
    (folder / "fields").mkdir()
    entries = ""
    for i, strength in enumerate(strengths):
        for level, (spacing, cells, low) in enumerate(grids):
            z, _, x = low + (np.indices((cells, cells, cells)) + 0.5) * spacing - MIDDLE
            curl = np.zeros((cells ** 3, 3))
            curl[:, 1] = (strength * np.exp(-(x ** 2 + z ** 2) / CORE ** 2)).ravel()
            image = vtk.vtkImageData()
            image.SetDimensions(cells + 1, cells + 1, cells + 1)
            image.SetSpacing(spacing, spacing, spacing)
            image.SetOrigin(low, low, low)
            values = numpy_to_vtk(curl, deep=True)
            values.SetName("vorticity[1/s]")
            image.GetCellData().AddArray(values)
            writer = vtk.vtkXMLImageDataWriter()
            writer.SetFileName(str(folder / f"fields/fluid_{i}_level{level}.vti"))
            writer.SetInputData(image)
            writer.Write()
            entries += f'<DataSet timestep="{0.01 * i}" part="{level}" file="fields/fluid_{i}_level{level}.vti"/>'
    (folder / "fluid.pvd").write_text(f"<VTKFile><Collection>{entries}</Collection></VTKFile>")


def unpacked(text):
    return np.frombuffer(base64.b64decode(text), "<u2").reshape(-1, 3).astype(int)


class Vortices(unittest.TestCase):
    def test_of_a_known_vortex(self):
        folder = Path(testing.new_folder())
        store(folder, (0.5 * STRONGEST, STRONGEST))
        found = vortices.vortices(folder, 1e6)
        self.assertEqual(found["times"], [0, 0.01])
        strongest = STRONGEST * np.exp(-2 * (SPACING / 2 / CORE) ** 2)  # in the middle of a cell
        levels = [level["value"] for level in found["levels"]]
        np.testing.assert_allclose(levels, [0.12 * strongest, 0.3 * strongest, 0.6 * strongest], rtol=0.05)
        for strength, frame in zip((0.5 * STRONGEST, STRONGEST), found["frames"]):
            points = np.array(found["low"]) + found["step"] * unpacked(frame["points"]) - MIDDLE
            triangles = unpacked(frame["triangles"])
            self.assertEqual(sum(frame["counts"]), len(triangles))
            self.assertLessEqual(len(triangles), 1.02 * vortices.MOST_TRIANGLES)
            parts = np.split(triangles, np.cumsum(frame["counts"])[:-1])
            for level, part in zip(levels, parts):
                if level > strength:
                    self.assertEqual(len(part), 0)
                    continue
                # A cylinder of this radius. Points lie between cells on straight lines, which at the top of
                # a parabola is an eighth of its curvature; decimation moves them by a tenth of a cell more.
                radius = np.linalg.norm(points[np.unique(part)][:, [0, 2]], axis=1)
                wanted = CORE * np.sqrt(np.log(strength / level))
                np.testing.assert_allclose(radius, wanted, atol=0.3 * SPACING)
                self.assertAlmostEqual(radius.mean(), wanted, delta=0.1 * SPACING)

    def test_each_part_is_of_the_finest_grid(self):
        """Cells of 1 mm, and of 0.25 mm in a patch that all surfaces pass through along y: in it they are as exact
        as on the fine grid everywhere, beside it as on the coarse one, and go on without a gap."""
        folder = Path(testing.new_folder())
        patch = 2e-3
        store(folder, [STRONGEST] * 2, [(4 * SPACING, CELLS // 4, 0.0), (SPACING, 2 * CELLS // 3, patch)])
        found = vortices.vortices(folder, 1e6)
        # In the middle of a cell of the fine grid.
        strongest = STRONGEST * np.exp(-2 * (SPACING / 2 / CORE) ** 2)
        self.assertAlmostEqual(found["levels"][-1]["value"], 0.6 * strongest, delta=0.05 * strongest)
        frame = found["frames"][-1]
        points = np.array(found["low"]) + found["step"] * unpacked(frame["points"]) - MIDDLE
        parts = np.split(unpacked(frame["triangles"]), np.cumsum(frame["counts"])[:-1])
        for level, part in zip((level["value"] for level in found["levels"]), parts):
            used = points[np.unique(part)]
            radius, y = np.linalg.norm(used[:, [0, 2]], axis=1), np.abs(used[:, 1])
            wanted, half = CORE * np.sqrt(np.log(STRONGEST / level)), MIDDLE - patch
            fine = y < half - SPACING
            self.assertGreater(fine.sum(), 20)
            np.testing.assert_allclose(radius[fine], wanted, atol=0.3 * SPACING)
            self.assertAlmostEqual(radius[fine].mean(), wanted, delta=0.1 * SPACING)
            coarse = y > half + SPACING
            self.assertGreater(coarse.sum(), 5)
            np.testing.assert_allclose(radius[coarse], wanted, atol=0.3 * 4 * SPACING)
            self.assertGreater((np.abs(y - half) < 1e-2 * SPACING).sum(), 10)  # where both end

    def test_room(self):
        folder = Path(testing.new_folder())
        store(folder, [STRONGEST] * 5)
        each = vortices.MOST_TRIANGLES * vortices.BYTES_A_TRIANGLE
        found = vortices.vortices(folder, 3.2 * each)
        self.assertEqual(len(found["times"]), 3)
        # A point is used by six triangles where a surface is closed, and by fewer where it ends.
        self.assertLess(data.bytes_of(found), 1.2 * 3 * each)
        self.assertIsNone(vortices.vortices(folder, 1.9 * each))

    def test_none_without_a_flow(self):
        self.assertIsNone(data.read_run(kinds.structure_alone().folder, 1e6)["vortices"])
        still = Path(testing.new_folder())
        store(still, [0.0])
        self.assertIsNone(vortices.vortices(still, 1e6))


if __name__ == "__main__":
    unittest.main()
