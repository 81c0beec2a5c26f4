# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes, shapes and designs that the tests of designs share."""
import math
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from magfsi import testing
from magfsi.design import curves
from magfsi.study.marked import InputError

STRIP = """name: {name}
time: {{end: 1 s, equilibrium: {{method: newton}}}}
bodies:
  strip:
    mesh: {{box: {{size: [{length} mm, {width} mm, {height} mm], elements: [{elements}]}}}}
    material: {{shear_modulus: {shear} kPa, lame_lambda: {lame} kPa, density: 1860 kg/m3}}
    clamps: [x_min]
output: {{structure: {{every: 50 ms}}}}
"""


class Strip:
    """A strip that is clamped at x = 0, and closed forms of the beam that it is: E of its moduli,
    the second moment of its section."""

    def __init__(self, length=20.0, width=4.0, height=0.4, elements=(60, 12, 2), shear=33.0, ratio=20.0,
                 name="strip"):
        self.length_m, self.width_m, self.height_m = (1e-3 * v for v in (length, width, height))
        self.elements, self.shear_pa = elements, 1e3 * shear
        lame = ratio * shear
        self.youngs_pa = self.shear_pa * (3 * ratio + 2) / (ratio + 1)
        self.poisson = ratio / (2 * (ratio + 1))
        self.text = STRIP.format(name=name, length=length, width=width, height=height, shear=shear, lame=lame,
                                 elements=", ".join(map(str, elements)))

    def area_m2(self):
        return self.width_m * self.height_m

    def bending_nm2(self):
        return self.youngs_pa * self.width_m * self.height_m**3 / 12

    def line(self, heading, count=2001):
        """Points of the centre line with a heading (function of the share of the length) from x
        towards z."""
        s = (np.arange(count - 1) + 0.5) / (count - 1)
        angle = heading(s)
        piece = self.length_m / (count - 1)
        points = np.zeros((count, 3))
        points[1:, 0] = np.cumsum(piece * np.cos(angle))
        points[1:, 2] = np.cumsum(piece * np.sin(angle))
        return points + [0, self.width_m / 2, self.height_m / 2]


def write_curve(path, points):
    rows = "\n".join(",".join(f"{1e3 * c:.9g}" for c in p) for p in points)
    Path(path).write_text("x[mm],y[mm],z[mm]\n" + rows + "\n")


def letter(turn):
    """Heading of an S: it turns one way by `turn` and back, with straight ends."""
    return lambda s: turn * (1 - np.cos(2 * math.pi * s)) / 2


def folder_with(**texts):
    folder = Path(testing.new_folder())
    for name, text in texts.items():
        (folder / name.replace("_yaml", ".yaml")).write_text(text)
    return folder


def called(file, *words):
    """magfsi design in this process."""
    return testing.called("magfsi.design", InputError, file, *words)


def run(file, *words, limit_s=900):
    """magfsi design as a runs.Run."""
    began = time.monotonic()
    process = testing.start([sys.executable, "-P", "-m", "magfsi.design", file, *words])
    return testing.finish(process, began, Path(file).parent, limit_s)


def mean_distance(found, wanted):
    """Of two curves at equal shares of their lengths."""
    shares = np.linspace(0, 1, 101)
    return float(np.linalg.norm(curves.at_shares(found, shares) - curves.at_shares(wanted, shares),
                                axis=1).mean())


__all__ = ["Strip", "folder_with", "letter", "mean_distance", "run", "subprocess", "write_curve"]
