# SPDX-License-Identifier: GPL-2.0-or-later
"""Each tutorial starts only the programs that its scene needs, and the LAMMPS script that is
generated for it has only the commands that the scene needs: those of a stored file. After a
change that is meant to be:  ./magfsi python tests/golden/scripts.py --renew"""

import difflib
import math
import os
import sys
import time
import unittest
from pathlib import Path

os.environ.setdefault("MAGFSI_BIN", str(Path("build/release/bin").resolve()))
os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
from magfsi import testing

HERE = Path(__file__).resolve().parent
RENEW = "./magfsi python tests/golden/scripts.py --renew"

# Runs are short, and told to end where the script is there; outputs are no part of it.
MOTION = {"time.end": "50 us", "probes": "null", "output": "null"}
PATH = {"time.end": "1 ms", "probes": "null", "output": "null"}
LAMMPS, SOLVER, FLUID = "magfsi-structure", "magfsi-equilibrium", "magfsi-fluid-lbm"

# name of the stored file: (scene, overrides, programs)
EVERY = 1  # of the scenes
SCENES = {
    "beam": ("tutorials/beam/scene.yaml", PATH, [SOLVER]),
    "gravity": ("tutorials/gravity/scene.yaml", PATH, [LAMMPS]),
    "gravity_weightless": ("tutorials/gravity/weightless.yaml", PATH, [SOLVER]),
    "origami": ("tutorials/origami/scene.yaml",
                {**PATH, "bodies.plate.mesh.oblique.elements": "[2, 2, 1]"}, [SOLVER]),
    "strip": ("tutorials/strip/scene.yaml", PATH, [LAMMPS]),
    "swimmer": ("tutorials/swimmer/uniform.yaml", MOTION, [LAMMPS, FLUID]),
    "swimmer_paper": ("tutorials/swimmer/paper.yaml", MOTION, [LAMMPS, FLUID]),
    "turning": ("tutorials/turning/scene.yaml", PATH, [SOLVER]),
    "turning_motion": ("tutorials/turning/motion.yaml", MOTION, [LAMMPS]),
    "turning_platform": ("tutorials/turning/platform.yaml", PATH, [LAMMPS]),
    # No tutorial is a fluid alone.
    "fluid": ("tests/golden/fluid.yaml", {}, [FLUID]),
}


def same_number(word, golden):
    """To the six digits that lengths are written with: the seventh may round either way."""
    try:
        return math.isclose(float(word), float(golden), rel_tol=2e-5)
    except ValueError:
        return False


def same(line, golden):
    words, others = line.split(), golden.split()
    return len(words) == len(others) and all(
        a == b or same_number(a, b) for a, b in zip(words, others))


def run(name):
    """The programs that were started, and the script that they left, None if there is none."""
    scene, settings, _ = SCENES[name]
    folder = Path(testing.new_folder())
    path = folder / "lammps.in"  # complete when it is there: written under another name
    process = testing.start([testing.BIN / "magfsi", "run", testing.ROOT / scene, "--out", folder,
                            *testing.overrides(settings)])
    while process.poll() is None and not path.exists():
        time.sleep(0.02)
    if path.exists():
        process.terminate()
    result = testing.finish(process, 0, folder, 120)
    if not path.exists() and result.code != 0:
        raise AssertionError(f"exit code {result.code}\n{result.out}\n{result.err}")
    command = result.out.splitlines()[0].split()  # mpirun's
    programs = [Path(word).name for word in command if word.startswith(str(testing.BIN))]
    return programs, path.read_text().replace(str(folder), "RUN") if path.exists() else None


class Scripts(unittest.TestCase):
    def test_have_only_what_the_scene_needs(self):
        for name, (_, _, needed) in list(SCENES.items())[::EVERY]:
            with self.subTest(name):
                programs, script = run(name)
                self.assertEqual(programs, needed)
                self.compare(name, script)

    def compare(self, name, text):
        golden = HERE / f"{name}.in"
        if text is None:
            self.assertFalse(golden.exists(), "no script where one is stored")
            return
        self.assertTrue(golden.exists(), f"nothing stored for {name}; to store it: {RENEW}")
        lines, stored = text.splitlines(), golden.read_text().splitlines()
        if len(lines) == len(stored) and all(map(same, lines, stored)):
            return
        diff = difflib.unified_diff(stored, lines, str(golden), "generated", lineterm="")
        self.fail("\n".join(diff) + f"\nif this is meant: {RENEW}")

    def test_that_differ_are_told(self):
        """The comparison sees a command too many, and a number that is another."""
        stored = (HERE / "swimmer.in").read_text()
        for wrong in (stored + "fix drag all magttice/drag 1\n",
                      stored.replace("9.81", "9.82")):
            with self.assertRaisesRegex(AssertionError, "--renew"):
                self.compare("swimmer", wrong)


def renew():
    for name in SCENES:
        _, text = run(name)
        if text is not None:
            (HERE / f"{name}.in").write_text(text)


if __name__ == "__main__":
    if "--renew" in sys.argv:
        renew()
    else:
        testing.main(EVERY=EVERY)
