# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi plot draws any run, and says in a line what it cannot draw; so do tutorials' figures."""
import subprocess
import unittest
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from magfsi import plot, runs, testing

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
        self.assertEqual(self.drawn(run.folder), 6)  # the field and its components are two
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
        self.assertEqual(self.drawn(bare.folder), 5)
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
                          for title, _, some in plot.panels(dict.fromkeys(names))],
                         [("field", ["field"]), ("robot.com", ["x", "y", "z"]),
                          ("robot", ["end_to_end", "mid_rise"]), ("tip_ux", ["ux"]),
                          ("mass", ["mass"])])


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
