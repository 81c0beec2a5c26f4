# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that touch in a fluid: themselves, each other, the box. Nothing passes through anything
(the run would end with its name), no energy comes from nowhere, all momentum and power arrive."""

import itertools
import math
import sys
import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "sphere"))
import ball_mesh  # noqa: E402

PERIODS = 1
PERIOD_S = 0.04
# The swimmer's course at nearly twice its strength: it closes until its ends meet, and opens.
SWIMMER = {"magnetic_field": "{plane: xz, table: {time: [0 ms, 19.5 ms, 32 ms, 40 ms], magnitude: "
                             "[-30 mT, 30 mT, -30 mT, -30 mT], direction: 45 deg, repeat: true}}",
           "contact": "{}", "probes.energy_audit": "true", "gravity": "null",
           "probes.every": "0.5 ms", "fluid.expected_speed": "1 m/s"}


class InAFluid(unittest.TestCase):
    ALONE = {"bodies.lower": "null", "time.end": "24 ms"}

    @classmethod
    def setUpClass(cls):
        folder = Path(testing.new_folder())
        cls.scene = folder / "balls.yaml"
        cls.scene.write_text((HERE / "balls.yaml").read_text())
        ball_mesh.write(folder / "ball.msh", ball_mesh.ball(4, 2, 2e-3))

    def check(self, run, label, mass_share=1e-12, column="audit.contact[J]"):
        probes, audit = run.probes(), run.summary()["energy_audit"]
        testing.report(f"{label}: contact stores up to {max(probes[column]):.2e} J, {audit}")
        self.assertGreater(max(probes[column]), 0, f"{label}: nothing touched")
        # As for sheets in a fluid without contact (stability_energy_audit).
        self.assertLess(audit["gained"], 0.01, label)
        testing.check_interface_balance(self, run, label)
        mass = probes["mass[kg]"]
        self.assertLess(max(abs(m / mass[0] - 1) for m in mass), mass_share, label)
        return probes

    def balls(self, settings, ranks=None, out=None):
        return testing.good_run(self.scene, settings, ranks, folder=out)

    def test_balls_on_each_other_and_on_the_floor(self):
        for scheme, ranks in (("serial", "structure=2,fluid=1"),
                              ("serial", "structure=1,fluid=1"), ("implicit", None)):
            run = self.balls({"coupling.scheme": scheme}, ranks)
            probes = self.check(run, scheme)
            # What contact holds apart may rest on it.
            self.assertNotIn("comes within", (run.folder / "run.log").read_text())
            # With the sound of the impacts counted, not even rounding is gained.
            self.assertLess(run.summary()["energy_audit"]["gained"], 1e-9, scheme)
            low, high = (probes[f"{name}.com_z[m]"][-1] for name in ("lower", "upper"))
            # On the floor, within a twentieth of a cell; and no nearer than touching.
            self.assertGreater(low, 1e-3 - 0.05 * 0.25e-3)
            self.assertLess(low, 1.1e-3)
            self.assertLess(high, 3.8e-3 - 0.5e-3)

    # A ball falls on each shape, beside the middle of the round ones.
    def test_ball_on_obstacles(self):
        on = {"ball": ("{sphere: {centre: [1.8 mm, 2 mm, 1 mm], diameter: 2 mm}}", (1.8, 2.0, 1.0)),
              "brick": ("{box: [[1 mm, 1 mm, 0 mm], [3 mm, 3 mm, 2 mm]]}", None),
              "rod": ("{cylinder: {centre: [2.2 mm, 2 mm, 1.25 mm], diameter: 1.5 mm, axis: y}}",
                      (2.2, None, 1.25))}
        for name, (shape, middle) in on.items():
            run = self.balls({**self.ALONE, "fluid.obstacles": f"{{{name}: {shape}}}"})
            # Walls between cells are interpolated, which does not keep the mass.
            probes = self.check(run, name, 1e-12 if name == "brick" else 1e-3)
            self.assertLess(run.summary()["energy_audit"]["gained"], 1e-9, name)
            path = list(zip(*(probes[f"upper.com_{a}[m]"] for a in "xyz"), strict=True))
            if middle is None:  # the brick is 2 mm high
                least = min(z for _, _, z in path) - 2e-3
            else:
                radius = {"ball": 1e-3, "rod": 0.75e-3}[name]
                least = min(math.hypot(*(x - 1e-3 * m for x, m in zip(place, middle)
                                         if m is not None)) for place in path) - radius
            testing.report(f"{name}: the ball's middle comes within {least * 1e3:.4f} mm of the surface")
            # No point of its surface was a twentieth of a cell inside, or the run would have ended;
            # its middle comes nearer by what the ball is pressed flat.
            self.assertGreater(least, 0.95e-3, name)
            self.assertLess(least, 1.05e-3, name)

    def test_ball_on_an_obstacle_on_other_ranks_and_over_a_restart(self):
        falls = {**self.ALONE,
                 "fluid.obstacles": "{ball: {sphere: {centre: [1.8 mm, 2 mm, 1 mm], diameter: 2 mm}}}"}
        whole = self.balls(falls, "structure=1,fluid=1")
        self.check(whole, "over a restart", 1e-3)
        divided = self.balls(falls, "structure=2,fluid=1").probes()
        for name in ("upper.com_x[m]", "upper.com_z[m]", "audit.contact[J]"):
            self.assertLess(testing.difference(whole.probes(), divided, name), 1e-9, name)
        folder = Path(testing.new_folder())
        short = {**falls, "checkpoint.every": "10 ms"}
        self.balls({**short, "time.end": "21 ms"}, "structure=1,fluid=1", folder)
        testing.finish(testing.start(
            [testing.BIN / "magfsi", "run", self.scene, "--out", folder, "--restart", "latest",
             "--ranks", "structure=1,fluid=1", *testing.overrides(short)]), 0, folder, 600)
        self.assertEqual((whole.folder / "probes.csv").read_bytes(),
                         (folder / "probes.csv").read_bytes())

    def test_block_slips_above_its_angle_of_friction_and_stays_below(self):
        self.slips_and_stays({})

    def test_block_on_an_obstacle_likewise(self):
        self.slips_and_stays({"bodies.block.initial.position": "[1.75 mm, 2 mm, 0.875 mm]", "fluid.obstacles":
                              "{slab: {box: [[0.25 mm, 0.5 mm, -1 mm], [5.75 mm, 3.5 mm, 0.5 mm]]}}"})

    # tan(15 deg) is 0.268.
    def slips_and_stays(self, where):
        weight_n = 2000 * 2.25e-9 * 9.81  # less buoyancy
        for friction, slips in ((0.25, True), (0.3, False)):
            run = testing.good_run(HERE / "incline.yaml", {"contact.friction": str(friction), **where})
            probes, audit = run.probes(), run.summary()["energy_audit"]
            way = probes["block.com_x[m]"][-1] - probes["block.com_x[m]"][0]
            lost = probes["audit.lost_friction[J]"][-1]
            testing.report(f"friction {friction}: goes {way:.3e} m, loses {lost:.4e} J, {audit}")
            testing.check_interface_balance(self, run, str(friction))
            self.assertLess(audit["gained"], 1e-3)
            if slips:
                self.assertGreater(way, 5e-5)
                # mu N over its way; the first 0.2 um are those of the springs.
                expected = friction * weight_n * math.cos(math.radians(15)) * way
                self.assertLess(abs(lost / expected - 1), 0.01)
            else:  # but for the springs' give: mu N over their stiffness
                self.assertLess(abs(way), 1e-6)
                self.assertLess(abs(probes["block.speed_x[m/s]"][-1]), 1e-5)

    def test_friction_between_balls_on_other_ranks_and_over_a_restart(self):
        rough = {"contact.friction": "0.5", "time.end": "30 ms"}
        whole = self.balls(rough, "structure=1,fluid=1")
        self.check(whole, "rough balls")
        self.assertLess(whole.summary()["energy_audit"]["gained"], 1e-9)
        divided = self.balls(rough, "structure=2,fluid=1").probes()
        for name in ("upper.com_x[m]", "lower.com_z[m]", "audit.lost_friction[J]"):
            self.assertLess(testing.difference(whole.probes(), divided, name), 1e-9, name)
        lost = divided["audit.lost_friction[J]"]
        self.assertGreater(lost[-1], 0)
        self.assertTrue(all(a <= b for a, b in itertools.pairwise(lost)))
        folder = Path(testing.new_folder())
        short = {**rough, "checkpoint.every": "10 ms"}
        self.balls({**short, "time.end": "20 ms"}, "structure=1,fluid=1", folder)
        testing.finish(testing.start(
            [testing.BIN / "magfsi", "run", self.scene, "--out", folder, "--restart", "latest",
             "--ranks", "structure=1,fluid=1", *testing.overrides(short)]), 0, folder, 600)
        self.assertEqual((whole.folder / "probes.csv").read_bytes(),
                         (folder / "probes.csv").read_bytes())

    def test_swimmer_closes_and_opens(self):
        for ranks in ("structure=1,fluid=1", "structure=2,fluid=1")[:1 if PERIODS == 1 else 2]:
            run = testing.good_run(testing.SMALL, {
                **SWIMMER, "time.end": f"{1e3 * PERIOD_S * PERIODS} ms"}, ranks, limit_s=3000)
            probes = self.check(run, f"swimmer, {ranks}")
            apart = list(zip(probes["t[s]"], probes["robot.end_to_end[m]"], strict=True))
            for period in range(PERIODS):
                in_it = [x for t, x in apart if period <= t / PERIOD_S <= period + 1]
                self.assertLess(min(in_it), 0.5e-3, f"period {period} does not close")
                self.assertGreater(max(in_it), 2e-3, f"period {period} does not open")


if __name__ == "__main__":
    testing.main(PERIODS=PERIODS)
