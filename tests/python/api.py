# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes and runs from Python, as a user's script has them."""
import ast
import json
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import magfsi
from magfsi import runs, testing

STRIP = testing.ROOT / "tutorials/strip"
SHORT = {"time.end": "2 ms", "output.structure.every": "0.5 ms"}


def folder():
    return Path(testing.new_folder()) / "run"


class Scenes(unittest.TestCase):
    def test_values_are_as_read(self):
        scene = magfsi.load(testing.SMALL, fluid={"viscosity": "2 mm2/s"})
        self.assertAlmostEqual(scene["fluid.viscosity"], 2e-6)
        self.assertEqual(scene.with_({"fluid.viscosity": "3 mm2/s"})["fluid.viscosity"], 3e-6)
        self.assertAlmostEqual(scene["fluid.viscosity"], 2e-6)
        with self.assertRaisesRegex(KeyError, "fluid.colour"):
            scene["fluid.colour"]

    def test_an_empty_map_is_an_effect_with_its_defaults(self):
        scene = magfsi.load(STRIP, {"contact": {}})
        self.assertEqual(scene.settings["contact"], "{}")
        self.assertIn("contact", scene.values)

    def test_a_wrong_scene_is_one_clear_error(self):
        with self.assertRaisesRegex(magfsi.SceneError, "viscosity: found .*allowed") as raised:
            magfsi.load(testing.SMALL, fluid={"viscosity": "2 parsec"})
        self.assertEqual(raised.exception.code, 2)
        with self.assertRaisesRegex(TypeError, "fluid.viscosity"):
            magfsi.load(testing.SMALL, fluid={"viscosity": object()})

    def test_settings_are_written_as_in_a_scene(self):
        scene = magfsi.load(testing.SMALL, {"probes.bodies": ["com"], "gravity": None},
                            coupling={"immersed_boundary": {"forcing": "no_slip"}})
        self.assertEqual(scene["coupling.immersed_boundary.forcing"], "no_slip")
        nested = magfsi.load(testing.SMALL, {"fluid": {"density": "900 kg/m3"}},
                             fluid={"viscosity": "2 mm2/s"})
        self.assertEqual((nested["fluid.density"], nested["fluid.viscosity"]), (900, 2e-6))
        self.assertNotIn("gravity", scene.values)
        self.assertEqual(scene["probes.bodies"], ["com"])


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = magfsi.run(testing.SMALL, SHORT, out=folder(), ranks={"structure": 1,
                                                                         "fluid": 2})

    def test_has_what_the_run_folder_has(self):
        self.assertEqual(self.run_.summary["outcome"], "completed")
        self.assertEqual(self.run_.summary["ranks"]["fluid"], 2)
        self.assertEqual(self.run_.columns,
                         runs.read_table(self.run_.folder / "probes.csv", float))

    def test_fields_are_those_of_the_instant(self):
        self.assertEqual(self.run_.times_s, self.run_.columns["t[s]"])
        self.assertEqual(len(self.run_.field_times_s), 5)
        fields = self.run_.fields("1.1 ms")
        self.assertAlmostEqual(fields.time_s, 1e-3)
        middle = fields.points.mean(axis=0)
        com = self.run_.columns
        at = min(range(len(com["t[s]"])), key=lambda i: abs(com["t[s]"][i] - 1e-3))
        for axis, found in zip("xyz", middle):
            # Nodes are no masses: half an element.
            self.assertAlmostEqual(found, com[f"robot.com_{axis}[m]"][at], delta=1e-4)
        self.assertEqual(len(fields.arrays["velocity[m/s]"]), len(fields.points))

    def test_probes_are_a_table(self):
        try:
            import pandas
        except ImportError:
            with self.assertRaisesRegex(ImportError, "python3-pandas"):
                self.run_.probes
            return
        self.assertIsInstance(self.run_.probes, pandas.DataFrame)
        self.assertEqual(list(self.run_.probes), list(self.run_.columns))

    def test_a_run_that_diverges_is_an_exception_with_its_cause(self):
        with self.assertRaisesRegex(magfsi.Diverged, "inverted at step") as raised:
            magfsi.run(testing.SMALL, {**SHORT, "magnetic_field": {
                "plane": "xz", "constant": {"magnitude": "9 T", "direction": "45 deg"}}},
                       out=folder())
        self.assertEqual(raised.exception.code, 3)

    def test_a_job_is_polled_and_stopped(self):
        with magfsi.start(testing.SMALL, {"time.end": "10 s", "checkpoint.every": "5 s",
                                          "coupling.overlap": "allow"},
                          out=folder()) as job:
            testing.wait_until(lambda: job.done_until > 0, job._process)
            self.assertFalse(job.poll())
            with self.assertRaises(TimeoutError):
                job.wait(0.01)
            job.stop()
            self.assertTrue(job.poll())
        self.assertEqual(job.summary["outcome"], "stopped")
        self.assertTrue(list(job.folder.glob("checkpoint_*")))
        self.assertEqual(list(job.folder.parent.glob(".*.stderr")), [])


