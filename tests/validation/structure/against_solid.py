# SPDX-License-Identifier: GPL-2.0-or-later
"""The strip clamped at both ends and the V that swings, against the finite elements of
quadratic_solid.py; and these against those of strip_harmonic.csv, of another program."""

import csv
import math
import unittest
from pathlib import Path

import numpy as np

import solid_cases
from magfsi import testing
from quadratic_solid import Solver

HERE = Path(__file__).resolve().parent
ELEMENTS = "bodies.strip.mesh.box.elements"
EVERY = 1  # 3: the lightest and the heaviest alone


def rows(name):
    with open(HERE / name, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def finest(name, **wanted):
    """The last row with these values: meshes are written from coarse to fine."""
    found = [r for r in rows(name) if all(float(r[k]) == v for k, v in wanted.items())]
    return found[-1]


class Solid(unittest.TestCase):
    def test_says_what_another_program_says(self):
        other = next(r for r in rows("strip_harmonic.csv") if r["source"] == "fem3D 40x4x2"
                     and float(r["theta_B_deg"]) == 45 and float(r["B_mT"]) == 20)
        same = next(r for r in rows("solid_free.csv") if r["cells"] == "40x4x2"
                    and float(r["theta_B_deg"]) == 45 and float(r["B_mT"]) == 20)
        for ours, theirs in (("end_to_end/L", "end_to_end/L"),
                             ("middle_section_deg", "mid_angle_deg")):
            testing.report(f"{ours}: {same[ours]}, another program {other[theirs]}")
            self.assertAlmostEqual(float(same[ours]) / float(other[theirs]), 1, delta=1e-4)

    def test_gives_its_table(self):
        solid = solid_cases.block((20, 2, 1))
        charges = solid.charges(solid_cases.magnetization)
        middle = solid.node(solid_cases.LENGTH / 2, 0, 0)
        load = solid_cases.field(1, 45)
        x = Solver(solid, charges, (3 * middle, 3 * middle + 2)).solve(solid.rest, load)
        squares, _ = Solver(solid, charges).frequencies(x, load, number=4)
        row = rows("solid_free.csv")[0]
        shape = solid_cases.Shape(solid, x)
        self.assertAlmostEqual(shape.end_to_end, float(row["end_to_end/L"]), delta=1e-5)
        self.assertAlmostEqual(math.sqrt(squares[2]) / (2 * math.pi),
                               float(row["frequency_1_Hz"]), delta=2e-3)


class ClampedStrip(unittest.TestCase):
    def compare(self, elements, weight_g, limit):
        run = testing.good_run(HERE / "clamped_strip.yaml", {
            ELEMENTS: elements, "gravity.acceleration": f"{9.81 * weight_g} m/s2"})
        self.assertNotIn("released", run.out + run.err)
        probes = run.probes()
        row = finest("solid_clamped.csv", weight_g=weight_g)
        for point in ("middle", "edge"):
            error = probes[f"{point}_uz[m]"][-1] / 0.185e-3 / float(row[f"{point}_uz/H"]) - 1
            testing.report(f"{elements}, {weight_g} g: {point} {100 * error:+.2f} %")
            self.assertLess(abs(error), limit)

    def test_settles_as_finite_elements_with_one_layer(self):
        # What the elements leave in bending, and the reference's own 0.2 %.
        for weight_g in (1, 3, 10, 30)[::EVERY]:
            self.compare("[20, 8, 1]", weight_g, 0.01)
            self.compare("[40, 8, 1]", weight_g, 0.01)

    def test_settles_too_little_with_two_layers(self):
        # A clamp lets no material give way across: true within a tenth of the thickness, while
        # elements have it over their whole length, of half a thickness here and a quarter.
        self.compare("[40, 8, 2]", 1, 0.04)
        self.compare("[80, 8, 2]", 1, 0.02)


class SwingingV(unittest.TestCase):
    def frequency_hz(self, settings):
        """The lowest, of the heading's part that swings."""
        probes = testing.good_run(HERE / "swinging_v.yaml", settings).probes()
        heading = np.unwrap(np.arctan2(
            np.subtract(probes["right_z[m]"], probes["left_z[m]"]),
            np.subtract(probes["right_x[m]"], probes["left_x[m]"])))
        times = np.array(probes["t[s]"])

        def left_over(hz):
            waves = [f(2 * np.pi * hz * times) for f in (np.cos, np.sin)]
            table = np.column_stack([*waves, np.ones_like(times)])
            return np.linalg.norm(heading - table @ np.linalg.lstsq(table, heading, rcond=None)[0])

        rates = np.arange(20, 35, 0.01)
        return rates[np.argmin([left_over(hz) for hz in rates])]

    def test_swings_as_often_as_finite_elements(self):
        right = float(finest("solid_free.csv", theta_B_deg=45, B_mT=20)["frequency_1_Hz"])
        for elements, limit in (("[20, 8, 1]", 0.015), ("[40, 8, 1]", 0.02),
                                ("[20, 8, 2]", 0.01)):
            for inertia in ("lumped", "corrected"):
                found = self.frequency_hz({ELEMENTS: elements, "bodies.strip.inertia": inertia})
                testing.report(f"{elements}, {inertia}: {found:.2f} Hz, finite elements "
                              f"{right:.2f}: {100 * (found / right - 1):+.2f} %")
                self.assertAlmostEqual(found / right, 1, delta=limit)


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
