# SPDX-License-Identifier: GPL-2.0-or-later
"""The flow that a carpet of slender rods drives between two walls, in a creeping fluid of viscosity 1.

Lengths in any unit. The cell, box, is periodic along x and y, with walls at z = 0 and box[2]."""
import math

import numpy as np
from scipy.special import erf, erfc, erfcx

EULER = 0.5772156649015329
SQUARE = 0.5902  # radius of the circle with the outer conformal radius of a square of side 1
WIDER = 1.5


def pumped(force_x, z, box):
    """Volume flow through x = const of the cell, by forces at heights z. The reciprocal theorem with the flow
    z (H - z) / 2 of a pressure gradient: exact for creeping flow without one."""
    return (force_x * z * (box[2] - z)).sum(-1) / (2 * box[0])


def on_a_cone(length, side, cone, tilt, box):
    """Mean flow at 1 rad a unit of time, of a straight rod on a cone whose axis is tilted in the plane yz from
    upright: by the pieces' own resistances across the rod. Of the force times its height the mean is zeta omega
    L^3 sin^2(cone) sin(tilt) / 6, as in Smith, Blake and Gaffney (J. R. Soc. Interface 5 (2008) 567)."""
    across = 4 * math.pi / (math.log(2 * length / (SQUARE * side)) + 0.5)
    beat = across * math.sin(cone)**2 * math.sin(tilt) / (4 * box[0])
    return beat * length**3 * (box[2] / 3 - length * math.cos(cone) * math.cos(tilt) / 2)


def forces(at, velocity, side, box):
    """Forces of even pieces of a rod on the fluid: slender-body theory with walls and images. Forces lie on the
    rod's middle line, blurred by Gaussians wider than the rod; what a thin line of forces adds to the velocity at
    its own place, the logarithm of how much wider, is added: without it pieces closer than the blur have no answer
    of their own. A cylinder that turns about its middle has 2 to 3 % less resistance so than it should, 14 to 7
    widths long (tests/validation/tutorials/cilia.py).

    at, velocity: (pieces, 3)."""
    # The Gaussian whose logarithm in the mean is that of the radius.
    thin = SQUARE * side / math.exp(0.5 * (math.log(2) - EULER))
    mobility = _mobility(at, WIDER * thin, np.array(box, float))
    along = np.gradient(at, axis=0)
    length = np.linalg.norm(along, axis=1)
    for i, (tangent, piece) in enumerate(zip(along / length[:, None], length)):
        own = (np.eye(3) + np.outer(tangent, tangent)) * 2 * math.log(WIDER) / (8 * math.pi * piece)
        mobility[3 * i:3 * i + 3, 3 * i:3 * i + 3] += own
    return np.linalg.solve(mobility, velocity.ravel()).reshape(-1, 3)


def _free(k, z, deviation):
    """Of a blurred force in an unbounded fluid, in waves exp(i k.r) along x and y: velocities (across k from a
    force across; along k from along; the two mixed; z from z), z above the force."""
    bell = np.exp(-0.5 * ((k * deviation)**2 + (z / deviation)**2))

    def half(way):  # exp(way k z) erfc(c) / 2, without its overflow
        c = (k * deviation + way * z / deviation) / math.sqrt(2)
        return 0.5 * np.where(c > 0, erfcx(np.maximum(c, 0)) * bell, np.exp(np.minimum(way * k * z, 0)) * erfc(c))

    low, high = half(-1), half(1)
    even, odd = low + high, low - high
    near = math.sqrt(2 / math.pi) * deviation * bell
    # exp(-k|z|), |z| exp(-k|z|) and z exp(-k|z|), blurred
    slope, skew = z * odd - k * deviation**2 * even + near, z * even - k * deviation**2 * odd
    return even / (2 * k), (even - k * slope) / (4 * k), skew / 4, (even + k * slope) / (4 * k)


