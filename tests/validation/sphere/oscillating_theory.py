# SPDX-License-Identifier: GPL-2.0-or-later
"""What a fluid does to a sphere that oscillates with small amplitude, alone or in a shell.

Velocity Re(U exp(-i w t)), force on the sphere Re(-(R - i X) U exp(-i w t)): R resists, X / w is the
mass that moves along. Alone it is Stokes' law (Landau & Lifshitz, Fluid Mechanics, section 24), with
delta = sqrt(2 nu / w):
  R = 6 pi mu a (1 + a / delta),  X = 3 pi a^2 rho w delta (1 + 2 a / (9 delta)).
"""

import cmath
import math


def _solve(matrix, right):
    """Gauss, with the largest pivot."""
    rows = [[*row, r] for row, r in zip(matrix, right, strict=True)]
    n = len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r in range(n):
            if r != i:
                factor = rows[r][i] / rows[i][i]
                rows[r] = [p - factor * q for p, q in zip(rows[r], rows[i], strict=True)]
    return [rows[i][n] / rows[i][i] for i in range(n)]


def unbounded(radius, delta):
    """R - i X over 6 pi mu a."""
    s = radius / delta
    return complex(1 + s, -s * (1 + 2 * s / 9))


def in_a_shell(radius, delta, shell):
    """The same inside a concentric sphere at rest.

    The stream function is f(r) sin(theta)^2, f = A / r + B r^2 + C g(k r) + D g(-k r) with
    g(x) = exp(-x) (1 + 1 / x), k = (1 - i) / delta; on a sphere f = U r^2 / 2 and f' = U r. The
    pressure is i w rho (2 B r - A / r^2) cos(theta), the shear stress mu (U - f'') / a sin(theta).
    """
    a, k = radius, (1 - 1j) / delta

    def g(x):
        return cmath.exp(-x) * (1 + 1 / x)

    def g1(x):
        return -cmath.exp(-x) * (1 + 1 / x + 1 / x**2)

    def g2(x):
        return cmath.exp(-x) * (1 + 1 / x + 2 / x**2 + 2 / x**3)

    c, d = 1 / g(k * a), 1 / g(-k * shell)  # so that neither overflows

    def conditions(r):
        return [[1 / r, r**2, c * g(k * r), d * g(-k * r)],
                [-1 / r**2, 2 * r, c * k * g1(k * r), -d * k * g1(-k * r)]]

    f = _solve(conditions(a) + conditions(shell), [a**2 / 2, a, 0, 0])
    curvature = (2 * f[0] / a**3 + 2 * f[1] + f[2] * c * k**2 * g2(k * a)
                 + f[3] * d * k**2 * g2(-k * a))
    # i w rho / mu = -k^2.
    force = 4 * math.pi * a**2 / 3 * (-k**2 * (f[0] / a**2 - 2 * f[1] * a)
                                      + 2 * (curvature - 1) / a)
    return -force / (6 * math.pi * a)
