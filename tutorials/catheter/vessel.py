# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes vessel.stl: a block with a round hole along x, a little longer than the box of the scene [mm]."""
import math
import pathlib
import struct

RADIUS, OUTER, ENDS, SIDES = 2.5, 3.2, (-1, 17), 48


def triangles():
    # The polygon that has the circle's area.
    hole = RADIUS * math.sqrt(2 * math.pi / SIDES / math.sin(2 * math.pi / SIDES))
    angles = [2 * math.pi * k / SIDES for k in range(SIDES)]
    ring = [(math.cos(a), math.sin(a)) for a in angles]
    inner = [(hole * y, hole * z) for y, z in ring]
    outer = [(OUTER * y / max(abs(y), abs(z)), OUTER * z / max(abs(y), abs(z))) for y, z in ring]
    begin, end = ENDS
    for k in range(SIDES):
        i, j, o, p = inner[k - 1], inner[k], outer[k - 1], outer[k]
        for a, b, c, d in (((end, *i), (begin, *i), (begin, *j), (end, *j)),
                           ((begin, *o), (end, *o), (end, *p), (begin, *p)),
                           ((end, *i), (end, *j), (end, *p), (end, *o)),
                           ((begin, *i), (begin, *o), (begin, *p), (begin, *j))):
            yield a, b, c
            yield a, c, d


def main():
    corners = list(triangles())
    data = bytes(80) + struct.pack("<I", len(corners))
    for triangle in corners:
        data += struct.pack("<12f", 0, 0, 0, *(x for corner in triangle for x in corner)) + bytes(2)
    (pathlib.Path(__file__).resolve().parent / "vessel.stl").write_bytes(data)


if __name__ == "__main__":
    main()
