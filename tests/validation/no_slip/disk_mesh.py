# SPDX-License-Identifier: GPL-2.0-or-later
"""A disk of hexahedra around the z axis, one layer thick: a square whose sides bulge, and rings."""

import math

SIDES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def _plane(parts, rings):
    """Points of the unit disk and its quadrilaterals, counter-clockwise."""
    points, quads = {}, []

    def number(x, y):
        return points.setdefault((round(x, 9), round(y, 9)), len(points))

    def inner(u, v):  # half square, half round
        out = max(abs(u), abs(v))
        if out == 0:
            return 0.0, 0.0
        scale = 0.5 * (0.75 + 0.25 * math.sqrt(2) * out / math.hypot(u, v))
        return scale * u, scale * v

    def ring(side, i, j):
        angle = math.pi / 4 * (2 * i / parts - 1)
        u, v = inner(1, 2 * i / parts - 1)
        part = j / rings
        x = (1 - part) * u + part * math.cos(angle)
        y = (1 - part) * v + part * math.sin(angle)
        for _ in range(side):
            x, y = -y, x
        return number(x, y)

    def middle(i, j):
        return number(*inner(2 * i / parts - 1, 2 * j / parts - 1))

    for i in range(parts):
        for j in range(parts):
            quads.append((middle(i, j), middle(i + 1, j), middle(i + 1, j + 1), middle(i, j + 1)))
        for side in range(4):
            for j in range(rings):
                quads.append((ring(side, i, j), ring(side, i, j + 1), ring(side, i + 1, j + 1),
                              ring(side, i + 1, j)))
    return list(points), quads


def write(path, radius, thickness, parts=6, rings=3):
    """Its surface "all" has every node; the unit is the metre."""
    points, quads = _plane(parts, rings)
    below = len(points)
    elements = [(*q, *(n + below for n in q)) for q in quads]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat",
             "$PhysicalNames", "2", '3 1 "disk"', '2 2 "all"', "$EndPhysicalNames",
             "$Nodes", str(2 * below)]
    lines += [f"{n + 1} {radius * x:.12g} {radius * y:.12g} {z:.12g}" for n, (x, y, z) in
              enumerate((x, y, z) for z in (0, thickness) for x, y in points)]
    kinds = [("5 2 1 1", e) for e in elements]
    kinds += [("3 2 2 2", [e[n] for n in side]) for e in elements for side in SIDES]
    lines += ["$EndNodes", "$Elements", str(len(kinds))]
    lines += [f"{i + 1} {kind} " + " ".join(str(n + 1) for n in e)
              for i, (kind, e) in enumerate(kinds)]
    path.write_text("\n".join([*lines, "$EndElements", ""]))
