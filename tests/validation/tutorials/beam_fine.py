# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's mesh of the beam, 70 x 20 x 4 elements: what an equilibrium costs by Newton's
method, and that it is accurate. Slow, so by name only."""

import resource
import unittest

import beam
from beam import testing


def timed(settings):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    path, _ = beam.bend({"bodies.beam.mesh.box.elements": "[70, 20, 4]",
                         "bodies.beam.element": "full", **settings})
    return path, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


class FineBeam(unittest.TestCase):
    def check(self, gamma, end, wanted):
        # Static, from the straight beam in a single step of the load: 20 s of one core.
        # One percent of the reference, which is converged to 0.1 %, as for every load.
        path, seconds = timed({"probes.every": "1 s",
                               "magnetic_field.table.magnitude": f"[0 mT, {end}]"})
        error = path[-1][2] / wanted - 1
        testing.report(f"gamma {gamma:g}: {seconds:.1f} s, error {100 * error:+.2f} %")
        self.assertLess(seconds, 20)
        self.assertLess(abs(error), 0.01)

    def test_single_equilibrium_is_quick(self):
        wanted = {float(row["gamma"]): float(row["uz_tip/L"]) for row in beam.reference()}
        self.check(0.001, "3.3 mT", wanted[0.001])
        self.check(0.04, "132 mT", wanted[0.04])

    def test_the_whole_path(self):
        path, seconds = timed({})
        error = beam.largest_error(path)
        testing.report(f"{len(path) - 1} equilibria: {seconds:.0f} s, "
                      f"uz within {100 * error:.2f} %")
        self.assertLess(error, 0.01)


if __name__ == "__main__":
    unittest.main()
