# SPDX-License-Identifier: GPL-2.0-or-later
"""Each kind of goal and of unknown once, on a small strip: the design is found, and the scene that it
writes does the same by Newton's method."""
import json
import sys
import unittest

import numpy as np

import magfsi
from designs import Strip, folder_with
from magfsi import testing

STRIP = Strip(elements=(20, 2, 1))
REGIONS = "    regions: {near: {box: [[0 mm, 0 mm, 0 mm], [10 mm, 4 mm, 1 mm]]}, " \
          "far: {box: [[10 mm, 0 mm, 0 mm], [20 mm, 4 mm, 1 mm]]}}\n"
FILE = """name: kind
scene: scene.yaml
poses:
  one: {{field: {field}, {goals}}}
magnetization: {{strength: {strength} kA/m, plane: xz{more}}}
{rest}
"""
TIP = "points: [{at: [20 mm, 2 mm, 0.2 mm], to: [13 mm, 2 mm, 13 mm]}]"
# The goals are met to a thousandth of the length; the scene has nine digits of the design.
WITHIN = 2e-3


class Kinds(unittest.TestCase):
    def designed(self, goals, field="[0 mT, 0 mT, 20 mT]", more="", rest="", scene=STRIP.text, strength=20,
                 tip="[20 mm, 2 mm, 0.2 mm]"):
        """(folder, figures, last row of the probes of the scene that was written)."""
        folder = folder_with(scene_yaml=scene, design_yaml=FILE.format(
            goals=goals, field=field, more=more, rest=rest, strength=strength))
        done = magfsi.design(folder / "design.yaml", out=folder / "out")
        testing.report(f"{self.id().split('.')[-1]}: {done.text.splitlines()[0]}")
        self.assertLess(done.summary["poses"]["one"]["error"], WITHIN)
        self.assertTrue(done.summary["poses"]["one"]["reached_by_rise"])
        run = testing.good_run(folder / "out/scene.yaml", {
            "probes": "{every: 100 ms, bodies: [reaction_force], "
                      f"points: {{tip: {{body: strip, at: {tip}}}}}}}"})
        return folder / "out", done.summary, {name: values[-1] for name, values in run.probes().items()}

    def tip_is_there(self, row):
        tip = np.array([row[f"tip_{axis}[m]"] for axis in "xz"])
        self.assertLess(np.linalg.norm(tip - [13e-3, 13e-3]), WITHIN * STRIP.length_m)

    def test_point(self):
        _, _, row = self.designed(TIP, more=", mirror: y")
        self.tip_is_there(row)

    def test_given_strength(self):
        """Only the directions are free."""
        out, _, row = self.designed(TIP, more=", free: direction, constant_along: [y, z], smoothing: 2 mm",
                                  strength=2)
        table = np.loadtxt(out / "magnetization.csv", delimiter=",", skiprows=1)
        self.assertLess(np.abs(np.linalg.norm(table[:, 3:], axis=1) / 2e3 - 1).max(), 0.01)
        self.tip_is_there(row)

    def test_opening(self):
        """Of an arc of a quarter of a circle that is held at one end: a finger that closes."""
        arc = STRIP.text.replace("{box: {size: [20.0 mm, 4.0 mm, 0.4 mm],",
                                 "{arc: {radius: 10 mm, angle: 90 deg, section: [4 mm, 0.4 mm],")
        self.assertIn("arc", arc)
        _, _, row = self.designed("opening: {between: [[-7.07 mm, 0 mm, -7.07 mm], [7.07 mm, 0 mm, -7.07 mm]], "
                                  "distance: 10 mm}", scene=arc, tip="[7.07 mm, 0 mm, -7.07 mm]")
        away = np.hypot(row["tip_x[m]"] + 7.07e-3, row["tip_z[m]"] + 7.07e-3)
        self.assertAlmostEqual(away, 10e-3, delta=WITHIN * STRIP.length_m)

    def test_force(self):
        """Of a strip that is held at both ends, on what holds the far one."""
        _, facts, row = self.designed("force: {face: x_max, direction: [0, 0, 1], force: 0.1 mN}",
                                      scene=STRIP.text.replace("[x_min]", "[x_min, x_max]"))
        name = next(name for name in row if "x_max" in name and "_z" in name)
        # The force of the body on the support; the probe has that of the support on the body.
        self.assertAlmostEqual(-row[name], 1e-4, delta=1e-3 * 1e-4)

    def test_regions_stiffness_and_field(self):
        """One vector in each half, and the field's direction is free."""
        _, facts, row = self.designed(
            TIP, field="[0 mT, 0 mT, 20 mT], free: direction", more=", by: region",
            rest="stiffness: {regions: [far], range: [0.5, 2]}",
            scene=STRIP.text.replace("    clamps:", REGIONS + "    clamps:"))
        self.assertEqual(facts["unknowns"], 7)
        self.tip_is_there(row)

    def test_thickness(self):
        out, facts, row = self.designed(
            TIP, more=", by: region", rest="thickness: {regions: [near, far], range: [0.7, 1.4]}",
            scene=STRIP.text.replace("    clamps:", REGIONS + "    clamps:"))
        self.assertTrue((out / "mesh.msh").exists())
        self.tip_is_there(row)


if __name__ == "__main__":
    sys.exit(unittest.main())
