# SPDX-License-Identifier: GPL-2.0-or-later
"""One arm of the gripper as a planar elastica with magnetic torques, a strip whose width curls as it bends
(Ashwell, J. R. Aeronaut. Soc. 54 (1950) 708). Nothing of it is from the lattice."""
import numpy as np
from scipy.optimize import brentq

LENGTH, WIDTH, THICK = 2.5e-3, 1e-3, 0.2e-3  # m
SHEAR, LAME = 33e3, 660e3  # Pa
INNER, TIP = (62e3, 0.0), (44e3 * 2**0.5, np.pi / 4)  # A/m, and how far it leans up from the arm
POISSON = LAME / (2 * (LAME + SHEAR))
YOUNG = 2 * SHEAR * (1 + POISSON)
PLATE = YOUNG * THICK**3 / (12 * (1 - POISSON**2))


def moment(curvature):
    """N m, for a curvature > 0: between nu^2 less than a wide plate's and a wide plate's.

    The sides curl by w(y), on which the bent strip's hoop stresses pull back: D w'''' + E h k^2 w = 0, sides
    free; the moment is the slope of the energy, int D (k + nu w'') + E h k w^2 dy.
    """
    rate = (3 * (1 - POISSON**2))**0.25 * np.sqrt(curvature / THICK)
    y = np.linspace(-WIDTH / 2, WIDTH / 2, 401)
    cosine, sine = np.cosh(rate * y) * np.cos(rate * y), np.sinh(rate * y) * np.sin(rate * y)
    c, s, ch, sh = (f(rate * WIDTH / 2) for f in (np.cos, np.sin, np.cosh, np.sinh))
    a, b = np.linalg.solve([[-sh * s, ch * c], [ch * s + sh * c, ch * s - sh * c]],
                           [-POISSON * curvature / (2 * rate**2), 0])
    curl, curled = a * cosine + b * sine, 2 * rate**2 * (b * cosine - a * sine)
    return np.trapz(PLATE * (curvature + POISSON * curled) + YOUNG * THICK * curvature * curl**2, y)


CURVATURES = np.append(0, np.linspace(10, 6e3, 600))
MOMENTS = np.append(0, [moment(k) for k in CURVATURES[1:]])


def course(root, field, steps=400):
    """Angles downwards at the ends of the steps, and the moment left at the tip, by Runge and Kutta's method;
    of one moment at the root, or of several."""
    angle, bent, along = np.zeros_like(root), np.array(root, float), LENGTH / steps
    angles = [angle]
    for i in range(steps):
        strength, lean = INNER if 2 * i < steps else TIP

        def slopes(angle, bent, strength=strength, lean=lean):
            torque = WIDTH * THICK * strength * field * np.cos(angle - lean)
            return np.sign(bent) * np.interp(np.abs(bent), MOMENTS, CURVATURES), -torque

        a = slopes(angle, bent)
        b = slopes(angle + along / 2 * a[0], bent + along / 2 * a[1])
        c = slopes(angle + along / 2 * b[0], bent + along / 2 * b[1])
        d = slopes(angle + along * c[0], bent + along * c[1])
        angle = angle + along / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0])
        bent = bent + along / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
        angles.append(angle)
    return np.array(angles), bent


def shape(field):
    """x, z [m] from the root on, and the angle downwards [rad], in the field [T] that points down."""
    # The moment at the root that leaves none at the tip; of several, the one that does not swing beyond its aim.
    tried = np.linspace(0, WIDTH * THICK * LENGTH * INNER[0] * field, 400)
    _, left = course(tried, field)
    for i in np.flatnonzero(np.sign(left[:-1]) != np.sign(left[1:])):
        root = brentq(lambda m: course(m, field)[1], tried[i], tried[i + 1], xtol=1e-15)
        angle, _ = course(root, field)
        if angle.min() >= 0 and angle.max() <= 3 * np.pi / 4:
            x, z = (np.append(0, np.cumsum((f(angle[1:]) + f(angle[:-1])) / 2)) * LENGTH / 400
                    for f in (np.cos, np.sin))
            return x, -z, angle
    raise ValueError(f"no shape in {field} T")
