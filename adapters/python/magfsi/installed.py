# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi test --installed: whether an installation works, in half a minute. Each solver, each kind
of file and the words of the launcher are tried once; what they compute is the test suite's to say.

    magfsi test --installed [-v] [NAME ...]
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import magfsi
from magfsi import runs

TUTORIALS = runs.ROOT / "tutorials"
SWIMMER = TUTORIALS / "swimmer"
for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"):
    os.environ.setdefault(name, "1")


def call(*words, **named):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, **named)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory(prefix="magfsi-installed-")
        cls.folder = Path(cls._folder.name)

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def good(self, *words, **named):
        done = call(*words, **named)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def test_every_tutorial_is_a_good_scene(self):
        scenes = sorted(TUTORIALS.glob("*/scene.yaml"))
        self.assertGreaterEqual(len(scenes), 6)
        for scene in scenes:
            with self.subTest(scene.parent.name):
                self.assertIn("good", self.good(runs.BIN / "magfsi", "check", scene.parent))

    def test_a_wrong_scene_is_refused_with_its_place(self):
        done = call(runs.BIN / "magfsi", "check", SWIMMER, "--set", "fluid.viscosity=3 parsec")
        self.assertEqual(done.returncode, 2)
        self.assertIn("fluid.viscosity", done.stderr)

    def test_a_body_swims_in_the_lattice_boltzmann_fluid(self):
        run = magfsi.run(SWIMMER, {"time.end": "2 ms", "output.structure.every": "1 ms"},
                         out=self.folder / "swimmer")
        self.assertEqual(run.summary["outcome"], "completed")
        # From flat it has begun to bend: by a tenth of its thickness and more.
        self.assertGreater(run.columns["robot.max_displacement[m]"][-1], 1.85e-5)
        self.assertTrue((run.folder / "structure.pvd").exists())

    def test_equilibria_are_found(self):
        run = magfsi.run(TUTORIALS / "beam", {"time.end": "0.1 s"}, out=self.folder / "beam")
        self.assertEqual(run.summary["outcome"], "completed")

    def test_lammps_has_the_styles(self):
        lammps = runs.BIN / "magfsi-lammps"
        self.good(lammps, "lattice", "beam", "--size", "4e-3", "1e-3", "1e-3", "--elements", "4", "1",
                  "1", "--shear-modulus", "330e3", "--lame-lambda", "6.6e6", "--density", "1860",
                  cwd=self.folder)
        script = self.folder / "in.beam"
        script.write_text("units si\natom_style sphere\natom_modify map array sort 0 0.0\nnewton on\n"
                          "boundary s s s\ncomm_modify mode single cutoff 3e-3 vel yes\n"
                          "neighbor 1e-4 bin\nneigh_modify once yes\nread_data beam.data\n"
                          "fix beam all magttice beam.lattice 1 330e3 6.6e6\nrun 2\n")
        self.assertIn("Loop time", self.good(lammps, "-in", script, "-log", "none", cwd=self.folder))

    def test_meshes_of_gmsh_are_read(self):
        mesh = self.folder / "cube.msh"
        corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        nodes = "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(corners, 1))
        mesh.write_text(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n{nodes}$EndNodes\n"
                        "$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n")
        out = self.good(runs.BIN / "magfsi-mesh", mesh, self.folder / "cube.mesh")
        self.assertIn("1 hexahedra, 8 nodes", out)

    def test_openfoam_where_it_is(self):
        # Whatever else the doctor finds: a container's own name is not always known to it.
        if "not there" in call(runs.BIN / "magfsi", "doctor", cwd=self.folder).stdout:
            self.skipTest("OpenFOAM is optional, and not here")
        run = magfsi.run(SWIMMER / "uniform.yaml", {"time.end": "1 ms", "fluid.solver": "openfoam",
                                                    "fluid.spacing": "0.4 mm"}, out=self.folder / "openfoam")
        self.assertEqual(run.summary["outcome"], "completed")

    def test_the_schema_is_one(self):
        schema = json.loads(self.good(runs.BIN / "magfsi", "schema"))
        self.assertIn("bodies", schema["properties"])

    def test_a_run_is_drawn(self):
        run = magfsi.run(TUTORIALS / "turning", out=self.folder / "turning")
        self.good(sys.executable, "-P", "-m", "magfsi.plot", run.folder)
        self.assertGreater((run.folder / "overview.png").stat().st_size, 10_000)
        self.good(sys.executable, "-P", "-m", "magfsi.figure", run.folder, "--columns", "*")
        self.assertGreater((run.folder / "figure.pdf").stat().st_size, 5_000)


if __name__ == "__main__":
    unittest.main(module="magfsi.installed")
