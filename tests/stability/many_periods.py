# SPDX-License-Identifier: GPL-2.0-or-later
"""A swimmer beats for many periods, and two side by side in each other's wake: no mass of fluid
drifts away, no energy grows."""

import sys
import unittest

from magfsi import testing

PERIOD_MS = 40  # the paper's 25 Hz
# Between walls the swimmer is at the box's top or bottom after five to seven periods.
ENDLESS = {"fluid.boundaries": "{" + ", ".join(
    f"{axis}_{end}: periodic" for axis in "xyz" for end in ("min", "max")) + "}"}


def beat(periods, spacing, sides):
    field = ("{plane: xz, table: {time: [0 ms, 19.5 ms, 32 ms, 40 ms], magnitude: "
             "[-10 mT, 10 mT, -10 mT, -10 mT], direction: 75 deg, repeat: true}}")
    return testing.good_run(testing.SMALL, {
        "magnetic_field": field, "gravity": "", "time.end": f"{periods * PERIOD_MS} ms",
        **sides, "fluid.spacing": spacing, "fluid.lattice_speed": "0.1", "probes.every": "2 ms",
        "probes.energy_audit": "true"}, limit_s=3000)


# Their middles 3.4 mm apart, more than twice their width, in a box twice as wide as that of one.
TWO = {**ENDLESS, "fluid.box": "[8 mm, 8 mm, 8 mm]",
       "bodies.robot.initial.position": "[4.1 mm, 2.3 mm, 4 mm]",
       "bodies.second": f"{{{testing.STRIP}, magnetization: {{harmonic: {{amplitude: 62 kA/m, "
                        "wavelength: 3.7 mm, phase: 45 deg, along: x, into: z}}, "
                        "initial: {position: [4.1 mm, 5.7 mm, 4 mm]}}"}


class ManyPeriods(unittest.TestCase):
    def stays(self, periods, run):
        probes, summary = run.probes(), run.summary()
        audit = summary["energy_audit"]
        testing.report(f"{periods} periods: {audit}")
        mass = probes["mass[kg]"]
        drift = abs(mass[-1] / mass[0] - 1)
        # Rounding of some 1e4 to 1e5 cells, a random walk over 1e4 to 1e5 steps.
        self.assertLess(drift, 1e-11)
        self.assertLess(audit["residual"], 0.01)
        self.assertLess(audit["gained"], 0.01)
        # Of the whole, the most in any of the last periods against those before. One that meets its
        # own wake, or another's, does not beat alike in each: 1.08 after fifty periods.
        rows = PERIOD_MS // 2
        whole = [sum(parts) for parts in zip(probes["audit.kinetic[J]"], probes["audit.elastic[J]"],
                                             probes["audit.fluid_kinetic[J]"])]
        peaks = [max(whole[p * rows:(p + 1) * rows]) for p in range(1, periods)]
        half = len(peaks) // 2
        later = max(peaks[half:]) / max(peaks[:half])
        boundary = summary["immersed_boundary"]
        testing.report(f"peaks {peaks[0]:.3g} ... {peaks[-1]:.3g} J, later ones {later:.3f} of the "
                       f"first, mass drifts by {drift:.1e}; {boundary}")
        self.assertLess(later, 1.1)
        return boundary

    def test_mass_stays_and_energy_does_not_grow(self):
        periods, spacing = (100, "0.25 mm") if LONG else (6, "0.5 mm")
        self.stays(periods, beat(periods, spacing, ENDLESS))

    def test_two_swimmers(self):
        # Three periods tell that it runs; twelve that neither drives the other. They draw near, and
        # in the nineteenth the run ends where one would pass through the other.
        periods, spacing = (12, "0.25 mm") if LONG else (3, "0.5 mm")
        boundary = self.stays(periods, beat(periods, spacing, TWO))
        if LONG:  # at 0.5 mm the strip is three cells wide
            # Warned of from 5 % on; seen 1.0 and 0.7 %.
            self.assertLess(boundary["no_slip_error"], 0.03)
            self.assertLess(boundary["leakage"], 0.015)


if __name__ == "__main__":
    LONG = "--long" in sys.argv
    if LONG:
        sys.argv.remove("--long")
    unittest.main()
