# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid balls in a fluid: one of a tenth of its density rises from rest, one settles in a tank."""

import math
import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).resolve().parent
LIGHT = HERE / "light_ball.yaml"
TANK = HERE.parent / "sphere/settling.yaml"


def rise(times_s, radius_m, ratio, viscosity, gravity, steps=4000):
    """Speeds of a ball let go in a fluid at rest, without advection (Basset, Boussinesq, Oseen):
    (ratio + 1/2) v' = (1 - ratio) g - 9 nu v / (2 R^2) - 9 / (2 R) sqrt(nu / pi) int v'(s) /
    sqrt(t - s) ds. Implicit in the last interval of the integral, whose kernel is integrated
    exactly over each."""
    h = times_s[-1] / steps
    drag, memory = 4.5 * viscosity / radius_m**2, 4.5 / radius_m * math.sqrt(viscosity / math.pi)
    weight = [2 * (math.sqrt((k + 1) * h) - math.sqrt(k * h)) for k in range(steps)]
    rates, speeds = [], [0.0]
    for n in range(steps):
        past = sum(weight[n - i] * rates[i] for i in range(n))
        rate = ((1 - ratio) * gravity - drag * speeds[-1] - memory * past) / \
            (ratio + 0.5 + drag * h / 2 + memory * weight[0])
        rates.append(rate)
        speeds.append(speeds[-1] + h * rate)
    return [speeds[round(t / h)] for t in times_s]


class LightBall(unittest.TestCase):
    def test_rises_against_its_added_mass(self):
        probes = testing.good_run(LIGHT).probes()
        times, speeds = probes["t[s]"], probes["ball.rigid_velocity_z[m/s]"]
        theory = rise(times, 1e-3, 0.1, 5e-6, 9.81)
        late = [i for i, t in enumerate(times) if t > 0.9e-3]
        off = [speeds[i] / theory[i] - 1 for i in late]
        testing.report("speed over theory at " + ", ".join(
            f"{1e3 * times[i]:.1f} ms {100 * o:+.2f} %" for i, o in zip(late, off)))
        self.assertLess(max(map(abs, off)), 0.03)


class TenCate(unittest.TestCase):
    """The four balls of ten Cate et al. (2002), 6 cells a diameter; see sphere/settling.py."""

    def settle(self, name, settings, expected):
        settings = {"fluid.spacing": "2.5 mm", "bodies.ball.rigid": "true",
                    "bodies.ball.mesh": "{ball: {diameter: 15 mm, elements: [4, 2]}}", **settings}
        probes = testing.good_run(TANK, settings, ranks="structure=1,fluid=2", limit_s=1200).probes()
        speed = max(map(abs, probes["ball.speed_z[m/s]"]))
        testing.report(f"{name}: {1e3 * speed:.2f} mm/s, {100 * (speed / expected - 1):+.2f} %")
        self.assertAlmostEqual(speed / expected, 1, delta=0.05)

    def test_e1(self):
        self.settle("E1", {}, 0.947 * 0.038)

    def test_e2(self):
        self.settle("E2", {"fluid.density": "965 kg/m3", "fluid.viscosity": "219.7 mm2/s",
                           "fluid.expected_speed": "66 mm/s", "fluid.lattice_speed": 0.04,
                           "time.end": "1.2 s"}, 0.953 * 0.06)

    def test_e3(self):
        self.settle("E3", {"fluid.density": "962 kg/m3", "fluid.viscosity": "117.46 mm2/s",
                           "fluid.expected_speed": "100 mm/s", "fluid.lattice_speed": 0.04,
                           "time.end": "0.9 s"}, 0.959 * 0.091)

    def test_e4(self):
        self.settle("E4", {"fluid.density": "960 kg/m3", "fluid.viscosity": "60.4 mm2/s",
                           "fluid.expected_speed": "141 mm/s", "fluid.lattice_speed": 0.04,
                           "time.end": "0.8 s"}, 0.955 * 0.128)


if __name__ == "__main__":
    unittest.main()
