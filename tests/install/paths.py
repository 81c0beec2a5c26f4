# SPDX-License-Identifier: GPL-2.0-or-later
"""Folders and files with umlauts and blanks in their paths: every kind of file that a scene reads,
and every command, as with plain ones."""
import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from magfsi import runs, surfaces, testing

SCENE = """\
name: paths
time: {end: 0.2 ms}
bodies:
  robot:
    mesh: {box: {size: [2 mm, 1.5 mm, 0.2 mm], elements: [4, 3, 1]}}
    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}
    magnetization: {table: {file: magnet ß.csv}}
    initial: {position: [2.5 mm, 2 mm, 4 mm]}
  cubes:
    mesh: {gmsh: {file: zwei würfel.msh, unit: 0.3 mm}}
    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}
    initial: {position: [5 mm, 2 mm, 6 mm]}
  lump:
    mesh: {voxels: {file: ein stein.stl, unit: 1 mm, spacing: 0.4 mm}}
    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}
    initial: {position: [2 mm, 2 mm, 6.5 mm]}
magnetic_field:
  vector_table: {file: feld ä.csv}
  sources: {map: {grid: {file: gitter ö.csv}}}
contact: {}
fluid:
  box: [8 mm, 4 mm, 8 mm]
  spacing: 0.25 mm
  density: 1000 kg/m3
  viscosity: 10 mm2/s
  expected_speed: 0.5 m/s
  obstacles: {stone: {stl: {file: ein stein.stl, unit: 1 mm}}}
probes: {every: 0.1 ms, bodies: [com], fluid: [kinetic_energy]}
checkpoint: {every: 0.1 ms}
output: {structure: {every: 0.1 ms}, fluid: {every: 0.1 ms}}
control: {script: lenker é.py, every: 0.1 ms, probes: [robot.com_x]}
report: off
"""
CONTROLLER = """\
class Controller:
    def step(self, time, probes):
        return 0, 0, 1e-3
"""
STUDY = """\
name: paths
scene: die szene.yaml
right_within: 5 %
axes:
  viscosity: {key: fluid.viscosity, values: [10 mm2/s]}
errors:
  end: {probe: "robot.com_z[m]", norm: final, reference: 0.004}
"""
BEAM = """\
name: balken
time: {end: 0.25 s, equilibrium: {method: newton}}
bodies:
  beam:
    mesh: {box: {size: [17.5 mm, 5 mm, 1 mm], elements: [6, 2, 1]}}
    material: {shear_modulus: 330 kPa, lame_lambda: 6.6 MPa, density: 1860 kg/m3}
    magnetization: {uniform: [100 kA/m, 0 A/m, 0 A/m]}
    clamps: [x_min]
magnetic_field: {vector_table: {file: feld ä.csv}}
probes: {every: 0.25 s, points: {tip: {body: beam, at: [17.5 mm, 2.5 mm, 0.5 mm]}}}
"""
SEARCH = """\
name: suche
scene: der balken.yaml
parameters: {slope: {key: bodies.beam.material.shear_modulus, range: [300 kPa, 360 kPa]}}
measures: {lift: {probe: "tip_uz[m]", number: final}}
maximize: lift
runs: 2
"""
PLAIN, STRANGE = "plain", "Ordner mit Ärger/ü b"
NAMES = ("ein stein.stl", "feld ä.csv", "gitter ö.csv", "magnet ß.csv", "zwei würfel.msh", "lenker é.py")


