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
import vtk
from kinds import SECOND
from magfsi import gallery, testing, units
from magfsi.drawing import actors, camera, clock, magnetisation, stage
from magfsi.drawing.labels import Labels
from magfsi.drawing.stage import Stage, ensure_display
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


# As little of each tutorial as shows its robot.
BRIEF = {"beam": {}, "catheter": {"time.end": "5 ms", "output.structure.every": "5 ms"},
         "cilia": {"time.end": "40 ms", "output.structure.every": "20 ms"}, "gait": {"time.end": "1.6 ms"},
         "gravity": {"time.end": "1 s"}, "gripper": {"time.end": "2 ms", "output.structure.every": "2 ms"},
         "helix": {"time.end": "10 ms", "output.structure.every": "10 ms"}, "letter": {"time.end": "1 s"},
         "origami": {"time.end": "250 ms"},
         "steering": {"time.end": "10 ms"}, "strip": {"time.end": "250 ms"}, "swimmer": {"time.end": "2 ms"},
         "tank": {"time.end": "1 ms"}, "turning": {"time.end": "1 s"}}


class Display(unittest.TestCase):
    def test_a_number_that_is_taken_is_left(self):
        number = stage.FIRST_DISPLAY + stage.DISPLAYS + os.getpid() % 100  # of no other test
        self.assertTrue(stage.started_display(number))
        self.assertFalse(stage.started_display(number))


class Framed(unittest.TestCase):
    def extent(self, name):
        """Of the robot's pixels, as shares of the picture's width."""
        run = testing.shared_run(testing.ROOT / "tutorials" / name, BRIEF[name])
        stage = Stage(run.folder, "picture", (400, 300), "", hidden=("vortices",))
        first, last = stage.times()
        return stage.share_of_width(first + 0.75 * (last - first))

    def test_every_tutorial_shows_its_robot(self):
        self.assertEqual(sorted(BRIEF), gallery.tutorials())
        for name in BRIEF:
            with self.subTest(name):
                wide, high = self.extent(name)
                testing.report(f"{name}: {100 * wide:.0f} % of the width, and {100 * high:.0f} % of it high")
                # What stands upright cannot be as wide: a hair of 0.1 x 0.8 mm.
                self.assertGreater(max(wide, high), 0.2)
                if name != "cilia":
                    self.assertGreater(wide, 0.2)
                self.assertLess(max(wide, high / 0.75), 0.98)  # all of it

    def test_what_hides_a_body_is_cut_open(self):
        run = testing.shared_run(testing.ROOT / "tutorials/catheter", BRIEF["catheter"])
        wide = {}
        for obstacles in ("cut", "glass", "whole"):
            stage = Stage(run.folder, "picture", (400, 300), "", obstacles=obstacles)
            wide[obstacles] = stage.share_of_width(0.0)[0]
        self.assertLess(wide["whole"], 0.05)
        self.assertGreater(wide["cut"], 0.3)
        self.assertAlmostEqual(wide["glass"], wide["cut"], delta=0.02)

    def test_what_stands_beside_is_whole(self):
        ball = vtk.vtkSphereSource()
        ball.SetRadius(1)
        course = np.array([[3.0, -1, -1], [4, 1, 1]])
        towards = np.array([0.1, -0.9, 0.2])
        self.assertIsNone(actors.cut_open(ball, towards, course))
        ball.SetCenter(3.5, 5, 0)  # behind
        self.assertIsNone(actors.cut_open(ball, towards, course))
        ball.SetCenter(3.5, 0, 0)
        half = actors.cut_open(ball, towards, course)
        half.Update()
        bounds = half.GetOutput().GetBounds()
        self.assertAlmostEqual(bounds[2], 0, delta=1e-6)  # the half away from the viewer
        self.assertAlmostEqual(bounds[3], 1, delta=0.05)
        closed = vtk.vtkMassProperties()
        whole = vtk.vtkTriangleFilter()
        whole.SetInputConnection(half.GetOutputPort())
        closed.SetInputConnection(whole.GetOutputPort())
        closed.Update()
        full = vtk.vtkMassProperties()
        full.SetInputConnection(ball.GetOutputPort())
        full.Update()
        # The middle of the octahedron of eight sectors is a corner: halves are equal.
        self.assertAlmostEqual(closed.GetVolume() / full.GetVolume(), 0.5, delta=0.02)

    def test_cameras_and_frames(self):
        right, up, towards = camera.axes(*camera.VIEWS["top"])
        np.testing.assert_allclose([right, up, towards], np.eye(3), atol=1e-12)
        np.testing.assert_allclose(camera.axes(*camera.VIEWS["side"])[2], [1, 0, 0], atol=1e-12)
        run = testing.shared_run(BEAM, LIFTED)
        for frame in camera.FRAMES:
            for look in ("page", "picture"):
                stage = Stage(run.folder, look, (400, 300), "", view=(0.0, 0.0), frame=frame)
                wide, high = stage.share_of_width(0.0)
                self.assertLess(max(wide, high / 0.75), 0.98)
                # The beam lies along x: 17.5 mm. The scale's pixels are those of the picture.
                scale = stage.camera.pixels_a_metre((8.75e-3, 0, 0.5e-3))
                self.assertAlmostEqual(17.5e-3 * scale, 400 * wide, delta=4 + 0.04 * 400 * wide)


