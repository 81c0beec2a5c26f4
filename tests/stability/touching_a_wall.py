# SPDX-License-Identifier: GPL-2.0-or-later
"""A magnetic sheet that touches a wall of the fluid's box, in a flow along it: no energy from
nowhere, all momentum and power arrive, no fluid is lost."""

import unittest

from magfsi import testing

AUDIT = {"probes.energy_audit": "true"}
PERIODIC = ("x_min", "x_max", "y_min", "y_max")


def boundaries(z_min):
    sides = ", ".join(f"{side}: periodic" for side in PERIODIC)
    return "{%s, z_min: %s, z_max: no_slip}" % (sides, z_min)


# A plane that carries the sheet where its surface touches the wall, half a cell above it,
# in a flow along it that starts at once.
TOUCHING = {**AUDIT, "time.end": "4 ms", "platform": "{point: [0 mm, 0 mm, 0.15 mm]}",
            "bodies.robot.initial.position": "[4.1 mm, 2 mm, 0.3 mm]",
            "fluid.boundaries": boundaries("no_slip"),
            "fluid.initial_velocity": "[0.2 m/s, 0 m/s, 0 m/s]"}


class TouchingAWall(unittest.TestCase):
    def test_under_flow(self):
        run = testing.good_run(testing.SMALL, TOUCHING)
        audit, probes = run.summary()["energy_audit"], run.probes()
        testing.report(f"touching a wall: {audit}")
        self.assertGreater(max(probes["audit.platform[J]"]), 0, "it never touched")
        self.assertGreater(probes["robot.com_x[m]"][-1] - probes["robot.com_x[m]"][0], 1e-4)
        self.assertLess(audit["gained"], 0.01)
        self.assertLess(audit["residual"], 0.01)
        testing.check_interface_balance(self, run, "touching a wall")
        mass = probes["mass[kg]"]
        self.assertLess(max(abs(m / mass[0] - 1) for m in mass), 1e-12)


if __name__ == "__main__":
    unittest.main()