def write(top, names):
    """The scene and its files by these names."""
    top.mkdir(parents=True)
    stone, field, grid, magnet, mesh, controller = (top / name for name in names)
    surfaces.write_stl(stone, surfaces.block([5.6, 1.6, 2.5], [6.4, 2.4, 3.4]))
    field.write_text("t[ms],Bx[mT],By[mT],Bz[mT]\n0,0,0,5\n10,0,0,5\n")
    grid.write_text("x[mm],y[mm],z[mm],Bx[mT],By[mT],Bz[mT]\n" + "".join(
        f"{x},{y},{z},0,0,1\n" for x in (-10, 20) for y in (-10, 20) for z in (-10, 20)))
    magnet.write_text("x[mm],y[mm],z[mm],Mx[A/m],My[A/m],Mz[A/m]\n" + "".join(
        f"{x},{y},{z},10000,0,0\n" for x in (0, 2) for y in (0, 1.5) for z in (0, 0.2)))
    shutil.copy(testing.ROOT / "tests/unit/mesh/two_cubes.msh", mesh)
    controller.write_text(CONTROLLER)
    text = SCENE
    for name, instead in zip(NAMES, names):
        text = text.replace(name, instead)
    (top / "die szene.yaml").write_text(text)


class Paths(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = Path(testing.new_folder())
        cls.plain, cls.top = folder / PLAIN, folder / STRANGE
        write(cls.plain, [f"file{i}{Path(name).suffix}" for i, name in enumerate(NAMES)])
        write(cls.top, NAMES)
        cls.run_ = cls.ran(cls.top, "lauf é 1")

    @classmethod
    def call(cls, *words, cwd=None, **named):
        return testing.output_of(*words, cwd=cwd or cls.top, stdin=subprocess.DEVNULL, **named)

    @classmethod
    def ran(cls, top, out, *more):
        cls.call(runs.BIN / "magfsi", "run", "die szene.yaml", "--out", out, *more, cwd=top)
        return top / out

    def module(self, name, *words):
        return self.call(sys.executable, "-P", "-m", f"magfsi.{name}", *words)

    def test_a_run_is_the_same(self):
        plain = self.ran(self.plain, "run")
        self.assertEqual((self.run_ / "probes.csv").read_bytes(), (plain / "probes.csv").read_bytes())

    def test_it_is_checked_and_explained(self):
        self.assertIn("good", self.call(runs.BIN / "magfsi", "check", "die szene.yaml"))
        self.assertIn("gitter ö.csv: field at", self.call(runs.BIN / "magfsi", "explain", "die szene.yaml"))

    def test_a_restart(self):
        more = ("--set", "time.end=0.4 ms")
        shutil.copytree(self.run_, self.top / "wieder ä")
        again = self.ran(self.top, "wieder ä", *more, "--restart", "latest")
        whole = self.ran(self.top, "ganz ä", *more)
        self.assertEqual((again / "probes.csv").read_bytes(), (whole / "probes.csv").read_bytes())

    def test_a_folder_and_no_out(self):
        scene = self.top / "ein ordner ö"
        scene.mkdir()
        (scene / "scene.yaml").write_text(testing.SMALL.read_text().replace("4 ms", "0.1 ms", 1))
        self.call(runs.BIN / "magfsi", "run", scene, cwd=scene)
        self.assertTrue((scene / "runs/small_swimmer/summary.json").exists())

    def test_the_script_of_a_run_and_its_lattice(self):
        self.call(runs.BIN / "magfsi", "lattice", "die szene.yaml", "--out", "gitter für lammps")
        self.assertTrue((self.top / "gitter für lammps/robot.lattice").exists())
        # Both from within their folders; the grid's file is named as where the scene was read.
        for folder in ("gitter für lammps", self.run_.name):
            script = self.top / folder / "lammps.in"
            self.assertIn("\nread_data bodies.data\n", script.read_text())
            shutil.copy(self.top / NAMES[0], script.parent)
            shutil.copy(self.top / NAMES[2], script.parent)
            self.assertIn("Loop time", self.call(runs.BIN / "magfsi-lammps", "-in", "lammps.in", "-log",
                                                 "none", cwd=script.parent, timeout=120))

    def test_pages_and_pictures(self):
        for command, *words in (("report", "lauf é 1", "lauf é 1", "--out", "seite ß.html"),
                                ("plot", "lauf é 1", "--out", "bild ß.png"),
                                ("figure", "lauf é 1", "--columns", "*", "--out", "kurven ß.svg")):
            with self.subTest(command):
                self.module(command, *words)
                self.assertTrue((self.top / words[-1]).exists())

    def test_a_study(self):
        (self.top / "eine studie.yaml").write_text(STUDY)
        self.module("study", "eine studie.yaml", "--out", "ergebnis ö")
        self.assertEqual(len(runs.read_rows(self.top / "ergebnis ö/runs.csv")), 1)

    def test_the_package(self):
        import magfsi
        run = magfsi.run(self.top / "die szene.yaml", out=self.top / "paket ü")
        self.assertEqual(len(run.field_times_s), 3)

    def test_new_and_the_launcher(self):
        """A checkout in such a folder, unbuilt: what needs no build."""
        top = self.top / "das programm"
        for part in ("adapters/app/launcher", "adapters/python", "tutorials/strip"):
            shutil.copytree(testing.ROOT / part, top / part, ignore=shutil.ignore_patterns("__pycache__"))
        for part in ("magfsi", "CMakeLists.txt"):
            shutil.copy(testing.ROOT / part, top / part)
        self.assertIn("explain", self.call(top / "magfsi", "--help"))
        self.assertIn("study", self.call(top / "magfsi", "study", "--help"))
        self.call(top / "magfsi", "new", "neue szenen/mein_roboter", "--like", "strip")
        text = (self.top / "neue szenen/mein_roboter/scene.yaml").read_text()
        self.assertIn("\nname: mein_roboter\n", text)

    @unittest.skipUnless((testing.BIN.parent / "lib/libmagfsi_openfoam_engine.so").exists(),
                         "built without OpenFOAM (packages-optional.txt)")
    def test_openfoam(self):
        settings = {"fluid.solver": "openfoam", "contact": "null",
                    "fluid.expected_speed": "0.1 m/s", "control": "null", "time.end": "2 ms",
                    "probes.every": "1 ms", "checkpoint": "null", "output": "null",
                    "coupling.immersed_boundary.forcing": "penalty"}
        run = self.ran(self.top, "foam ä", *testing.overrides(settings))
        self.assertEqual(json.loads((run / "summary.json").read_text())["outcome"], "completed")


class Searches(unittest.TestCase):
    """Commands that run a scene several times, and films."""

    @classmethod
    def setUpClass(cls):
        cls.top = Path(testing.new_folder()) / STRANGE
        cls.top.mkdir(parents=True)
        for name, text in (("der balken.yaml", BEAM), ("die suche.yaml", SEARCH),
                           ("feld ä.csv", "t[s],Bx[mT],By[mT],Bz[mT]\n0,0,0,0\n1,0,0,20\n")):
            (cls.top / name).write_text(text)

    def module(self, name, *words):
        return testing.output_of(sys.executable, "-P", "-m", f"magfsi.{name}", *words, cwd=self.top,
                                 stdin=subprocess.DEVNULL)

    def test_cost(self):
        self.module("cost", "der balken.yaml", "--budget", "20 s", "--out", "kosten ä")
        self.assertTrue(list(self.top.glob("kosten ä/*.csv")))

    def test_a_search(self):
        self.module("optimize", "die suche.yaml", "--out", "ergebnis ö")
        self.assertTrue((self.top / "ergebnis ö/best.yaml").exists())
        testing.output_of(runs.BIN / "magfsi", "check", "ergebnis ö/best.yaml", cwd=self.top)

    def test_picture_and_film(self):
        testing.output_of(runs.BIN / "magfsi", "run", "der balken.yaml", "--out", "lauf é", "--set",
                          "output.structure.every=0.125 s", cwd=self.top)
        self.module("render", "lauf é", "--out", "bild ß.png")
        self.assertTrue((self.top / "bild ß.png").exists())
        if shutil.which("ffmpeg"):
            self.module("film", "lauf é", "--out", "film ß.mp4", "--seconds", "0.2")
            self.assertTrue((self.top / "film ß.mp4").exists())


if __name__ == "__main__":
    unittest.main()