class Written(unittest.TestCase):
    def test_time_is_in_the_unit_of_the_scene(self):
        run = {"scene": "time: {end: 2 s}\n", "overrides": [], "end": 0.02, "load": None}
        self.assertEqual(clock.Clock(run).text(0.0125), "t = 0.0125 s")
        self.assertEqual(clock.Clock({**run, "overrides": ["time.end=20 ms"]}).text(0.0125), "t = 12.5 ms")
        self.assertEqual(clock.Clock({**run, "scene": "time: {end: 800 us}"}).text(2e-4), "t = 200 \u00b5s")
        self.assertEqual(clock.Clock({**run, "scene": ""}).text(0.0125), "t = 12.5 ms")

    def test_equilibria_are_named_by_their_load(self):
        stage = Stage(testing.shared_run(BEAM, LIFTED).folder, "picture", (400, 300), "direction")
        stage.draw(0.5)
        field = testing.shared_run(BEAM, LIFTED).probes()
        row = field["t[s]"].index(0.5)
        self.assertEqual(stage.labels.time.get_text(), f"field {1e3 * field['field[T]'][row]:.4g} mT")
        self.assertEqual(stage.labels.strength.get_text(), f"B = {1e3 * field['field[T]'][row]:.3g} mT")

    def test_any_size(self):
        """Some, such as 1020, are no whole number of pixels as inches in binary."""
        for size in ((1020, 57), (64, 1020), (113, 115), (231, 229)):
            blank = np.full((size[1], size[0], 3), 255, np.uint8)
            self.assertEqual(Labels(size).over(blank).shape, blank.shape)

    def test_numbers_with_their_units(self):
        for value, unit, text in ((2e-5, "m", "20 \u00b5m"), (0.017, "T", "17 mT"), (62e3, "A/m", "62 kA/m"),
                                  (1500.0, "s", "1.5e+03 s"), (30.0, "deg", "30\u00b0"), (140.0, "1/s", "140 s\u207b\u00b9")):
            self.assertEqual(units.with_unit(value, unit), text)

    def test_units_are_typeset(self):
        for unit, text in (("1/s^2", "s\u207b\u00b2"), ("1/s", "s\u207b\u00b9"), ("m2/s", "m\u00b2/s"), ("mm2/s", "mm\u00b2/s"),
                           ("m3/s", "m\u00b3/s"), ("kg/m3", "kg/m\u00b3"), ("J/m3", "J/m\u00b3"), ("A m2", "A m\u00b2"),
                           ("m/s2", "m/s\u00b2"), ("kg m/s", "kg m/s"), ("N m", "N m"), ("1", ""), ("deg", "\u00b0"),
                           ("rad/s", "rad/s"), ("A/m", "A/m")):
            self.assertEqual(units.typeset(unit), text)

    def test_the_wheel_says_what_is_drawn(self):
        """Magnetisation along z of the body and the wheel's upper side have one colour."""
        east, north, west, none = magnetisation.colours(np.array([1.0, 0, -1, 0]), np.array([0, 1.0, 0, 0]), 1.0)
        self.assertGreater(east[0], 2 * max(east[1:]))
        self.assertGreater(north[1], 1.5 * max(north[0], north[2]))
        self.assertGreater(min(west[1:]), 2 * west[0])
        self.assertLess(np.ptp(none), 1)
        stage = Stage(testing.shared_run(BEAM, LIFTED).folder, "picture", (400, 300), "direction")
        found = stage.magnetisation
        self.assertEqual((found.plane, round(found.largest)), ("xz", 100000))
        vectors = found.of_faces(0.5)  # bent: no longer all along x
        self.assertGreater(vectors[:, 2].max(), 0.5 * found.largest)
        shown = stage.arrows.glyphs
        stage.draw(0.5)
        shown.Update()
        self.assertEqual(len(stage.arrows.chosen), stage.arrows.data.GetNumberOfPoints())
        places = stage._centres(0.0)[stage.arrows.chosen]
        apart = np.linalg.norm(places[:, None] - places[None], axis=2) + np.eye(len(places))
        self.assertGreater(apart.min(), 0.99 * stage.arrows.distance)

    def test_parts_that_are_hidden(self):
        run = testing.shared_run(BEAM, LIFTED)
        def corner(*hidden):
            stage = Stage(run.folder, "picture", (400, 300), "direction", hidden=hidden)
            return stage.draw(0.5)
        whole = corner()
        for part, rows, columns in (("field", slice(0, 70), slice(0, 70)), ("bars", slice(0, 80), slice(300, 400)),
                                    ("time", slice(270, 300), slice(0, 120)), ("scale", slice(250, 280), slice(0, 120))):
            self.assertGreater(np.abs(whole[rows, columns].astype(int) - corner(part)[rows, columns]).sum(), 2000, part)
        self.assertEqual(draw("render", run.folder, "--hide", "bar").returncode, 2)
        self.assertEqual(draw("render", run.folder, "--camera", "above").returncode, 2)
        self.assertEqual(draw("render", run.folder, "--levels", "3,2").returncode, 2)


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
