# SPDX-License-Identifier: GPL-2.0-or-later
"""What is predicted is the sum of what is asked, at the prices of the calibration; without one for
this machine nothing is."""

import json
import os
import subprocess
import unittest
from pathlib import Path

from magfsi import testing

CELL_S, MARKER_S, STEP_S = 1e-6, 5e-6, 1e-3
REGULARIZED_S, WALL_S, COUPLED_CELL_S = 2e-7, 4e-6, 3e-8
ELEMENT_S, SUBSTEP_S, MARKER_SUBSTEP_S, EXCHANGE_S = 2e-6, 3e-5, 4e-7, 1.5e-4
PRICES = {
    "fluid": [{"cells": 1000, "ranks": 1, "single_precision": False, "s_per_cell_step": CELL_S},
              {"cells": 100000, "ranks": 1, "single_precision": False,
               "s_per_cell_step": CELL_S}],
    "newton": [{"nodes": 100, "s_per_point": 0.01}, {"nodes": 1000, "s_per_point": 0.1}],
    "s_per_element_substep": ELEMENT_S, "s_per_substep": SUBSTEP_S,
    "s_per_substep_exchange": EXCHANGE_S, "s_per_marker_substep": MARKER_SUBSTEP_S, "s_per_marker_step": MARKER_S,
    "s_per_coupled_step": STEP_S, "s_per_coupled_step_shared": STEP_S,
    "s_per_coupled_cell": COUPLED_CELL_S, "s_per_coupled_cell_shared": 3 * COUPLED_CELL_S,
    "s_per_cell_regularized": REGULARIZED_S, "s_per_wall_cell": WALL_S,
    "s_per_cell_row": 0, "s_per_cell_enstrophy": 0,
    "s_per_probe_row": 0, "s_per_cell_byte": 0, "s_per_element_file": 0,
    "fluid_bytes": 1e7, "coupled_fluid_bytes": 1.5e7, "lammps_bytes": 3e7, "newton_bytes": 2e7, "bytes_per_cell": 160,
    "bytes_per_cell_file": 20, "bytes_per_cell_curl": 30, "bytes_per_element": 1000, "newton_bytes_per_element": 2000,
    "bytes_per_marker": 3000, "structure_file_bytes": 1e6}


# Counted below by hand: 560 markers.
PENALTY = {"coupling.immersed_boundary.forcing": "penalty"}


def explain(scene, settings=None, ranks="", as_json=True):
    settings = {**(PENALTY if scene == testing.SMALL else {}), **(settings or {})}
    words = [testing.BIN / "magfsi", "explain", scene, *testing.overrides(settings)]
    words += ["--ranks", ranks] if ranks else []
    done = subprocess.run([*words, *(["--json"] if as_json else [])], capture_output=True,
                          text=True, check=True)
    return json.loads(done.stdout) if as_json else done.stdout


