# SPDX-License-Identifier: GPL-2.0-or-later
"""A run in a fluid whose bodies pass through themselves, each other, an obstacle or a side of
the box ends with the name of both; with `overlap: allow` it goes on; what only comes near is
warned of."""

import json
import unittest
from pathlib import Path

from magfsi import surfaces, testing

QUIET = {"magnetic_field": "null", "bodies.robot.magnetization": "null", "gravity": "null"}
EXIT_DIVERGED = 3


def ramp(displacement, face="x_min"):
    return f"[{{face: {face}, ramp: {{displacement: {displacement}, duration: 4 ms}}}}]"


# All of the strip is driven: both ends alike.
def driven(displacement):
    return {**QUIET, "bodies.robot.prescribed_motion": ramp(displacement, "[x_min, x_max]")}


PLATE = ("{mesh: {box: {size: [1 mm, 1 mm, 0.5 mm], elements: [3, 3, 2]}}, "
         "material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}, "
         "clamps: [x_min], initial: {position: [4.1 mm, 2 mm, 3 mm]}}")
ONTO_PLATE = {**driven("[0 m, 0 m, -1 mm]"), "bodies.plate": PLATE}
# The strip's free end is bent by the field, through the clamped one.
CURLS = {"time.end": "12 ms", "gravity": "null",
         "magnetic_field.constant": "{magnitude: 60 mT, direction: 230 deg}"}


class Overlap(unittest.TestCase):
    def ends(self, settings, *words, ranks=None):
        run = testing.run(testing.SMALL, settings, ranks)
        self.assertEqual(run.code, EXIT_DIVERGED, run.err or run.out)
        testing.report(run.err.strip())
        for word in (*words, "after coupled step ", "element ", "coupling.overlap: allow"):
            self.assertIn(word, run.err)
        summary = json.loads((run.folder / "summary.json").read_text())
        self.assertEqual(summary["outcome"], "diverged")
        self.assertIn(words[0], summary["cause"])
        return run, summary

    def test_with_another_body(self):
        runs = [self.ends(ONTO_PLATE, "body 'plate' passes through body 'robot'",
                          ranks=f"structure={n},fluid=1") for n in (1, 2)]
        steps = [summary["steps"] for _, summary in runs]
        self.assertEqual(*steps)
        # The gap of 0.66 mm is closed after this much of 4 ms, and an element is 0.18 mm thick.
        self.assertIn("warning: step", (runs[0][0].folder / "run.log").read_text())

    def test_with_itself(self):
        self.ends(CURLS, "body 'robot' passes through itself")

    def test_with_an_obstacle(self):
        self.ends({**driven("[0 m, 0 m, -1 mm]"), "fluid.obstacles":
                   "{post: {sphere: {centre: [4 mm, 2 mm, 3 mm], diameter: 1 mm}}}"},
                  "body 'robot' passes into the obstacle 'post'")

    def test_with_an_obstacle_from_a_file(self):
        file = Path(testing.new_folder()) / "cube.stl"
        surfaces.write_stl(file, surfaces.block([3.6e-3, 1.6e-3, 2.5e-3], [4.4e-3, 2.4e-3, 3.4e-3]))
        self.ends({**driven("[0 m, 0 m, -1 mm]"),
                   "fluid.obstacles": f"{{cube: {{stl: {{file: {file}, unit: 1 m}}}}}}"},
                  "body 'robot' passes into the obstacle 'cube'")

    def test_with_a_side_of_the_box(self):
        self.ends({**driven("[0 m, 0 m, -1.6 mm]"),
                   "bodies.robot.initial.position": "[4.1 mm, 2 mm, 1.5 mm]"},
                  "body 'robot' passes into the side z_min of the fluid's box")

    def test_a_body_clamped_on_a_side_or_an_obstacle(self):
        plate = PLATE.replace("[x_min]", "[z_min]")
        step = "{step: {box: [[3 mm, 1 mm, 0 mm], [5 mm, 3 mm, 2.75 mm]]}}"
        for settings in ({"bodies.plate": plate.replace("3 mm]}", "0.25 mm]}")},
                         {"bodies.plate": plate, "fluid.obstacles": step}):
            run = testing.good_run(testing.SMALL, {**QUIET, **settings})
            self.assertNotIn("comes within", (run.folder / "run.log").read_text())

    def test_allowed(self):
        run = testing.good_run(testing.SMALL, {**ONTO_PLATE, "coupling.overlap": "allow"})
        self.assertNotIn("warning", (run.folder / "run.log").read_text())

    def test_what_only_comes_near_is_warned_of(self):
        run = testing.good_run(testing.SMALL, {
            **ONTO_PLATE, "time.end": "5 ms", "bodies.robot.prescribed_motion":
            ramp("[0 m, 0 m, -0.6 mm]", "[x_min, x_max]")})
        log = (run.folder / "run.log").read_text()
        self.assertEqual(log.count("comes within half a cell of body 'robot'"), 1, log)

    def test_a_body_held_by_an_obstacle(self):
        testing.good_run(testing.SMALL, {
            "bodies.robot.clamps": "[x_min]", "fluid.obstacles":
            "{post: {cylinder: {centre: [2 mm, 2 mm, 4 mm], diameter: 1 mm, axis: y}}}"})


if __name__ == "__main__":
    testing.main()
