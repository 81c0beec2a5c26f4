# SPDX-License-Identifier: GPL-2.0-or-later
"""Integrals over planes (probes.integrals) with OpenFOAM, against the exact flow between plates."""

import unittest
from pathlib import Path

from magfsi import testing

SCENE = """
name: plates
time: {end: 150 ms, step: 2.5 ms}
fluid:
  solver: openfoam
  box: [6 mm, 0.5 mm, 2 mm]
  spacing: 0.125 mm
  density: 1000 kg/m3
  viscosity: 4 mm2/s
  boundaries:
    x_min: {velocity_inlet: {velocity: [10 mm/s, 0 m/s, 0 m/s], profile: parabolic}}
    x_max: pressure_outlet
    y_min: periodic
    y_max: periodic
  initial_velocity: [10 mm/s, 0 m/s, 0 m/s]
probes:
  every: 150 ms
  fluid: [mass]
  integrals:
    first: {plane: {axis: x, at: 2 mm}}
    between_faces: {plane: {axis: x, at: 4.03 mm}}
    start: {plane: {axis: x, at: 0 m}}
    end: {plane: {axis: x, at: 6 mm}}
    across: {plane: {axis: z, at: 1.01 mm}}
"""
SPEED, WIDTH, HEIGHT, DENSITY, VISCOSITY = 0.01, 0.5e-3, 2e-3, 1000, 4e-6
# The flow between faces is kept to the pressure's tolerance.
CONTINUITY = 1e-5
# 16 cells over the height, of second order with the wall's half cell: some 2 / 16^2.
GRID = 0.01


class Planes(unittest.TestCase):
    def check(self, settings, ranks, at_ends=GRID):
        scene = Path(testing.new_folder()) / "scene.yaml"
        scene.write_text(SCENE)
        p = {name: values[-1] for name, values in
             testing.good_run(scene, settings, ranks).probes().items()}
        flow = SPEED * WIDTH * HEIGHT
        for name in ("first", "between_faces", "start", "end"):
            with self.subTest(name):
                self.assertAlmostEqual(p[f"{name}.flow[m3/s]"] / flow, 1, delta=CONTINUITY)
                # Of a parabola 6/5 of what the mean has.
                exact = 1.2 * DENSITY * SPEED * flow
                bound = at_ends if name in ("start", "end") else GRID
                self.assertAlmostEqual(p[f"{name}.momentum_flux_x[N]"] / exact, 1, delta=bound)
                self.assertLess(abs(p[f"{name}.momentum_flux_z[N]"]), 1e-3 * exact)
        drop = p["first.pressure[Pa]"] - p["between_faces.pressure[Pa]"]
        exact = 12 * VISCOSITY * DENSITY * SPEED / HEIGHT**2 * 2.03e-3
        testing.report(f"{ranks}: drop of pressure {drop / exact - 1:+.2%}, momentum "
                       f"{p['first.momentum_flux_x[N]'] / (1.2 * DENSITY * SPEED * flow) - 1:+.2%}")
        self.assertAlmostEqual(drop / exact, 1, delta=GRID)
        self.assertLess(abs(p["across.flow[m3/s]"]), CONTINUITY * flow)

    def test_between_plates(self):
        self.check({}, "fluid=1")

    def test_on_three_ranks(self):
        self.check({}, "fluid=3")

    def test_on_a_graded_mesh(self):
        """At the ends cells are three times as long, and the planes are of second order."""
        self.check({"fluid.grading.uniform": "[[2 mm, 0 m, 0 m], [3 mm, 0.5 mm, 2 mm]]",
                    "fluid.grading.growth": "1.2"}, "fluid=2", at_ends=9 * GRID)


if __name__ == "__main__":
    unittest.main()