class SumOfParts(unittest.TestCase):
    def setUp(self):
        cache = Path(testing.new_folder())
        os.environ["XDG_CACHE_HOME"] = str(cache)
        self.file = cache / "magfsi/calibration.json"
        self.file.parent.mkdir()

    def calibrate(self, **changed):
        known = explain(testing.SMALL)
        self.assertNotIn("predicted", known)
        self.file.write_text(json.dumps({"machine": known["machine"], "date": "today",
                                         "version": known["version"], **PRICES, **changed}))

    def test_coupled(self):
        self.calibrate()
        # small_swimmer: 160 steps of 6 substeps, 40 elements, 560 markers, 32 x 16 x 32 cells in
        # walls, of recursive_regularized.
        cells, walls = 32 * 16 * 32, 4 * 16 * 32 + 2 * 32 * 32
        found = explain(testing.SMALL, ranks="structure=1,fluid=1")["predicted"]
        expected = 160 * (cells * (CELL_S + REGULARIZED_S + COUPLED_CELL_S)
                          + walls * WALL_S + 560 * MARKER_S + STEP_S
                          + 6 * (SUBSTEP_S + 40 * ELEMENT_S + 560 * MARKER_SUBSTEP_S))
        self.assertAlmostEqual(found["wall_s"] / expected, 1, places=9)
        self.assertEqual(found["memory_bytes"],
                         {"structure": 3e7 + 40 * 1000 + 560 * 3000,
                          "fluid": 1.5e7 + 16384 * 160})
        text = explain(testing.SMALL, ranks="structure=1,fluid=1", as_json=False)
        self.assertRegex(text, r"time +6\.8 s \(structure .*, fluid .*, messages 0\.24 s\)")

    def test_more_ranks_than_cores(self):
        """A side that waits then takes time from the other: three times as much here."""
        self.calibrate()
        cores = os.cpu_count()
        found = [explain(testing.SMALL, ranks=f"structure={n},fluid=1")["predicted"]["wall_s"]
                 for n in (cores, cores - 1)]
        ranked = 160 * 6 * (40 * ELEMENT_S + 560 * MARKER_SUBSTEP_S) * (1 / (cores - 1) - 1 / cores)
        exchanged = 160 * 6 * EXCHANGE_S if cores == 2 else 0
        added = 160 * 32 * 16 * 32 * 2 * COUPLED_CELL_S
        self.assertAlmostEqual(found[0] - found[1], added - ranked + exchanged, places=9)

    def test_periodic_sides_and_other_collisions(self):
        self.calibrate()
        sides = "{" + ", ".join(f"{side}: periodic" for side in ("y_min", "y_max")) + "}"
        first, open_, plain = (explain(testing.SMALL, sets, ranks="structure=1,fluid=1")
                               ["predicted"]["wall_s"]
                               for sets in ({}, {"fluid.boundaries": sides},
                                            {"fluid.collision": "bgk"}))
        self.assertAlmostEqual(first - open_, 160 * 2 * 32 * 32 * WALL_S, places=9)
        self.assertAlmostEqual(first - plain, 160 * 32 * 16 * 32 * REGULARIZED_S, places=9)

    def test_path(self):
        """Through the two points of the prices goes a straight line; 228 nodes, 80 points."""
        self.calibrate()
        beam = testing.ROOT / "tutorials/beam"
        self.assertAlmostEqual(explain(beam)["predicted"]["wall_s"], 80 * 0.01 * 2.28, places=9)
        self.assertIsNone(explain(testing.ROOT / "tutorials/strip")["predicted"]["wall_s"])

    def test_memory_of_each_rank(self):
        self.calibrate()
        memory = [explain(testing.SMALL, ranks=f"structure=1,fluid={n}")["predicted"]
                  ["memory_bytes"]["fluid"] for n in (1, 2)]
        self.assertEqual(memory[1] - memory[0], 1.5e7)

    def test_memory_that_passes(self):
        """A vorticity needs the velocity of all cells, for files beside what is written."""
        self.calibrate()
        cells = 32 * 16 * 32
        files = "{fluid: {every: 1 ms, fields: [velocity%s]}}"

        def fluid(sets):
            return explain(testing.SMALL, sets, ranks="structure=1,fluid=1")["predicted"][
                "memory_bytes"]["fluid"]

        alone = fluid({})
        self.assertEqual(fluid({"probes.fluid": "[enstrophy]"}) - alone, 30 * cells)
        self.assertEqual(fluid({"output": files % ""}) - alone, 20 * cells)
        self.assertEqual(fluid({"output": files % ", vorticity"}) - alone, (20 + 30) * cells)

    def test_of_another_machine_or_torn(self):
        self.calibrate(machine="another")
        self.assertNotIn("predicted", explain(testing.SMALL))
        self.assertIn("bench --calibrate", explain(testing.SMALL, as_json=False))
        self.file.write_text(self.file.read_text()[:100])
        self.assertNotIn("predicted", explain(testing.SMALL))


if __name__ == "__main__":
    unittest.main()
