#!/usr/bin/python3
"""Accuracy that no study can promise is bad input, told at its place in the scene."""

import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import magfsi_runs as magfsi  # noqa: E402

BEAM = magfsi.ROOT / "tutorials/beam"
NO_ELEMENTS = {"bodies.beam.mesh.box.elements": "null"}
HARMONIC = {"bodies.beam.magnetization": "{harmonic: {amplitude: 62 kA/m}}"}
CASES = [
    ("beside elements", BEAM, {"accuracy.error": "3 %"}, "nothing to choose"),
    ("without a unit", BEAM, NO_ELEMENTS | {"accuracy.error": "3"}, "a share such as 3 %"),
    ("both", BEAM, NO_ELEMENTS | {"accuracy": "{error: 3 %, time: 1 s}"}, "exactly one of"),
    ("too accurate", BEAM, NO_ELEMENTS | {"accuracy.error": "0.01 %"},
     "as far as docs/accuracy/beam goes"),
    ("another magnetization", BEAM, NO_ELEMENTS | HARMONIC | {"accuracy.error": "3 %"},
     "body 'beam' with a magnetization that varies"),
    ("too strong", BEAM, NO_ELEMENTS | {"accuracy.error": "3 %",
                                        "magnetic_field.table.magnitude": "[0 mT, 1 T]"},
     "at most 0.04"),
    ("another scene", magfsi.SMALL, {"fluid.spacing": "null", "accuracy.error": "3 %"},
     "none of the studies covers"),
]


class IsRefused(unittest.TestCase):
    def test_with_its_reason(self):
        for name, scene, settings, said in CASES:
            with self.subTest(name):
                run = magfsi.run(scene, settings)
                self.assertEqual(run.code, 2, run.err)
                self.assertIn(said, run.err)
                self.assertEqual(len(run.err.strip().splitlines()), 1)
                self.assertFalse((run.folder / "summary.json").exists())

    def test_without_the_launcher(self):
        """A participant knows no studies."""
        done = subprocess.run([magfsi.BIN / "magfsi-equilibrium", BEAM, "--out",
                               magfsi.new_folder(), "--set", "accuracy.error=3 %", "--set",
                               "bodies.beam.mesh.box.elements=null"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("magfsi run, check and explain", done.stderr)


if __name__ == "__main__":
    unittest.main()
