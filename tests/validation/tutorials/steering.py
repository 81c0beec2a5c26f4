# SPDX-License-Identifier: GPL-2.0-or-later
"""The steered strip stays where its controller is to hold it, and goes where it is to go; without the
controller it does neither."""
import unittest

import numpy as np
from magfsi import testing

STEERING = testing.ROOT / "tutorials/steering"
HELD_S, HELD_M = 0.2, 6e-3
THERE_M = 6.5e-3
WITHIN_M = 0.2e-3  # asked for


class Steering(unittest.TestCase):
    def course(self, settings):
        probes = testing.good_run(STEERING, {"output": "null", **settings}, limit_s=600).probes()
        return [np.array(probes[name]) for name in ("t[s]", "strip.com_x[m]", "strip.com_z[m]")]

    def test_is_held_and_goes_to_a_point(self):
        time, x, z = self.course({})
        held = time <= HELD_S * (1 + 1e-9)
        off = [np.abs(c[held] - HELD_M).max() for c in (x, z)]
        end = [abs(c[-1] - THERE_M) for c in (x, z)]
        testing.report(f"held within {1e3 * off[0]:.3f} mm in x and {1e3 * off[1]:.3f} mm in z for "
                       f"{HELD_S} s; at the end {1e3 * end[0]:.3f} and {1e3 * end[1]:.3f} mm from where "
                       "it is to be")
        self.assertLess(max(off), WITHIN_M)
        self.assertLess(max(end), WITHIN_M)

    def test_alone_it_leaves(self):
        """In the constant field that would carry what the controller believes in: cos 56 degrees is
        cos 47 degrees, which carries the strip, over 1.22."""
        _, x, z = self.course({"control": "null", "time.end": "200 ms",
                               "magnetic_field.constant.direction": "-34 deg"})
        testing.report(f"alone it is {1e3 * abs(z[-1] - HELD_M):.2f} mm off after 0.2 s")
        self.assertGreater(abs(z[-1] - HELD_M), 2 * WITHIN_M)


if __name__ == "__main__":
    unittest.main()
