# SPDX-License-Identifier: GPL-2.0-or-later
"""A thick beam of Gent's rubber in bending against the finite elements of quadratic_solid.py, which
know nothing of the lattice; and what the stiffening changes."""

import unittest
from functools import cache
from pathlib import Path

import numpy as np

from magfsi import testing
from quadratic_solid import Block, Solver

SCENE = Path(__file__).resolve().parent / "thick_rubber.yaml"
LENGTH, SIDE, G, LIMIT = 12e-3, 4e-3, 33e3, 0.3
FIELDS_T = (0.05, 0.1, 0.15, 0.2)


@cache
def solid(cells, gent):
    """Displacements (x, z) of the middle of the free end, and the largest share of the limit, at
    each field. Cells are finer towards the clamp."""
    along = LENGTH * np.linspace(0, 1, cells[0] + 1)**1.5
    block = Block(along, SIDE, SIDE, cells[1], cells[2], G, 20 * G, 1860, gent)
    clamp = np.flatnonzero(block.rest[:, 0] < 1e-12)
    charges = block.charges(lambda points: np.broadcast_to([62e3, 0, 0], points.shape))
    solver = Solver(block, charges, [3 * n + d for n in clamp for d in range(3)])
    tip = block.node(LENGTH, 0, 0)
    x, rows, share = block.rest, [], 0.0
    for field in FIELDS_T:
        x = solver.solve(x, [0, 0, field])
        rows.append((x[tip] - block.rest[tip])[[0, 2]])
        f = np.einsum("ead,eqak->eqdk", x[block.nodes], block.slopes)
        share = max(share, ((f**2).sum((2, 3)).max() - 3) / LIMIT)
    return np.array(rows), share


class ThickRubber(unittest.TestCase):
    def lattice(self, settings=None):
        probes = testing.good_run(SCENE, settings or {}).probes()
        return np.column_stack([probes["tip_ux[m]"], probes["tip_uz[m]"]])[1:]

    def test_coarse_elements_bend_alike(self):
        """Bricks twice as large, and finite elements that are 0.25 % off: within the same bound."""
        right, _ = solid((8, 2, 3), LIMIT)
        neo_hookean, _ = solid((6, 1, 2), None)
        size = np.linalg.norm(right, axis=1)
        error = np.linalg.norm(self.lattice({"bodies.beam.mesh.box.elements": "[12, 4, 4]"}) - right, axis=1) / size
        changed = np.linalg.norm(neo_hookean - right, axis=1) / size
        testing.report(f"lattice of [12, 4, 4] bricks {100 * error.max():.2f} %, without stiffening "
                       f"{100 * changed.max():.1f} %")
        self.assertGreater(changed.max(), 0.03)
        self.assertLess(error.max(), 0.01)

    def test_bends_as_converged_finite_elements(self):
        coarse, _ = solid((8, 2, 3), LIMIT)
        right, share = solid((10, 2, 4), LIMIT)
        neo_hookean, _ = solid((6, 1, 2), None)
        size = np.linalg.norm(right, axis=1)
        error = np.linalg.norm(self.lattice() - right, axis=1) / size
        converged = np.linalg.norm(coarse - right, axis=1) / size
        changed = np.linalg.norm(neo_hookean - right, axis=1) / size
        testing.report(f"deflection {right[-1, 1] / LENGTH:.3f} L, {100 * share:.0f} % of the limit; "
                       f"lattice {100 * error.max():.2f} %, coarse finite elements "
                       f"{100 * converged.max():.2f} %, without stiffening "
                       f"{100 * changed.max():.1f} %")
        self.assertGreater(changed.max(), 0.03)
        self.assertLess(converged.max(), 0.005)
        self.assertLess(error.max(), 0.01)


if __name__ == "__main__":
    unittest.main(verbosity=2)