def _between_walls(k, z, deviation, height):
    """The same with walls, by waves (waves, 1, 1): to z (rows) from z (columns): what waves that walls send
    back take away. w is the velocity along z, w'/k that along k (continuity)."""
    across, along, mixed, up = _free(k, z[:, None] - z[None, :], deviation)
    walls = [_free(k, wall - z[None, None, :], deviation) for wall in (0.0, height)]

    def basis(at):
        low, high = k * at, k * (height - at)
        down, back = np.exp(-low), np.exp(-high)
        return ([down, low * down, back, high * back],
                [-down, (1 - low) * down, back, -(1 - high) * back])

    at_walls = [basis(wall) for wall in (0.0, height)]
    matrix = np.array([[w[:, 0, 0] for w in row] for pair in at_walls for row in pair]).transpose(2, 0, 1)
    here_w, here_slope = (np.array(part)[..., 0].transpose(1, 2, 0) for part in basis(z[None, :, None]))

    def sent_back(w_walls, slope_walls):
        known = np.concatenate([w_walls[0], slope_walls[0], w_walls[1], slope_walls[1]], 1)
        factors = np.linalg.solve(matrix, known)
        return here_w @ factors, here_slope @ factors

    w, slope = sent_back([wall[2] for wall in walls], [wall[1] for wall in walls])
    along, up_from_along = along - slope, mixed - w
    w, slope = sent_back([wall[3] for wall in walls], [-wall[2] for wall in walls])
    up, along_from_up = up - w, mixed + slope
    two = matrix[:, [0, 2]][:, :, [0, 2]]
    known = np.concatenate([wall[0] for wall in walls], 1)
    across = across - here_w[..., [0, 2]] @ np.linalg.solve(two, known)
    return across, along, along_from_up, up_from_along, up


def _mobility(at, deviation, box):
    """Velocities of all places by forces on all."""
    most = (4.5 / deviation * box[:2] / (2 * math.pi)).astype(int)  # beyond: exp(-10)
    i, j = np.meshgrid(*[np.arange(-m, m + 1) for m in most], indexing="ij")
    half = (i > 0) | ((i == 0) & (j > 0))  # of k and -k one
    waves = 2 * math.pi * np.stack([i[half], j[half]], 1) / box[:2]
    waves = waves[(waves**2).sum(1) < (4.5 / deviation)**2]
    n, z = len(at), at[:, 2]
    out = np.zeros((3, 3, n, n))
    for part in np.array_split(waves, 1 + len(waves) // 64):
        k = np.hypot(*part.T)[:, None, None]
        across, along, along_from_up, up_from_along, up = _between_walls(k, z, deviation, box[2])
        phase = part @ at[:, :2].T
        phase = phase[:, :, None] - phase[:, None, :]
        cosine, sine = np.cos(phase), np.sin(phase)
        x, y = (part[:, d, None, None] / k for d in range(2))
        out[0, 0] += ((x * x * along + y * y * across) * cosine).sum(0)
        out[0, 1] += (x * y * (along - across) * cosine).sum(0)
        out[1, 1] += ((y * y * along + x * x * across) * cosine).sum(0)
        for d, e in ((0, x), (1, y)):
            out[d, 2] += (e * along_from_up * sine).sum(0)
            out[2, d] += (e * up_from_along * sine).sum(0)
        out[2, 2] += (up * cosine).sum(0)
    out[1, 0] = out[0, 1]
    out *= 2
    # The mean over x and y, driven by no pressure gradient.
    apart = z[:, None] - z[None, :]
    blurred = apart * erf(apart / (math.sqrt(2) * deviation)) \
        + math.sqrt(2 / math.pi) * deviation * np.exp(-0.5 * (apart / deviation)**2)
    mean = 0.5 * (z[:, None] + z[None, :] - blurred) - z[:, None] * z[None, :] / box[2]
    for d in range(2):
        out[d, d] += mean
    return out.transpose(2, 0, 3, 1).reshape(3 * n, 3 * n) / (box[0] * box[1])
