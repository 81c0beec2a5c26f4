# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a body that swings by 20 um, and what it feels of the fluid."""

import cmath
import math

from magfsi import testing

AMPLITUDE, FREQUENCY, DENSITY, LENGTH = 20e-6, 25, 1000, 0.4e-3
OMEGA = 2 * math.pi * FREQUENCY


def run(scene, body, axis, settings):
    """The added area and, below zero, the drag over rho omega V, per length along y [m2], from the
    second period; and what the summary says of the boundary."""
    done = testing.good_run(scene, settings, limit_s=900)
    probes = done.probes()
    time, force = probes["t[s]"], probes[f"{body}.fluid_force_{axis}[N]"]
    rows = round(1 / (FREQUENCY * (time[1] - time[0])))
    # Displacement -A cos(w t): velocity A w sin(w t), acceleration A w^2 cos(w t).
    found = sum(2 / rows * f * cmath.exp(1j * OMEGA * t)
                for t, f in zip(time[-rows:], force[-rows:], strict=True))
    boundary = done.summary()["immersed_boundary"]
    moved = -found / (DENSITY * LENGTH * AMPLITUDE * OMEGA**2)
    return complex(moved.real, -abs(moved.imag)), boundary
