# SPDX-License-Identifier: GPL-2.0-or-later
"""Whoever does what a message says gets rid of it: each advice is provoked and followed to the letter.

advice/*.txt has a row a line: settings | words of the message | remedy | another remedy ... A
remedy is settings on top of the first ones (of several keys with "; " between them), "-" the scene
without them. A line "== NAME" starts the rows of the scene advice/NAME.yaml.

--runs 1 follows what a run says, --runs 0 what is said before, of which --every 8 takes each
eighth row. Not here: advice on the machine or the MPI job (attack_no_start, attack_wrong_partners,
attack_one_owner), of studies and searches (study_is_refused), of the launcher (launcher_words), of
LAMMPS scripts (structure_script), what only Gmsh can mend (ElementOrder); a gain of energy without
a source and the law of steps of a crushed body, which take long runs; and what a scene cannot
reach, for it is refused or made right before: effective densities, one magnetised region of many,
relaxation times of 1/2, contact with an obstacle without a surface, a program built without an
effect, sides out of step.
"""

import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import advice_files
from magfsi import testing

HERE = Path(__file__).parent / "advice"
RUNS, EVERY = 0, 1
# The scenes, beside the files that they name.
SCENES = Path(testing.new_folder())
for scene in HERE.glob("*.yaml"):
    shutil.copy(scene, SCENES)
advice_files.write(SCENES)


def rows(table):
    scene = None
    for line in (HERE / table).read_text().splitlines():
        if line.startswith("== "):
            scene = SCENES / f"{line[3:]}.yaml"
        elif line and not line.startswith("#"):
            yield scene, *(part.strip() for part in line.split(" | "))


def said(*words):
    """Exit code of a program, and what it says."""
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=120, check=False,
                          cwd=SCENES)
    return done.returncode, done.stdout + done.stderr


def told(command, scene, *settings):
    sets = [word for one in "; ".join(settings).split("; ") if one for word in ("--set", one)]
    out = ["--out", Path(testing.new_folder()) / "run"] if command == "run" else []
    return said(testing.BIN / "magfsi", command, scene, *out, *sets)


class Advice(unittest.TestCase):
    runs = None

    @classmethod
    def setUpClass(cls):
        if cls.runs != RUNS:
            raise unittest.SkipTest(f"--runs {RUNS}")

    def follow(self, table, command="check"):
        number = 0
        for scene, cause, message, *remedies in list(rows(table))[::EVERY]:
            with self.subTest(cause):
                self.assertTrue(remedies)
                self.assertIn(message, told(command, scene, cause)[1])
                for remedy in remedies:
                    number += 1
                    code, after = told(command, scene, *([] if remedy == "-" else [cause, remedy]))
                    self.assertEqual(code, 0, f"{remedy}: {after}")
                    self.assertNotIn(message, after, remedy)
        testing.report(f"{table}: {number} advices followed")

    def then(self, message, wrong, right):
        """The first words say the message, the second ones run."""
        with self.subTest(message):
            self.assertIn(message, said(*wrong)[1])
            code, after = said(*right)
            self.assertEqual(code, 0, after)
            self.assertNotIn(message, after)


class BeforeTheRun(Advice):
    runs = 0

    def test_keys_and_numbers(self):
        self.follow("keys.txt")

    def test_fluid(self):
        self.follow("fluid.txt")

    def test_loads_and_coupling(self):
        self.follow("loads.txt")

    def test_files(self):
        self.follow("files.txt")

    def test_what_explain_says(self):
        self.follow("explain.txt", "explain")

    def test_text(self):
        whole = (SCENES / "fluid.yaml").read_bytes()
        for old, new, message in ((b"fluid:", b"---\nfluid:", 'remove the line "---"'),
                                  (b"  spacing", b"\tspacing", "indentation by spaces"),
                                  (b"  spacing", b"  density: 1 kg/m3\n  spacing", "each key once"),
                                  (b"mm2/s", b"mm\xb2/s", "text in UTF-8")):
            text = SCENES / "text.yaml"
            text.write_bytes(whole.replace(old, new, 1))
            self.then(message, [testing.BIN / "magfsi", "check", text],
                      [testing.BIN / "magfsi", "check", SCENES / "fluid.yaml"])

    def test_programs(self):
        run, lattice = [testing.BIN / "magfsi", "check"], [testing.BIN / "magfsi", "lattice"]
        self.then("a scene file, or a folder with a scene.yaml", [*run, "no.yaml"], [*run, "body.yaml"])
        self.then("name one with the key bodies", [*lattice, "fluid.yaml", "--out", "lattice"],
                  [*lattice, "body.yaml", "--out", "lattice"])
        self.then("allowed with a scene", [*lattice, "lattice/arm.lattice", "--out", "back", "--set", "a=b"],
                  [*lattice, "lattice/arm.lattice", "--out", "back"])


