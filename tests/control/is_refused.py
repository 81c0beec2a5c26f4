# SPDX-License-Identifier: GPL-2.0-or-later
"""What a scene may not say of its controller: one line, exit code 2, nothing started."""
import os
import unittest
from pathlib import Path

from scripts import ALONE, EVERY, of, testing, with_control

GOOD = of("return 0, 0, 1e-3")


SCENE = """\
name: steered
time: {end: 1 ms}
bodies:
  strip:
    mesh: {box: {size: [4 mm, 1 mm, 0.2 mm], elements: [4, 1, 1]}}
    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}
    magnetization: {uniform: [62 kA/m, 0 kA/m, 0 kA/m]}
magnetic_field: {plane: xz, constant: {magnitude: 1 mT, direction: 0 deg}}
probes: {every: 0.1 ms, bodies: [com]}
control:
  script: steer.py
  every: 0.5 ms
  probes: [strip.com_x,
           strip.com_q]
"""


class Refused(unittest.TestCase):
    def test_a_probe_that_is_absent_where_it_stands(self):
        scene = Path(testing.new_folder()) / "scene.yaml"
        scene.write_text(SCENE)
        (scene.parent / "steer.py").write_text(GOOD)
        folder = Path(testing.new_folder()) / "run"
        run = testing.run(scene, folder=folder)
        testing.check_refused(self, run, f'{scene}:14:12: found "strip.com_q"')
        self.assertFalse(folder.exists())

    def refused(self, settings, *words):
        folder = Path(testing.new_folder()) / "run"
        run = testing.run(EVERY, settings, folder=folder)
        testing.check_refused(self, run, words[0])
        for word in words:
            self.assertIn(word, run.err)
        self.assertFalse(folder.exists())

    def test_a_probe_that_is_absent(self):
        self.refused(with_control(ALONE, GOOD, probes=["strip.com_q"]), "control.probes",
                     '"strip.com_q"', "columns of probes.csv", 'did you mean "strip.com_')

    def test_probes_without_probes(self):
        self.refused({**with_control(ALONE, GOOD, probes=["strip.com_x"]), "probes": ""},
                     "control.probes without probes")

    def test_no_script(self):
        for script, word in (("/none/steer.py", 'no file "/none/steer.py"'), ("/etc", "a folder"),
                             ("/etc/passwd", "the ending .py")):
            self.refused({**ALONE, "control": f"{{script: {script}, every: 1 ms}}"}, word)

    def test_no_field(self):
        self.refused({**with_control(ALONE, GOOD), "magnetic_field": ""},
                     "control without a magnetic field")

    def test_equilibria(self):
        self.refused({**with_control(ALONE, GOOD), "time.equilibrium": "{}", "damping": ""},
                     "control of a path of equilibria")

    def test_calls_between_rows(self):
        self.refused(with_control(ALONE, GOOD, every="0.7 ms"), "700 us between two calls",
                     "a whole number of times probes.every, 500 us")

    def test_a_package_that_is_missing(self):
        folder = Path(testing.new_folder())
        (folder / "mpi4py.py").write_text("raise ImportError\n")
        before = os.environ["PYTHONPATH"]
        os.environ["PYTHONPATH"] = f"{folder}:{before}"
        try:
            self.refused(with_control(ALONE, GOOD), "apt install python3-mpi4py")
        finally:
            os.environ["PYTHONPATH"] = before


if __name__ == "__main__":
    unittest.main()
