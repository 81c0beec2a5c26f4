# SPDX-License-Identifier: GPL-2.0-or-later
"""Drag of a ball that creeps through a fluid whose viscosity depends on the rate of shear, by Galerkin's method.

The flow of a generalised Newtonian fluid without inertia dissipates least, of all that have the ball's speed at the
ball and none at a wall (Johnson 1960; bounds from trial flows: Wasserman and Slattery 1964). Here they are stream
functions, f_k(r) sin^2 P_k'(cos) of odd k, the f_k polynomials of log r, which find the least to 1e-5; the viscosity
is that of the flow before (Picard). Nothing of it is from the lattice.
"""
import math

import numpy as np
from numpy.polynomial import chebyshev, legendre


class Flow:
    """Of a ball of radius 1 and speed 1 in the middle of a hollow ball of this radius."""

    def __init__(self, wall, modes=6, degree=20, points=(120, 48)):
        depth = math.log(wall)
        nodes, weights = legendre.leggauss(points[0])
        log_r = (nodes + 1) / 2 * depth
        self.r = np.exp(log_r)
        self.x, weights_x = legendre.leggauss(points[1])
        self.volumes = 2 * math.pi * np.outer(self.r**3 * weights * depth / 2, weights_x).ravel()
        held = chebyshev.Chebyshev.fromroots([0, 0, depth, depth], domain=[0, depth]) / depth**4
        shapes = [held * chebyshev.Chebyshev.basis(j, domain=[0, depth]) for j in range(degree)]
        # f_1 = 1/2 and df_1/dr = 1 at the ball, by Hermite's cubics.
        z = np.polynomial.Polynomial([0, 1 / depth])
        moving = (2 * z**3 - 3 * z**2 + 1) / 2 + depth * (z**3 - 2 * z**2 + z)
        parts = [[f.deriv(n)(log_r) if n else f(log_r) for n in range(3)] for f in (moving, *shapes)]
        self.given = self.strain(1, parts[0])
        free = np.array([self.strain(k, f) for k in range(1, 2 * modes, 2) for f in parts[1:]])
        norms = np.sqrt(np.einsum("nak,nak,k->n", free, free, self.volumes))
        self.free = free / norms[:, None, None]

    def strain(self, k, f):
        """rr, tt, pp and sqrt(2) rt of the flow's rate of strain, from f and its slopes over log r."""
        r, x, sine = self.r[:, None], self.x, np.sqrt(1 - self.x**2)
        value, slope, curve = f[0][:, None], f[1][:, None] / r, (f[2] - f[1])[:, None] / r**2
        p, p1, p2 = (legendre.Legendre.basis(k).deriv(n)(x) if n else legendre.Legendre.basis(k)(x) for n in range(3))
        many = k * (k + 1)
        outwards, along = value / r**2 * many * p, -slope / r * sine * p1
        rr = (slope / r**2 - 2 * value / r**3) * many * p
        tt = -slope / r**2 * (x * p1 - sine**2 * p2) + outwards / r
        rt = ((slope / r**2 - curve / r) * sine * p1 - along / r - value / r**3 * sine * many * p1) / 2
        return np.stack([rr, tt, outwards / r + along * x / sine / r, math.sqrt(2) * rt]).reshape(4, -1)

    def dissipated(self, viscosity):
        """The ball's drag, as its speed is 1; viscosity: of the rate of shear."""
        size, before = np.zeros(len(self.free)), 0
        for _ in range(200):
            strain = self.given + np.einsum("n,nak->ak", size, self.free)
            rate = np.sqrt(2 * (strain**2).sum(axis=0))
            weights = viscosity(rate) * self.volumes
            now = (weights * rate**2).sum()
            if abs(now - before) < 1e-9 * now:
                return now
            before = now
            weighted = (self.free * weights).reshape(len(size), -1)
            size = np.linalg.lstsq(weighted @ self.free.reshape(len(size), -1).T, -weighted @ self.given.ravel(),
                                   rcond=1e-13)[0]
        raise ArithmeticError("does not settle")


def power_law(exponent, wall=300):
    """Over 3 pi m U^n d^(2 - n), m the stress at the rate 1."""
    return Flow(wall).dissipated(lambda rate: rate**(exponent - 1)) / (3 * math.pi * 2**(2 - exponent))


def carreau(exponent, number, wall=300):
    """Over 3 pi mu d U, mu that at rest; number: Carreau's time times U over the radius."""
    return Flow(wall).dissipated(lambda rate: (1 + (number * rate)**2)**((exponent - 1) / 2)) / (6 * math.pi)
