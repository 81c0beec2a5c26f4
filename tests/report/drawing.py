# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi render and film draw any run: a structure alone, several bodies, obstacles, a platform, no
fluid; what they cannot write is an exit code."""
import contextlib
import importlib
import io
import json
import os
import subprocess
import sys
import types
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from kinds import SECOND
from magfsi import testing
from magfsi.drawing.stage import ensure_display
from PIL import Image

FIELDS = {"time.end": "1 ms", "output.structure.every": "0.5 ms",
          "output.fluid": "{every: 0.5 ms, fields: [velocity]}"}
STONE, PLAIN = (158, 161, 168), (219, 115, 51)


BEAM = testing.ROOT / "tutorials/beam"
LIFTED = {"time.end": "500 ms", "output.structure.every": "250 ms",
          "bodies.beam.mesh.box.elements": "[9, 2, 1]"}
COARSE = {"time.end": "50 ms", "bodies.beam.mesh.box.elements": "[9, 2, 1]"}


def draw(what, *words):
    """The command in this process, which has VTK and a display already."""
    out, err, code = io.StringIO(), io.StringIO(), 0
    with mock.patch.object(sys, "argv", [f"magfsi {what}", *map(str, words)]), \
            contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = importlib.import_module(f"magfsi.{what}").main()
        except SystemExit as ended:
            code = ended.code
    return types.SimpleNamespace(returncode=code, stdout=out.getvalue(), stderr=err.getvalue())


class Pictures(unittest.TestCase):
    def drawn(self, run, *words):
        out = Path(testing.new_folder()) / "picture.png"
        done = draw("render", run.folder, "--size", "480x360", "--out", out, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        image = np.array(Image.open(out)).astype(int)
        self.assertEqual(image.shape, (360, 480, 3))
        return image

    def near(self, image, colour, far=40):
        """Pixels of about this colour in any light: by their hue."""
        norm = np.linalg.norm(image, axis=2, keepdims=True) + 1e-9
        wanted = np.array(colour) / np.linalg.norm(colour)
        return ((image / norm - wanted)**2).sum(axis=2) < 1e-3 * far

    def test_a_structure_alone(self):
        run = testing.shared_run(BEAM, LIFTED)
        first, last = (self.near(self.drawn(run, "--colour", "body", "--time", t), PLAIN, 20)
                       for t in ("0 s", "500 ms"))
        self.assertGreater(first.sum(), 500)
        # It bends upwards: pixels of its end are higher up.
        self.assertLess(np.nonzero(last)[0].min(), np.nonzero(first)[0].min() - 20)

    def test_bodies_obstacles_and_platform(self):
        run = testing.good_run(testing.SMALL, {
            **FIELDS, "bodies.second": SECOND, "platform": "{point: [0 mm, 0 mm, 1 mm]}",
            "fluid.obstacles": "{ball: {sphere: {centre: [6.5 mm, 2 mm, 6.5 mm], diameter: 1.5 mm}}, "
                               "rod: {cylinder: {centre: [6 mm, 2 mm, 2 mm], diameter: 0.8 mm, "
                               "axis: y}}, block: {box: [[1 mm, 1 mm, 1.5 mm], [2 mm, 2 mm, 2.5 mm]]}}"})
        image = self.drawn(run, "--colour", "body")
        self.assertGreater(self.near(image, PLAIN, 20).sum(), 100)
        self.assertGreater(self.near(image, (0, 114, 178), 40).sum(), 50)
        # Without its obstacles the same scene has fewer grey pixels: balls hide what is behind.
        held = json.loads((run.folder / "scene.json").read_text())
        del held["fluid"]["obstacles"]
        (run.folder / "scene.json").write_text(json.dumps(held))
        without = self.drawn(run, "--colour", "body")
        changed = np.abs(image - without).sum(axis=2) > 30
        self.assertGreater(changed.sum(), 400)
        for look in ("page", "picture"):
            self.drawn(run, "--look", look, "--flow", "vorticity", "--zoom", "2")

    def test_vortices_are_where_the_flow_turns(self):
        run = testing.good_run(testing.SMALL, FIELDS)
        image = self.drawn(run)
        blue = (image[..., 2] > image[..., 0] + 30)
        self.assertGreater(blue.sum(), 100)


class Refused(unittest.TestCase):
    def test_what_cannot_be_drawn_or_written(self):
        folder = Path(testing.new_folder())
        bare = testing.good_run(BEAM, {**COARSE, "output": "null"})
        for run, words, code, says in (
                (folder, (), 2, "found no scene.json"), (bare.folder, (), 2, "nothing to draw"),
                (folder / "none", (), 2, "found no scene.json")):
            done = draw("render", run, *words)
            self.assertEqual((done.returncode, len(done.stderr.strip().splitlines())), (code, 1),
                             done.stderr)
            self.assertIn(says, done.stderr)
        good = testing.shared_run(BEAM, LIFTED)
        done = draw("render", good.folder, "--size", "64x48", "--out", "/proc/none/picture.png")
        self.assertEqual((done.returncode, len(done.stderr.strip().splitlines())), (1, 1), done.stderr)
        self.assertEqual(draw("render", good.folder, "--size", "9x9").returncode, 2)
        self.assertEqual(list(folder.iterdir()), [])

    def test_the_program_itself_where_there_is_no_display(self):
        run = testing.shared_run(BEAM, LIFTED)
        out = run.folder / "alone.png"
        without = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        done = subprocess.run([sys.executable, "-P", "-m", "magfsi.render", str(run.folder), "--size",
                               "64x48", "--out", str(out)], env=without, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with Image.open(out) as picture:
            self.assertEqual(picture.size, (64, 48))


@testing.needs("ffmpeg")
class Films(unittest.TestCase):
    def test_a_film_moves_as_the_run_does(self):
        run = testing.shared_run(BEAM, LIFTED)
        out = run.folder / "swim.mp4"
        done = draw("film", run.folder, "--out", out, "--size", "321x241", "--seconds", "0.4",
                    "--rate", "10", "--colour", "body")
        self.assertEqual(done.returncode, 0, done.stderr)
        raw = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", out, "-f", "rawvideo", "-pix_fmt",
                              "rgb24", "-"], capture_output=True, check=True).stdout
        frames = np.frombuffer(raw, "u1").reshape(-1, 240, 320, 3).astype(int)
        self.assertEqual(len(frames), 4)
        for frame, time in ((frames[0], "0 s"), (frames[-1], "500 ms")):
            still = run.folder / "still.png"
            self.assertEqual(draw("render", run.folder, "--look", "page", "--size", "320x240",
                                  "--colour", "body", "--time", time, "--out", still).returncode, 0)
            # What compression changes: colours have half of the resolution.
            self.assertLess(np.abs(frame - np.array(Image.open(still)).astype(int)).mean(), 4)
        self.assertGreater(np.abs(frames[0] - frames[-1]).sum(axis=2).max(), 150)

    def test_a_film_that_cannot_be_written(self):
        run = testing.shared_run(BEAM, LIFTED)
        done = draw("film", run.folder, "--out", "/proc/none/film.mp4", "--size", "64x48",
                    "--seconds", "0.1")
        self.assertEqual((done.returncode, len(done.stderr.strip().splitlines())), (1, 1), done.stderr)


if __name__ == "__main__":
    ensure_display()
    unittest.main()
