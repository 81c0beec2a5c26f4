# SPDX-License-Identifier: GPL-2.0-or-later
"""The gripper's arms bend as the elastica does; it closes on the ball, lifts it and lets it go."""
import sys
import unittest

import numpy as np
import vtk
from magfsi import plotting, testing
from vtk.util.numpy_support import vtk_to_numpy

GRIPPER = testing.ROOT / "tutorials/gripper"
sys.path.insert(0, str(GRIPPER))
import theory  # noqa: E402

CELL, HUB = 0.2e-3, (0.5e-3, 0.1e-3)  # m; where an arm's middle begins
G = 9.81
WEIGHT = G * (4.608e-6 * (1 - 1000 / 1100) + 4.092e-6 * (1 - 1000 / 1860))  # N, ball and gripper in water


def skins(file):
    """Of each body, its closed surface."""
    grid = plotting.read_grid(file)
    body = vtk_to_numpy(grid.GetCellData().GetArray("body"))
    for number in np.unique(body):
        chosen = vtk.vtkIdList()
        for cell in np.flatnonzero(body == number):
            chosen.InsertNextId(int(cell))
        steps = vtk.vtkExtractCells(), vtk.vtkGeometryFilter(), vtk.vtkTriangleFilter(), vtk.vtkPolyDataNormals()
        steps[0].SetInputData(grid)
        steps[0].SetCellList(chosen)
        for before, after in zip(steps, steps[1:], strict=False):
            after.SetInputConnection(before.GetOutputPort())
        steps[-1].SplittingOff()
        steps[-1].AutoOrientNormalsOn()
        steps[-1].Update()
        yield steps[-1].GetOutput()


def gap(file):
    """Of the two bodies, from the nodes of each to the surface of the other; negative where one is in the other."""
    first, second = skins(file)
    least = np.inf
    for skin, other in ((first, second), (second, first)):
        distance = vtk.vtkImplicitPolyDataDistance()
        distance.SetInput(skin)
        least = min(least, *(distance.EvaluateFunction(x) for x in vtk_to_numpy(other.GetPoints().GetData())))
    return least


class Arm(unittest.TestCase):
    def test_bends_as_the_elastica(self):
        p = testing.good_run(GRIPPER / "arm.yaml").probes()
        worst = 0
        for field, x, z in zip(p["field_z[T]"], p["east_tip_x[m]"], p["east_tip_z[m]"], strict=True):
            if field:
                expected = theory.shape(-field)
                worst = max(worst, np.hypot(x - HUB[0] - expected[0][-1], z - HUB[1] - expected[1][-1]))
        testing.report(f"tip within {100 * worst / theory.LENGTH:.2f} % of the arm's length of the elastica")
        # The mesh's own error is 0.8 % (explain); the hub holds the curl of the arm's root, which a thickness away
        # is free: a twelfth of the length, up to a third stiffer.
        self.assertLess(worst / theory.LENGTH, 0.03)


class Gripper(unittest.TestCase):
    END, HELD = "0.14 s", (0.1, 0.14)

    def course(self):
        run = testing.good_run(GRIPPER, {"time.end": self.END}, ranks="structure=1,fluid=1", limit_s=3000)
        testing.check_interface_balance(self, run, "gripper")
        self.assertLess(run.summary()["energy_audit"]["gained"], 1e-9)
        least = min(gap(file) for _, file in plotting.frames(run.folder))
        testing.report(f"surfaces of gripper and ball are {1e3 * least:.3f} mm apart at least")
        self.assertGreater(least, -0.05 * CELL)
        return {name: np.array(values) for name, values in run.probes().items()}

    def check_held(self, p):
        """Below the arms' tips it cannot fall, and it goes where the hub goes."""
        held = (p["t[s]"] >= self.HELD[0] - 1e-9) & (p["t[s]"] <= self.HELD[1] + 1e-9)
        hub = 1e-3 * (1 - np.cos(np.pi * np.minimum(p["t[s]"] / 0.4, 1)))
        ball = p["ball.com_z[m]"]
        slip = np.ptp((ball - hub)[held])
        testing.report(f"ball lifted by {1e3 * (ball[held][-1] - ball[0]):.3f} mm, hub by {1e3 * hub[held][-1]:.3f}; "
                       f"it moves by {1e6 * slip:.1f} um against the hub")
        # A tenth of a cell; the grip still tightens, and water resists the way up.
        self.assertLess(slip, 0.1 * CELL)
        below = (ball - p["east_tip_z[m]"])[held]
        inside = np.hypot(p["east_tip_x[m]"] - p["ball.com_x[m]"], p["east_tip_y[m]"] - p["ball.com_y[m]"])[held]
        testing.report(f"tips {1e3 * below.min():.2f} mm below its middle, {1e3 * inside.max():.2f} mm from its axis")
        self.assertGreater(below.min(), 0.4e-3)
        self.assertLess(inside.max(), 1.2e-3)
        self.assertGreater(ball[held][-1], 1.02e-3 + hub[held][-1])
        return held

    def test_closes_and_lifts(self):
        self.check_held(self.course())


class Whole(Gripper):
    END, HELD = "0.7 s", (0.42, 0.51)

    def test_closes_and_lifts(self):
        p = self.course()
        held = self.check_held(p)
        carried = p["gripper.top.reaction_z[N]"][held].mean()
        testing.report(f"the hub carries {1e6 * carried:.2f} uN, gripper and ball weigh {1e6 * WEIGHT:.2f} uN")
        # The water that the lift has set going swings on, by 3 %, about the mean.
        self.assertLess(abs(carried / WEIGHT - 1), 0.02)
        # Let go, it falls to the floor.
        self.assertLess(p["ball.com_z[m]"][-1], 1.1e-3)


if __name__ == "__main__":
    names = ["Whole" if word == "--long" else word for word in sys.argv[1:]] or ["Arm", "Gripper"]
    unittest.main(argv=[sys.argv[0], *names], verbosity=2)
