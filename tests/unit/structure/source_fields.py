#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Flux density and gradient of magnets and coils by quadrature, independent of the closed
forms: of the charges on a magnet's surface (x - x')/|x - x'|^3 J.n dS / (4 pi), of a coil's
current by Biot and Savart. Gauss points along straight edges, the trapezoidal rule around
circles, twice as many until nothing changes in ten digits.

    tests/unit/structure/source_fields.py > tests/unit/structure/source_fields.csv
"""

import numpy as np

MU0 = 4e-7 * np.pi


def gauss(low, high, n):
    x, w = np.polynomial.legendre.leggauss(n)
    return 0.5 * (low + high) + 0.5 * (high - low) * x, 0.5 * (high - low) * w


def of_charges(point, places, charges):
    """Charges [T m2]: field and the six different entries of its gradient."""
    r = point - places
    d = np.linalg.norm(r, axis=1)
    field = (charges / d**3) @ r
    gradient = np.sum(charges / d**3) * np.eye(3) - 3 * np.einsum("n,ni,nj", charges / d**5, r, r)
    return np.concatenate([field, gradient[np.triu_indices(3)]]) / (4 * np.pi)


def cuboid(point, n, a, b, c, jx, jy, jz):
    edges, places, charges = np.array([a, b, c]) / 2, [], []
    for axis, polarization in enumerate((jx, jy, jz)):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        xu, wu = gauss(-edges[u], edges[u], n)
        xv, wv = gauss(-edges[v], edges[v], n)
        for side in (1, -1):
            place = np.zeros((n * n, 3))
            place[:, axis] = side * edges[axis]
            place[:, u], place[:, v] = np.repeat(xu, n), np.tile(xv, n)
            places.append(place)
            charges.append(side * polarization * np.outer(wu, wv).ravel())
    return of_charges(point, np.concatenate(places), np.concatenate(charges))


def cylinder(point, n, diameter, height, _, jx, jy, jz):
    a, h = diameter / 2, height / 2
    angle = 2 * np.pi * np.arange(2 * n) / (2 * n)
    places, charges = [], []
    z, wz = gauss(-h, h, n)
    c, s = np.cos(angle), np.sin(angle)
    places.append(np.stack([np.repeat(a * c, n), np.repeat(a * s, n), np.tile(z, 2 * n)], 1))
    charges.append(np.repeat(jx * c + jy * s, n) * np.tile(wz, 2 * n) * a * np.pi / n)
    r, wr = gauss(0, a, n)
    for side in (1, -1):
        places.append(np.stack([np.outer(c, r).ravel(), np.outer(s, r).ravel(),
                                np.full(2 * n * n, side * h)], 1))
        charges.append(side * jz * np.tile(wr * r, 2 * n) * np.pi / n)
    return of_charges(point, np.concatenate(places), np.concatenate(charges))


def loop(point, n, diameter, current, *_):
    """dB/dx_j of mu0 I/(4 pi) dl x r/r^3 too."""
    angle = 2 * np.pi * np.arange(4 * n) / (4 * n)
    a = diameter / 2
    places = np.stack([a * np.cos(angle), a * np.sin(angle), 0 * angle], 1)
    dl = np.stack([-a * np.sin(angle), a * np.cos(angle), 0 * angle], 1) * np.pi / (2 * n)
    r = point - places
    d = np.linalg.norm(r, axis=1)[:, None]
    field = np.sum(np.cross(dl, r) / d**3, 0)
    gradient = np.zeros((3, 3))
    for j in range(3):
        e = np.eye(3)[j]
        gradient[:, j] = np.sum(np.cross(dl, e) / d**3 - 3 * np.cross(dl, r) * r[:, j:j + 1] / d**5,
                                0)
    out = np.concatenate([field, gradient[np.triu_indices(3)]])
    return MU0 * current / (4 * np.pi) * out


POINTS = {"cuboid": [(9e-3, 2e-3, 3e-3), (1e-3, -2e-3, 7e-3), (-3e-3, 4.2e-3, 0), (4e-3, 0, 12e-3),
                     (0, 0, -9e-3), (-8e-3, -9e-3, -10e-3)],
          "cylinder": [(9e-3, 2e-3, 3e-3), (1e-3, -2e-3, 9e-3), (-5e-3, 2.2e-3, 0), (4e-3, 0, 12e-3),
                       (0, 0, -9e-3), (1e-6, 2e-6, 9e-3), (4e-5, 0, -8e-3), (-8e-3, -9e-3, -1e-2)],
          "loop": [(9e-3, 2e-3, 3e-3), (1e-3, -2e-3, 9e-3), (-1e-3, 2.2e-3, 0), (4e-3, 0, 12e-3),
                   (0, 0, -9e-3), (1e-6, 2e-6, 9e-3), (6e-5, 0, 4e-3), (-8e-3, -9e-3, -1e-2)]}
SOURCES = [("cuboid", cuboid, (8e-3, 6e-3, 4e-3, 0, 0, 1.2)),
           ("cuboid", cuboid, (8e-3, 6e-3, 4e-3, 0.7, -0.4, 1.1)),
           ("cylinder", cylinder, (8e-3, 10e-3, 0, 0, 0, 1.3)),
           ("cylinder", cylinder, (8e-3, 10e-3, 0, 0.9, 0.5, 0)),
           ("loop", loop, (12e-3, 50, 0, 0, 0, 0))]


def converged(of, point, numbers):
    n, before = 32, None
    while True:
        now = of(np.array(point), n, *numbers)
        if before is not None and np.all(np.abs(now - before) <= 1e-10 * np.abs(now).max()):
            return now
        n, before = 2 * n, now
        if n > 1024:
            raise RuntimeError(f"no convergence at {point}")


def main():
    print("# Made by source_fields.py: quadrature of surface charges and of Biot and Savart.")
    print("# cuboid: edges, polarisation; cylinder: diameter, height, 0, polarisation;")
    print("# loop: diameter, current. SI.")
    print("source,p1,p2,p3,p4,p5,p6,x[m],y[m],z[m],Bx[T],By[T],Bz[T],"
          "Gxx[T/m],Gxy[T/m],Gxz[T/m],Gyy[T/m],Gyz[T/m],Gzz[T/m]")
    for name, of, numbers in SOURCES:
        for point in POINTS[name]:
            values = converged(of, point, numbers)
            print(",".join([name, *(f"{p:g}" for p in (*numbers, *point)),
                            *(f"{v:.12g}" for v in values)]))


if __name__ == "__main__":
    main()