class OfRuns(Advice):
    runs = 1

    def test_what_ends_them(self):
        self.follow("runs.txt", "run")

    def run_of(self, scene, *more):
        return [testing.BIN / "magfsi", "run", f"{scene}.yaml", "--out", Path(testing.new_folder()) / "run", *more]

    def test_programs(self):
        def alone(program, *more):
            return [testing.BIN / program, *more, "--out", Path(testing.new_folder()) / "run"]
        use = "use ./magfsi run SCENE"
        self.then(use, alone("magfsi-structure", "fluid.yaml"), self.run_of("fluid"))
        self.then(use, alone("magfsi-fluid-lbm", "body.yaml"), self.run_of("body"))
        self.then(use, alone("magfsi-structure", "both.yaml"), self.run_of("both"))
        self.then("start magfsi-equilibrium for it", alone("magfsi-structure", "path.yaml"),
                  alone("magfsi-equilibrium", "path.yaml"))
        self.then("start magfsi-structure for it", alone("magfsi-equilibrium", "body.yaml"),
                  alone("magfsi-structure", "body.yaml"))
        foam = ["fluid.yaml", "--set", "fluid.solver=openfoam"]
        self.then("use ./magfsi run SCENE --fluid lbm", alone("magfsi-fluid-lbm", *foam),
                  self.run_of("fluid", *foam[1:], "--fluid", "lbm"))

    def test_ranks(self):
        small = ["--set", "fluid.box=[8 mm, 4 mm, 4 mm]"]
        flat = ["--set", "fluid.box=[8 mm, 1 mm, 4 mm]", "--set", "fluid.boundaries={y_min: periodic, "
                "y_max: periodic, z_min: pressure_outlet, z_max: pressure_outlet}"]
        self.then("choose a number of fluid ranks that is a product of at most 4 and at most 4",
                  self.run_of("fluid", "--ranks", "fluid=5", *small),
                  self.run_of("fluid", "--ranks", "fluid=2", *small))
        self.then("choose fewer fluid ranks", self.run_of("fluid", "--ranks", "fluid=4", *flat),
                  self.run_of("fluid", "--ranks", "fluid=2", *flat))

    def test_structure_of_ones_own(self):
        own = ["--set", "bodies=", "--set", "magnetic_field=", "--set", "probes=", "--set", "coupling={structure: own}"]
        self.then("which only the command line may name", self.run_of("both", *own), self.run_of("both"))
        self.then("allowed with coupling.structure: own", self.run_of("both", "--structure", sys.executable),
                  self.run_of("both"))

    def test_restarts(self):
        keeps = ["--set", "checkpoint={every: 2 ms}"]
        first = self.run_of("both", *keeps)
        self.assertEqual(said(*first)[0], 0)
        again = [*first, "--restart"]
        folder = first[4]
        other, longer = ["--set", "fluid.density=998 kg/m3"], ["--set", "time.end=12 ms"]
        early = [*again, sorted(folder.glob("checkpoint_*_fluid.h5"))[-1], "--set", "time.end=3 ms"]
        self.then("start without --restart", self.run_of("both", "--restart", "latest"), self.run_of("both"))
        self.then("start without --restart", self.run_of("both", *keeps, "--restart", "latest"), self.run_of("both"))
        self.then("use the scene file and the --set options of that run", [*again, "latest", *other],
                  [*again, "latest"])
        self.then("give a later time.end, or an earlier checkpoint's file", early,
                  [*again, "latest", *longer])
        torn = sorted(folder.glob("checkpoint_*_fluid.h5"))[0]
        torn.write_bytes(torn.read_bytes()[:1000])
        self.then("take latest, or the file of another step", [*again, torn, *longer], [*again, "latest", *longer])

    def test_pages_and_pictures(self):
        run = self.run_of("both")
        self.assertEqual(said(*run)[0], 0)
        for word in ("report", "plot"):
            module = [sys.executable, "-P", "-m", f"magfsi.{word}"]
            self.then("allowed are folders that ./magfsi run has written", [*module, SCENES], [*module, run[4]])


if __name__ == "__main__":
    testing.main(RUNS=RUNS, EVERY=EVERY)
