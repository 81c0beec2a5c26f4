# SPDX-License-Identifier: GPL-2.0-or-later
"""Hexahedra of a swimmer: a cylinder along x with rounded edges, and a helix of round wire that begins in it
and ends in a ball."""

import itertools
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "sphere"))
import ball_mesh  # noqa: E402

UNIT = 1e-6  # in which nodes are told apart


def disc(across, rim):
    """Cells of a disc of radius 1: a square of `across` x `across` in the middle, `rim` layers around it."""
    t = [math.tan(math.pi / 4 * (2 * i / across - 1)) for i in range(across + 1)]

    def layer(axis, side, i, k):
        x = [side, t[i]] if axis == 0 else [t[i], side]
        return [(1 - k / rim) * a + k / rim * b / math.hypot(*x) for a, b in zip(ball_mesh.inflated(x), x)]

    def cells(at, n):
        return [[at(i + a, j + b) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                for i, j in itertools.product(range(n[0]), range(n[1]))]

    quads = cells(lambda i, j: ball_mesh.inflated([t[i], t[j]]), (across, across))
    for axis, side in itertools.product((0, 1), (-1, 1)):
        quads += cells(lambda i, k: layer(axis, side, i, k), (across, rim))
    return quads


def sweep(mesh, quads, stations, place):
    for a, b in itertools.pairwise(stations):
        for quad in quads:
            mesh.add([[c / UNIT for c in place(s, p)] for s in (a, b) for p in quad])


def head(mesh, radius, length, rounded, spacing):
    ends = [rounded * share for share in (0, 0.1, 0.3, 0.6)]
    parts = round((length - 2 * rounded) / spacing)
    middle = [rounded + (length - 2 * rounded) * i / parts for i in range(parts + 1)]

    def place(x, p):
        inside = max(0.0, rounded - min(x, length - x))
        r = radius - rounded + math.sqrt(rounded**2 - inside**2)
        return x, r * p[0], r * p[1]
    sweep(mesh, disc(8, 3), [*ends, *middle, *(length - x for x in reversed(ends))], place)


def tail(mesh, coil, pitch, wire, turns, begin, spacing):
    """Left-handed, from x = begin and the side of y."""
    a_turn = math.hypot(2 * math.pi * coil, pitch)

    def place(turn, p):
        w = 2 * math.pi * turn
        out = (0, math.cos(w), -math.sin(w))
        across = (2 * math.pi * coil / a_turn, pitch / a_turn * math.sin(w), pitch / a_turn * math.cos(w))
        inside = max(0.0, wire - (turns - turn) * a_turn)  # of the ball at the end
        r = math.sqrt(max(0.03 * wire**2, wire**2 - inside**2))
        middle = (begin + turn * pitch, coil * out[1], coil * out[2])
        return [m + r * (p[0] * a + p[1] * b) for m, a, b in zip(middle, out, across)]

    # Both are one piece if they share a node: the head's nearest moves to the wire's first middle.
    first = [c / UNIT for c in place(0, (0, 0))]
    near = min(range(len(mesh.nodes)), key=lambda n: math.dist(mesh.nodes[n], first))
    mesh.nodes[near] = first
    mesh.number[tuple(round(c, 9) for c in first)] = near + 1
    parts = round(turns * a_turn / spacing)
    sweep(mesh, disc(4, 2), [turns * i / parts for i in range(parts + 1)], place)


def in_metres(mesh):
    mesh.nodes = [[c * UNIT for c in x] for x in mesh.nodes]
    return mesh


def new():
    return ball_mesh._Mesh()
