# SPDX-License-Identifier: GPL-2.0-or-later
"""A folder from a stranger in which one runs: its links, its name and what else lies there. A run
writes nowhere but in its run folder, and reads nothing that could be code.

--every 4 takes each fourth name, of files, folders, studies and settings."""

import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from magfsi import testing

TRACE = "trace"
EVERY = 1  # of the names
SCENE = """\
name: bar
time: {{end: {end}}}
bodies:
  bar:
    mesh: {{box: {{size: [2 mm, 1 mm, 1 mm], elements: [2, 1, 1]}}}}
    material: {{shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
probes: {{every: 20 us, bodies: [com]}}
output: {{structure: {{every: 20 us}}}}
checkpoint: {{every: 20 us}}
{more}"""
FLUID = """\
name: bar
time: {{end: {end}}}
fluid: {{solver: openfoam, box: [4 mm, 4 mm, 4 mm], spacing: 1 mm, density: 1000 kg/m3,
  viscosity: 10 mm2/s, expected_speed: 0.1 m/s, courant: 0.2}}
checkpoint: {{every: 2 ms}}
"""
CODE = """FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }
x #codeStream { code #{ os << system("touch TRACE"); #}; };
functions { x { type systemCall; executeCalls ("touch TRACE"); libs (utilityFunctionObjects); } }
"""


