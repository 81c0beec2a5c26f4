# SPDX-License-Identifier: GPL-2.0-or-later
"""Womersley's flow (J. Physiol. 127 (1955) 553) in a round vessel: an inlet whose velocity swings, and the hole of an
obstacle from an STL file. With the mean speed U sin(omega t) and b^2 = -i omega R^2 / nu,

    u = Im U e^(i omega t) (1 - J0(b r / R) / J0(b)) / (1 - 2 J1(b) / (b J0(b)))
"""
import math
import unittest
from pathlib import Path

import numpy as np
from scipy.special import jv
from vtk.util.numpy_support import vtk_to_numpy

import pipe
from magfsi import plotting, testing

RADIUS, VISCOSITY, SPEED, WOMERSLEY = pipe.RADIUS, 1e-6, 1e-3, 2  # the Reynolds number is 1
OMEGA = WOMERSLEY**2 * VISCOSITY / RADIUS**2
PERIOD = 2 * math.pi / OMEGA


def exact(radius, time):
    b = np.sqrt(-1j * OMEGA * RADIUS**2 / VISCOSITY)
    shape = (1 - jv(0, b * radius / RADIUS) / jv(0, b)) / (1 - 2 * jv(1, b) / (b * jv(0, b)))
    return SPEED * (np.exp(1j * OMEGA * time) * shape).imag


def error(cells):
    """Of the speeds in the middle of the vessel, root mean square over U, at eight instants of the second half of the
    first period, when the start has died out; cells across."""
    spacing = 2 * RADIUS / cells
    across, along = cells + 4, 2 * cells
    width, length = across * spacing, along * spacing
    # A sixteenth of the period is a whole number of steps, at a relaxation time of about 0.55.
    count = math.ceil(PERIOD / 16 / (0.05 / 3 * spacing**2 / VISCOSITY))
    step = PERIOD / 16 / count
    folder = Path(testing.new_folder())
    pipe.write_pipe(folder / "pipe.stl", 0.75 * width, length)
    opening = f"disc: {{centre: [{width / 2:.12g} m, {width / 2:.12g} m], diameter: {2 * RADIUS} m}}"
    (folder / "pulse.yaml").write_text(f"""
name: pulse
time: {{end: {16 * count * step:.12g} s, step: {step:.12g} s}}
fluid:
  box: [{width:.12g} m, {width:.12g} m, {length:.12g} m]
  spacing: {spacing:.12g} m
  density: 1000 kg/m3
  viscosity: {VISCOSITY} m2/s
  collision: trt
  magic_number: 0.1875
  boundaries:
    z_min:
      velocity_inlet:
        velocity: [0 m/s, 0 m/s, {SPEED} m/s]
        profile: parabolic
        course: {{oscillation: {{mean: 0, amplitude: 1, frequency: {1 / PERIOD:.12g} Hz}}}}
        {opening}
    z_max: {{pressure_outlet: {{{opening}}}}}
  obstacles:
    wall: {{stl: {{file: pipe.stl, unit: 1 m, shift: [{width / 2:.12g} m, {width / 2:.12g} m, 0 m]}}}}
output: {{fluid: {{every: {count * step:.12g} s, fields: [velocity]}}}}
""")
    run = testing.good_run(folder / "pulse.yaml", ranks="fluid=1")
    at = (np.arange(across) + 0.5) * spacing - width / 2
    radius = np.hypot(at[:, None], at[None, :])
    inside = radius < RADIUS
    square = []
    for time, file in plotting.frames(run.folder, "fluid.pvd"):
        if time < 0.499 * PERIOD:
            continue
        speed = vtk_to_numpy(plotting.read_grid(file).GetCellData().GetArray("velocity[m/s]"))
        speed = speed.reshape(along, across, across, 3)[cells - 1:cells + 1, :, :, 2].mean(axis=0)
        square.append(np.mean((speed - exact(radius, time))[inside]**2))
    worst = math.sqrt(np.mean(square)) / SPEED
    testing.report(f"{cells} cells across, {len(square)} instants: error {100 * worst:.3f} %")
    return worst


class Pulse(unittest.TestCase):
    def test_profile(self):
        errors = [error(cells) for cells in (10, 20, 28)]
        self.assertLess(errors[-1], 0.005)
        # Where a wall cuts a link changes from cell to cell: the order is that of the whole range.
        order = math.log(errors[0] / errors[-1]) / math.log(28 / 10)
        testing.report(f"order {order:.2f}")
        self.assertGreater(order, 1.8)


if __name__ == "__main__":
    unittest.main(verbosity=2)
