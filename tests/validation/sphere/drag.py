# SPDX-License-Identifier: GPL-2.0-or-later
"""The drag of a ball of markers, held still in a stream, is that of a solid sphere.

The box is narrow to be cheap, 4 x 4 diameters, and the stream fast, so its drag is not that of the
unbounded stream. What is compared is the same sphere as an obstacle with interpolated walls in the
same box at the same spacing and step; of that one the drag in an unbounded stream is known to agree
with the reference to 0.7, 0.1 and 0.3 % at Reynolds numbers 20, 100 and 200
(fluid_sphere_drag_long).
"""

import argparse
import math
import sys
import unittest
from pathlib import Path

from magfsi import testing

import ball_mesh

SCENE = Path(__file__).resolve().parent / "drag.yaml"
DIAMETER, SPEED, DENSITY = 1e-3, 0.02, 1000
SOLID = {"bodies": "", "probes.bodies": "", "probes.fluid": "[obstacle_force]",
         "fluid.obstacles.ball.sphere": "{centre: [2.02 mm, 2 mm, 2 mm], diameter: 1 mm}"}


def coefficient(cells, settings, column):
    folder = testing.new_folder()
    scene = Path(folder) / "drag.yaml"
    scene.write_text(SCENE.read_text())
    ball_mesh.write(Path(folder) / "ball.msh", ball_mesh.ball(8, 3, DIAMETER), hold=True)
    run = testing.good_run(scene, {"fluid.spacing": f"{1 / cells} mm", **settings}, limit_s=1500)
    force = run.probes()[column]
    tail = len(force) // 20  # some sound is left in the box
    return (sum(force[-tail:]) / tail
            / (0.5 * DENSITY * SPEED**2 * math.pi / 4 * DIAMETER**2))


PENALTY = {"coupling.immersed_boundary.forcing": "penalty"}
NO_SLIP = {"coupling.immersed_boundary.forcing": "no_slip",
           "coupling.immersed_boundary.kernel": "3-point"}


def error(cells, settings, boundary):
    """Of the markers against the obstacle."""
    ball = coefficient(cells, {**boundary, **settings}, "ball.fluid_force_x[N]")
    solid = coefficient(cells, {**SOLID, **settings}, "ball.force_x[N]")
    testing.report(f"{settings or 'Reynolds number 20'}, {cells} cells a diameter: drag "
                  f"coefficient {ball:.4f}, solid {solid:.4f}, {100 * (ball / solid - 1):+.2f} %")
    return ball / solid - 1


class Quick(unittest.TestCase):
    def test_reynolds_20(self):
        # Markers sit 0.4 cells below the surface, where viscous flow sees a ball of the right
        # size; the smeared surface adds drag, and the slip that the penalty leaves takes some off:
        # 0.1 cells of the radius is 2.5 % of the drag.
        for cells in (6, 8):
            self.assertLess(abs(error(cells, {}, PENALTY)), 0.05)

    # The depth of its markers comes from the theory of the lattice for plane walls
    # (no_slip/lattice_response.py), nothing from balls.
    def test_reynolds_20_without_slip(self):
        self.assertLess(abs(error(8, {}, NO_SLIP)), 0.02)

    def test_reynolds_20_without_slip_on_six_cells(self):
        self.assertLess(abs(error(6, {}, NO_SLIP)), 0.02)


class Held(unittest.TestCase):
    """Reynolds numbers 4 to 20. Where the density that goes with the pressure in the ball was left
    out of what passes a marker, it fell without end from a lattice speed of 0.08 on."""

    def holds(self, lattice_speed, viscosity):
        with self.subTest(lattice_speed=lattice_speed, viscosity=viscosity):
            held = error(8, {"fluid.viscosity": viscosity, "fluid.lattice_speed": lattice_speed},
                         NO_SLIP)
            # As at Reynolds number 20 above, and the depth of the markers, 0.05 cells of 4.
            self.assertLess(abs(held), 0.03)

    def test_at_reynolds_10(self):
        self.holds(0.08, "2 mm2/s")

    def test_at_relaxation_times_from_a_half_to_one(self):
        for lattice_speed in (0.08, 0.12):
            for viscosity in ("1 mm2/s", "2 mm2/s", "5 mm2/s"):
                self.holds(lattice_speed, viscosity)


def without_slip(reynolds, cells=8):
    """Drag of markers and of the solid on a coarse grid, over the solid's own limit: by the second
    order of its walls from this grid and one twice as fine."""
    def of_solid(n):
        return coefficient(n, {**SOLID, **settings, "fluid.lattice_speed": speed * cells / n
                               if reynolds < 10 else speed, "fluid.collision": collision},
                           "ball.force_x[N]")
    # A relaxation time of at most 1; one collision for both grids, whose order is that of walls:
    # the automatic one of the coarse grid.
    speed = min(0.08, reynolds / cells / 6)
    collision = "trt" if reynolds < 50 else "recursive_regularized"
    settings = {"fluid.viscosity": f"{1e6 * SPEED * DIAMETER / reynolds} mm2/s",
                "fluid.lattice_speed": speed, "time.end": "0.2 s" if reynolds < 10 else "0.8 s"}
    coarse, fine = of_solid(cells), of_solid(2 * cells)
    limit = fine + (fine - coarse) / 3
    markers = coefficient(cells, {**NO_SLIP, **settings}, "ball.fluid_force_x[N]")
    testing.report(f"Reynolds number {reynolds}, {cells} cells: markers {markers:.4f}, solid "
                   f"{coarse:.4f}, twice as fine {fine:.4f}; limit {limit:.4f}: markers "
                   f"{100 * (markers / limit - 1):+.1f} %, solid {100 * (coarse / limit - 1):+.1f} %")
    return markers / limit - 1, coarse / limit - 1


class Long(unittest.TestCase):
    def test_without_slip(self):
        # The layer at the front is a diameter over sqrt(Re): 1.8 cells at 20, 0.65 at 150.
        for reynolds, allowed, of_solid in (
                (1, 0.03, 0.03), (20, 0.03, 0.03), (50, 0.03, 0.03), (100, 0.05, 0.06),
                (150, 0.08, 0.08), (200, 0.11, 0.12)):
            markers, solid = without_slip(reynolds)
            self.assertLess(abs(markers), allowed)
            self.assertLess(abs(solid), of_solid)
            if reynolds >= 50:  # the wall of an obstacle loses more on such a grid
                self.assertLess(abs(markers), abs(solid))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--long", action="store_true")
    known, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *(rest or (["Long"] if known.long else ["Quick", "Held"]))], verbosity=2)