class Folder(unittest.TestCase):
    def setUp(self):
        self.top = Path(testing.new_folder())
        self.victim = self.top / "victim"
        self.enter(self.top / "scene")

    def enter(self, folder):
        self.folder = folder
        folder.mkdir(parents=True)
        self.write()

    def write(self, end="100 us", more="", text=SCENE):
        (self.folder / "scene.yaml").write_text(text.format(end=end, more=more))

    def magfsi(self, *words, program=None):
        done = subprocess.run(program or [testing.BIN / "magfsi", *words], cwd=self.folder,
                              stdin=subprocess.DEVNULL, text=True, capture_output=True,
                              check=False)
        self.assertFalse(list(self.top.rglob(f"{TRACE}*")), "something was executed")
        return done

    def run_scene(self, *more, code=0):
        done = self.magfsi("run", "scene.yaml", *more)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def refused(self, message, *more):
        done = self.run_scene(*more, code=2)
        lines = [line for line in done.stderr.splitlines() if not line.startswith("warning: ")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertIn(message, lines[0])
        testing.report(lines[0])


class Links(Folder):
    ran = None  # folder of runs, of one run for all tests

    def setUp(self):
        super().setUp()
        if Links.ran is None:
            self.run_scene()
            Links.ran = Path(testing.new_folder()) / "runs"
            shutil.copytree(self.folder / "runs", Links.ran)
        else:
            shutil.copytree(Links.ran, self.folder / "runs")
        self.out = self.folder / "runs/bar"
        self.names = sorted(path.name for path in self.out.iterdir() if path.name != "run.lock")
        self.assertIn("lammps.in", self.names)

    def put_links(self, names):
        """In the place of the run's files; each to one of ours, or to a folder of ours."""
        shutil.rmtree(self.victim, ignore_errors=True)
        self.victim.mkdir()
        for name in names:
            goal, link = self.victim / name, self.out / name
            if link.is_dir() and not link.is_symlink():
                shutil.rmtree(link)
                goal.mkdir()
            else:
                link.unlink(missing_ok=True)
                goal.write_text("ours")
            link.symlink_to(goal)

    def is_untouched(self):
        for path in self.victim.iterdir():
            if path.is_dir():
                self.assertEqual(list(path.iterdir()), [])
            else:
                self.assertEqual(path.read_text(), "ours", path.name)

    def test_in_the_place_of_results(self):
        for more in ((), ("--overwrite",)):
            with self.subTest(more):
                self.put_links(self.names + [name + ".tmp" for name in self.names])
                self.run_scene(*more)
                self.is_untouched()

    def test_in_the_place_of_results_to_go_on_with(self):
        self.write(end="200 us")
        # Others are written anew, and renamed.
        for name in [n for n in self.names if not n.startswith(("checkpoint", "summary"))][::EVERY]:
            with self.subTest(name):
                shutil.copytree(self.out, self.top / "kept", dirs_exist_ok=True)
                self.put_links([name])
                self.refused(f"{name} is a link", "--restart", "latest")
                self.is_untouched()
                shutil.rmtree(self.out)
                shutil.move(self.top / "kept", self.out)
        for file in sorted((self.out / "fields").iterdir())[:1]:
            shutil.copy(file, self.victim)
            file.unlink()
            file.symlink_to(self.victim / file.name)
            self.refused("is a link", "--restart", "latest")
        self.assertNotEqual(self.names, [])

    def test_in_the_place_of_the_lock(self):
        self.put_links(["run.lock"])
        self.assertIn("run.lock", self.run_scene(code=1).stderr)
        self.is_untouched()

    def test_in_the_place_of_the_run_folder(self):
        for place in ("runs/bar", "runs"):
            with self.subTest(place):
                shutil.rmtree(self.folder / "runs", ignore_errors=True)
                shutil.rmtree(self.victim, ignore_errors=True)
                (self.victim / "bar").mkdir(parents=True)
                (self.victim / "summary.json").write_text("ours")
                (self.folder / place).parent.mkdir(exist_ok=True)
                (self.folder / place).symlink_to(self.victim)
                self.refused("is a link to")
                self.assertEqual((self.victim / "summary.json").read_text(), "ours")
                self.assertEqual(list((self.victim / "bar").iterdir()), [])
                (self.folder / place).unlink()


class Names(Folder):
    def test_of_the_folder(self):
        """It runs, or is refused; what LAMMPS or a shell could take for a command is not one."""
        names = (f'a"\nshell touch {TRACE}\n', f"a\nshell touch {TRACE}\n",
                 f"$(touch {TRACE})", f"`touch {TRACE}`", f"a; touch {TRACE}", "a b", "${x}",
                 "a'b", "-x", "a & b", "#codeStream", "a,b:c")
        for name in names[::EVERY]:
            with self.subTest(name):
                self.enter(self.top / "as" / name)
                ended = [self.magfsi("run", "scene.yaml"),
                         self.magfsi("run", "scene.yaml", "--out", str(self.folder / "x"))]
                for done in ended:
                    self.assertIn(done.returncode, (0, 2), done.stderr)
                for script in self.folder.rglob("lammps.in"):
                    self.magfsi(program=[testing.BIN / "magfsi-lammps", "-in", script])

    def study(self, head):
        (self.folder / "study.yaml").write_text(
            f"{head}\nscene: scene.yaml\naxes: {{a: {{values: {{b: {{}}}}}}}}\n"
            'errors: {e: {probe: "bar.com_x[m]", norm: peak, reference: 1}}\n')
        return self.magfsi(program=[sys.executable, "-P", "-m", "magfsi.study", "study.yaml"])

    def test_of_a_study(self):
        for name in ("x/../../../victim", "../x", "/tmp/x", "a\\nb", "")[::EVERY]:
            with self.subTest(name):
                done = self.study(f'name: "{name}"')
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn("study.yaml:1:7: name: found", done.stderr)
                self.assertFalse((self.folder / "runs").exists())
        self.assertEqual(self.study("name: good").returncode, 0)

    def test_of_settings_in_a_study(self):
        """A key that reads like an option of the command line is a key."""
        for key in (f"--out={self.victim}", "--overwrite", f"-o={self.victim}")[::EVERY]:
            with self.subTest(key):
                done = self.study(f'set: {{"{key}": x}}')
                self.assertEqual(done.returncode, 2, done.stderr)
                testing.report(done.stderr.strip())
                self.assertFalse(self.victim.exists())


class Code(Folder):
    """What lies in the folder as if it belonged to Python, MPI or OpenFOAM."""

    def test_modules_of_python(self):
        for name in ("numpy", "yaml", "matplotlib", "magfsi", "argparse", "sitecustomize"):
            (self.folder / f"{name}.py").write_text(f"open('{TRACE}', 'w')\n")
        (self.folder / "study.yaml").write_text("nothing\n")
        launcher = [line for line in (testing.ROOT / "magfsi").read_text().splitlines()
                    if "python" in line and "-m magfsi" in line]
        self.assertTrue(launcher)
        for line in launcher:
            self.assertIn("$python -P -m magfsi", line)
        done = self.magfsi(program=[sys.executable, "-P", "-m", "magfsi.study", "study.yaml"])
        self.assertEqual(done.returncode, 2, done.stderr)

    def test_settings_of_mpi(self):
        for name in ("openmpi-mca-params.conf", ".openmpi/mca-params.conf", "mca-params.conf"):
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text(f"orte_launch_agent = touch {TRACE}\n"
                                            f"plm_rsh_agent = touch {TRACE}\n"
                                            "mca_base_component_path = .\n")
        (self.folder / "mpirun").write_text(f"#!/bin/sh\ntouch {TRACE}\n")
        (self.folder / "mpirun").chmod(0o755)
        self.run_scene()

    @unittest.skipUnless(list((testing.BIN.parent / "lib").glob("*openfoam*")), "without OpenFOAM")
    def test_a_case_of_openfoam(self):
        self.write(end="4 ms", text=FLUID)
        self.run_scene()
        case = next(path.parent.parent for path in (self.folder / "runs/bar").rglob("controlDict"))
        for more in (("--restart", "latest"), ()):
            self.write(end="8 ms", text=FLUID)
            for name in ("system/fvOptions", "system/controlDict", "constant/fvOptions",
                         "constant/dynamicMeshDict", "system/fvSolution", "0/U", "0/p",
                         "system/codeDict", "controlDict"):
                (case / name).write_text(CODE.replace("TRACE", str(self.folder / TRACE)))
            with self.subTest(more):
                self.run_scene(*more)


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
