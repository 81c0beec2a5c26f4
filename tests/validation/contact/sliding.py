# SPDX-License-Identifier: GPL-2.0-or-later
"""A block slides on a slab, body on body, as Coulomb's law says: x'' = g (sin a - mu cos a), and
stays where mu is above tan a."""
import math
import unittest
from pathlib import Path

import numpy as np
from magfsi import testing

SLIDE = Path(__file__).resolve().parent / "slide.yaml"
G, ANGLE = 9.81, math.radians(15)
WEIGHT_N = 3000 * 2.25e-9 * G
# Takes the hops of a block that is let go on the slab.
CALM = {f"bodies.{body}.material.viscosity": "20 Pa s" for body in ("slab", "block")}


class Sliding(unittest.TestCase):
    def slide(self, friction, **more):
        run = testing.good_run(SLIDE, {"contact.friction": str(friction) if friction else "null",
                                       "probes.energy_audit": "true", **more})
        return run.summary()["energy_audit"], {c: np.array(v) for c, v in run.probes().items()}

    def test_coulombs_law(self):
        for friction in (0, 0.1, 0.2, 0.25):
            audit, p = self.slide(friction)
            late = p["t[s]"] >= 0.02
            slope = np.polyfit(p["t[s]"][late], p["block.speed_x[m/s]"][late], 1)[0]
            found = (G * math.sin(ANGLE) - slope) / (G * math.cos(ANGLE))
            testing.report(f"friction {friction}: the block slides as with {found:.3f}, {audit}")
            # Two rigid lattices of such spacings, at rest, hold up to 0.03 to 0.1 of what presses them; in motion
            # most of it comes back.
            self.assertLess(abs(found - friction), 0.02)
            # Velocity Verlet at the kinks of the contact's force.
            self.assertLess(audit["residual"], 1e-3)
            self.assertLess(audit["gained"], 1e-3)
            if friction:
                lost = p["audit.lost_friction[J]"]
                self.assertTrue((np.diff(lost) >= 0).all())
                way = p["block.com_x[m]"]
                share = (lost[-1] - lost[late][0]) / (friction * WEIGHT_N * math.cos(ANGLE)
                                                      * (way[-1] - way[late][0]))
                testing.report(f"friction {friction}: of mu N times the way {share:.3f} is lost")
                self.assertLess(abs(share - 1), 0.06)  # nodes also rub as they hop

    # tan(15 deg) is 0.268.
    def test_stays_below_its_angle(self):
        audit, p = self.slide(0.3, **CALM)
        way, speed = p["block.com_x[m]"], p["block.speed_x[m/s]"]
        testing.report(f"friction 0.3: the block has gone {way[-1] - way[0]:.3g} m when it stands, then goes at "
                       f"{speed[-1]:.2g} m/s, {audit}")
        late = p["t[s]"] >= 0.03
        self.assertLess(np.ptp(way[late]), 1e-7)  # of 60 mm/s times 30 ms without friction: 1.8 mm
        self.assertLess(abs(speed[-1]), 1e-6)
        self.assertLess(audit["gained"], 1e-3)
        # Hops that nothing damps but friction: less than the 29 mm/s that a drag without memory lets it creep.
        audit, p = self.slide(0.3)
        creep = np.polyfit(p["t[s]"][late], p["block.com_x[m]"][late], 1)[0]
        testing.report(f"friction 0.3, hopping: {creep:.2g} m/s, {audit}")
        self.assertLess(abs(creep), 5e-4)

    # The springs are in the checkpoint: without them the block would go on sliding a little.
    def test_goes_on_over_a_restart_and_on_other_ranks(self):
        rough = {"contact.friction": "0.3", "time.end": "20 ms"}
        whole = testing.good_run(SLIDE, rough, "structure=1")
        folder = Path(testing.new_folder())
        testing.good_run(SLIDE, {**rough, "time.end": "10 ms", "checkpoint.every": "10 ms"}, "structure=1",
                         folder=folder)
        testing.finish(testing.start(
            [testing.BIN / "magfsi", "run", SLIDE, "--out", folder, "--restart", "latest", "--ranks", "structure=1",
             *testing.overrides({**rough, "checkpoint.every": "10 ms"})]), 0, folder, 600)
        self.assertEqual((whole.folder / "probes.csv").read_bytes(), (folder / "probes.csv").read_bytes())
        divided = testing.good_run(SLIDE, {**rough, "time.end": "10 ms"}, "structure=2").probes()
        alone = {c: v[:len(divided["t[s]"])] for c, v in whole.probes().items()}
        # Hops make a hundred thousand times as much of a rounding.
        self.assertLess(testing.difference(alone, divided, "block.com_x[m]"), 1e-9)


if __name__ == "__main__":
    unittest.main()
