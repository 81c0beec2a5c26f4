# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of a design is drawn for a bent block, with an arrow for each cross-section."""
import sys
import unittest
from types import SimpleNamespace

import numpy as np

from magfsi import testing
from magfsi.design import page
from magfsi.design.mesh_file import boundary, gmsh_text, thickened
from magfsi.design.objective import Points, PoseObjective
from magfsi.design.program import Design
from magfsi.design.search import Step


def block(count=12, length_m=0.02, width_m=4e-3, height_m=4e-4):
    """Rest positions and elements of a row of bricks, as a Program has them."""
    s = np.linspace(0, length_m, count + 1)
    y, z = np.array([0, width_m]), np.array([0, height_m])
    rest = np.array([[a, b, c] for c in z for b in y for a in s])
    number = np.arange(len(rest)).reshape(2, 2, count + 1)
    elements = [[int(number[k, j, i + e]) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
                for e in range(count)]
    centres = rest[np.array(elements)].mean(axis=1)
    facts = {"element_nodes": elements, "body": "strip", "regions": ["near", "far"],
             "region": [0] * (count // 2) + [1] * (count - count // 2),
             "faces": {"x_min": number[:, :, 0].ravel().tolist()}}
    return SimpleNamespace(rest=rest, centres=centres, facts=facts, volumes=np.full(count, 1.0))


class Page(unittest.TestCase):
    def test_is_drawn(self):
        program = block()
        x = program.rest.copy()
        angle = program.rest[:, 0] / 0.02
        radius = 0.02 - program.rest[:, 2]
        x[:, 0], x[:, 2] = radius * np.sin(angle), 0.02 - radius * np.cos(angle)
        nodes = np.array([[i, i + 13, i + 26, i + 39] * 2 for i in range(13)])
        term = Points(nodes, np.full((13, 8), 0.125), x[nodes].mean(axis=1), 1.0, 0.02, True)
        pose = PoseObjective([term])
        m = np.full((12, 3), 3e4) * [1, 0, -1]
        design = Design(m, np.array([0.01, 0, 0.01]))
        problem = SimpleNamespace(
            program=program, length_m=0.02, magnetization=SimpleNamespace(strength=6e4),
            wanted=SimpleNamespace(poses=[SimpleNamespace(name="c")],
                                   magnetization=SimpleNamespace(axes=(0, 2))))
        search = SimpleNamespace(poses=[pose], history=[Step(0.5, 1e-2, 1, 1, 0, 1.0), Step(1, 1e-3, 1, 1, 0, 2.0)],
                                 unknowns=SimpleNamespace(designs=lambda p: [design]))
        facts = {"name": "c", "poses": {"c": {"error": 1e-3, "field_t": [0.01, 0, 0.01], "reached_by_rise": True,
                                              "followed_by_the_field": 1.0}},
                 "directions": 1, "vectors": 1, "largest_turn_deg_per_mm": 0.0, "unknowns": 24, "null_space": 3,
                 "seconds": 2.0}
        picture = page.figure(problem, search, SimpleNamespace(p=None, x=[x]), facts)
        self.assertTrue(picture.startswith(b"\x89PNG"))
        text = page.assemble(problem, search, facts, picture)
        self.assertIn("0.1 %", text)
        # A magnetisation turns with its element: at the end by one radian.
        places, arrows = page._sections(problem, m, x, [0, 2], 12)
        turned = np.arctan2(arrows[-1, 1], arrows[-1, 0]) - np.arctan2(-1, 1)
        self.assertAlmostEqual(turned, 1.0 - 0.5 / 12, delta=0.01)

    def test_mesh_file(self):
        program = block()
        self.assertEqual(len(boundary(np.array(program.facts["element_nodes"]))), 4 * 12 + 2)
        nodes = thickened(program, [1.0, 2.0])
        self.assertAlmostEqual(np.ptp(nodes[:, 2]), 8e-4)
        self.assertAlmostEqual(np.ptp(nodes[program.rest[:, 0] < 5e-3, 2]), 4e-4)
        text = gmsh_text(program, nodes)
        self.assertIn('2 3 "x_min"', text)
        self.assertIn("$Elements\n13\n", text)
        testing.report(f"{len(text)} bytes")


if __name__ == "__main__":
    sys.exit(unittest.main())
