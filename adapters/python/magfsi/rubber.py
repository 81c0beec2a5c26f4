# SPDX-License-Identifier: GPL-2.0-or-later
"""Incompressible rubber by closed forms: nominal stress of the laws of stiffening and of Maxwell
branches (docs/theory.md) in homogeneous states, for fits to measured curves.

    law = rubber.Law("gent", {"shear_modulus": 30e3, "limit": 40})
    stress_pa = rubber.relaxed_stress(law, "uniaxial", stretches)
    stress_pa = rubber.stress_over_time(law, [(20e3, 1.5)], "uniaxial", times_s, stretches)
"""
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_banded

# Principal stretches by the one that is measured; of shear, by the angle's tangent.
MODES = ("uniaxial", "equibiaxial", "pure_shear", "shear")
# Parameters of each law beyond the shear modulus, with their units in a scene.
LAWS = {"neo_hookean": {}, "gent": {"limit": ""}, "yeoh": {"c2": "Pa", "c3": "Pa"},
        "arruda_boyce": {"locking_stretch": ""}}


def inverse_langevin(y):
    """By Newton's method from Cohen's approximation; y from 0 to below 1."""
    y = np.asarray(y, float)
    b = y * (3 - y**2) / (1 - y**2)
    for _ in range(30):
        small = np.abs(b) < 1e-3
        safe = np.where(small, 1.0, b)
        value = np.where(small, b / 3 - b**3 / 45, 1 / np.tanh(safe) - 1 / safe)
        slope = np.where(small, 1 / 3 - b**2 / 15,
                         1 / safe**2 - 1 / np.sinh(np.minimum(safe, 300))**2)
        b = b - (value - y) / slope
    return b


@dataclass
class Law:
    """kind: of LAWS; values: SI, with shear_modulus."""

    kind: str
    values: dict

    def factor(self, s):
        """2 W' / G at s = I1 - 3; infinite beyond a limit."""
        s = np.asarray(s, float)
        if self.kind == "neo_hookean":
            return np.ones_like(s)
        if self.kind == "gent":
            room = 1 - s / self.values["limit"]
            return np.where(room > 0, 1 / np.where(room > 0, room, 1), np.inf)
        if self.kind == "yeoh":
            g = self.values["shear_modulus"]
            return 1 + 4 * self.values["c2"] / g * s + 6 * self.values["c3"] / g * s**2
        lock = self.values["locking_stretch"]
        y = np.sqrt((s + 3) / 3) / lock
        inside = np.where(y < 1, y, 0.5)
        at_rest = inverse_langevin(1 / lock) * lock
        return np.where(y < 1, inverse_langevin(inside) / inside / at_rest, np.inf)


def stretches_of(mode, a):
    a = np.asarray(a, float)
    if mode == "uniaxial":
        return np.stack([a, a**-0.5, a**-0.5], -1)
    if mode == "equibiaxial":
        return np.stack([a, a, a**-2.0], -1)
    return np.stack([a, np.ones_like(a), 1 / a], -1)


def relaxed_stress(law, mode, a):
    """Nominal stress [Pa] at the stretches a, of shear at the tangents a."""
    a, g = np.asarray(a, float), law.values["shear_modulus"]
    if mode == "shear":
        return g * law.factor(a**2) * a
    l = stretches_of(mode, a)
    return g * law.factor((l**2).sum(-1) - 3) * (l[..., 0] - l[..., 2]**2 / l[..., 0])


def branch_stress(modulus_pa, time_s, mode, times_s, a):
    """Of one branch, relaxed before the first row. C^-1 changes evenly between rows, which is exact
    for rows that lie close."""
    a = np.asarray(a, float)
    if mode == "shear":
        e = a[:, None]  # minus the component of C^-1
    else:
        e = -stretches_of(mode, a)**-2.0
    share = np.diff(times_s) / time_s
    safe = np.where(share > 0, share, 1.0)
    gain = np.where(share > 0, -np.expm1(-safe) / safe, 1.0)
    # d_i - exp(-share_i) d_{i-1} = gain_i (e_i - e_{i-1}): a system of two bands.
    bands = np.ones((2, len(a)))
    bands[1, :-1] = -np.exp(-share)
    right = np.zeros_like(e)
    right[1:] = gain[:, None] * np.diff(e, axis=0)
    d = solve_banded((1, 0), bands, right)
    if mode == "shear":
        return modulus_pa * d[:, 0]
    l = stretches_of(mode, a)
    # A = D + C^-1; the pressure takes the unloaded direction's stress away.
    return modulus_pa * (l[:, 0] * d[:, 0] - l[:, 2]**2 / l[:, 0] * d[:, 2])


def stress_over_time(law, branches, mode, times_s, a):
    """Nominal stress [Pa]. branches: (modulus [Pa], time [s])."""
    out = relaxed_stress(law, mode, a)
    for modulus_pa, time_s in branches:
        out = out + branch_stress(modulus_pa, time_s, mode, times_s, a)
    return out
