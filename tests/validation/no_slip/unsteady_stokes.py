# SPDX-License-Identifier: GPL-2.0-or-later
"""The force on a rigid plate that swings in a periodic box: exact, for unsteady Stokes flow.

A plate of W x t, infinitely long, swings with velocity V exp(i w t). A layer of force f on its
outline that moves the fluid there with V moves the fluid inside as a rigid body too, so that the
sum of f is the force on all of the fluid; the force on that outside of the plate is less by the
inertia of the inside. In Fourier space

    u(k) = (1 - k k / k^2) f(k) / (mu (k^2 + i w / nu)),

on the lattice of wave vectors of the box. f is a sum of functions whose transforms are known,

    (1 - s^2)^(a - 1/2) C_n^a(s)   ->   (2 / k)^a J_(n + a)(k)   but for constants,

on each of the four sides (Gegenbauer polynomials; a = 0.0444 is the singularity of a corner of 270
degrees of fluid), and Galerkin's equations give their amplitudes.
"""

import numpy as np
from scipy.special import gamma, jv

CORNER = 0.0444


def _transform(n, k):
    k = np.abs(k)
    zero = k < 1e-8
    safe = np.where(zero, 1.0, k)
    limit = 1 / gamma(CORNER + 1) if n == 0 else 0.0
    return np.where(zero, limit, (2 / safe)**CORNER * jv(n + CORNER, safe))


def _waves(width, thickness, box, modes, functions):
    """Row by row of wave vectors: k along the width, k through the thickness, the weights of the
    row's wave vectors, and the transforms of the driven and of the other component's functions."""
    a, h = width / 2, thickness / 2
    along, through = functions
    step = 2 * np.pi / box
    kz = step * np.arange(modes + 1)
    mirrored = np.where(kz == 0, 1.0, 2.0)
    rim = [[_transform(2 * n + odd, kz * h) for n in range(through)] for odd in (0, 1)]
    cos, sin = np.cos(kz * h), np.sin(kz * h)
    for kx in step * np.arange(modes + 1):
        face = [[float(_transform(2 * n + odd, kx * a)) for n in range(along)] for odd in (0, 1)]
        # Even in both directions; the other component is odd in both.
        driven = [2 * f * cos for f in face[0]] + [2 * np.cos(kx * a) * r for r in rim[0]]
        other = [-2 * f * sin for f in face[1]] + [-2 * np.sin(kx * a) * r for r in rim[1]]
        yield kx, kz, (1 if kx == 0 else 2) * mirrored, np.array(driven), np.array(other)


def _response(kx, kz, rate, broadside):
    """Driven-driven, driven-other and other-other component of the response, times mu."""
    k2 = kx**2 + kz**2
    safe = np.where(k2 > 0, k2, 1)
    scale = 1 / (k2 + rate)
    x = np.where(k2 > 0, kz**2 / safe, 1) * scale
    z = np.where(k2 > 0, kx**2 / safe, 1) * scale
    cross = np.where(k2 > 0, -kx * kz / safe, 0) * scale
    return (z, cross, x) if broadside else (x, cross, z)


def _moved(width, thickness, box, rate, broadside, modes, functions):
    matrix = 0
    for kx, kz, weight, driven, other in _waves(width, thickness, box, modes, functions):
        dd, do, oo = (weight * part for part in _response(kx, kz, rate, broadside))
        matrix = matrix + np.block([[(driven * dd) @ driven.T, (driven * do) @ other.T],
                                    [(other * do) @ driven.T, (other * oo) @ other.T]])
    total = np.zeros(len(matrix))
    total[[0, functions[0]]] = 2 * float(_transform(0, 0.0))
    return total @ np.linalg.solve(matrix / box**2, total) / rate


def force_coefficient(width, thickness, box, omega, viscosity, broadside=True):
    """C of F = rho C dV/dt, F the force per length on the fluid outside of the plate: the real part
    is the added area, the imaginary one, below zero, the drag over rho omega V."""
    rate = 1j * omega / viscosity
    # The sums over wave vectors converge with the first power of their number.
    coarse, fine = (_moved(width, thickness, box, rate, broadside, modes, (8, 5))
                    for modes in (750, 1500))
    return 2 * fine - coarse - width * thickness


if __name__ == "__main__":
    for broadside in (True, False):
        c = force_coefficient(1.5e-3, 0.185e-3, 9.6e-3, 2 * np.pi * 25, 1e-6, broadside)
        print("broadside" if broadside else "edgewise", c / (np.pi / 4 * 1.5e-3**2))
