# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene folder from a stranger executes nothing, and writes nowhere but in its run folder.

--every 4 takes each fourth name, ending, script and kind."""

import json
import os
import shutil
import subprocess
import unittest
from pathlib import Path

from magfsi import testing

MESH = testing.ROOT / "tests/unit/mesh/two_cubes.msh"
# What it would leave if anything of it were executed.
TRACE = "trace"
EVERY = 1  # of the names and files
BODY = """\
name: {name}
time: {{end: 20 us}}
bodies:
  cubes:
    mesh: {{gmsh: {{file: "{mesh}", unit: 1 mm}}}}
    material: {{shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
{more}"""


class Scene(unittest.TestCase):
    def setUp(self):
        self.folder = Path(testing.new_folder()) / "scene"
        self.folder.mkdir()
        self.mesh = "cubes.msh"
        shutil.copy(MESH, self.folder / self.mesh)
        self.before = set(self.folder.parent.iterdir())

    def write(self, name="cubes", more="", mesh=None):
        text = BODY.format(name=name, more=more, mesh=mesh or self.mesh)
        (self.folder / "scene.yaml").write_text(text)

    def magfsi(self, verb, *more, env=None):
        """In the scene's folder, with answers for whoever asks."""
        done = subprocess.run([testing.BIN / "magfsi", verb, "scene.yaml", *more], cwd=self.folder,
                              env=env, input="1\ny\n1\n", text=True, capture_output=True,
                              check=False)
        self.assertFalse(list(self.folder.parent.rglob(f"{TRACE}*")), "something was executed")
        return done

    def is_refused(self, message):
        """By check and by run, in one line with its place."""
        for verb in ("check", "run", "explain"):
            done = self.magfsi(verb)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertIn(message, done.stderr)
        testing.report(done.stderr.strip())
        self.assertFalse((self.folder / "runs").exists())
        self.assertEqual(set(self.folder.parent.iterdir()), self.before)


class Meshes(Scene):
    def test_a_good_one_runs(self):
        self.write()
        done = self.magfsi("run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "runs/cubes/summary.json").exists())

    def test_options_beside_the_mesh(self):
        (self.folder / "cubes.msh.opt").write_text(f'SystemCall "touch {TRACE}";\n')
        self.write()
        self.is_refused("cubes.msh.opt")

    def test_a_link_to_options(self):
        (self.folder / "options").write_text(f'SystemCall "touch {TRACE}";\n')
        (self.folder / "cubes.msh.opt").symlink_to("options")
        self.write()
        self.is_refused("cubes.msh.opt")

    def test_endings_that_gmsh_takes_for_others(self):
        for name in (f"$(touch {TRACE}).msh.gz", "cubes.geo", "cubes.opt", "cubes.py")[::EVERY]:
            with self.subTest(name):
                shutil.copy(MESH, self.folder / name)
                self.write(mesh=name)
                self.is_refused("the ending .msh")

    def test_a_script_called_a_mesh(self):
        for script in (f'SystemCall "touch {TRACE}";', f'Merge "{TRACE}.geo";',
                       f'$Comments\nSystemCall "touch {TRACE}";\n$EndComments')[::EVERY]:
            with self.subTest(script):
                (self.folder / self.mesh).write_text(script + "\n")
                self.write()
                self.is_refused("$MeshFormat")

    def test_commands_behind_a_good_mesh(self):
        """Gmsh's reader of meshes takes no commands: it runs as without them."""
        for script in (f'SystemCall "touch {TRACE}";',
                       f'$Options\nSystemCall "touch {TRACE}";\n$EndOptions'):
            with self.subTest(script):
                (self.folder / self.mesh).write_text(MESH.read_text() + script + "\n")
                self.write()
                self.assertIn(self.magfsi("check").returncode, (0, 2))

    def test_shell_words_in_a_mesh_name(self):
        for name in (f"a;touch {TRACE};.msh", f"$(touch {TRACE}).msh", f"`touch {TRACE}`.msh",
                     f"|touch {TRACE}.msh")[::EVERY]:
            with self.subTest(name):
                shutil.copy(MESH, self.folder / "plain.msh")
                os.rename(self.folder / "plain.msh", self.folder / name)
                self.write(mesh=name)
                self.assertIn(self.magfsi("check").returncode, (0, 2))
                (self.folder / name).unlink()

    def test_a_misspelt_face_is_refused_by_check_too(self):
        self.write(more="    clamps: [hold]\n")
        self.is_refused("hold")

    def test_a_point_outside_is_refused_by_check_too(self):
        self.write(more="probes: {every: 10 us, points: {p: {body: cubes, "
                        "at: [9 mm, 9 mm, 9 mm]}}}\n")
        self.is_refused("lies in no element")


    def test_names_of_groups_that_are_commands(self):
        """Of faces and regions, which the scene takes over; LAMMPS sees numbers only."""
        whole = MESH.read_text()
        for name in (f"x\nshell touch {TRACE}\n", f"$(touch {TRACE})", "${x}", "x & y", f"`touch {TRACE}`",
                     f"; shell touch {TRACE}")[::EVERY]:
            for old, more in (("held", "    clamps: [{}]\n"),
                              ("rubber", "    material_regions: [{{region: {}, shear_modulus: "
                                        "66 kPa}}]\n")):
                with self.subTest((name, old)):
                    (self.folder / self.mesh).write_text(whole.replace(f'"{old}"', f'"{name}"'))
                    self.write(more=more.format(json.dumps(name)))
                    self.assertIn(self.magfsi("run").returncode, (0, 2))
                    shutil.rmtree(self.folder / "runs", ignore_errors=True)

    def test_settings_of_gmsh_beside_the_scene(self):
        """Gmsh reads them in the user's home, and where there is none in the present folder."""
        for name in (".gmshrc", ".gmsh-options", "gmsh.conf"):
            (self.folder / name).write_text(f'SystemCall "touch {TRACE}";\n')
        self.write()
        for home in (None, str(self.folder)):
            environment = {k: v for k, v in os.environ.items() if k != "HOME"}
            done = self.magfsi("run", "--overwrite", env={**environment, **(
                {"HOME": home} if home else {})})
            self.assertEqual(done.returncode, 0, done.stderr)


class Names(Scene):
    def test_that_leave_the_runs(self):
        for name in ("../../x", "/tmp/magfsi-x", "..", ".", "a/b", "-rf", "~root/x/y",
                     '"a\\nshell touch ' + TRACE + '"', '"a\\u0000b"', "a" * 300,
                     "'$(touch " + TRACE + ")'", "'a\\b'", "'a;b'", "'a\"b'", "'a & b'", "kästchen")[::EVERY]:
            with self.subTest(name):
                self.write(name=name)
                self.is_refused("found")

    def test_that_stay(self):
        for name in ("cubes_2.1 (a)", "two cubes", "Turek-Hron FSI3")[::EVERY]:
            with self.subTest(name):
                self.write(name=name)
                done = self.magfsi("run")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue((self.folder / "runs" / name / "summary.json").exists())

    def test_names_of_bodies(self):
        for name in ("a b", "../x", "a;b", "$(touch x)", "all clamped")[::EVERY]:
            with self.subTest(name):
                self.write()
                scene = self.folder / "scene.yaml"
                scene.write_text(scene.read_text().replace("  cubes:", f'  "{name}":'))
                self.is_refused("letters, digits and _")


class Kinds(Scene):
    """Files that are no files."""

    def is_refused_as(self, path, kind):
        self.write(mesh=path)
        self.is_refused(kind)

    def test_a_mesh_that_is_a_pipe(self):
        os.mkfifo(self.folder / "pipe.msh")
        self.is_refused_as("pipe.msh", "a pipe or a device")

    def test_a_mesh_that_is_a_device(self):
        os.symlink("/dev/zero", self.folder / "zero.msh")
        self.is_refused_as("zero.msh", "a pipe or a device")

    def test_a_mesh_that_is_a_folder(self):
        (self.folder / "folder.msh").mkdir()
        self.is_refused_as("folder.msh", "a folder")

    def test_a_mesh_that_is_huge(self):
        with open(self.folder / "huge.msh", "w") as file:
            file.truncate(10**12)
        self.is_refused_as("huge.msh", "bytes")

    def test_a_table_and_a_surface(self):
        os.mkfifo(self.folder / "pipe")
        for more in ("    magnetization: {table: {file: pipe}}\n",
                     "    magnetization: {table: {file: /dev/zero}}\n",
                     "    magnetization: {table: {file: .}}\n")[::EVERY]:
            with self.subTest(more):
                self.write(more=more)
                self.is_refused("regular files")
        for path in ("pipe", "/dev/zero", ".")[::EVERY]:
            with self.subTest(path):
                (self.folder / "scene.yaml").write_text(
                    "time: {end: 1 ms}\nfluid: {box: [8 mm, 8 mm, 8 mm], spacing: 1 mm, "
                    "density: 1000 kg/m3, viscosity: 1 mm2/s, expected_speed: 0.1 m/s, "
                    f"obstacles: {{o: {{stl: {{file: '{path}'}}}}}}}}\n")
                self.is_refused("regular files")

    def test_the_scene_itself(self):
        scene = self.folder / "scene.yaml"
        for make in (os.mkfifo, os.mkdir, lambda path: os.symlink("/dev/zero", path)):
            make(scene)
            done = self.magfsi("check")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            shutil.rmtree(scene) if scene.is_dir() else scene.unlink()


class Elsewhere(Scene):
    def test_files_outside_of_the_folder_are_told(self):
        shutil.copy(MESH, self.folder.parent / "far.msh")
        os.symlink("../far.msh", self.folder / "link.msh")
        for mesh in ("../far.msh", "link.msh", str(self.folder.parent / "far.msh")):
            with self.subTest(mesh):
                self.write(mesh=mesh)
                told = self.magfsi("explain").stdout
                self.assertIn("far.msh, outside of the scene's folder", told)
        self.write()
        self.assertNotIn("outside of the scene's folder", self.magfsi("explain").stdout)


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
