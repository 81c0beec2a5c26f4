# SPDX-License-Identifier: GPL-2.0-or-later
"""The files for ParaView have the orientation of rigid parts that the probes have, and their nodes are where it
turns them."""

import unittest

import numpy as np
from magfsi import plotting, testing
from vtk.util.numpy_support import vtk_to_numpy

SCENE = testing.ROOT / "docs/examples/scenes/rigid.yaml"
# Bodies in the order of the files, which is that of their names, with the columns of their rigid part and how many of
# their elements are rigid.
PARTS = {"anvil": ("anvil", None), "arm": ("arm.magnet", 8), "ball": ("ball", None), "capsule": ("capsule", None),
         "needle": ("needle", None), "nose": (None, 0), "puller": ("puller", None), "rocker": ("rocker", None),
         "screw": ("screw", None), "top": ("top", None)}
NAMES = {"orientation[1]": ("q_w[1]", "q_x[1]", "q_y[1]", "q_z[1]"),
         "angles[rad]": ("roll[rad]", "pitch[rad]", "yaw[rad]")}


def matrix(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class InFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        run = testing.good_run(SCENE, {"output": "{structure: {every: 1 ms}}", "time.step": "20 us"})
        cls.probes = run.probes()
        cls.grids = [plotting.read_grid(file) for _, file in plotting.frames(run.folder)]

    def cells(self, frame, name):
        return vtk_to_numpy(self.grids[frame].GetCellData().GetArray(name))

    def rigid(self, frame, number):
        """Which elements of a body are rigid: their quaternion has the length 1."""
        mine = self.cells(frame, "body") == number
        length = np.linalg.norm(self.cells(frame, "orientation[1]"), axis=1)
        return mine & (np.abs(length - 1) < 1e-6), mine & (length == 0), mine

    def test_orientations_are_those_of_the_probes(self):
        self.assertEqual(len(self.grids), 3)
        self.assertEqual(set(self.cells(0, "body")), set(range(len(PARTS))), "a body of the scene that PARTS lacks")
        for frame in range(3):
            for number, (part, count) in enumerate(PARTS.values()):
                rigid, soft, mine = self.rigid(frame, number)
                self.assertEqual(rigid.sum(), mine.sum() if count is None else count, part)
                self.assertEqual(rigid.sum() + soft.sum(), mine.sum())
                for name, columns in NAMES.items() if part else ():
                    for component, column in enumerate(columns):
                        off = self.cells(frame, name)[rigid, component] - self.probes[f"{part}.rigid_{column}"][frame]
                        self.assertLess(np.abs(off).max(), 1e-6, (part, column))

    def test_nodes_are_where_the_orientation_turns_them(self):
        """The top has turned by 0.6 about its axis: its nodes, about their middle."""
        number = list(PARTS).index("top")
        rigid, _, _ = self.rigid(0, number)
        first, last = (self.cells(frame, "orientation[1]")[rigid][0] for frame in (0, -1))
        self.assertGreater(2 * np.arccos(abs(last @ first)), 0.5)
        turn = matrix(last) @ matrix(first).T
        nodes = {i for cell in np.flatnonzero(rigid) for i in nodes_of(self.grids[0], cell)}
        before, after = (vtk_to_numpy(grid.GetPoints().GetData())[sorted(nodes)] for grid in (self.grids[0], self.grids[-1]))
        before, after = before - before.mean(axis=0), after - after.mean(axis=0)
        self.assertLess(np.abs(after - before @ turn.T).max(), 1e-5 * np.abs(before).max())

    def test_a_scene_without_rigid_parts_has_none(self):
        run = testing.good_run(testing.ROOT / "tutorials/beam", {"time.end": "100 ms"})
        _, file = next(iter(plotting.frames(run.folder)))
        cells = plotting.read_grid(file).GetCellData()
        self.assertFalse(cells.HasArray("orientation[1]") or cells.HasArray("angles[rad]"))


def nodes_of(grid, cell):
    ids = grid.GetCell(int(cell)).GetPointIds()
    return [ids.GetId(i) for i in range(ids.GetNumberOfIds())]


if __name__ == "__main__":
    unittest.main()
