#!/usr/bin/python3
"""The paper's mesh of the beam, 70 x 20 x 4 elements: what an equilibrium costs by Newton's
method, and that it is accurate. Slow, so by name only."""

import resource
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import beam  # noqa: E402
from beam import magfsi  # noqa: E402


def timed(settings):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    path, _ = beam.bend({"bodies.beam.mesh.box.elements": "[70, 20, 4]",
                         "bodies.beam.element": "full", **settings})
    return path, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


class FineBeam(unittest.TestCase):
    def test_single_equilibrium_is_quick(self):
        # Static, from the straight beam, at the paper's first loads: 20 s of one core. The
        # element is right on this mesh, whose error is below the reference's own.
        path, seconds = timed({"probes.every": "1 s",
                               "magnetic_field.table.magnitude": "[0 mT, 3.3 mT]"})
        error = path[-1][2] / 0.342595 - 1
        magfsi.report(f"gamma 0.001: {seconds:.1f} s, error {100 * error:+.2f} %")
        self.assertLess(seconds, 20)
        self.assertLess(abs(error), 0.01)

    def test_the_whole_path(self):
        path, seconds = timed({})
        error = beam.largest_error(path)
        magfsi.report(f"{len(path) - 1} equilibria: {seconds:.0f} s, "
                      f"uz within {100 * error:.2f} %")
        self.assertLess(error, 0.01)


if __name__ == "__main__":
    unittest.main()
