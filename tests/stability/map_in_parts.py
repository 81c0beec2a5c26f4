# SPDX-License-Identifier: GPL-2.0-or-later
"""Cells of the stability map: right where the map says so, stopped by name where a flow goes
wrong, and counted so."""

import subprocess
import sys
import unittest
from pathlib import Path

from magfsi import runs, testing

MAP = testing.ROOT / "tests/stability/map"
DRAW = testing.ROOT / "tests/stability/draw_map.py"


def study(name, out, **only):
    words = [word for axis, value in only.items() for word in ("--only", f"{axis}={value}")]
    subprocess.run([sys.executable, "-m", "magfsi.study", MAP / f"{name}.yaml", "--out", out / name, *words], check=True,
                   stdout=subprocess.DEVNULL)
    row, = runs.read_rows(out / name / "runs.csv")
    testing.report(f"{name} {only}: {row['verdict']} {row['cause']}")
    return row


class MapInParts(unittest.TestCase):
    def test_right_stopped_and_refused(self):
        out = Path(testing.new_folder())
        # A stream carries the sheet at 0.2 cells a step: its energy is in no frame's favour.
        low = {"relaxation_time": 0.501, "lattice_speed": 0.2}
        row = study("lattice", out, **low, collision="recursive_regularized")
        self.assertEqual(row["verdict"], "right")
        weak = study("boundary", out, strength=0.25)
        self.assertEqual(weak["verdict"], "right")
        refused = study("schemes", out, strength=4, scheme="implicit, aitken", kernel="3-point")
        self.assertEqual(refused["verdict"], "refused")
        page = subprocess.run([sys.executable, DRAW, out, "--out", out / "drawn"],
                              check=True, capture_output=True, text=True).stdout
        self.assertIn("| all | 3 | 2 | 0 | 1 | 0 |", page)
        self.assertTrue((out / "drawn/coupling.png").exists())

    def test_held_slow_and_rigid(self):
        out = Path(testing.new_folder())
        for name, cell in (
                ("held", {"relaxation_time": 0.69, "lattice_speed": 0.08, "kernel": "3-point",
                          "collision": "automatic", "cells": "uniform"}),
                ("slow", {"relaxation_time": 1, "ball": "rigid, 3-point"}),
                ("rigid", {"density_ratio": 8, "shape": "thin disk", "load": "turning field"})):
            self.assertEqual(study(name, out, **cell)["verdict"], "right")

    def test_a_body_at_rest_gains_no_energy(self):
        """A rigid body of the fluid's density: all that moves it is the lag of the fluid inside in the first step."""
        run = testing.good_run(testing.ROOT / "tests/scenes/rigid_body.yaml", {
            "bodies.body.material.density": "1000 kg/m3", "time.end": "5 ms"})
        z = run.probes()["body.com_z[m]"]
        testing.report(f"it moves by {abs(z[-1] - z[0]):.1e} m")
        # A ten-thousandth of a cell, and less than that of the way that it would fall without buoyancy.
        self.assertLess(abs(z[-1] - z[0]), 1e-4 * min(0.125e-3, 2 * 0.005**2 / 2))

    def test_energy_from_nowhere_ends_a_run(self):
        # Two relaxation times at this relaxation time do not damp what the stream feeds; the
        # speed is still within the lattice's limit when the audit ends the run.
        row = study("lattice", Path(testing.new_folder()), relaxation_time=0.503,
                    lattice_speed=0.1, collision="trt")
        self.assertEqual(row["verdict"], "diverged")
        self.assertIn("gained energy without a source", row["cause"])


if __name__ == "__main__":
    unittest.main()
