# SPDX-License-Identifier: GPL-2.0-or-later
"""The helix of scene.yaml in creeping flow, by forces on the surface of its wire (a boundary integral): as
theory.in_periodic_box, for a wire of any thickness. Writes surface.csv, in some minutes and 3 GB.

    surface.py [POINTS ...]      points along a side of the wire's section, by default 2 3 4 5
"""
import csv
import math
import pathlib
import sys

import numpy as np
from scipy.special import erf

import theory

HERE = pathlib.Path(__file__).resolve().parent
SHAPE, BOX = (0.5, 2, 3, 0.3), (8, 4, 4)  # mm
COLUMNS = ("points", "width[spacings]", "speed[mm]", "torque[mm3]")
# Width of the Gaussian at a point, in spacings of points. In a plane of points on a square lattice the flow at
# a point is that of an even layer for 0.13 in the plane and 0.19 across it; all widths have one limit.
WIDTHS = (0.15, 0.19, 0.25)
SPLIT = 0.2  # mm: width up to which forces are summed over waves, the rest from neighbours


def points(radius, pitch, turns, side, along):
    """Middles of squares on the wire's four faces and two ends, `along` by `along` at an end."""
    def section(angle):
        middle = np.stack([pitch * angle / (2 * math.pi), radius * np.cos(angle), radius * np.sin(angle)], 1)
        tangent = np.stack([np.full_like(angle, pitch / (2 * math.pi)), -radius * np.sin(angle),
                            radius * np.cos(angle)], 1)
        outwards = np.stack([0 * angle, np.cos(angle), np.sin(angle)], 1)
        return middle, outwards, np.cross(tangent / np.linalg.norm(tangent[0]), outwards)

    stations = round(turns * theory.wire(radius, pitch)[0] * along / side)
    middle, u, v = section((np.arange(stations) + 0.5) / stations * 2 * math.pi * turns)
    s = ((np.arange(along) + 0.5) / along - 0.5) * side
    edge = side / 2
    at = [middle + a * u + b * v for x in s for a, b in ((x, -edge), (x, edge), (-edge, x), (edge, x))]
    for end in (0, 2 * math.pi * turns):
        middle, u, v = section(np.array([end]))
        at += [middle + a * u + b * v for a in s for b in s]
    return np.concatenate(at)


def blurred(distance, width):
    """(A, B): velocity A f + B (f.e) e at a distance along e of a force f that a Gaussian blurs so that its
    waves have exp(-k^2 width^2), as in theory.py; viscosity 1."""
    r = np.where(distance > 0, distance, 1)
    inside = erf(r / (2 * width))
    tail = 2 * width / (math.sqrt(math.pi) * r) * np.exp(-(r / (2 * width))**2)
    ratio = (width / r)**2
    a = (inside * (1 + 2 * ratio) - tail) / (8 * math.pi * r)
    b = (inside * (1 - 6 * ratio) + 3 * tail) / (8 * math.pi * r)
    return np.where(distance > 0, a, 1 / (6 * math.pi**1.5 * width)), np.where(distance > 0, b, 0)


def mobility(at, width, box):
    """As theory._mobility, by Ewald's way: waves of wider Gaussians, the difference from the nearest image."""
    count = len(at)
    out = theory.mobility(at, SPLIT, box).reshape(count, 3, count, 3)
    apart = at[:, None] - at[None]
    apart -= box * np.round(apart / box)
    distance = np.linalg.norm(apart, axis=2)
    a, b = (narrow - wide for narrow, wide in zip(blurred(distance, width), blurred(distance, SPLIT)))
    apart /= np.where(distance > 0, distance, 1)[..., None]
    for i in range(3):
        for j in range(3):
            out[:, i, :, j] += (a if i == j else 0) + b * apart[..., i] * apart[..., j]
    return out.reshape(3 * count, 3 * count)


def rows():
    with (HERE / "surface.csv").open() as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            yield tuple(float(row[name]) for name in COLUMNS)


def limit():
    """(swimming speed, torque) in the limit of many points: the error falls with their spacing. The mean over the
    widths of what the two finest say."""
    found = {(points, width): np.array(rest) for points, width, *rest in rows()}
    fine, coarse = sorted({points for points, _ in found}, reverse=True)[:2]
    return np.mean([(fine * found[fine, width] - coarse * found[coarse, width]) / (fine - coarse)
                    for width in WIDTHS], axis=0)


def main():
    lines = []
    for along in map(int, sys.argv[1:] or ("2", "3", "4", "5")):
        at = points(*SHAPE, along)
        for width in WIDTHS:
            spread = width * SHAPE[3] / along
            speed, torque = theory.of_a_free_body(at, mobility(at, spread, np.array(BOX, float)))
            lines.append(f"{along},{width},{speed:.5g},{torque:.5g}")
            print(lines[-1], flush=True)
    (HERE / "surface.csv").write_text("# By surface.py: rate of turning and viscosity 1.\n"
                                      + "\n".join([",".join(COLUMNS), *lines, ""]))


if __name__ == "__main__":
    main()
