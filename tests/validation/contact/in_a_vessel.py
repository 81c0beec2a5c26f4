# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that touch surfaces of triangles in a fluid: a robot in a vessel, a ball on a brick."""
import math
import sys
import unittest
from pathlib import Path

from magfsi import surfaces, testing

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "failure"), str(HERE.parent / "sphere")]
import ball_mesh  # noqa: E402
from overlap import EXIT_DIVERGED  # noqa: E402

RADIUS = 1.2  # of the vessel, mm
SIDES = 64


class InAVessel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = Path(testing.new_folder())
        # A block whose hole has its corners on the circle, longer than the box.
        surfaces.write_stl(folder / "vessel.stl", surfaces.block_with_hole(RADIUS, 1.8, (-1, 7), SIDES))
        cls.scene, cls.balls = folder / "vessel.yaml", folder / "balls.yaml"
        cls.scene.write_text((HERE / "vessel.yaml").read_text())
        cls.balls.write_text((HERE / "balls.yaml").read_text())
        ball_mesh.write(folder / "ball.msh", ball_mesh.ball(4, 2, 2e-3))

    def test_a_plate_comes_to_lie_on_the_wall(self):
        whole = testing.good_run(self.scene, ranks="structure=1,fluid=1")
        probes, audit = whole.probes(), whole.summary()["energy_audit"]
        self.assertNotIn("warning", (whole.folder / "run.log").read_text())
        height = probes["plate.com_z[m]"][-1]
        # Its lower edges, 0.5 mm to each side, on the circle, which the facets are within of by 1.4 um.
        expected = 1e-3 * (1.6 + 0.2 - math.sqrt(RADIUS**2 - 0.5**2))
        testing.report(f"the plate lies {1e6 * (height - expected):.2f} um above the edges' place on the circle, "
                       f"at {probes['plate.speed_z[m/s]'][-1]:.1e} m/s; {audit}")
        self.assertLess(abs(height - expected), 2e-6)
        self.assertLess(abs(probes["plate.speed_z[m/s]"][-1]), 1e-3)
        self.assertLess(abs(probes["plate.com_y[m]"][-1] - 1.6e-3), 1e-6)
        self.assertLess(audit["gained"], 1e-9)
        testing.check_interface_balance(self, whole, "vessel")

        divided = testing.good_run(self.scene, ranks="structure=2,fluid=1").probes()
        apart = [abs(a - b) for a, b in zip(probes["plate.com_z[m]"], divided["plate.com_z[m]"], strict=True)]
        flying = [probes["plate.com_z[m]"][i] > height + 1e-5 for i in range(len(apart))]
        self.assertLess(max(a for a, flies in zip(apart, flying, strict=True) if flies), 1e-14)
        # Rows of nodes that hop on the wall when they land make ten million times as much of a rounding of 1e-17 m.
        self.assertLess(max(apart), 1e-9)
        folder = Path(testing.new_folder())
        short = {"checkpoint.every": "10 ms"}
        testing.good_run(self.scene, {**short, "time.end": "21 ms"}, "structure=1,fluid=1", folder=folder)
        testing.finish(testing.start(
            [testing.BIN / "magfsi", "run", self.scene, "--out", folder, "--restart", "latest",
             "--ranks", "structure=1,fluid=1", *testing.overrides(short)]), 0, folder, 600)
        self.assertEqual((whole.folder / "probes.csv").read_bytes(), (folder / "probes.csv").read_bytes())

    def test_without_contact_it_passes_into_the_wall(self):
        run = testing.run(self.scene, {"contact": "null"})
        self.assertEqual(run.code, EXIT_DIVERGED, run.err)
        self.assertIn("body 'plate' passes into the obstacle 'vessel'", run.err)
        self.assertIn("add the key contact", run.err)

    def test_a_brick_of_triangles_is_the_brick(self):
        file = self.balls.parent / "brick.stl"
        surfaces.write_stl(file, surfaces.block([1, 1, 0], [3, 3, 2]))
        alone = {"bodies.lower": "null", "time.end": "20 ms"}
        box, stl = (testing.good_run(self.balls, {**alone, "fluid.obstacles": f"{{post: {{{shape}}}}}"}).probes()
                    for shape in ("box: [[1 mm, 1 mm, 0 mm], [3 mm, 3 mm, 2 mm]]",
                                  f"stl: {{file: {file}, unit: 1 mm}}"))
        self.assertGreater(max(box["audit.contact[J]"]), 0)
        for name in ("upper.com_x[m]", "upper.com_z[m]", "audit.contact[J]"):
            self.assertLess(testing.difference(box, stl, name), 1e-9, name)


if __name__ == "__main__":
    testing.main()
