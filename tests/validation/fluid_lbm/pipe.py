# SPDX-License-Identifier: GPL-2.0-or-later
"""Flow of a fluid that thins in a round pipe, by Carreau's law: the stress is rho g r / 2 whatever the
fluid; the rate of shear that has it is integrated to the speed. The pipe is the hole of an obstacle
that is read from an STL file."""
import math
import unittest
from pathlib import Path

import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import plotting, surfaces, testing

RADIUS, DRIVING = 0.5e-3, 0.5  # m, m/s2
AT_REST, INFINITE, TIME, EXPONENT = 4e-6, 0.4e-6, 0.2, 0.4
END_S = 0.6  # 10 R^2 / nu of the fluid at rest: near the wall it has a fifth of that


def viscosity(rate):
    return INFINITE + (AT_REST - INFINITE) * (1 + (TIME * rate)**2)**((EXPONENT - 1) / 2)


def rate_at(stress):
    low, high = 0.0, 1e6
    while high - low > 1e-13 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if viscosity(middle) * middle < stress else (low, middle)
    return high


RADII = np.linspace(0, RADIUS, 4001)
RATES = np.array([rate_at(DRIVING * r / 2) for r in RADII])
STEPS = (RATES[1:] + RATES[:-1]) / 2 * np.diff(RADII)
SPEEDS = np.append(np.cumsum(STEPS[::-1])[::-1], 0)  # at RADII


def write_pipe(file, half_width, length):
    """A block with a round hole along z, from end to end of the box and beyond."""
    sides = 240
    surfaces.write_stl(file, ([(y, z, x) for x, y, z in triangle] for triangle in surfaces.block_with_hole(
        surfaces.same_area(RADIUS, sides), half_width, (-0.5 * length, 1.5 * length), sides)))


def error(cells):
    """Of the speeds, root mean square over the largest; cells across the diameter."""
    spacing = 2 * RADIUS / cells
    across, along = cells + 4, 4
    width = across * spacing
    folder = Path(testing.new_folder())
    write_pipe(folder / "pipe.stl", 0.75 * width, along * spacing)
    tau = 0.9
    step = (tau - 0.5) / 3 * spacing**2 / AT_REST
    (folder / "pipe.yaml").write_text(f"""
name: pipe
time: {{end: {math.ceil(END_S / step) * step:.12g} s, step: {step:.12g} s}}
fluid:
  box: [{width:.12g} m, {width:.12g} m, {along * spacing:.12g} m]
  spacing: {spacing:.12g} m
  density: 1000 kg/m3
  viscosity: {AT_REST} m2/s
  collision: trt
  boundaries: {{z_min: periodic, z_max: periodic}}
  body_force: [0 N/m3, 0 N/m3, {1000 * DRIVING} N/m3]
  rheology: {{carreau: {{infinite_viscosity: {INFINITE} m2/s, time: {TIME} s, exponent: {EXPONENT}}}}}
  obstacles:
    wall: {{stl: {{file: pipe.stl, unit: 1 m, shift: [{width / 2:.12g} m, {width / 2:.12g} m, 0 m]}}}}
output: {{fluid: {{every: {math.ceil(END_S / step) * step:.12g} s, fields: [velocity]}}}}
""")
    run = testing.good_run(folder / "pipe.yaml")
    _, file = plotting.nearest_frames(plotting.frames(run.folder, "fluid.pvd"), [END_S])[0]
    image = plotting.read_grid(file)
    speed = vtk_to_numpy(image.GetCellData().GetArray("velocity[m/s]")).reshape(
        along, across, across, 3)[0, :, :, 2]
    at = (np.arange(across) + 0.5) * spacing - width / 2
    radius = np.hypot(at[:, None], at[None, :])
    inside = radius < RADIUS
    exact = np.interp(radius, RADII, SPEEDS)
    worst = math.sqrt(np.mean((speed - exact)[inside]**2)) / SPEEDS[0]
    testing.report(f"{cells} cells across: error {100 * worst:.3f} % of {1e3 * SPEEDS[0]:.3f} mm/s")
    return worst


class Pipe(unittest.TestCase):
    def test_profile(self):
        errors = [error(cells) for cells in (10, 20, 40)]
        self.assertLess(errors[1], 0.01)
        # Where a wall cuts a link changes from cell to cell: the order is that of the whole range.
        self.assertGreater(math.log(errors[0] / errors[2]) / math.log(4), 1.7)


if __name__ == "__main__":
    unittest.main(verbosity=2)
