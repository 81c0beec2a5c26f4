# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies of the fluid's density in a shear flow: spheroids turn on Jeffery's orbits, and a ball
near a wall moves along it as Goldman, Cox and Brenner (1967, part II) computed."""

import math
import sys
import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).resolve().parent
SHEAR = HERE.parent / "sphere/shear.yaml"
sys.path.insert(0, str(SHEAR.parent))
import ball_mesh  # noqa: E402

RADIUS, HEIGHT = 0.5e-3, 4e-3


def spheroid(aspect):
    """Of the volume of a ball of RADIUS; its axis is that of z."""
    mesh = ball_mesh.ball(6, 3, 2 * RADIUS)
    along = aspect ** (2 / 3)
    mesh.nodes = [[x / math.sqrt(along), y / math.sqrt(along), z * along] for x, y, z in mesh.nodes]
    return mesh


def run_in_shear(mesh, settings):
    folder = Path(testing.new_folder())
    (folder / "shear.yaml").write_text(SHEAR.read_text())
    ball_mesh.write(folder / "ball.msh", mesh)
    return testing.good_run(folder / "shear.yaml", {
        "bodies.ball.rigid": "true", "probes.bodies": "[com, speed, rigid_motion]", **settings},
        ranks="structure=1,fluid=1", limit_s=1200).probes()


class Jeffery(unittest.TestCase):
    """A turn takes 2 pi / G (r + 1 / r), r the ratio of the axes (Jeffery 1922), here half of one. The
    walls are ten half axes apart: at five they take 2 % more. The body has 12 cells a diameter of the
    ball of its volume: with 8 it takes 2 % more, by the markers' depth below the surface."""

    def half_turn(self, aspect):
        rate, height_m = 2.0, 8e-3  # Reynolds number G a^2 / nu of at most 0.13
        wall = f"{1e3 * rate * height_m / 2} mm/s"
        half = math.pi / rate * (aspect + 1 / aspect)
        # Along the flow it is slow; it starts 35 degrees before, while the flow becomes linear.
        along = 90 if aspect > 1 else 0
        probes = run_in_shear(spheroid(aspect), {
            "bodies.ball.initial": f"{{position: [4 mm, 3 mm, 4 mm], rotation: {{plane: zx, "
                                   f"angle: {along - 35} deg}}}}",
            "fluid.box": "[8 mm, 6 mm, 8 mm]", "fluid.spacing": "0.166666666667 mm",
            "fluid.refinement": "{levels: 1}",
            "fluid.viscosity": "10 mm2/s", "fluid.expected_speed": wall,
            "fluid.lattice_speed": 0.017, "time.end": f"{3.6 + 1.1 * half:.4g} s",
            "probes.every": "50 ms",
            "fluid.boundaries.z_min": f"{{no_slip: {{velocity: [-{wall}, 0 m/s, 0 m/s]}}}}",
            "fluid.boundaries.z_max": f"{{no_slip: {{velocity: [{wall}, 0 m/s, 0 m/s]}}}}"})
        times, turned, before = probes["t[s]"], [0.0], None
        for w, y in zip(probes["ball.rigid_q_w[1]"], probes["ball.rigid_q_y[1]"]):
            angle = 2 * math.atan2(y, w)
            if before is not None:
                turned.append(turned[-1] + math.remainder(angle - before, 2 * math.pi))
            before = angle

        def when(wanted):
            n = next(n for n, angle in enumerate(turned) if angle >= wanted)
            part = (wanted - turned[n - 1]) / (turned[n] - turned[n - 1])
            return times[n - 1] + part * (times[n] - times[n - 1])

        first = math.radians(35) + 0.9
        found = when(first + math.pi) - when(first)
        testing.report(f"aspect {aspect}: half a turn in {found:.4f} s from {when(first):.2f} s on, "
                       f"{100 * (found / half - 1):+.2f} %")
        self.assertGreater(when(first), 2.5)
        self.assertAlmostEqual(found / half, 1, delta=0.02)

    def test_of_a_long_spheroid(self):
        self.half_turn(2)

    def test_of_a_flat_spheroid(self):
        self.half_turn(0.5)


class AlongAWall(unittest.TestCase):
    """U / (G h) of a free ball whose middle is at h, by gap [radii]: the table of Goldman et al. has
    0.9218 at h = 1.5431 and 0.9777 at 2.3524; between them 1 - U / (G h) is 0.925 of 5/16 (a / h)^3."""

    def test_moves_with_the_flow_less_what_the_wall_takes(self):
        for gap in (0.5, 1.0):
            h = 1 + gap
            expected = 1 - 0.925 * 5 / 16 / h**3
            probes = run_in_shear(ball_mesh.ball(4, 2, 2 * RADIUS), {
                "bodies.ball.initial.position": f"[3 mm, 2 mm, {1e3 * h * RADIUS} mm]",
                "fluid.spacing": "0.1 mm"})
            rate, wall = 2 * 0.96e-3 / HEIGHT, -0.96e-3
            times = probes["t[s]"]
            late = next(n for n, t in enumerate(times) if t >= 8)
            span = times[-1] - times[late]
            speed = (probes["ball.rigid_x[m]"][-1] - probes["ball.rigid_x[m]"][late]) / span
            height = sum(probes["ball.rigid_z[m]"][late:]) / len(times[late:])
            found = (speed - wall) / (rate * height)
            spin = sum(probes["ball.rigid_spin_y[rad/s]"][late:]) / len(times[late:]) / (rate / 2)
            testing.report(f"gap of {gap} radii: U / (G h) {found:.4f}, expected {expected:.4f}, "
                           f"{100 * (found / expected - 1):+.2f} %; height {1e3 * height:.4f} mm, "
                           f"spin {spin:.4f} of G / 2")
            self.assertAlmostEqual(found / expected, 1, delta=0.03)


if __name__ == "__main__":
    unittest.main()
