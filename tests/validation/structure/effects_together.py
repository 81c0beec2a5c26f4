# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects of a solid act together as they do alone: stable at the step that is chosen, in the
script once each, and gone without a trace when the scene does not name them."""

import unittest

from magfsi import testing

SCENE = testing.ROOT / "tests/scenes/every_structure_effect.yaml"
# Effect, key that removes it, what it puts into the LAMMPS script.
EFFECTS = [
    ("viscosity", "bodies.strip.material.viscosity", "viscosity"),
    ("magnetic field", "magnetic_field", "magttice/field"),
    ("field gradient", "magnetic_field.gradient", "gradient"),
    ("gravity", "gravity", "fix gravity"),
    ("damping", "damping", "magttice/drag"),
    ("platform", "platform", "magttice/platform"),
    ("friction", "platform.friction", "friction"),
    ("contact", "contact", "pair_style"),
]

EVERY = 1  # 3: each third of them alone


def run(settings=None):
    return testing.good_run(SCENE, {"time.end": "10 ms", **(settings or {})})


class EffectsTogether(unittest.TestCase):
    def test_all_at_once(self):
        all_of_them = run()
        script = (all_of_them.folder / "lammps.in").read_text()
        for effect, _, command in EFFECTS:
            self.assertIn(effect, all_of_them.summary()["effects"])
            self.assertIn(command, script)
        probes = all_of_them.probes()
        # Rows lie on the interval asked for, to the rounding of a product.
        for row, time in enumerate(probes["t[s]"]):
            self.assertAlmostEqual(time, row * 0.005, delta=1e-15)
        # The platform keeps the strip up: a hundredth of its thickness is what a penalty
        # may give way.
        self.assertGreater(min(probes["strip.com_z[m]"]), 0.2e-3 - 0.0925e-3 - 0.185e-5)
        testing.report(f"all effects: V of {probes['strip.bend[rad]'][-1]:.3f} rad after 10 ms")
        # In 17 mT along 45 degrees the strip is on its way to the V (bend above 1 rad).
        self.assertGreater(probes["strip.bend[rad]"][-1], 1.0)

    def test_each_leaves_no_trace(self):
        for effect, key, command in EFFECTS[::EVERY]:
            with self.subTest(effect):
                rest = run({key: "null", "time.end": "0.5 ms"})  # the script alone is looked at
                self.assertIn(effect, rest.summary()["absent_effects"])
                self.assertNotIn(command, (rest.folder / "lammps.in").read_text())


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
