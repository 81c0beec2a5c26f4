# SPDX-License-Identifier: GPL-2.0-or-later
"""What the finite elements of quadratic_solid.py say of the paper's strip: rows of CSV on stdout.

    solid_cases.py clamped|free|ground X Y Z     cells along length, half width and thickness

clamped: both ends held, under weight; cells graded towards the ends. free: V and C without weight,
the lowest frequencies. ground: on a smooth platform in a field at 135 degrees that rises and falls
again. The seconds of a case on 40 x 4 x 2 cells: 10, 20 and some thousand.
"""

import sys

import numpy as np

from quadratic_solid import Block, Solver

LENGTH, WIDTH, HEIGHT = 3.7e-3, 1.5e-3, 0.185e-3
G, DENSITY = 33e3, 1860
K = 20 * G
G_EARTH = 9.81
PLANE_STIFFNESS = 0.5 * (K + 2 * G) / HEIGHT  # the tutorial's default


def magnetization(points):
    angle = 2 * np.pi * points[..., 0] / LENGTH + np.radians(45)
    return 62e3 * np.stack([np.cos(angle), 0 * angle, np.sin(angle)], -1)


def block(cells, towards_ends=1.0):
    along = np.linspace(0, 1, cells[0] + 1)
    half = 0.5 * (2 * np.minimum(along, 1 - along))**towards_ends
    edges = LENGTH * np.where(along <= 0.5, half, 1 - half)
    return Block(edges, WIDTH, HEIGHT, cells[1], cells[2], G, K, DENSITY)


def field(milli_tesla, degrees):
    angle = np.radians(degrees)
    return 1e-3 * milli_tesla * np.array([np.cos(angle), 0, np.sin(angle)])


def degrees_of(line):
    return np.degrees(np.arctan2(line[2], line[0]))


class Shape:
    """Of the state x: as the tutorials' probes measure it, and by sections."""

    def __init__(self, solid, x):
        def at(s, z=0.0):
            return x[solid.node(s * LENGTH, 0, z)]

        def section(s):
            return degrees_of(at(s, HEIGHT / 2) - at(s, -HEIGHT / 2)) - 90

        ends = at(1) - at(0)
        self.end_to_end = np.linalg.norm(ends) / LENGTH
        self.heading = degrees_of(ends)
        self.middle = degrees_of(at(0.55) - at(0.45))
        self.middle_section = section(0.5)
        turn = np.unwrap([np.radians(section(s)) for s in np.linspace(0, 1, 21)])
        self.bend = np.degrees(turn[-1] - turn[0])


def clamped(cells):
    solid = block(cells, towards_ends=2.0)
    ends = np.flatnonzero(np.isin(solid.rest[:, 0], solid.rest[[0, -1], 0]))
    solver = Solver(solid, np.zeros(len(solid.rest)), [3 * n + d for n in ends for d in range(3)])
    x = solid.rest
    print("case,cells,weight_g,middle_uz/H,edge_uz/H")
    for weight in (1, 3, 10, 30):
        x = solver.solve(x, np.zeros(3), weight * G_EARTH)
        middle, edge = (x[solid.node(LENGTH / 2, y, 0), 2] / HEIGHT for y in (0, WIDTH / 2))
        print(f"clamped,{label(cells)},{weight},{middle:.5f},{edge:.5f}", flush=True)


def free(cells):
    solid = block(cells)
    charges = solid.charges(magnetization)
    middle = solid.node(LENGTH / 2, 0, 0)
    pinned = Solver(solid, charges, (3 * middle, 3 * middle + 2))
    print("case,cells,theta_B_deg,B_mT,end_to_end/L,middle_deg,middle_section_deg,"
          "frequency_1_Hz,frequency_2_Hz")
    for theta in (45, 225):
        x = solid.rest
        for tesla in (1, 2, 3.5, 5, 7, 10, 15, 20):
            x = pinned.solve(x, field(tesla, theta))
            if tesla not in (1, 5, 10, 20):
                continue
            shape = Shape(solid, x)
            squares, _ = Solver(solid, charges).frequencies(x, field(tesla, theta), number=4)
            first, second = np.sqrt(squares[2:]) / (2 * np.pi)  # two translations before
            print(f"free,{label(cells)},{theta},{tesla},{shape.end_to_end:.5f},"
                  f"{shape.middle:.3f},{shape.middle_section:.3f},{first:.3f},{second:.3f}",
                  flush=True)


def ground(cells):
    solid = block(cells)
    middle = solid.node(LENGTH / 2, 0, 0)
    solver = Solver(solid, solid.charges(magnetization), (3 * middle,),
                    (-HEIGHT / 2, PLANE_STIFFNESS))
    rising = np.arange(0.5, 20.1, 0.5)
    print("source,g,B_mT,end_to_end/L,bend_deg,middle_deg,heading_deg")
    for weight in (1, 0.5, 2):
        x = solid.rest - [0, 0, 1e-4 * HEIGHT]
        for way, fields in (("", rising), (" down", rising[-2:2:-1])):
            for tesla in fields:
                x = solver.solve(x, field(tesla, 135), weight * G_EARTH)
                shape = Shape(solid, x)
                print(f"solid {label(cells)}{way},{weight},{tesla},{shape.end_to_end:.4f},"
                      f"{shape.bend:.2f},{shape.middle:.2f},{shape.heading:.2f}", flush=True)


def label(cells):
    return "x".join(map(str, cells))


if __name__ == "__main__":
    {"clamped": clamped, "free": free, "ground": ground}[sys.argv[1]](
        tuple(map(int, sys.argv[2:5])))
