# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid helical swimmer with a magnetic head in a tube of glycerol, against the finite elements of
Caldag and Yesilyurt (J. Fluids Struct. 90, 164, 2019): the advance for each turn of the field.

Their flow is Stokes', in which advance and turns do not depend on the viscosity. Here it is 50 mm2/s,
with a Reynolds number of 0.3 of the head, for steps that are longer than glycerol's. Nothing flows through
the ends of their tube: one is an inlet of no flow. Here both are walls.

The advance with two turns is off by +5.7, +2.5 and -0.6 % with cells of 0.05, 0.04 and 0.033 mm, so its
limit on finer grids is not known; half the step changes it by -0.7 %."""

import math
import sys
import unittest
from pathlib import Path

from magfsi import surfaces, testing

HERE = Path(__file__).resolve().parent
SCENE = HERE / "helix_in_tube.yaml"
sys.path.insert(0, str(HERE))
import swimmer_mesh  # noqa: E402

HEAD, HEAD_LENGTH, ROUNDED = 0.4e-3, 1.5e-3, 0.1e-3
COIL, PITCH, WIRE = 0.29e-3, 1e-3, 0.1e-3
ELEMENT = 0.05e-3


def swimmer(turns):
    mesh = swimmer_mesh.new()
    swimmer_mesh.head(mesh, HEAD, HEAD_LENGTH, ROUNDED, ELEMENT)
    swimmer_mesh.tail(mesh, COIL, PITCH, WIRE, turns, HEAD_LENGTH - 0.1e-3, ELEMENT)
    return swimmer_mesh.in_metres(mesh)


class Puller(unittest.TestCase):
    def advance(self, tube_mm, turns, expected_mm, more=None):
        folder = Path(testing.new_folder())
        (folder / "scene.yaml").write_text(SCENE.read_text())
        swimmer_mesh.ball_mesh.write(folder / "swimmer.msh", swimmer(turns))
        side, length = tube_mm + 0.2, max(10, turns + 6)
        surfaces.write_stl(folder / "tube.stl",
                           surfaces.block_with_hole(tube_mm / 2, side / 2 + 0.1, (-1, length + 1), 64))
        probes = testing.good_run(folder / "scene.yaml", {
            "fluid.box": f"[{length} mm, {side} mm, {side} mm]",
            "fluid.obstacles.tube.stl.shift": f"[0 mm, {side / 2} mm, {side / 2} mm]",
            "bodies.swimmer.initial.position": f"[{(length - 1.5 - turns) / 2} mm, {side / 2} mm, {side / 2} mm]",
            **(more or {})}, ranks="structure=1,fluid=2", limit_s=1800).probes()
        times, x = probes["t[s]"], probes["swimmer.rigid_x[m]"]
        rate = 15.0
        last = times[-1] - 1 / rate
        first = min(range(len(times)), key=lambda n: abs(times[n] - last))
        found = 1e3 * (x[-1] - x[first]) / ((times[-1] - times[first]) * rate)
        turned = [math.atan2(w, v) for w, v in zip(probes["swimmer.rigid_q_x[1]"], probes["swimmer.rigid_q_w[1]"])]
        behind = math.remainder(2 * turned[-1] - 2 * math.pi * rate * times[-1], 2 * math.pi)
        off_axis = max(math.hypot(y - 0.5e-3 * side, z - 0.5e-3 * side) for y, z in zip(
            probes["swimmer.rigid_y[m]"][first:], probes["swimmer.rigid_z[m]"][first:]))
        testing.report(f"tube {tube_mm} mm, {turns} turns: {found:.4f} mm a turn, "
                       f"{100 * (abs(found) / expected_mm - 1):+.2f} %; {1e3 * off_axis:.3f} mm off the axis, "
                       f"{math.degrees(behind):.0f} degrees from the field")
        self.assertAlmostEqual(abs(found) / expected_mm, 1, delta=0.05)

    def test_in_a_narrow_tube(self):
        self.advance(1.6, 4, 0.1184)

    def test_with_two_turns(self):
        self.advance(1.6, 2, 0.0733)

    def test_with_eight_turns(self):
        self.advance(1.6, 8, 0.1653)

    def test_in_a_wider_tube(self):
        self.advance(3, 4, 0.1288)

    def test_in_a_wide_tube(self):
        self.advance(5, 4, 0.129)


if __name__ == "__main__":
    unittest.main()
