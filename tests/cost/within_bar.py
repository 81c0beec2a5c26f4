# SPDX-License-Identifier: GPL-2.0-or-later
"""The true error of a scene lies within the bar that magfsi cost states: a beam against finite
elements, a channel against its series; the tolerance that is asked for is kept."""
import unittest

import numpy as np
from scenes import BEAM, Scene, beam_tip_m, testing

# A stream between walls, driven from rest by a force; 8 nu U / H^2 makes U in the middle.
HEIGHT, VISCOSITY, SPEED, CELLS, END = 1.0, 0.02, 0.1, 12, 6.0
CHANNEL = f"""
name: channel
time: {{end: {END} s, step: {0.05 / CELLS / SPEED:.9g} s}}
fluid:
  box: [{4 / CELLS:.12g} m, 1 m, {4 / CELLS:.12g} m]
  spacing: {1 / CELLS:.12g} m
  density: 1 kg/m3
  viscosity: {VISCOSITY} m2/s
  body_force: [{8 * VISCOSITY * SPEED / HEIGHT**2} N/m3, 0 N/m3, 0 N/m3]
  boundaries: {{x_min: periodic, x_max: periodic, z_min: periodic, z_max: periodic}}
probes: {{every: {END / 20} s, fluid: [kinetic_energy]}}
"""


def channel_energy_j():
    """Series of sines, each with its own decay."""
    k = np.arange(1, 2001, 2) * np.pi / HEIGHT
    amplitude = 32 * SPEED / (k * HEIGHT)**3 * (1 - np.exp(-VISCOSITY * k**2 * END))
    return 0.5 * HEIGHT * (4 / CELLS)**2 * 0.5 * float(amplitude @ amplitude)


class WithinBar(unittest.TestCase):
    def check(self, scene, column, true):
        found = scene.probe(column)
        testing.report(f"{column}: true error {abs(found['value'] / true - 1):.2%}, bar "
                       f"{found['bar'] / abs(true):.2%}; limit {found['limit'] / true - 1:+.2%} +- "
                       f"{found['limit_bar'] / abs(true):.2%}")
        self.assertEqual(found["doubt"], "")
        self.assertLessEqual(abs(found["value"] - true), found["bar"])
        self.assertLessEqual(abs(found["limit"] - true), found["limit_bar"])
        # A bar that says nothing holds as well.
        self.assertLess(found["bar"], 0.2 * abs(true))
        self.assertTrue((scene.out / "figure.png").stat().st_size > 0)

    def test_a_beam(self):
        scene = Scene(BEAM)
        scene.good_cost("--budget", "30 s", "--probe", "tip_uz")
        self.check(scene, "tip_uz[m]", beam_tip_m(0.01))

    def test_a_channel(self):
        scene = Scene(CHANNEL)
        scene.good_cost("--budget", "30 s")
        self.check(scene, "kinetic_energy[J]", channel_energy_j())

    def test_a_run_within_a_tolerance(self):
        scene = Scene(BEAM + "accuracy: {error: 3 %, probes: [tip_uz], budget: 30 s}\n")
        done = scene.run()
        self.assertEqual(done.code, 0, done.out + done.err)
        testing.report(done.out)
        stated = scene.summary("runs/beam")["accuracy"]
        found = stated["probes"]["tip_uz[m]"]
        self.assertLessEqual(abs(found["value"] - beam_tip_m(0.01)), found["bar"])
        self.assertLessEqual(found["bar"], 1.001 * 0.03 * abs(found["value"]))


if __name__ == "__main__":
    unittest.main()
