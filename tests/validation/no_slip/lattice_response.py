# SPDX-License-Identifier: GPL-2.0-or-later
"""What an infinite sheet of markers that swings along its plane moves, by theory of the lattice.

The lattice-Boltzmann scheme with two relaxation rates is linear in a shear flow: each shear wave
exp(i k z) responds alone to the force that moves it. Markers spread their forces by the kernel and
hold q = U + F dt / (2 rho), interpolated, at the plane's velocity. Lengths are in grid spacings.
"""

import numpy as np


def two_point(r):
    return np.maximum(0, 1 - np.abs(r))


def three_point(r):
    r = np.abs(r)
    inner = (1 + np.sqrt(np.maximum(0, 1 - 3 * r**2))) / 3
    outer = (5 - 3 * r - np.sqrt(np.maximum(0, 1 - 3 * (1 - r)**2))) / 6
    return np.where(r <= 0.5, inner, np.where(r <= 1.5, outer, 0))


def _wave(k, tau, magic, omega):
    """q over the amplitude of the force. The populations that carry the shear are lumped by their
    velocity along z: 0, +1, -1, with 2/3, 1/6, 1/6 of the momentum at rest."""
    even = 1 / tau
    odd = 1 / (magic / (tau - 0.5) + 0.5)
    momentum, third, stress = np.array([1, 1, 1]), np.array([0, 1, 1]), np.array([0, 1, -1])
    third_after = (1 - odd) * third + odd * momentum / 3
    third_forced = odd / 6 + (1 - odd / 2) / 3
    stress_after = (1 - even) * stress
    after = np.array([momentum - third_after, (third_after + stress_after) / 2,
                      (third_after - stress_after) / 2])
    forced = np.array([1 - third_forced, third_forced / 2, third_forced / 2])
    stream = np.diag([1, np.exp(-1j * k), np.exp(1j * k)])
    state = np.linalg.solve(np.exp(1j * omega) * np.eye(3) - stream @ after, stream @ forced)
    return momentum @ state + 0.5


def moved_fluid(kernel, planes, cells, tau, magic, omega):
    """Force over rho i omega V of planes of markers at these places: the fluid that they move, a
    thickness; the imaginary part, below zero, is the drag. omega: per step."""
    k = 2 * np.pi * np.fft.fftfreq(cells)
    nodes = np.arange(cells)
    response = np.array([_wave(q, tau, magic, omega) for q in k])
    spread = np.array([np.fft.fft(sum(kernel(nodes - p + turn * cells) for turn in (-1, 0, 1)))
                       for p in planes])
    felt = (spread.conj() * response) @ spread.T / cells
    return np.linalg.solve(felt, np.ones(len(planes))).sum() / (1j * omega)
