# SPDX-License-Identifier: GPL-2.0-or-later
"""What a user of OpenFOAM adds to the case (fluid.openfoam): dictionaries that are merged, function
objects that run along, time folders for the stock tools, on one rank and on two."""

import re
import shutil
import subprocess
import unittest
from pathlib import Path

import stock_case
from magfsi import testing
from magfsi.witness import foam

SCENE = """
name: cavity
time: {end: 0.45 s, step: 5 ms}
fluid:
  solver: openfoam
  box: [10 mm, 2.5 mm, 10 mm]
  spacing: 0.625 mm
  density: 1000 kg/m3
  viscosity: 1 mm2/s
  boundaries:
    y_min: periodic
    y_max: periodic
    z_max: {no_slip: {velocity: [10 mm/s, 0 m/s, 0 m/s]}}
  openfoam: OWN
probes: {every: 50 ms, fluid: [kinetic_energy, momentum]}
"""
# Twelve digits of the files' numbers, of which the sum over 2048 cells loses two.
DIGITS = 1e-9
# Pressure's tolerance, from other roundings (as in stock_case.py).
SAME = 1e-6


class OwnCase(unittest.TestCase):
    def setUp(self):
        self.folder = Path(testing.new_folder())

    def scene(self, own, **files):
        for name, text in files.items():
            (self.folder / name).write_text(text)
        file = self.folder / "scene.yaml"
        file.write_text(SCENE.replace("OWN", own))
        return file

    def energies(self, own, ranks="fluid=1", **files):
        run = testing.good_run(self.scene(own, **files), ranks=ranks)
        return run, run.probes()["kinetic_energy[J]"]

    def test_schemes_are_merged_in_the_run_and_in_the_stock_case(self):
        """Upwind differences add u h / 2 to the viscosity: at the lid 3 mm2/s to 1 mm2/s."""
        _, central = self.energies("{}")
        run, upwind = self.energies("{schemes: mine}",
                                    mine="divSchemes { div(phi,U) Gauss upwind; }")
        testing.report(f"energy with upwind differences {upwind[-1] / central[-1] - 1:+.1%}")
        self.assertLess(upwind[-1] / central[-1], 0.97)  # far beyond any rounding
        stock_case.stock(run.folder / "openfoam")
        found = stock_case.energy(run.folder / "openfoam")
        self.assertAlmostEqual(found / upwind[-1], 1, delta=SAME)

    def test_the_solution_is_merged(self):
        """Two outer correctors are another splitting of the same equations."""
        _, one = self.energies("{}")
        _, two = self.energies("{solution: mine}", mine="PIMPLE { nOuterCorrectors 2; }")
        testing.report(f"two outer correctors: energy {two[-1] / one[-1] - 1:+.1e}")
        self.assertNotEqual(one[-1], two[-1])
        # The splitting's error falls with the step; 0.04 % at this one, a Courant number of 0.08.
        self.assertAlmostEqual(two[-1] / one[-1], 1, delta=0.002)

    def test_functions_run_along(self):
        """The integral of U by OpenFOAM's function object is the momentum over the density."""
        for ranks in ("fluid=1", "fluid=2"):
            run, _ = self.energies("{functions: mine}", ranks, mine="""
                all { type volFieldValue; libs (fieldFunctionObjects); fields (U);
                      operation volIntegrate; regionType all; writeFields no;
                      writeControl timeStep; writeInterval 10; }""")
            file = run.folder / "openfoam/postProcessing/all/0/volFieldValue.dat"
            rows = re.findall(r"^([0-9.e-]+)\s+\((\S+) ", file.read_text(), re.M)
            probes = run.probes()
            self.assertEqual(len(rows), 9)  # every 50 ms of 450
            for i, (t, x) in enumerate(rows, 1):
                self.assertAlmostEqual(float(t), probes["t[s]"][i])
                # The function object writes six digits.
                momentum = probes["momentum_x[kg m/s]"][i]
                self.assertAlmostEqual(float(x) * 1000 / momentum, 1, delta=1e-5)
            self.assertFalse((run.folder / "openfoam/0.45").exists())

    def test_a_function_that_cannot_be_made_ends_the_run(self):
        run = testing.run(self.scene("{functions: mine}", mine="a { type volFieldValue; "
                                     "libs (fieldFunctionObjects); }"), ranks="fluid=1")
        self.assertEqual(run.code, 1, run.err)
        self.assertIn("OpenFOAM", run.err)

    def test_time_folders_also_of_the_last_time(self):
        run, energy = self.energies("{write: {every: 200 ms}}")
        case = run.folder / "openfoam"
        times = sorted(p.name for p in case.iterdir() if p.name[0].isdigit())
        self.assertEqual(times, ["0", "0.2", "0.4", "0.45"])
        self.assertAlmostEqual(stock_case.energy(case) / energy[-1], 1, delta=DIGITS)
        self.post_process(case)
        self.assertTrue((case / "0.45" / "mag(U)").exists())
        shutil.rmtree(case / "0.45")
        stock_case.run("pimpleFoam", case)  # whose interval does not meet the end either
        self.assertAlmostEqual(stock_case.energy(case) / energy[-1], 1, delta=SAME)

    def test_time_folders_of_two_ranks(self):
        run, energy = self.energies("{write: {every: 200 ms, format: binary}}", "fluid=2")
        case = run.folder / "openfoam"
        for rank in ("processor0", "processor1"):
            self.assertTrue((case / rank / "0.45" / "U").exists())
        control = case / "system/controlDict"
        control.write_text(control.read_text().replace("writeFormat binary", "writeFormat ascii"))
        for words in (["reconstructParMesh", "-constant"], ["reconstructPar"],
                      ["foamFormatConvert"]):
            subprocess.run([*words, "-case", case], env=foam.environment(), check=True,
                           capture_output=True, timeout=120)
        self.assertAlmostEqual(stock_case.energy(case) / energy[-1], 1, delta=DIGITS)

    def test_time_folders_stay_where_a_run_goes_on(self):
        scene = self.scene("{write: {every: 200 ms}}")
        every = {"checkpoint.every": "0.2 s"}
        first = testing.good_run(scene, {"time.end": "0.2 s", **every}, "fluid=1")
        testing.good_run(scene, every, "fluid=1", folder=first.folder, restart="latest")
        case = first.folder / "openfoam"
        times = sorted(p.name for p in case.iterdir() if p.name[0].isdigit())
        self.assertEqual(times, ["0", "0.2", "0.4", "0.45"])

    def post_process(self, case):
        subprocess.run(["postProcess", "-func", "mag(U)", "-latestTime", "-case", case],
                       env=foam.environment(), check=True, capture_output=True, timeout=120)


if __name__ == "__main__":
    unittest.main()
