# SPDX-License-Identifier: GPL-2.0-or-later
"""Bars and cubes of a few cells, held in a creeping stream through a periodic box, against obstacles of
the same size on a finer grid, whose walls are interpolated: another boundary of the same fluid."""

import random
import unittest
from pathlib import Path

from magfsi import testing

BOX, SPACING = 8.0, 0.5  # mm
SCENE = """
name: bars
time: {{end: 1.2 s}}
fluid:
  box: [{box} mm, {box} mm, {depth} mm]
  spacing: {spacing} mm
  density: 1000 kg/m3
  viscosity: 10 mm2/s
  expected_speed: 20 mm/s
  body_force: {force}
  boundaries: {{x_min: periodic, x_max: periodic, y_min: periodic, y_max: periodic,
               z_min: periodic, z_max: periodic}}
probes: {{every: 0.4 s, fluid: [momentum]}}
"""
BODY = """
bodies:
  bar:
    mesh: {{box: {{size: {size}, elements: [3, 3, 3]}}}}
    # Nothing strains; soft, so that few substeps are needed.
    material: {{shear_modulus: 1 kPa, lame_lambda: 2 kPa, density: 1000 kg/m3}}
    clamps: [x_min, x_max, y_min, y_max, z_min, z_max]
    initial: {{position: {place}}}
coupling: {{immersed_boundary: {{forcing: no_slip, kernel: 3-point}}}}
"""


def mm(values):
    return "[" + ", ".join(f"{v} mm" for v in values) + "]"


def momentum(axis, depth, finer, more):
    """Of the fluid at the end, along the stream, for the obstacle or the body that `more` describes."""
    force = ["0 N/m3"] * 3
    force[axis] = "20 N/m3"
    scene = Path(testing.new_folder()) / "bars.yaml"
    text = SCENE.format(box=BOX, depth=depth, spacing=SPACING / finer, force="[" + ", ".join(force) + "]")
    if "bodies" in more:
        text += more
    else:
        text = text.replace("  boundaries:", more + "  boundaries:")
    scene.write_text(text)
    return testing.good_run(scene).probes()[f"momentum_{'xyz'[axis]}[kg m/s]"][-1]


class Bars(unittest.TestCase):
    def at(self, cells):
        """Size, place and depth of the box; a size of None goes on through the fluid."""
        size = [SPACING * (cell or 2) for cell in cells]
        depth = BOX if cells[2] else size[2]
        place = [0.5 * BOX + SPACING * at for at in self.places[:2]]
        place.append(0.5 * depth + (SPACING * self.places[2] if cells[2] else 0))
        return size, place, depth

    def marked(self, cells, axes):
        """Momentum in streams along these axes with markers."""
        size, place, depth = self.at(cells)
        body = BODY.format(size=mm(size), place=mm(place))
        return [momentum(axis, depth, 1, body) for axis in axes]

    def streams(self, cells, axes):
        """The same, and over that with an obstacle."""
        size, place, depth = self.at(cells)
        corners = [[x + side * s / 2 for x, s in zip(place, size)] for side in (-1, 1)]
        obstacle = f"  obstacles: {{bar: {{box: [{mm(corners[0])}, {mm(corners[1])}]}}}}\n"
        marked = self.marked(cells, axes)
        # Of a square one the obstacle is alike in all streams, too.
        exact = [momentum(axis, depth, 3 if cells[2] else 4, obstacle)
                 for axis in (axes[:1] if cells[0] == cells[1] else axes)] * len(axes)
        ratios = [value / other for value, other in zip(marked, exact)]
        testing.report(f"{cells} cells: over the obstacle's "
                       + ", ".join(f"{'xyz'[axis]} {ratio:.4f}" for axis, ratio in zip(axes, ratios)))
        return marked, ratios

    def setUp(self):
        # Off the grid's own symmetries, as it happens, but alike in x, y and z.
        self.places = [random.Random(self.id()).random()] * 3

    def test_a_square_bar_is_alike_in_both_streams(self):
        along, across = self.marked([3, 3, None], (0, 1))
        self.assertAlmostEqual(along / across, 1, delta=1e-10)

    def test_square_bars_are_as_thick_as_obstacles(self):
        # 0.1 cells of width are 7 % of this flow at 2 cells, 4 % at 3; a single line of markers is as
        # thick as its kernel makes it.
        for cells, within in ((1.4, 0.08), (3, 0.05)):
            _, ratios = self.streams([cells, cells, None], (0, 1))
            self.assertAlmostEqual(ratios[0] / ratios[1], 1, delta=1e-10)
            self.assertLess(abs(ratios[0] - 1), within)

    def test_a_cube_is_alike_in_all_streams(self):
        marked, ratios = self.streams([3, 3, 3], (0, 2, 1))
        self.assertLess(max(marked) / min(marked) - 1, 1e-10)
        self.assertLess(abs(ratios[0] - 1), 0.05)

    def test_bars_wider_than_thick(self):
        # Rows at distances that did not fit the width let up to 22 % more through.
        for cells in ([3, 3.3, None], [4.4, 6.2, None], [5, 8, None]):
            for ratio in self.streams(cells, (0, 1))[1]:
                self.assertLess(abs(ratio - 1), 0.06)
        for ratio in self.streams([2, 5, None], (0, 1))[1]:
            self.assertLess(abs(ratio - 1), 0.08)


if __name__ == "__main__":
    unittest.main()
