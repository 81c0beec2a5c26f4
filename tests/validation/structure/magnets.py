# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies near magnets: what holds them bears the force of the field, both methods find the same
equilibria, in motion the work of the field is what bodies gain, and on a small magnet force and
torque are those of a dipole."""

import math
import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).resolve().parent
AXES = "xyz"
MU0 = 4e-7 * math.pi


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class NearAMagnet(unittest.TestCase):
    def test_both_methods_agree_and_the_clamp_bears_the_force(self):
        runs = {method: testing.good_run(HERE / "near_a_magnet.yaml", {
            "time.equilibrium.method": method, "time.equilibrium.tolerance": 1e-6}).probes()
            for method in ("newton", "dynamics")}
        for column in ("tip_x[m]", "tip_z[m]", "bar.work_magnetic[J]", "bar.energy_elastic[J]",
                       "bar.magnetic_force_z[N]", "bar.magnetic_torque_y[N m]"):
            newton, dynamics = (runs[m][column] for m in ("newton", "dynamics"))
            testing.report(f"{column}: newton {newton[-1]:.6g}, dynamics {dynamics[-1]:.6g}")
            # The residual times the bar's softness, as in supports.py.
            for a, b in zip(newton, dynamics):
                self.assertAlmostEqual(a, b, delta=1e-3 * max(map(abs, newton)))
        p = runs["newton"]
        largest = max(abs(f) for a in AXES for f in p[f"bar.magnetic_force_{a}[N]"])
        for axis in AXES:
            for held, drawn in zip(p[f"bar.x_min.reaction_{axis}[N]"],
                                   p[f"bar.magnetic_force_{axis}[N]"]):
                # 99 nodes, each with the tolerance.
                self.assertAlmostEqual(held, -drawn, delta=1e-4 * largest)

    # Let go near a magnet that turns, free of all else: kinetic and elastic energy are the work.
    def test_work_of_the_field_is_what_the_body_gains(self):
        for turning in ({}, {"magnetic_field.sources.magnet.turning":
                             "{axis: [0, 1, 0], frequency: 20 Hz}"}):
            run = testing.good_run(HERE / "near_a_magnet.yaml", turning | {
                "time": "{end: 10 ms}", "bodies.bar.clamps": "null",
                "magnetic_field.sources.magnet.motion": "null",
                "probes": "{every: 1 ms, bodies: [energy, speed], energy_audit: true}"})
            p = run.probes()
            work = p["bar.work_magnetic[J]"]
            gained = [e + k for e, k in zip(p["bar.energy_elastic[J]"],
                                            p["bar.energy_kinetic[J]"])]
            off = max(abs(w - g) for w, g in zip(work, gained)) / max(gained)
            testing.report(f"{'turning' if turning else 'at rest'}: work {work[-1]:.6g} J, off by {off:.2g}")
            # Second order in LAMMPS's step, of which the stiffest mode has some ten.
            self.assertLess(off, 2e-3)
            self.assertGreater(math.hypot(*(p[f"bar.speed_{a}[m/s]"][-1] for a in AXES)), 1e-3)


class SmallMagnet(unittest.TestCase):
    """A cube of 0.5 mm, 60 to 100 mm from a source: sizes change the forces by (0.5 / 60)^2 / 4 at most,
    the cube's strain in the field by 1e-4."""

    MAGNETIZATION = [20e3, -30e3, 50e3]
    MOMENT = [m * 0.5e-3**3 for m in MAGNETIZATION]

    def loads(self, source):
        p = testing.good_run(HERE / "near_a_magnet.yaml", {
            "time.end": "1 s", "magnetic_field.sources": "{far: " + source + "}",
            "bodies.bar.mesh.box": "{size: [0.5 mm, 0.5 mm, 0.5 mm], elements: [2, 2, 2]}",
            "bodies.bar.magnetization.uniform": f"[{', '.join(f'{m} A/m' for m in self.MAGNETIZATION)}]",
            "probes.points": "null"}).probes()
        return ([p[f"bar.magnetic_force_{a}[N]"][-1] for a in AXES],
                [p[f"bar.magnetic_torque_{a}[N m]"][-1] for a in AXES])

    def compare(self, name, found, right):
        off = math.dist(found, right) / math.hypot(*right)
        testing.report(f"{name}: {math.hypot(*found):.6g}, off by {off:.2g}")
        self.assertLess(off, 1e-3)

    def test_beside_a_dipole(self):
        other = [0.3, 0.5, -0.4]  # A m2
        away = [80e-3, 40e-3, -30e-3]  # from it to the cube's middle
        force, torque = self.loads(
            f"{{dipole: {{moment: [{', '.join(f'{m} A m2' for m in other)}]}}, position: "
            f"[{', '.join(f'{0.25e-3 - x} m' for x in away)}]}}")
        r = math.hypot(*away)
        n = [x / r for x in away]
        # Yung, Landecker, Villani, Magn. Electr. Sep. 9 (1998) 39.
        ours, theirs = dot(self.MOMENT, n), dot(other, n)
        right = [3 * MU0 / (4 * math.pi * r**4) * (theirs * a + ours * b + dot(self.MOMENT, other) * c
                                                   - 5 * ours * theirs * c)
                 for a, b, c in zip(self.MOMENT, other, n)]
        field = [MU0 / (4 * math.pi * r**3) * (3 * theirs * c - b) for b, c in zip(other, n)]
        self.compare("dipole, force", force, right)
        self.compare("dipole, torque", torque, cross(self.MOMENT, field))

    def test_on_the_axis_of_a_coil(self):
        current, radius, z = 200, 30e-3, 60e-3
        force, torque = self.loads(f"{{coil: {{diameter: {2 * radius} m, turns: 1, current: {current} A}}, "
                                   f"position: [0.25 mm, 0.25 mm, {0.25e-3 - z} m]}}")
        # B = mu0 I R^2 / (2 (R^2 + z^2)^1.5) along the axis; across it the field opens by half of
        # what it falls along it, since div B = 0.
        field = MU0 * current * radius**2 / (2 * (radius**2 + z**2)**1.5)
        slope = -3 * z / (radius**2 + z**2) * field
        m = self.MOMENT
        self.compare("coil, force", force, [-slope / 2 * m[0], -slope / 2 * m[1], slope * m[2]])
        self.compare("coil, torque", torque, cross(m, [0, 0, field]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
