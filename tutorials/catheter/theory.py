# SPDX-License-Identifier: GPL-2.0-or-later
"""The tip of the catheter as a slender rod that bends and does not stretch, in the field of the ball magnet, with
the fluid's forces on it. In the plane xz; SI."""
import math

import numpy as np
from scipy.integrate import solve_bvp

MU0 = 4e-7 * math.pi
LENGTH, SIDE, BASE = 6e-3, 0.6e-3, np.array([4e-3, 2.8e-3])
MODULUS, MAGNETIZATION = 150e3, 20e3
MOMENT, MAGNET, WAY, RAMP = np.array([0, 5.33]), np.array([-90e-3, 62.8e-3]), 98e-3, 0.4
VISCOSITY, DENSITY, RADIUS, SHAFT = 3.7e-3, 1060, 2.5e-3, 0.4e-3


def magnet_at(time):
    moved = WAY * (1 - math.cos(math.pi * min(time, RAMP) / RAMP)) / 2
    return MAGNET + [moved, 0]


def dipole(away):
    """Field (2, n) and gradient dB_i/dx_j (2, 2, n) at places (2, n) from it."""
    r = np.hypot(*away)
    n = away / r
    along = MOMENT @ n
    field = MU0 / (4 * math.pi * r**3) * (3 * along * n - MOMENT[:, None])
    m = MOMENT[:, None, None]
    gradient = m * n[None] + (m * n[None]).transpose(1, 0, 2) + np.eye(2)[:, :, None] * along \
        - 5 * along * n[:, None] * n[None]
    return field, 3 * MU0 / (4 * math.pi * r**4) * gradient


def bent(magnet, load=None):
    """Places (2, 101) along the rod, from its base, and the way it points there. load(s): the fluid's force by
    length (2, n). Balances of force n and moment m: n' = -f, m' = -t x n - M A t x B, with f the field's force
    M A (t.grad) B and the load, m = E I angle'; the end is free."""
    stiffness, strength = MODULUS * SIDE**4 / 12, MAGNETIZATION * SIDE**2

    def slopes(s, y):
        field, gradient = dipole(y[:2] - magnet[:, None])
        t = np.array([np.cos(y[2]), np.sin(y[2])])
        force = strength * np.einsum("ijn,jn->in", gradient, t) + (0 if load is None else load(s))
        moment = t[0] * (y[5] + strength * field[1]) - t[1] * (y[4] + strength * field[0])
        return np.array([*t, y[3] / stiffness, -moment, *-force])

    def ends(a, b):
        return np.array([a[0] - BASE[0], a[1] - BASE[1], a[2], *b[3:]])

    s = np.linspace(0, LENGTH, 101)
    start = np.zeros((6, len(s)))
    start[0], start[1] = BASE[0] + s, BASE[1]
    found = solve_bvp(slopes, ends, s, start, tol=1e-6, max_nodes=20000)
    if not found.success:
        raise RuntimeError(found.message)
    y = found.sol(s)
    return y[:2], y[2]


def drag(places, angle, flow):
    """The fluid's force by length (2, n) of a rod in Poiseuille's flow: across, White's drag of a circular cylinder
    of the same area, 1 + 10 Re^(-2/3) (Viscous Fluid Flow), by the speed across the rod; along, the friction of
    the flow between coaxial cylinders."""
    wide = 2 * SIDE / math.sqrt(math.pi)
    radius = np.abs(places[1] - BASE[1])
    speed = 2 * flow / (math.pi * RADIUS**2) * (1 - (radius / RADIUS)**2)
    across = speed * np.sin(angle)
    reynolds = np.maximum(np.abs(across) * wide * DENSITY / VISCOSITY, 1e-3)
    pushed = 0.5 * DENSITY * wide * across * np.abs(across) * (1 + 10 * reynolds**(-2 / 3))
    a, log = 0.5 * wide, math.log(RADIUS / (0.5 * wide))
    gap = RADIUS**2 - a**2
    gradient = 8 * VISCOSITY * flow / (math.pi * (RADIUS**4 - a**4 - gap**2 / log))
    friction = 0.5 * math.pi * gradient * (gap / log - 2 * a**2) * np.cos(angle)
    return np.array([friction * np.cos(angle) + pushed * np.sin(angle),
                     friction * np.sin(angle) - pushed * np.cos(angle)])


def bent_in_flow(magnet, flow):
    """As bent(), with the drag of what it has bent to."""
    s = np.linspace(0, LENGTH, 101)
    places, angle = bent(magnet)
    for _ in range(6):  # each changes a fifth of what the one before did
        force = drag(places, angle, flow)
        places, angle = bent(magnet, lambda at, f=force: np.array([np.interp(at, s, component) for component in f]))
    return places, angle
