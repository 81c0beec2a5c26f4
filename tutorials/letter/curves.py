# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes s.csv and mirrored.csv beside itself: the centre line of a strip bent to a letter S, and its mirror
image. The heading turns by 108 degrees and back, with straight ends."""
import pathlib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
LENGTH, WIDTH, HEIGHT = 20.0, 4.0, 0.4  # mm
TURN, POINTS = np.radians(108), 101


def line():
    """Points [mm] from the clamp on, by the midpoint rule in steps a hundredth of the table's."""
    s = (np.arange(100 * (POINTS - 1)) + 0.5) / (100 * (POINTS - 1))
    heading = TURN * (1 - np.cos(2 * np.pi * s)) / 2
    steps = np.stack([np.cos(heading), np.sin(heading)], axis=1) * LENGTH / len(s)
    x, z = np.vstack([[0, 0], np.cumsum(steps, axis=0)[99::100]]).T
    return np.column_stack([x, np.full(POINTS, WIDTH / 2), z + HEIGHT / 2])


def write(name, points):
    rows = [",".join(f"{c:.6g}" for c in point) for point in points]
    (HERE / name).write_text("\n".join(["x[mm],y[mm],z[mm]", *rows, ""]))


if __name__ == "__main__":
    points = line()
    write("s.csv", points)
    write("mirrored.csv", points * [1, 1, -1] + [0, 0, HEIGHT])
