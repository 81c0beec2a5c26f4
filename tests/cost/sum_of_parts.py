#!/usr/bin/python3
"""What is predicted is the sum of what is asked, at the prices of the calibration; without one for
this machine nothing is."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import magfsi_runs as magfsi  # noqa: E402

CELL_S, MARKER_S, STEP_S = 1e-6, 5e-6, 1e-3
ELEMENT_S, SUBSTEP_S, MARKER_SUBSTEP_S = 2e-6, 3e-5, 4e-7
PRICES = {
    "fluid": [{"cells": 1000, "ranks": 1, "single_precision": False, "s_per_cell_step": CELL_S},
              {"cells": 100000, "ranks": 1, "single_precision": False,
               "s_per_cell_step": CELL_S}],
    "newton": [{"nodes": 100, "s_per_point": 0.01}, {"nodes": 1000, "s_per_point": 0.1}],
    "s_per_element_substep": ELEMENT_S, "s_per_substep": SUBSTEP_S,
    "s_per_marker_substep": MARKER_SUBSTEP_S, "s_per_marker_step": MARKER_S,
    "s_per_coupled_step": STEP_S, "s_per_coupled_step_shared": STEP_S,
    "s_per_cell_row": 0, "s_per_probe_row": 0, "s_per_cell_byte": 0, "s_per_element_file": 0,
    "fluid_bytes": 1e7, "lammps_bytes": 3e7, "newton_bytes": 2e7, "bytes_per_cell": 160,
    "bytes_per_cell_file": 20, "bytes_per_element": 1000, "newton_bytes_per_element": 2000,
    "bytes_per_marker": 3000, "structure_file_bytes": 1e6}


def explain(scene, settings=None, ranks="", as_json=True):
    words = [magfsi.BIN / "magfsi", "explain", scene, *magfsi.overrides(settings or {})]
    words += ["--ranks", ranks] if ranks else []
    done = subprocess.run([*words, *(["--json"] if as_json else [])], capture_output=True,
                          text=True, check=True)
    return json.loads(done.stdout) if as_json else done.stdout


class SumOfParts(unittest.TestCase):
    def setUp(self):
        cache = Path(magfsi.new_folder())
        os.environ["XDG_CACHE_HOME"] = str(cache)
        self.file = cache / "magfsi/calibration.json"
        self.file.parent.mkdir()

    def calibrate(self, **changed):
        known = explain(magfsi.SMALL)
        self.assertNotIn("predicted", known)
        self.file.write_text(json.dumps({"machine": known["machine"], "date": "today",
                                         "version": known["version"], **PRICES, **changed}))

    def test_coupled(self):
        self.calibrate()
        # small_swimmer: 160 steps of 6 substeps, 40 elements, 560 markers, 16384 cells.
        found = explain(magfsi.SMALL, ranks="structure=1,fluid=1")["predicted"]
        expected = 160 * (16384 * CELL_S + 560 * MARKER_S + STEP_S
                          + 6 * (SUBSTEP_S + 40 * ELEMENT_S + 560 * MARKER_SUBSTEP_S))
        self.assertAlmostEqual(found["wall_s"] / expected, 1, places=9)
        self.assertEqual(found["memory_bytes"],
                         {"structure": 3e7 + 40 * 1000 + 560 * 3000,
                          "fluid": 1e7 + 16384 * 160})
        text = explain(magfsi.SMALL, ranks="structure=1,fluid=1", as_json=False)
        self.assertRegex(text, r"time +3\.6 s \(structure .*, fluid .*, messages 0\.16 s\)")

    def test_path(self):
        """Through the two points of the prices goes a straight line; 228 nodes, 80 points."""
        self.calibrate()
        beam = magfsi.ROOT / "tutorials/beam"
        self.assertAlmostEqual(explain(beam)["predicted"]["wall_s"], 80 * 0.01 * 2.28, places=9)
        self.assertIsNone(explain(magfsi.ROOT / "tutorials/strip")["predicted"]["wall_s"])

    def test_a_path_that_ran_before(self):
        self.calibrate()
        beam = magfsi.ROOT / "tutorials/beam"
        first = magfsi.good_run(beam, {"probes.every": "100 ms", "output": "null"}).summary()
        self.assertIn("predicted", first)
        again = explain(beam, {"probes.every": "100 ms", "output": "null"})["predicted"]
        self.assertEqual(again["wall_s"], first["wall_s"])
        other = explain(beam, {"probes.every": "50 ms", "output": "null"})["predicted"]
        self.assertNotEqual(other["wall_s"], first["wall_s"])

    def test_of_another_machine_or_torn(self):
        self.calibrate(machine="another")
        self.assertNotIn("predicted", explain(magfsi.SMALL))
        self.assertIn("bench --calibrate", explain(magfsi.SMALL, as_json=False))
        self.file.write_text(self.file.read_text()[:100])
        self.assertNotIn("predicted", explain(magfsi.SMALL))


if __name__ == "__main__":
    unittest.main()
