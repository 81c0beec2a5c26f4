# SPDX-License-Identifier: GPL-2.0-or-later
"""A plate starts to heave in a closed box of water: the sound of its start, which water's viscosity would keep for
half a minute, is gone from its force within a bulk viscosity's time, and the flow is what it was."""
import re
import unittest

import numpy as np

from magfsi import runs, testing

PLATE = testing.ROOT / "tests/openfoam/strip.yaml"
SETTINGS = {"time.end": "60 ms", "fluid.spacing": "0.16666666666667 mm", "output": "null"}
BEGIN_S, MEAN_S = 20e-3, 2e-3  # after three crossings of the box and more; a 25th of a period


def force(settings):
    """(time, force along z, both from BEGIN_S on, the second as deviation and mean of MEAN_S)."""
    probes = testing.good_run(PLATE, {**SETTINGS, **settings}).probes()
    t, f = (np.array(probes[name]) for name in ("t[s]", "plate.fluid_force_z[N]"))
    n = round(MEAN_S / (t[1] - t[0])) | 1
    mean = np.convolve(f, np.ones(n) / n, "same")
    kept = (t >= BEGIN_S) & (t <= t[-1] - MEAN_S)
    return t[kept], (f - mean)[kept], f[kept]


class Sound(unittest.TestCase):
    def test_of_a_start_is_damped_and_the_work_is_kept(self):
        value = re.search(r"fluid.bulk_viscosity: (\S+ \S+) in", runs.explain(PLATE, SETTINGS)).group(1)
        found = {}
        for name, settings in (("without", {}), ("with", {"fluid.bulk_viscosity": value})):
            t, wiggles, whole = force(settings)
            share = wiggles.std() / whole.std()
            speed = 0.5e-3 * 2 * np.pi * 25 * np.sin(2 * np.pi * 25 * t)
            found[name] = share, np.mean(whole * speed)
            testing.report(f"{name} a bulk viscosity of {value}: wiggles {100 * share:.2f} % rms of the force")
        (before, work_before), (after, work_after) = found["without"], found["with"]
        testing.report(f"power of the force changes by {100 * (work_after / work_before - 1):+.2f} %")
        self.assertGreater(before, 0.08)  # there is something to damp
        # The curvature of the force itself within a mean of 2 ms is 0.4 % of it, 4 % of its third harmonic.
        self.assertLess(after, 0.03)
        # One hundredth is what the lattice's compression leaves (docs/fluid.md).
        self.assertAlmostEqual(work_after / work_before, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
