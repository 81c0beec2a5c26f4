# SPDX-License-Identifier: GPL-2.0-or-later
"""The force on a rigid disk that moves in a periodic cube: exact, for Stokes flow.

As unsteady_stokes.py, in three dimensions: a layer of force on the surface of a disk of radius a
and thickness t that moves the fluid there with V exp(i w t), broadside or edgewise. On the faces

    r^n (1 - r^2)^b  ->  2 pi 2^b Gamma(b + 1) J_(n + b + 1)(k) / k^(b + 1)      (Sonine)

with n = 0, 1, 2 for what turns n times around the axis and b = CORNER - 1/2, ..., + 1, + 2 ...; on the
rim Gegenbauer polynomials along the axis. What depends on the direction of a wave vector across the
axis is averaged over it: images in a cube differ from images all around by less than (a / box)^4.
"""

import numpy as np
from scipy.special import gamma, jv

from unsteady_stokes import CORNER, _transform

FACE, RIM = 6, 4  # functions of each kind


def _face(turns, k):
    """Functions on a disk of radius 1, each over k^turns where k is small."""
    rows = []
    safe = np.where(k < 1e-8, 1.0, k)
    for n in range(FACE):
        b = CORNER - 0.5 + n
        at_zero = np.pi / (b + 1) if turns == 0 else 0.0
        far = 2 * np.pi * 2**b * gamma(b + 1) * jv(turns + b + 1, safe) / safe**(b + 1)
        rows.append(np.where(k < 1e-8, at_zero, far))
    return np.array(rows)


def _lattice_waves(step, most):
    """Along an axis, and across it by length: wave vectors of the box and how many there are."""
    n = np.arange(-most, most + 1)
    square = (n[:, None]**2 + n[None, :]**2).ravel()
    length2, count = np.unique(square[square <= most**2], return_counts=True)
    along = np.arange(most + 1)
    return step * np.sqrt(length2), count, step * along, np.where(along == 0, 1.0, 2.0)


def _free_waves(step, most, finest):
    """The same for an integral up to `most`; finest: the smallest length to see along the axis."""
    d = 0.3
    across = np.arange(d / 2, most, d)
    edges = [0.0]
    while edges[-1] < most:
        edges.append(edges[-1] + min(0.3 + 0.03 * edges[-1], 0.3 / finest))
    edges = np.array(edges)
    return (across, 2 * np.pi * across * d / step**2, (edges[1:] + edges[:-1]) / 2,
            2 * np.diff(edges) / step)


def _fading(k, last):
    """From 1 where waves of the box are told from each other to 0 where they are not."""
    return 0.5 + 0.5 * np.cos(np.pi * np.clip(2 * k / last - 1, 0, 1))


def _sums(waves, share, h, rate, broadside):
    """The matrix of Galerkin's equations for a disk of radius 1 and thickness 2 h, times mu."""
    k, count, along_axis, counts = waves
    face, rim = ([f(n, k) for n in range(3)] for f in (_face, jv))
    matrix = 0
    for kz, twice in zip(along_axis, counts):
        even, odd = ([float(_transform(2 * n + o, kz * h)) for n in range(RIM)] for o in (0, 1))
        across = {n: np.vstack([2 * np.cos(kz * h) * face[n],
                                np.outer(even, 2 * np.pi * rim[n])]) for n in (0, 2)}
        turned = -np.vstack([2 * np.sin(kz * h) * face[1], np.outer(odd, 2 * np.pi * rim[1])])
        k2 = k**2 + kz**2
        safe = np.where(k2 > 0, k2, 1)
        # A steady force on all of the fluid is held by something else.
        scale = np.where(k2 + rate != 0, k2 + rate, np.inf)
        weight = count * twice * share(k, kz) / scale
        along, outward = (np.where(k2 > 0, part / safe, 2 / 3) for part in (kz**2, k**2))
        cross = -k * kz / safe
        zero = 0 * turned
        if broadside:
            z, radial = np.vstack([across[0], zero]), np.vstack([zero, turned])
        else:  # with the cosine of the angle around the axis; around the axis with its sine
            radial = np.vstack([across[0], -across[2], zero])
            around = np.vstack([-across[0], -across[2], zero])
            z = np.vstack([zero, zero, turned])
            matrix = matrix + 0.5 * (around * weight) @ around.T
        mixed = (z * weight * cross) @ radial.T
        matrix = matrix + (1 if broadside else 0.5) * (
            (z * weight * outward) @ z.T + (radial * weight * along) @ radial.T + mixed + mixed.T)
    return matrix


def _moved(thickness, box, rate, broadside, most):
    """Force over mu V of a disk of radius 1, with waves up to a number per unit length."""
    step, told_apart, h = 2 * np.pi / box, 60, thickness / 2
    last = step * told_apart

    def boxed(k, kz):
        return _fading(k, last) * _fading(kz, last)

    matrix = _sums(_lattice_waves(step, told_apart), boxed, h, rate, broadside)
    matrix = matrix + _sums(_free_waves(step, most, h), lambda k, kz: 1 - boxed(k, kz), h, rate,
                            broadside)
    total = np.zeros(len(matrix), dtype=complex)
    total[:FACE] = 2 * _face(0, np.zeros(1))[:, 0]
    total[FACE] = 2 * np.pi * float(_transform(0, 0.0))
    return total @ np.linalg.lstsq(matrix / box**3, total, rcond=1e-13)[0]


def force(thickness, box, rate=0j, broadside=True):
    """Over mu V, in units of the radius: of a disk that moves with V exp(i w t), rate = i w / nu, or
    through fluid of mean velocity 0 (rate 0). With the inertia of the fluid in its place,
    pi thickness rate."""
    # What is left out falls with the first power of the number of waves.
    coarse, fine = (_moved(thickness, box, rate, broadside, most) for most in (600, 1200))
    return 2 * fine - coarse


if __name__ == "__main__":
    for thickness in (0.02, 0.1, 0.25):
        for broadside, thin in ((True, 16), (False, 32 / 3)):
            drag = force(thickness, 8, 0j, broadside).real
            alone = 1 / (1 / drag + 2.837297 / (6 * np.pi * 8))  # Hasimoto, in a cube
            print(f"thickness {thickness}: {drag:.3f}, unbounded {alone:.3f}, thin {thin:.3f}")
