# SPDX-License-Identifier: GPL-2.0-or-later
"""What clamps, rollers and moved faces do to a body (probes.bodies: reaction_force): they bear its
load, give it its momentum and do the work on it, by Newton's method and in motion alike; and in
a field gradient and on a platform both methods find the same equilibria."""

import itertools
import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).resolve().parent
AXES = "xyz"


def reactions(probes, face):
    return [probes[f"bar.{face}.reaction_{axis}[N]"] for axis in AXES]


def trapezium(times, values):
    return [0.5 * (a + b) * (t1 - t0)
            for (t0, t1), (a, b) in zip(itertools.pairwise(times), itertools.pairwise(values))]


class Supports(unittest.TestCase):
    WEIGHT_N = 2000 * 2e-8 * 9.81

    def test_bear_the_weight(self):
        # The field's own forces add up to nothing. Each node keeps the tolerance of its load.
        for method, tolerance in (("newton", 1e-9), ("dynamics", 1e-5)):
            run = testing.good_run(HERE / "held_in_a_gradient.yaml", {
                "magnetic_field.gradient": "null", "time.equilibrium.method": method,
                "time.equilibrium.tolerance": tolerance})
            x, y, z = (values[-1] for values in reactions(run.probes(), "x_min"))
            testing.report(f"{method}: reaction {z / self.WEIGHT_N:.9f} of the weight")
            # 99 nodes, of the one largest load each.
            self.assertAlmostEqual(z / self.WEIGHT_N, 1, delta=99 * tolerance)
            for across in (x, y):
                self.assertAlmostEqual(across / self.WEIGHT_N, 0, delta=99 * tolerance)

    def test_of_both_methods_agree_in_a_gradient(self):
        runs = [testing.good_run(HERE / "held_in_a_gradient.yaml", {
            "time.equilibrium.method": method, "time.equilibrium.tolerance": 1e-6}).probes()
            for method in ("newton", "dynamics")]
        for column in ("bar.x_min.reaction_x[N]", "bar.x_min.reaction_z[N]", "tip_x[m]",
                       "tip_z[m]", "bar.work_magnetic[J]", "bar.energy_elastic[J]"):
            newton, dynamics = (run[column] for run in runs)
            testing.report(f"{column}: newton {newton[-1]:.6g}, dynamics {dynamics[-1]:.6g}")
            # The residual times the bar's softness, as in tests/validation/probes/field_work.py.
            for a, b in zip(newton, dynamics):
                self.assertAlmostEqual(a, b, delta=1e-3 * max(map(abs, newton)))

    # On rollers LAMMPS's own steps keep the momentum to rounding; a face in motion has its course
    # to the second order in the step.
    def test_give_the_body_its_momentum(self):
        probes = testing.good_run(HERE / "shaken.yaml").probes()
        times = probes["t[s]"]
        for d, axis in enumerate(AXES):
            pushed = [sum(both) - (self.WEIGHT_N if axis == "z" else 0) for both in
                      zip(reactions(probes, "x_min")[d], reactions(probes, "y_min")[d])]
            impulse = list(itertools.accumulate(trapezium(times, pushed)))
            momentum = probes[f"whole.momentum_{axis}[kg m/s]"]
            gained = [p - momentum[0] for p in momentum[1:]]
            largest = max(map(abs, gained))
            off = max(abs(a - b) for a, b in zip(impulse, gained)) / largest
            testing.report(f"{axis}: impulse of the supports off by {off:.2g} of the momentum")
            self.assertLess(off, 1e-3)

    # Ends pulled apart and sheared: the elastic energy is the work of the face that moves.
    def test_of_a_driven_face_do_the_elastic_work(self):
        probes = testing.good_run(HERE / "driven.yaml").probes()
        work = 0
        for d, axis in enumerate(AXES):
            held, driven = reactions(probes, "x_min")[d], reactions(probes, "x_max")[d]
            largest = max(map(abs, driven))
            for a, b in zip(held, driven):
                # 1e-6 of the largest force on a node, 99 of them.
                self.assertAlmostEqual(a + b, 0, delta=1e-4 * max(largest, 1e-6))
            work += sum(trapezium(probes[f"end_u{axis}[m]"], driven))
        elastic = probes["bar.energy_elastic[J]"][-1]
        testing.report(f"work of the driven face over elastic energy {work / elastic:.6f}")
        self.assertAlmostEqual(work / elastic, 1, delta=1e-3)  # the trapezium rule's


class Platform(unittest.TestCase):
    def test_strip_stands_as_in_damped_motion(self):
        runs = [testing.good_run(HERE / "on_smooth_ground.yaml", {
            "time.equilibrium.method": method, "time.equilibrium.tolerance": tolerance}).probes()
            for method, tolerance in (("newton", 1e-6), ("dynamics", 1e-7))]
        for column in ("strip.com_z[m]", "strip.end_to_end[m]", "strip.mid_rise[m]"):
            newton, dynamics = (run[column] for run in runs)
            testing.report(f"{column}: newton {newton[-1]:.6g}, dynamics {dynamics[-1]:.6g}")
            for a, b in zip(newton, dynamics):
                self.assertAlmostEqual(a, b, delta=1e-3 * 3.7e-3)


if __name__ == "__main__":
    unittest.main()
