# SPDX-License-Identifier: GPL-2.0-or-later
"""What a design file may not ask for: one line with the place, exit code 2, nothing written."""
import unittest

from designs import Strip, called, folder_with, letter, run, write_curve
from magfsi import testing

STRIP = Strip(elements=(20, 2, 1))
TEXT = """scene: scene.yaml
poses:
  s:
    field: [0 mT, 0 mT, 20 mT]
    curve: {file: s.csv}
magnetization: {strength: 60 kA/m, plane: xz}
"""


class Refused(unittest.TestCase):
    def refused(self, text, *words, line=None, scene=STRIP.text, start=called):
        folder = folder_with(scene_yaml=scene, design_yaml=text)
        points = STRIP.line(letter(1.0))
        write_curve(folder / "s.csv", points if line is None else line(points))
        done = start(folder / "design.yaml", "--out", folder / "out")
        testing.check_refused(self, done)
        for word in words:
            self.assertIn(word, done.err)
        self.assertFalse((folder / "out").exists())

    def test_curve_of_the_wrong_length(self):
        """By a process of its own, too, as a shell starts it."""
        for start in (called, run):
            self.refused(TEXT, "design.yaml:5:19", "a curve 24 mm long", "20 mm", line=lambda p: 1.2 * p,
                         start=start)

    def test_curve_that_begins_elsewhere(self):
        self.refused(TEXT, "design.yaml:5:19", "out of reach", line=lambda p: p + [0, 0, 5e-3])

    def test_place_out_of_reach(self):
        self.refused(TEXT.replace("curve: {file: s.csv}", "points: [{at: [20 mm, 2 mm, 0.2 mm], "
                                  "to: [10 mm, 2 mm, 20 mm]}]"), "design.yaml:5:14", "out of reach")

    def test_point_outside_of_the_body(self):
        self.refused(TEXT.replace("curve: {file: s.csv}", "points: [{at: [24 mm, 2 mm, 0.2 mm], "
                                  "to: [10 mm, 2 mm, 12 mm]}]"), "design.yaml:5:14", "outside of the body")

    def test_no_field(self):
        self.refused(TEXT.replace("    field: [0 mT, 0 mT, 20 mT]\n", ""), 'no "field"')
        self.refused(TEXT.replace("20 mT", "0 mT"), "design.yaml:4:12", "a field of zero")

    def test_no_goal(self):
        self.refused(TEXT.replace("    curve: {file: s.csv}\n", ""), "no goal")

    def test_unknown_key(self):
        self.refused(TEXT + "quantise: 4\n", "design.yaml:7:1", '"quantise"')

    def test_no_curve_file(self):
        self.refused(TEXT.replace("s.csv", "t.csv"), "design.yaml:5:19", "t.csv", "cannot be read")

    def test_scene_that_is_wrong(self):
        self.refused(TEXT, "scene.yaml:", "clamp", scene=STRIP.text.replace("x_min", "x_low"))

    def test_regions_that_are_not_there(self):
        self.refused(TEXT.replace("plane: xz", "by: region"), "design.yaml:6:", "without regions")

    def test_unit(self):
        self.refused(TEXT.replace("60 kA/m", "60 mT"), "design.yaml:6:27", "a strength such as 60 kA/m")


if __name__ == "__main__":
    unittest.main()
