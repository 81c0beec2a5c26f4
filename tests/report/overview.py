# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi plot draws any run, and says in a line what it cannot draw; so do tutorials' figures."""
import subprocess
import unittest
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from magfsi import curves, plot, runs, testing

TUTORIALS = testing.ROOT / "tutorials"


def plotted(*words, script=None):
    command = ["/usr/bin/python3", *([script] if script else ["-P", "-m", "magfsi.plot"]), *words]
    return subprocess.run([str(word) for word in command], capture_output=True, text=True)


class Overview(unittest.TestCase):
    def drawn(self, folder):
        done = plotted(folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater((Path(folder) / "overview.png").stat().st_size, 10000)
        return int(done.stdout.split()[-2])

    def test_a_structure_alone(self):
        run = testing.good_run(TUTORIALS / "beam", {"time.end": "200 ms"})
        self.assertEqual(self.drawn(run.folder), 4)  # the field is the axis
        # Shapes are where the run has them: the beam lies along x and bends along z.
        found, faces, body = plot.views(Path(run.folder))
        figure, axes = plt.subplots()
        plot.draw_shapes(axes, {}, found, faces, body)
        plt.close(figure)
        tip = 1e3 * max(run.probes()["tip_uz[m]"])
        (low_x, low_z), (high_x, high_z) = axes.dataLim.min, axes.dataLim.max
        points = 1e3 * np.concatenate([p for _, p in found])
        self.assertEqual(axes.get_ylabel(), "z [mm]")
        self.assertAlmostEqual(high_z, points[:, 2].max(), delta=1e-6)
        self.assertGreater(high_z, 0.9 * tip)
        self.assertAlmostEqual(high_x - low_x, np.ptp(points[:, 0]), delta=1e-6)

    def test_without_fields_and_without_probes(self):
        short = {"time.end": "100 ms", "bodies.beam.mesh.box.elements": "[9, 2, 1]"}
        bare = testing.good_run(TUTORIALS / "beam", {**short, "output": "null"})
        self.assertEqual(self.drawn(bare.folder), 3)
        shapes = testing.good_run(TUTORIALS / "beam", {**short, "probes": "null"})
        self.assertEqual(self.drawn(shapes.folder), 1)

    def test_a_swimmer(self):
        run = testing.good_run(TUTORIALS / "swimmer", {"time.end": "2 ms", "fluid.spacing": "0.4 mm"})
        self.assertGreater(self.drawn(run.folder), 10)

    def test_what_is_no_run(self):
        folder = testing.new_folder()
        done = plotted(folder)
        self.assertEqual(done.returncode, runs.EXIT_INPUT)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertIn("found no scene.json", done.stderr)
        self.assertEqual(list(Path(folder).iterdir()), [])

    def test_panels(self):
        names = ["t[s]", "field[T]", "robot.com_x[m]", "robot.com_y[m]", "robot.com_z[m]",
                 "robot.end_to_end[m]", "robot.mid_rise[m]", "tip_x[m]", "tip_ux[m]", "mass[kg]"]
        self.assertEqual([(title, [label for label, _ in some])
                          for title, _, some in curves.panels(dict.fromkeys(names))],
                         [("field", ["field"]), ("robot.com", ["x", "y", "z"]),
                          ("robot", ["end_to_end", "mid_rise"]), ("tip_ux", ["ux"]),
                          ("mass", ["mass"])])

    def test_a_quaternion_is_one_panel(self):
        names = ["t[s]", *(f"ball.rigid_q_{part}[1]" for part in "wxyz"),
                 *(f"ball.rigid_{angle}[rad]" for angle in ("roll", "pitch", "yaw"))]
        self.assertEqual([(title, [label for label, _ in some])
                          for title, _, some in curves.panels(dict.fromkeys(names))],
                         [("ball.rigid_q", ["w", "x", "y", "z"]),
                          ("ball", ["rigid_roll", "rigid_pitch", "rigid_yaw"])])

    def test_no_title_is_there_twice(self):
        names = ["t[s]", "field[T]", "field_x[T]", "field_z[T]", "robot.end_to_end[m]", "robot.mid_rise[m]",
                 "robot.energy_elastic[J]", "robot.work_magnetic[J]"]
        self.assertEqual([title for title, _, _ in curves.panels(dict.fromkeys(names))],
                         ["field, magnitude", "field, components", "robot, lengths", "robot, energies"])

    def test_what_does_not_change_is_a_number(self):
        t = np.linspace(0, 1, 5)
        columns = {"t[s]": t, "a_x[m]": 1 + t, "a_y[m]": 1 + 1e-12 * t, "mass[kg]": 2 + 0 * t, "field[T]": t,
                   "field_x[T]": t, "field_y[T]": 1e-20 * t}
        drawn, constant = curves.shown(columns, [("x", "a_x[m]"), ("y", "a_y[m]")])
        self.assertEqual([label for label, _, _ in drawn], ["x"])
        np.testing.assert_allclose(drawn[0][2], t)  # from the start
        self.assertEqual([name for name, _ in constant], ["a_y[m]"])
        self.assertEqual(curves.shown(columns, [("mass", "mass[kg]")]), ([], [("mass[kg]", 2.0)]))
        drawn, constant = curves.shown(columns, [("x", "field_x[T]"), ("y", "field_y[T]")])
        self.assertEqual((drawn, constant), ([], [("field_y[T]", 0.0)]))  # its x is the field itself

    def test_legends_are_beside_and_equal_curves_are_both_seen(self):
        run = testing.good_run(TUTORIALS / "beam", {"time.end": "200 ms"})
        probes = curves.Probes(Path(run.folder))
        self.assertEqual(probes.axis, ("field", "mT"))
        found, still = plot.sorted_out(probes, ["*energy*", "*work*"])
        (title, unit, drawn), = found
        self.assertEqual(still, "zero: beam.energy_kinetic")
        figure, axes = plt.subplots(constrained_layout=True)
        plot.draw_curves(axes, probes, title, unit, drawn)
        figure.canvas.draw()
        legend, curves_ = axes.get_legend().get_window_extent(), axes.get_window_extent()
        self.assertGreaterEqual(legend.x0, curves_.x1 - 1)
        self.assertLessEqual(legend.x1, figure.bbox.x1)
        self.assertTrue(axes.get_ylabel().endswith("\u00b5J]"), axes.get_ylabel())
        below, above = axes.lines
        self.assertGreater(below.get_linewidth(), 1.15 * above.get_linewidth())
        self.assertEqual((below.get_linestyle(), above.get_linestyle()), ("-", "--"))
        plt.close(figure)

    def test_parts_of_a_run(self):
        run = testing.good_run(TUTORIALS / "beam", {"time.end": "200 ms"})
        out = run.folder / "part.png"
        done = plotted(run.folder, "--columns", "tip_u*", "--from", "50 ms", "--to", "150 ms", "--instants", 2,
                       "--plane", "xy", "--out", out)
        self.assertEqual((done.returncode, done.stdout.split()[-2]), (0, "2"), done.stderr)
        done = plotted(run.folder, "--columns", "tip_q")
        self.assertEqual((done.returncode, len(done.stderr.strip().splitlines())), (runs.EXIT_INPUT, 1))
        self.assertIn("did you mean tip_", done.stderr)


class FiguresOfSeveralRuns(unittest.TestCase):
    def test_one_line_where_runs_are_missing(self):
        for name in ("beam", "strip", "gravity", "turning", "origami", "swimmer"):
            folder = testing.new_folder()
            done = plotted(folder, script=TUTORIALS / name / "plot.py")
            self.assertEqual(done.returncode, 1, name)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertIn("./magfsi plot RUN", done.stderr)


if __name__ == "__main__":
    unittest.main()
