# SPDX-License-Identifier: GPL-2.0-or-later
"""A block slides on a slab, body on body, as Coulomb's law says: x'' = g (sin a - mu cos a)."""
import math
import unittest
from pathlib import Path

import numpy as np
from magfsi import testing

SLIDE = Path(__file__).resolve().parent / "slide.yaml"
G, ANGLE = 9.81, math.radians(15)


class Sliding(unittest.TestCase):
    def test_coulombs_law(self):
        for friction in (0, 0.1, 0.2):
            p = testing.good_run(SLIDE, {"contact.friction": str(friction) if friction else "null"}).probes()
            time, speed = np.array(p["t[s]"]), np.array(p["block.speed_x[m/s]"])
            late = time >= 0.02
            slope = np.polyfit(time[late], speed[late], 1)[0]
            found = (G * math.sin(ANGLE) - slope) / (G * math.cos(ANGLE))
            testing.report(f"friction {friction}: the block slides as with {found:.3f}")
            # Two rigid lattices of such spacings, at rest, hold up to 0.03 to 0.1 of what presses them; in motion
            # most of it comes back.
            self.assertLess(abs(found - friction), 0.02)


if __name__ == "__main__":
    unittest.main()
