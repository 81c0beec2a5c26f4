# SPDX-License-Identifier: GPL-2.0-or-later
"""A ball of hexahedra as a Gmsh file: a cube in the middle, six shells around it."""

import itertools
import math


def _unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


class _Mesh:
    def __init__(self):
        self.nodes, self.number, self.elements = [], {}, []

    def node(self, x):
        key = tuple(round(c, 9) for c in x)
        if key not in self.number:
            self.nodes.append(x)
            self.number[key] = len(self.nodes)
        return self.number[key]

    def add(self, corners):
        """Corners in Gmsh's order, turned over if left-handed."""
        a, b, d, e = (corners[i] for i in (0, 1, 3, 4))
        u, v, w = ([q[i] - a[i] for i in range(3)] for q in (b, d, e))
        det = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
               + u[2] * (v[0] * w[1] - v[1] * w[0]))
        if det < 0:
            corners = corners[4:] + corners[:4]
        self.elements.append([self.node(c) for c in corners])

    def volume(self):
        """Of the trilinear elements, by 2 x 2 x 2 Gauss points."""
        total, g = 0.0, 1 / math.sqrt(3)
        signs = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1),
                 (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
        for element in self.elements:
            x = [self.nodes[n - 1] for n in element]
            for p in itertools.product((-g, g), repeat=3):
                j = [[0.0] * 3 for _ in range(3)]
                for s, at in zip(signs, x):
                    f = [1 + s[i] * p[i] for i in range(3)]
                    for d in range(3):
                        slope = s[d] / 8 * f[(d + 1) % 3] * f[(d + 2) % 3]
                        for c in range(3):
                            j[c][d] += at[c] * slope
                total += (j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1])
                          - j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0])
                          + j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]))
        return total


def inflated(x):
    """Of a square or cube with corners at 1, whose middle stays: grown round towards its sides, which
    meet the layers around it."""
    out = max(abs(c) for c in x)
    if out == 0:
        return x
    round_ = [0.6 * out * c for c in _unit(x)]
    return [(1 - 0.5 * out) * 0.45 * a + 0.5 * out * b for a, b in zip(x, round_)]


def ball(parts, layers, diameter):
    """parts: elements along an edge of the cube; layers: of each shell. Of the volume of
    the ball, though its surface is made of flat pieces."""
    mesh = _Mesh()
    t = [math.tan(math.pi / 4 * (2 * i / parts - 1)) for i in range(parts + 1)]

    def block(at, n):
        for i, j, k in itertools.product(range(n[0]), range(n[1]), range(n[2])):
            mesh.add([at(i + a, j + b, k + c) for c in (0, 1)
                      for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])

    block(lambda i, j, k: inflated([t[i], t[j], t[k]]), (parts,) * 3)
    for axis, side in itertools.product(range(3), (-1, 1)):
        def shell(i, j, k, axis=axis, side=side):
            x = [0.0] * 3
            x[axis], x[(axis + 1) % 3], x[(axis + 2) % 3] = side, t[i], t[j]
            s = k / layers
            return [(1 - s) * a + s * b for a, b in zip(inflated(x), _unit(x))]
        block(shell, (parts, parts, layers))
    scale = (math.pi / 6 * diameter**3 / mesh.volume()) ** (1 / 3)
    mesh.nodes = [[scale * c for c in x] for x in mesh.nodes]
    return mesh


SIDES = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def write(path, mesh, hold=False):
    """hold: with the surface "all", which has every node, to clamp the ball by."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    if hold:
        lines += ["$PhysicalNames", "2", '3 1 "ball"', '2 2 "all"', "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(mesh.nodes))]
    lines += [f"{i + 1} {x:.12g} {y:.12g} {z:.12g}" for i, (x, y, z) in enumerate(mesh.nodes)]
    kinds = [("5 2 1 1", e) for e in mesh.elements]
    if hold:
        kinds += [("3 2 2 2", [e[n] for n in side]) for e in mesh.elements for side in SIDES]
    lines += ["$EndNodes", "$Elements", str(len(kinds))]
    lines += [f"{i + 1} {kind} " + " ".join(map(str, e)) for i, (kind, e) in enumerate(kinds)]
    path.write_text("\n".join([*lines, "$EndElements", ""]))
