# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid helix that turns about its axis in a creeping fluid: how fast it swims, what torque it takes.

Lengths in any unit; viscosity 1, rate of turning 1 rad a unit of time."""
import math

import numpy as np

EULER = 0.5772156649015329
SQUARE = 0.5902  # radius of the circle with the outer conformal radius of a square of side 1


def wire(radius, pitch):
    """(length of a turn, cosine and sine of the angle between the wire and the axis)"""
    turn = math.hypot(2 * math.pi * radius, pitch)
    return turn, pitch / turn, 2 * math.pi * radius / turn


def lighthill(radius, pitch, turns, side):
    """(swimming speed, torque) by resistances of the wire's own pieces, with Lighthill's coefficients (SIAM
    Review 18 (1976) 161, in Lauga and Powers, Rep. Prog. Phys. 72 (2009) 096601): the flow that pieces make
    further off is in their q = 0.09 turns."""
    turn, cosine, sine = wire(radius, pitch)
    thin = SQUARE * side
    log = math.log(2 * 0.09 * turn / thin)
    along, across = 2 * math.pi / log, 4 * math.pi / (log + 0.5)
    speed = radius * (across - along) * sine * cosine / (along * cosine**2 + across * sine**2)
    a_length = radius**2 * (along * sine**2 + across * cosine**2) \
        - (across - along) * sine * cosine * radius * speed + 4 * math.pi * thin**2 * cosine**2
    return speed, turns * turn * a_length


def in_periodic_box(radius, pitch, turns, side, box):
    """(swimming speed, torque) of a free helix with its images in a periodic box: slender-body theory. Forces
    lie on the wire's middle line, blurred by Gaussians whose logarithm in the mean is that of the wire's
    radius, so that far and near pieces act on each other as those of a wire do (error: the square of the
    wire's radius over the helix's). The flow of a force in a periodic box is a sum over waves (Hasimoto, J.
    Fluid Mech. 5 (1959) 317). No net force, no torque but about the axis; wire pieces turn about themselves
    with 4 pi mu a^2."""
    turn, cosine, _ = wire(radius, pitch)
    thin = SQUARE * side
    # Two Gaussians of width sigma are one of width sqrt(2) sigma, whose mean logarithm in a plane is this.
    sigma = thin / (math.sqrt(2) * math.exp(0.5 * (math.log(2) - EULER)))
    pieces = round(turns * turn / (0.6 * thin))
    angle = (np.arange(pieces) + 0.5) / pieces * 2 * math.pi * turns
    at = np.stack([pitch * angle / (2 * math.pi), radius * np.cos(angle), radius * np.sin(angle)], 1)
    spin = 4 * math.pi * thin**2 * cosine**2 * turns * turn
    return of_a_free_body(at, mobility(at, sigma, np.array(box, float)), spin)


def of_a_free_body(at, mobility, spin=0):
    """(swimming speed, torque) of places that move as one about x, without a force on them or a torque but along
    x; `spin` is added to the torque."""
    arm = at - [at[:, 0].mean(), 0, 0]
    unit = np.eye(3)
    motions = np.stack([np.broadcast_to(e, at.shape).ravel() for e in unit]
                       + [np.cross(e, arm).ravel() for e in unit], 1)
    resistance = motions.T @ np.linalg.solve(mobility, motions)
    resistance[3, 3] += spin
    free = [0, 1, 2, 4, 5]
    motion = np.linalg.solve(resistance[np.ix_(free, free)], -resistance[free, 3])
    return motion[0], resistance[3, 3] + resistance[3, free] @ motion


def mobility(at, sigma, box):
    """Velocities of all places by forces on all: (1 - kk/k^2) / k^2 exp(-k^2 sigma^2) over the waves."""
    largest = 3 / sigma  # beyond: exp(-9)
    most = (largest * box / (2 * math.pi)).astype(int)
    grid = np.stack(np.meshgrid(*[np.arange(-m, m + 1) for m in most], indexing="ij"), -1).reshape(-1, 3)
    first, second, third = grid.T  # of k and -k one
    grid = grid[(first > 0) | ((first == 0) & ((second > 0) | ((second == 0) & (third > 0))))]
    waves = 2 * math.pi * grid / box
    waves = waves[(waves**2).sum(1) < largest**2]
    square = (waves**2).sum(1)
    weight = 2 * np.exp(-square * sigma**2) / square / box.prod()
    out = np.zeros((3, 3, len(at), len(at)))
    for part in np.array_split(np.arange(len(waves)), 1 + len(waves) // 20000):
        phase = waves[part] @ at.T
        cosines, sines = np.cos(phase), np.sin(phase)
        for i in range(3):
            for j in range(i + 1):
                w = (weight[part] * ((i == j) - waves[part, i] * waves[part, j] / square[part]))[:, None]
                out[i, j] += (w * cosines).T @ cosines + (w * sines).T @ sines
                out[j, i] = out[i, j]
    return out.transpose(2, 0, 3, 1).reshape(3 * len(at), 3 * len(at))


def angle_of(probes):
    """Angle by which the helix has turned about x. The middle of two points a turn apart is across from the one
    between them: tilted by its wobble, the helix has the same angle."""
    y, z = (probes[f"start_{c}[m]"] + probes[f"a_turn_on_{c}[m]"] - 2 * probes[f"opposite_{c}[m]"] for c in "yz")
    return np.unwrap(np.arctan2(z, y))


def turns_with_the_field(frequency, step_out):
    """Mean rate of turning: the field's up to the step-out frequency, above it less (Adler, Proc. IRE 34
    (1946) 351): the mean of dphi/dt = omega - omega_c sin(phi)."""
    f = np.asarray(frequency, float)
    return f - np.sqrt(np.maximum(f**2 - step_out**2, 0))
