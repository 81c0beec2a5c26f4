# SPDX-License-Identifier: GPL-2.0-or-later
"""summary.json tells how well the immersed boundary holds: better with a stronger one, the same
on any ranks, and nothing of it without one."""

import unittest

from magfsi import testing

IB = "coupling.immersed_boundary."
PENALTY = {IB + "forcing": "penalty"}


def quality(settings=None, ranks="structure=1,fluid=1"):
    summary = testing.shared_run(testing.SMALL, settings, ranks).summary()
    boundary = summary["immersed_boundary"]
    testing.report(f"{settings} {ranks}: no-slip error {boundary['no_slip_error']:.4f}, "
                  f"leakage {boundary['leakage']:.4f}")
    return boundary


class BoundaryQuality(unittest.TestCase):
    def test_a_stronger_boundary_slips_and_leaks_less(self):
        weak, strong = quality({IB + "strength": 0.25}), quality(PENALTY)
        self.assertEqual(strong["samples"], 40)  # one a probe row
        self.assertLess(strong["no_slip_error"], 0.6 * weak["no_slip_error"])
        self.assertLess(strong["leakage"], 0.6 * weak["leakage"])
        # The sheet moves across itself, and so does its slip.
        self.assertAlmostEqual(strong["leakage"] / strong["no_slip_error"], 1, delta=0.3)

    def test_the_interface_is_audited_without_probes_of_the_fluid(self):
        run = testing.good_run(testing.SMALL, {
            "probes": "{every: 0.1 ms, bodies: [com], interface_balance: true}",
            "time.end": "0.4 ms"})
        testing.check_interface_balance(self, run, "no probe of the fluid")

    def test_the_same_on_any_ranks(self):
        one, four = quality(), quality(ranks="structure=2,fluid=2")
        self.assertEqual(one["markers"], four["markers"])
        for key in ("no_slip_error", "leakage", "marker_speed_m_s"):
            # Nodes of the neighbour rank are half a LAMMPS step behind in their velocity:
            # 2e-4 and 4e-4 were seen.
            self.assertAlmostEqual(four[key] / one[key], 1, delta=5e-3)

    def test_none_without_a_boundary(self):
        summary = testing.good_run(testing.SMALL, {
            "fluid": "", "bodies.robot.initial.position": "", "probes.fluid": "",
            "probes.bodies": "[com]", "probes.interface_balance": "", "time.end": "1 ms",
        }).summary()
        self.assertNotIn("immersed_boundary", summary)


if __name__ == "__main__":
    unittest.main()
