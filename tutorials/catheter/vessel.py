# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes vessel.stl: a block with a round hole along x, a little longer than the box of the scene [mm]."""
import pathlib

from magfsi import surfaces

RADIUS, OUTER, ENDS, SIDES = 2.5, 3.2, (-1, 17), 48

if __name__ == "__main__":
    surfaces.write_stl(pathlib.Path(__file__).resolve().parent / "vessel.stl",
                       surfaces.block_with_hole(surfaces.same_area(RADIUS, SIDES), OUTER, ENDS, SIDES))
