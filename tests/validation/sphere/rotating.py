# SPDX-License-Identifier: GPL-2.0-or-later
"""A magnetised ball in a turning field, in water: it follows below the step-out frequency and falls
behind above.

The field's torque m B sin(lag) balances the drag 8 pi mu a^3 spin of a ball that turns slowly
(Kirchhoff 1876), so that it follows with sin(lag) = omega / omega_c as long as omega is below
omega_c = m B / (8 pi mu a^3). Here omega_c a^2 / nu = 0.5; the drag's inertial part is its square over
1200. In a periodic box all images turn as well: as no vorticity is left on the whole, the ball turns
more slowly by its share of the box (T / (6 mu box), the mean of a rotlet's), 1.9 %. With 12 cells a
diameter the drag is 3 % too small, with 8 cells 6 %: the markers' depth below the surface."""

import math
import unittest
from pathlib import Path

from magfsi import testing

import ball_mesh

SCENE = Path(__file__).resolve().parent / "rotating.yaml"
RADIUS, BOX, VISCOSITY, MAGNETIZATION, FIELD = 0.5e-3, 3e-3, 1e-3, 12, 1e-3


def lags(share, mesh, end_s):
    """(times, how far the ball is behind the field [rad]) in a field of that share of omega_c."""
    moment = MAGNETIZATION * mesh.volume()
    alone = moment * FIELD / (8 * math.pi * VISCOSITY * RADIUS**3)
    omega = share * alone * (1 - 4 / 3 * math.pi * (RADIUS / BOX)**3)
    folder = Path(testing.new_folder())
    (folder / "rotating.yaml").write_text(SCENE.read_text())
    ball_mesh.write(folder / "ball.msh", mesh)
    p = testing.good_run(folder / "rotating.yaml", {
        "magnetic_field.precession.frequency": f"{omega / (2 * math.pi):.9f} Hz",
        "time.end": f"{end_s} s"},
        ranks="structure=1,fluid=1").probes()
    t, turned, before = p["t[s]"], 0.0, 0.0
    behind = []
    for n, time in enumerate(t):
        angle = math.atan2(p["high_x[m]"][n] - p["low_x[m]"][n],
                           p["high_z[m]"][n] - p["low_z[m]"][n])
        turned += (angle - before + math.pi) % (2 * math.pi) - math.pi
        before = angle
        behind.append(omega * time - turned)
    testing.report(f"{share} of the step-out frequency: behind by {math.degrees(behind[-1]):.2f} degrees "
                   f"at {t[-1]:.0f} s, {math.degrees(behind[2 * len(t) // 3]):.2f} at two thirds of that")
    return t, behind, p


# Share of the step-out frequency at which the ball follows, and time until it turns evenly [s].
FOLLOWS = (0.5, 5), (0.95, 10)
FREQUENCIES = 2  # number of them to try


class SteppingOut(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = ball_mesh.ball(4, 2, 2 * RADIUS)

    def test_follows_below(self):
        # What is left of the start falls as exp(-omega_c cos(lag) t).
        for share, end_s in FOLLOWS[:FREQUENCIES]:
            t, behind, p = lags(share, self.mesh, end_s)
            late = [b for b, time in zip(behind, t) if time > 2 / 3 * t[-1]]
            self.assertLess(max(late) - min(late), 0.01)
            # Within 5 % of the drag: at 0.95 the sine may reach one.
            if share == 0.5:
                # Once it turns evenly the fluid's torque is the field's, but for what is left of the start.
                field, drag = (p[f"ball.{name}_torque_y[N m]"][-1] for name in ("magnetic", "fluid"))
                testing.report(f"torque of the field {field:.6g} N m, of the fluid {drag:.6g}")
                self.assertAlmostEqual(drag / field, -1, delta=0.01)
                self.assertAlmostEqual(math.sin(behind[-1]), share, delta=0.05 * share)

    def test_falls_behind_above(self):
        _, behind, _ = lags(1.05, self.mesh, 20)
        # It passes the bottleneck at 90 degrees, after which it is drawn to the next turn.
        self.assertGreater(behind[-1], math.pi)


if __name__ == "__main__":
    testing.main(FREQUENCIES=FREQUENCIES)
