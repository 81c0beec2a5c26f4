# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid parts that are moved and turned as prescribed: they are where their course has them, and a fluid
resists them as it does in the frame that moves with them."""

import math
import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).resolve().parent
BRICK, BEAM, DRAGGED = HERE / "brick.yaml", HERE / "beam.yaml", HERE / "dragged_ball.yaml"


def columns(probes, body, *names):
    return list(zip(*(probes[f"{body}.rigid_{name}"] for name in names)))


class InAir(unittest.TestCase):
    def test_turns_about_a_tilted_axis_by_a_formula(self):
        settings = {"bodies.brick.moved":
                        "{turning: {axis: [1, 2, -2], about: [4 mm, -1 mm, 2 mm], "
                        "angle: 0.4*sin(2*pi*7 Hz*t) + 30 rad/s^2*t^2}}",
                    "time.step": "50 us", "gravity": "{acceleration: 9.81 m/s2}"}
        probes = testing.good_run(BRICK, settings).probes()
        turns = columns(probes, "brick", "q_w[1]", "q_x[1]", "q_y[1]", "q_z[1]")
        spins = columns(probes, "brick", "spin_x[rad/s]", "spin_y[rad/s]", "spin_z[rad/s]")
        axis, off, rate_off = [1 / 3, 2 / 3, -2 / 3], 0, 0
        for t, q, spin in zip(probes["t[s]"], turns, spins):
            half = 0.2 * math.sin(14 * math.pi * t) + 15 * t**2
            exact = [math.cos(half)] + [math.sin(half) * k for k in axis]
            off = max(off, min(math.dist(q, exact), math.dist(q, [-x for x in exact])))
            if t == 0:
                continue  # the differences there are those at 20 us
            rate = 5.6 * math.pi * math.cos(14 * math.pi * t) + 60 * t
            rate_off = max(rate_off, math.dist(spin, [rate * k for k in axis]))
        testing.report(f"turned by a formula: quaternion off by {off:.2g}, spin by {rate_off:.2g} rad/s")
        self.assertLess(off, 1e-10)
        # Differences over 10 us of an angle of 0.5 rad: 1e-16 / 1e-5, and a little more.
        self.assertLess(rate_off, 1e-9)

    def test_moves_on_a_circle_and_the_audit_has_the_work(self):
        """The magnetised brick goes round 5 mm aside against its weight and a field that would turn it:
        the work of the motion is the gain of energy less the work of both."""
        settings = {"bodies.brick.moved":
                        "{formula: {x: 5 mm*cos(2*pi*20 Hz*t), z: 5 mm*sin(2*pi*20 Hz*t)}, turning: "
                        "{axis: [0, 1, 0], about: [0 mm, 0 mm, 0 mm], oscillation: {amplitude: 30 deg, "
                        "frequency: 15 Hz, phase: -90 deg}}}",
                    "bodies.brick.magnetization": "{uniform: [50 kA/m, 0 A/m, 0 A/m]}",
                    "magnetic_field": "{constant: {magnitude: 5 mT, direction: 30 deg}}",
                    "gravity": "{acceleration: 9.81 m/s2}", "time.step": "20 us",
                    "probes.energy_audit": "true"}
        probes = testing.good_run(BRICK, settings).probes()
        place = columns(probes, "brick", "x[m]", "z[m]")
        off = 0
        for t, (x, z) in zip(probes["t[s]"], place):
            angle, around = math.pi / 6 * (1 - math.cos(30 * math.pi * t)), 40 * math.pi * t
            c, s = math.cos(angle), math.sin(angle)  # about y: z turns towards x
            exact = [1.5e-3 * c + 0.5e-3 * s + 5e-3 * (math.cos(around) - 1),
                     0.5e-3 * c - 1.5e-3 * s + 5e-3 * math.sin(around)]
            off = max(off, math.dist((x, z), exact))
        gain = [k - probes["audit.kinetic_whole[J]"][0] - f - w for k, f, w in
                zip(probes["audit.kinetic_whole[J]"], probes["audit.work_field[J]"],
                    probes["audit.work_weight[J]"])]
        work = probes["audit.work_motion[J]"]
        largest = max(map(abs, work))
        residual = max(map(abs, probes["audit.residual[J]"])) / largest
        testing.report(f"on a circle: place off by {off:.2g} m, work of the motion up to "
                       f"{largest:.3g} J, residual {residual:.2g} of it")
        self.assertLess(off, 1e-13)
        self.assertLess(residual, 1e-4)  # of second order in the step of 20 us
        for a, b in zip(work, gain):
            self.assertAlmostEqual(a / largest, b / largest, delta=1e-4)

    def test_a_region_shakes_its_soft_neighbours(self):
        """A beam whose first layer of elements is a rigid region in motion is the beam without that
        layer whose face is moved."""
        wave = "{oscillation: {amplitude: [0 mm, 0 mm, 0.2 mm], frequency: 40 Hz, phase: -90 deg}"
        common = {"time.end": "10 ms", "time.step": "2 us", "bodies.beam.clamps": "",
                  "bodies.beam.magnetization": "", "magnetic_field": "", "bodies.beam.inertia": "lumped",
                  "probes.points.half": ""}
        part = testing.good_run(BEAM, {
            **common, "bodies.beam.regions": "{base: {box: [[0 mm, 0 mm, 0 mm], [0.5 mm, 1 mm, 1 mm]]}}",
            "bodies.beam.rigid": "base", "bodies.beam.moved": wave + "}"}).probes()
        face = testing.good_run(BEAM, {
            **common, "bodies.beam.regions": "", "probes.points.tip.at": "[7.5 mm, 0.5 mm, 0.25 mm]",
            "bodies.beam.mesh.box": "{size: [7.5 mm, 1 mm, 0.5 mm], elements: [15, 2, 2]}",
            "bodies.beam.prescribed_motion": f"[{{face: x_min, {wave[1:]}}}]"}).probes()
        name = "tip_uz[m]"
        largest = max(map(abs, face[name]))
        off = max(abs(a - b) for a, b in zip(part[name], face[name])) / largest
        testing.report(f"tip of the shaken beam: up to {1e3 * largest:.3f} mm, off by {off:.2g}")
        self.assertGreater(largest, 0.1e-3)  # half of what the base moves
        self.assertLess(off, 1e-8)
        # The base's own mass is moved, too: its energy belongs to the audit.
        for probes in (part, face):
            residual = max(map(abs, probes["audit.residual[J]"]))
            self.assertLess(residual, 1e-3 * max(map(abs, probes["audit.work_motion[J]"])))


class InAFluid(unittest.TestCase):
    def test_has_the_drag_of_the_frame_that_moves_with_it(self):
        """A ball dragged along at 20 mm/s, and one that stands in a duct whose walls and fluid come at
        it: the flow is the same by Galileo, the grid another at each time."""
        dragged = testing.good_run(DRAGGED, ranks="structure=1,fluid=1").probes()
        wall = "{no_slip: {velocity: [-20 mm/s, 0 m/s, 0 m/s]}}"
        held = testing.good_run(DRAGGED, {
            "bodies.ball.moved.formula.x": "0 mm", "fluid.initial_velocity": "[-20 mm/s, 0 m/s, 0 m/s]",
            **{f"fluid.boundaries.{side}": wall for side in ("y_min", "y_max", "z_min", "z_max")}},
            ranks="structure=1,fluid=1").probes()
        way = [x - 3e-3 for x in dragged["ball.rigid_x[m]"]]
        for t, x in zip(dragged["t[s]"], way):
            self.assertAlmostEqual(x, 20e-3 * t, delta=1e-14)
        self.assertLess(max(abs(x - 3e-3) for x in held["ball.rigid_x[m]"]), 1e-15)
        name = "ball.fluid_force_x[N]"
        off = [a / b - 1 for a, b in zip(dragged[name][3:], held[name][3:])]
        mismatch = max(map(max, (p["interface.momentum_mismatch[1]"] for p in (dragged, held))))
        power = dragged[name][-1] * 20e-3
        testing.report(f"drag {1e6 * dragged[name][-1]:.3f} uN, off the held ball's by "
                       f"{100 * min(off):+.2f} to {100 * max(off):+.2f} %; momentum mismatch {mismatch:.1g}")
        self.assertLess(dragged[name][-1], 0)
        self.assertLess(max(map(abs, off)), 0.03)  # of places between the cells
        self.assertLess(mismatch, 1e-12)
        # In steady motion the work is what the drag takes.
        given = dragged["audit.work_motion[J]"]
        rate = (given[-1] - given[-2]) / 10e-3
        testing.report(f"work of the motion per time over drag times speed: {-rate / power:.4f}")
        self.assertAlmostEqual(-rate / power, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
