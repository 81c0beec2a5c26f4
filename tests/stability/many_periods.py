# SPDX-License-Identifier: GPL-2.0-or-later
"""A swimmer beats for many periods: no mass of fluid drifts away, no energy grows."""

import sys
import unittest

from magfsi import testing

PERIOD_MS = 40  # the paper's 25 Hz
# Between walls the swimmer is at the box's top after seven periods.
ENDLESS = {"fluid.boundaries": "{" + ", ".join(
    f"{axis}_{end}: periodic" for axis in "xyz" for end in ("min", "max")) + "}"}


def beat(periods, spacing, sides):
    field = ("{plane: xz, table: {time: [0 ms, 19.5 ms, 32 ms, 40 ms], magnitude: "
             "[-10 mT, 10 mT, -10 mT, -10 mT], direction: 75 deg, repeat: true}}")
    return testing.good_run(testing.SMALL, {
        "magnetic_field": field, "gravity": "", "time.end": f"{periods * PERIOD_MS} ms",
        **sides, "fluid.spacing": spacing, "fluid.lattice_speed": "0.1", "probes.every": "2 ms",
        "probes.energy_audit": "true"}, limit_s=3000)


class ManyPeriods(unittest.TestCase):
    def test_mass_stays_and_energy_does_not_grow(self):
        periods, spacing, sides = (100, "0.25 mm", ENDLESS) if LONG else (6, "0.5 mm", {})
        run = beat(periods, spacing, sides)
        probes, audit = run.probes(), run.summary()["energy_audit"]
        testing.report(f"{periods} periods: {audit}")
        mass = probes["mass[kg]"]
        drift = abs(mass[-1] / mass[0] - 1)
        # Rounding of some 1e4 to 1e5 cells, a random walk over 1e4 to 1e5 steps.
        self.assertLess(drift, 1e-11)
        self.assertLess(audit["residual"], 0.01)
        self.assertLess(audit["gained"], 0.01)
        # Of the whole, the most in any of the last periods against those before.
        rows = PERIOD_MS // 2
        whole = [sum(parts) for parts in zip(probes["audit.kinetic[J]"], probes["audit.elastic[J]"],
                                             probes["audit.fluid_kinetic[J]"])]
        peaks = [max(whole[p * rows:(p + 1) * rows]) for p in range(1, periods)]
        half = len(peaks) // 2
        testing.report(f"peaks {peaks[0]:.3g} ... {peaks[-1]:.3g} J, mass drifts by {drift:.1e}")
        self.assertLess(max(peaks[half:]), 1.1 * max(peaks[:half]))


if __name__ == "__main__":
    LONG = "--long" in sys.argv
    if LONG:
        sys.argv.remove("--long")
    unittest.main()