class Page(unittest.TestCase):
    def test_its_blocks_run(self):
        """docs/python.md, as it is, on a scene that is shorter and coarser; not coarser still: at
        0.3 mm the fluid diverges after a period, which may come before job.stop()."""
        text = (testing.ROOT / "docs/python.md").read_text().replace(
            '"tutorials/swimmer", time={"end": "40 ms"}',
            f'"{testing.SWIMMER}", time={{"end": "21 ms"}}, fluid={{"spacing": "0.26666666666667 mm"}}')
        text = text.replace('"tutorials/', f'"{testing.ROOT}/tutorials/')
        text = text.replace('"0.2 mm"', '"0.26666666666667 mm"').replace('"runs/', f'"{folder()}/')
        blocks = [part.split("```")[0] for part in text.split("```python\n")[1:]]
        self.assertEqual(len(blocks), 5)
        done = subprocess.run([sys.executable, "-c", "".join(blocks)], capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        viscosity, _, slip, shape, times, sweep, outcome, height = done.stdout.splitlines()
        self.assertEqual((viscosity, shape, outcome), ("1e-06", "(378, 3)", "stopped"))
        self.assertLess(float(slip), 0.05)
        self.assertEqual(len(times.split()), 2)
        self.assertEqual(len(set(ast.literal_eval(sweep).values())), 3)
        self.assertAlmostEqual(float(height), 6e-3, delta=0.1e-3)


class Installed(unittest.TestCase):
    def test_pip_installs_it_from_a_checkout(self):
        target = folder().parent
        done = subprocess.run(
            [sys.executable, "-m", "pip", "install", "-q", "--no-index", "--no-build-isolation",
             "--no-deps", "--disable-pip-version-check", "--target", target, testing.ROOT],
            capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        # No PYTHONPATH of the checkout, no word of where the programs are.
        environment = {name: value for name, value in os.environ.items() if name != "MAGFSI_BIN"}
        code = ("import magfsi; print(magfsi.__file__); "
                f"print(magfsi.load({str(testing.SMALL)!r})['fluid.viscosity'])")
        found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                               cwd=target, env={**environment, "PYTHONPATH": str(target)})
        self.assertEqual(found.stdout.splitlines(),
                         [str(target / "magfsi/__init__.py"), "1e-06"], found.stderr)


class Notebook(unittest.TestCase):
    def test_its_cells_run(self):
        """docs/first_steps.ipynb: the weaker field lifts the robot less."""
        cells = json.loads((testing.ROOT / "docs/first_steps.ipynb").read_text())["cells"]
        code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
        text = "\n".join(["import matplotlib; matplotlib.use('Agg')", *code,
                          "print(height_mm(run)[-1], height_mm(other)[-1])"])
        text = text.replace('"runs/', f'"{folder()}/').replace('"tutorials/swimmer/quick.yaml"',
                                                               f'"{testing.QUICK_SWIMMER}"')
        done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        mistake, heights = done.stdout.splitlines()
        self.assertIn('"parsec"', mistake)
        strong, weak = map(float, heights.split())
        self.assertGreater(strong, weak)


class Import(unittest.TestCase):
    def test_works_for_a_user_who_is_not_root(self):
        """Where nothing of root's can be read or written: the package lies in a folder of its own,
        the user has no home."""
        place = Path(testing.new_folder())
        shutil.copytree(testing.ROOT / "adapters/python/magfsi", place / "magfsi",
                        ignore=shutil.ignore_patterns("__pycache__"))
        for path in (place, *place.rglob("*")):
            path.chmod(0o755 if path.is_dir() else 0o644)
        words = ["env", "-i", f"PYTHONPATH={place}", "/usr/bin/python3", "-c",
                 "import os, magfsi; print(os.getuid() != 0, magfsi.__file__)"]
        if os.getuid() == 0:
            words = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", *words]
        found = subprocess.run(words, capture_output=True, text=True, cwd="/")
        self.assertEqual(found.stdout.split(), ["True", str(place / "magfsi/__init__.py")],
                         found.stderr)

    def test_needs_the_standard_library_only(self):
        code = ("import sys, json, magfsi; print(json.dumps([m for m in sys.modules if m in "
                "('numpy', 'pandas', 'vtk', 'matplotlib', 'scipy')]))")
        found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                               check=True)
        self.assertEqual(json.loads(found.stdout), [])


if __name__ == "__main__":
    unittest.main()
