# SPDX-License-Identifier: GPL-2.0-or-later
"""A checkpoint is that of the cells and nodes, not of the ranks: gone on with on others, the run
ends where it would have, within rounding."""

import unittest

import scenes
from scenes import COUPLED, EVERY, FLUID, REFINED, RIGID, RIGID_PARTS, STRUCTURE, testing

# Sums over ranks differ by some 1e-16, and 40 steps of the swimmer, or 1000 of the strip on its
# platform, where nodes touch and slide, magnify that: 1e-12 was seen.
BOUND = 1e-9
# The quasi-Newton columns of nearly converged iterations hold little but rounding: two whole runs on
# these ranks differ by 2e-9 in the force after 2 ms, by 2e-6 (6e-6 with the penalty) after 4 ms.
IMPLICIT_BOUND = 1e-8
# The fluid's populations are the same to the last bit on any ranks; only its sums differ, most
# of all the lift, a small difference of large forces: 1e-13 was seen.
FLUID_BOUND = 1e-11


class OtherRanks(unittest.TestCase):
    def close(self, scene, settings, end, ranks, new_ranks, bound):
        whole = scenes.good(scene, settings, testing.new_folder(), ranks)
        parts = scenes.interrupted(scene, settings, end, ranks, new_ranks)
        found = testing.worst_difference(whole.probes(), parts.probes())
        testing.report(f"{ranks} -> {new_ranks}: {found[0]:.1e} in {found[1]}")
        self.assertLess(found[0], bound)

    def test_swimmer_on_more(self):
        self.close(testing.SMALL, COUPLED, "1.375 ms", "structure=1,fluid=1",
                   "structure=2,fluid=3", BOUND)

    def test_swimmer_on_fewer(self):
        self.close(testing.SMALL, COUPLED, "1.375 ms", "structure=3,fluid=2",
                   "structure=1,fluid=1", BOUND)

    def test_swimmer_in_the_implicit_scheme(self):
        for forcing, bound in ("penalty", BOUND), ("no_slip", IMPLICIT_BOUND):
            self.close(testing.SMALL, {**COUPLED, "coupling.scheme": "implicit",
                                       "coupling.immersed_boundary.forcing": forcing}, "1.375 ms",
                       "structure=2,fluid=3", "structure=1,fluid=1", bound)

    def test_swimmer_in_a_refined_grid(self):
        self.close(testing.SMALL, REFINED, "1.375 ms", "structure=1,fluid=1",
                   "structure=2,fluid=3", BOUND)

    def test_solid(self):
        self.close(EVERY, STRUCTURE, "7.2 ms", "structure=1", "structure=3", BOUND)

    def test_rigid_parts(self):
        self.close(RIGID, RIGID_PARTS, "7.2 ms", "structure=1", "structure=3", BOUND)

    def test_solid_with_contact_on_as_many(self):
        self.close(EVERY, STRUCTURE, "7.2 ms", "structure=3", "structure=3", BOUND)

    def test_fluid(self):
        self.close(testing.SMALL, FLUID, "1.375 ms", "fluid=1", "fluid=4", FLUID_BOUND)


if __name__ == "__main__":
    unittest.main()
