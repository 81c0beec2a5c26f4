# SPDX-License-Identifier: GPL-2.0-or-later
"""A run folder alone, somewhere else and without what its scene read, runs again to the same bytes, and
goes on from its checkpoints."""
import json
import shutil
import subprocess
import unittest
from pathlib import Path

import scenes
from magfsi import runs
from scenes import COUPLED, testing

FIELD = "t[ms],Bx[mT],By[mT],Bz[mT]\n0,0,0,0\n1,10,0,4\n4,10,0,8\n"
STONE = ("solid stone\n" + "".join(
    "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {corner}\n" for corner in corners) +
    "endloop\nendfacet\n" for corners in (
        ("0 0 0", "0 1 0", "1 0 0"), ("0 0 0", "1 0 0", "0 0 1"),
        ("0 0 0", "0 0 1", "0 1 0"), ("1 0 0", "0 1 0", "0 0 1"))) + "endsolid stone\n")


def again(folder, *more, cwd):
    return subprocess.run([str(runs.BIN / "magfsi"), "run", str(folder), *more], cwd=cwd, text=True,
                          capture_output=True)


class FromItsFolder(unittest.TestCase):
    """The tables and the surface lie beside and above the scene; a part of the scene is overrides."""

    @classmethod
    def setUpClass(cls):
        origin = Path(testing.new_folder())
        (origin / "scenes").mkdir()
        (origin / "scenes/field.csv").write_text(FIELD)
        (origin / "a stone.stl").write_text(STONE)
        scene = origin / "scenes/swimmer.yaml"
        cls.text = testing.SMALL.read_text().replace(
            "  constant: {magnitude: 10 mT, direction: 50 deg}", "  vector_table: {file: field.csv}")
        scene.write_text(cls.text)
        cls.first = scenes.good(scene, {
            **COUPLED, "fluid.obstacles.stone.stl": "{file: ../a stone.stl, unit: 1 mm, "
            "shift: [1 mm, 1 mm, 1 mm]}"}, origin / "run", "structure=2,fluid=1")
        cls.folder = Path(testing.new_folder()) / "moved"
        shutil.move(cls.first.folder, cls.folder)
        shutil.rmtree(origin)
        cls.first.folder = cls.folder

    def test_leaves_the_same_bytes_on_the_same_ranks(self):
        out = Path(testing.new_folder()) / "out"
        done = again(self.folder, "--out", str(out), cwd=out.parent)
        self.assertEqual(done.returncode, 0, done.stderr)
        second = runs.Run(done.returncode, done.stdout, done.stderr, 0.0, out)
        scenes.assert_same_bytes(self, self.first, second, 2)
        ranks = [json.loads((folder / "run.json").read_text())[-1]["ranks"] for folder in (self.folder, out)]
        self.assertEqual(ranks[0], ranks[1])
        self.assertIn("structure=2", done.stdout)
        for name in ("scene.yaml", "scene_files/field.csv", "scene_files/a stone.stl"):
            self.assertEqual((out / name).read_bytes(), (self.folder / name).read_bytes(), name)

    def test_keeps_the_scene_as_given(self):
        self.assertEqual((self.folder / "scene_as_given.yaml").read_text(), self.text)
        plain = Path(testing.new_folder()) / "short.yaml"
        plain.write_text(testing.SMALL.read_text().replace("end: 4 ms", "end: 0.5 ms"))
        kept = testing.good_run(plain)
        self.assertEqual((kept.folder / "scene.yaml").read_text(), plain.read_text())
        self.assertFalse((kept.folder / "scene_as_given.yaml").exists())

    def test_goes_on_where_it_was_moved(self):
        folder = Path(testing.new_folder()) / "copy"
        shutil.copytree(self.folder, folder)
        done = again(folder, "--restart", "latest", "--set", "time.end=2.5 ms", cwd=folder.parent)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = runs.read_table(folder / "probes.csv", float)["t[s]"]
        self.assertAlmostEqual(rows[-1], 2.5e-3, delta=1e-9)
        self.assertIn("end: 2.5 ms", (folder / "scene.yaml").read_text())
        self.assertEqual((folder / "scene_as_given.yaml").read_text(), self.text)

    def test_its_own_place_is_left_alone(self):
        """In the folder above runs/small_swimmer a run of it goes to runs/small_swimmer-again."""
        top = Path(testing.new_folder())
        shutil.copytree(self.folder, top / "runs/small_swimmer")
        before = scenes.results(top / "runs/small_swimmer")
        done = again("runs/small_swimmer", "--set", "time.end=0.5 ms", cwd=top)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(scenes.results(top / "runs/small_swimmer"), before)
        self.assertTrue((top / "runs/small_swimmer-again/summary.json").exists())

    def test_what_would_lose_the_scene_is_refused(self):
        folder = Path(testing.new_folder()) / "mine"
        folder.mkdir()
        shutil.copy(testing.SMALL, folder / "scene.yaml")
        before = (folder / "scene.yaml").read_bytes()
        for more in ([], ["--overwrite"]):
            done = again(folder, "--out", str(folder), *more, cwd=folder)
            self.assertEqual(done.returncode, runs.EXIT_INPUT, done.stderr)
            self.assertIn("the folder of the scene itself", done.stderr)
            self.assertEqual([(p.name, p.read_bytes()) for p in folder.iterdir()], [("scene.yaml", before)])

    def test_the_scene_as_read_says_what_to_run(self):
        done = again(self.folder / "scene.json", cwd=self.folder.parent)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (runs.EXIT_INPUT, 1), done.stderr)
        self.assertIn(f"give the folder, {self.folder}", done.stderr)


if __name__ == "__main__":
    unittest.main()
