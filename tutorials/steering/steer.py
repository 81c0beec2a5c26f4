# SPDX-License-Identifier: GPL-2.0-or-later
"""The controller of tutorials/steering: holds the strip where it is for 0.2 s, then takes it elsewhere.

The strip has a moment m along the field, and a gradient (g, 0, -g) along x, y, z pulls it with
F = (g m_x, 0, -g m_z). So the force that is wanted gives m_x and m_z; what is left of the moment points
along y, where nothing pulls.
"""
import math

GRADIENT = 0.2  # T/m
MOMENT = 62e3 * 3.7e-3 * 1.5e-3 * 0.185e-3  # A m2
FIELD = 5e-3  # T
WEIGHT = 8.66e-6 / 1.22  # N, in water; as this controller believes
MASS = 6e-6  # kg, with the water that moves along; likewise
RATE = 40.0  # 1/s, at which errors go away
EVERY = 2e-3  # s, as in the scene
TURN = 0.05  # most of a turn between two calls [rad]
START, HELD_UNTIL, THERE = (6e-3, 6e-3), 0.2, (6.5e-3, 6.5e-3)  # x and z [m]; s


class Controller:
    def __init__(self):
        self.sums = [0.0, 0.0]
        self.way = (0.0, math.sin(math.radians(47)), -math.cos(math.radians(47)))  # of the field

    def target(self, t):
        """Where it is to be: x and z [m]; on its way for 100 ms."""
        part = min(max((t - HELD_UNTIL) / 0.1, 0.0), 1.0)
        part = part * part * (3 - 2 * part)
        return [a + part * (b - a) for a, b in zip(START, THERE)]

    def force(self, t, probes):
        """Errors, their rates and their sums: all go away as exp(-RATE t) does."""
        wanted = []
        for i, (axis, goal) in enumerate(zip("xz", self.target(t))):
            error = goal - probes[f"strip.com_{axis}"]
            self.sums[i] += EVERY * error
            wanted.append(MASS * (3 * RATE**2 * error + RATE**3 * self.sums[i]
                                  - 3 * RATE * probes[f"strip.speed_{axis}"]))
        return wanted[0], WEIGHT + wanted[1]

    def step(self, t, probes):
        along, up = (f / (GRADIENT * MOMENT) for f in self.force(t, probes))
        x, z = min(max(along, -0.6), 0.6), -min(max(up, 0.1), 0.95)
        most = math.sqrt(0.98 - z * z)
        x = min(max(x, -most), most)
        self.way = turned(self.way, (x, math.sqrt(1 - x * x - z * z), z), TURN)
        return [FIELD * part for part in self.way]


def turned(way, wanted, most):
    """A unit vector from `way` towards `wanted`, at most by this angle."""
    cosine = sum(a * b for a, b in zip(way, wanted))
    angle = math.acos(min(max(cosine, -1.0), 1.0))
    if angle <= most:
        return wanted
    a, b = math.sin(angle - most) / math.sin(angle), math.sin(most) / math.sin(angle)
    return tuple(a * u + b * v for u, v in zip(way, wanted))
