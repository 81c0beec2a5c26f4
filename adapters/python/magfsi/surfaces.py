# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed surfaces of triangles, for obstacles, vessels and robots from STL files. A triangle is three
points, counter-clockwise as seen from outside."""
import math
import struct


def write_stl(file, triangles):
    """A binary STL file, in the triangles' unit."""
    triangles = list(triangles)
    data = bytes(80) + struct.pack("<I", len(triangles))
    for triangle in triangles:
        data += struct.pack("<12f", 0, 0, 0, *(x for point in triangle for x in point)) + bytes(2)
    file.write_bytes(data)


def _halves(*quads):
    for a, b, c, d in quads:
        yield a, b, c
        yield a, c, d


def block(low, high):
    """Between opposite corners."""
    corner = [[(low, high)[i >> a & 1][a] for a in range(3)] for i in range(8)]
    quads = (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)
    return list(_halves(*([corner[i] for i in quad] for quad in quads)))


def same_area(radius, sides):
    """Where the corners are of a regular polygon that has the circle's area."""
    return radius * math.sqrt(2 * math.pi / sides / math.sin(2 * math.pi / sides))


def block_with_hole(corners_at, half_width, ends, sides):
    """A square block around the x axis with a hole along it, a polygon whose corners have this
    distance from the axis."""
    angles = [2 * math.pi * k / sides for k in range(sides)]
    ring = [(math.cos(a), math.sin(a)) for a in angles]
    inner = [(corners_at * y, corners_at * z) for y, z in ring]
    outer = [(half_width * y / max(abs(y), abs(z)), half_width * z / max(abs(y), abs(z)))
             for y, z in ring]
    begin, end = ends
    for k in range(sides):
        i, j, o, p = inner[k - 1], inner[k], outer[k - 1], outer[k]
        yield from _halves(((end, *i), (begin, *i), (begin, *j), (end, *j)),
                           ((begin, *o), (end, *o), (end, *p), (begin, *p)),
                           ((end, *i), (end, *j), (end, *p), (end, *o)),
                           ((begin, *i), (begin, *o), (begin, *p), (begin, *j)))
