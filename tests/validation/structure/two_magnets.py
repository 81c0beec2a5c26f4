# SPDX-License-Identifier: GPL-2.0-or-later
"""Magnetised bodies on each other: they come together by the law of two dipoles, turn towards each
other, stop where contact holds them, and the energy of their field is what they gain."""

import math
import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "two_magnets.yaml"
MU0 = 4e-7 * math.pi
MOMENT = 200e3 * 1e-9  # A m2
MASS = 2000 * 1e-9
# Askew, one cube across the other's field.
ASKEW = {"bodies.upper.magnetization.uniform": "[200 kA/m, 0 A/m, 0 A/m]",
         "bodies.upper.initial.position": "[0.5 mm, 0.3 mm, 2.5 mm]", "time.end": "2 ms"}
TOUCHING = {**ASKEW, "dipoles.within_bodies": "true", "contact": "{}", "time.end": "12 ms"}


class TwoMagnets(unittest.TestCase):
    def audit(self, run, label, share):
        p, audit = run.probes(), run.summary()["energy_audit"]
        testing.report(f"{label}: {audit}")
        self.assertLess(audit["residual"], share, label)
        self.assertLess(audit["gained"], share, label)
        # Nothing outside acts: what one gains in momentum the other loses.
        for axis in "xyz":
            speed = [p[f"{name}.speed_{axis}[m/s]"] for name in ("lower", "upper")]
            fastest = max(1e-6, *(abs(v) for v in speed[0]))
            self.assertLess(max(abs(a + b) for a, b in zip(*speed, strict=True)), 1e-11 * fastest)
        return p

    # 1/2 (mass / 2) v^2 = mu0 m^2 / (2 pi) (1 / r^3 - 1 / r0^3), v and r of one against the other.
    def test_come_together_by_the_law_of_two_dipoles(self):
        p = self.audit(testing.good_run(SCENE), "on one axis", 1e-4)
        apart = [b - a for a, b in zip(p["lower.com_z[m]"], p["upper.com_z[m]"], strict=True)]
        speed = p["lower.speed_z[m/s]"][-1] - p["upper.speed_z[m/s]"][-1]
        fallen = MU0 * MOMENT**2 / (2 * math.pi) * (apart[-1]**-3 - apart[0]**-3)
        right = math.sqrt(4 * fallen / MASS)
        testing.report(f"from {apart[0]} to {apart[-1]} m, {speed} m/s, law {right}")
        self.assertLess(apart[-1], 0.75 * apart[0])
        # A cube's next multipole at 4 of its edges: 1e-3 of the force (unit test), and its strain.
        self.assertLess(abs(speed / right - 1), 2e-3)

    def test_askew_they_turn_and_the_energy_is_closed(self):
        residual = []
        for step in ("10 us", "5 us"):
            run = testing.good_run(SCENE, {**ASKEW, "time.step": step})
            p = self.audit(run, f"askew, {step}", 1e-4)
            residual.append(run.summary()["energy_audit"]["residual"])
        self.assertGreater(abs(p["audit.dipoles[J]"][-1]), 5 * abs(p["audit.dipoles[J]"][0]))
        # That of the time integration, of second order, and of nothing else.
        self.assertGreater(residual[0] / residual[1], 3.5)
        work = p["audit.dipoles[J]"][0] - p["audit.dipoles[J]"][-1]
        gained = p["audit.kinetic_whole[J]"][-1] + p["audit.elastic[J]"][-1]
        testing.report(f"work {work} J, gained {gained} J")
        self.assertLess(abs(work / gained - 1), 1e-4)

    def test_contact_holds_them_apart(self):
        # The blow takes some ten steps: a quarter of the residual of 10 us.
        p = self.audit(testing.good_run(SCENE, {**TOUCHING, "time.step": "5 us"}), "touching", 0.005)
        self.assertGreater(max(p["audit.contact[J]"]), 0)
        apart = [math.dist(a, b) for a, b in zip(*(
            zip(*(p[f"{name}.com_{axis}[m]"] for axis in "xyz")) for name in ("lower", "upper")))]
        self.assertGreater(min(apart), 1e-3)

    def test_on_other_ranks_and_over_a_restart(self):
        whole = testing.good_run(SCENE, TOUCHING, "structure=1")
        divided = testing.good_run(SCENE, TOUCHING, "structure=2").probes()
        for name in ("upper.com_x[m]", "lower.com_z[m]", "audit.dipoles[J]"):
            self.assertLess(testing.difference(whole.probes(), divided, name), 1e-9, name)
        folder = Path(testing.new_folder())
        kept = {**TOUCHING, "checkpoint.every": "2 ms"}
        testing.good_run(SCENE, {**kept, "time.end": "5 ms"}, "structure=1", folder=folder)
        testing.finish(testing.start(
            [testing.BIN / "magfsi", "run", SCENE, "--out", folder, "--restart", "latest",
             "--ranks", "structure=1", *testing.overrides(kept)]), 0, folder, 300)
        self.assertEqual((whole.folder / "probes.csv").read_bytes(),
                         (folder / "probes.csv").read_bytes())

    def test_long_elements_are_refused_within_bodies(self):
        result = testing.finish(testing.start(
            [testing.BIN / "magfsi", "check", SCENE, *testing.overrides(
                {"dipoles.within_bodies": "true",
                 "bodies.lower.mesh.box.elements": "[6, 2, 2]"})]), 2, "", 120)
        self.assertIn("dipoles.within_bodies", result.out + result.err)


if __name__ == "__main__":
    unittest.main(verbosity=2)
