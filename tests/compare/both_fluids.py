# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi compare SCENE: the small swimmer on the lattice and in OpenFOAM. Both bend alike, what
was run is kept, and what OpenFOAM does not do is refused with how to change the scene for it
alone."""
import unittest
from pathlib import Path

from command import called

from magfsi import runs, testing

# As docs/openfoam.md compares them: the penalty for both, OpenFOAM with a step twice as long, and
# the strength raised by as much, so that both have the same drag coefficient.
WORDS = ["--set", "time.end=2 ms", "--set", "coupling.immersed_boundary.forcing=penalty",
         "--set", "coupling.immersed_boundary.kernel=3-point",
         "--set", "output.fluid={every: 0.5 ms, fields: [velocity]}",
         "--set", "output.structure.every=0.5 ms", "--openfoam", "fluid.courant=0.1",
         "--openfoam", "coupling.immersed_boundary.strength=2",
         "--openfoam", "fluid.grading.uniform=[[2 mm, 1 mm, 3 mm], [6.2 mm, 3 mm, 5.2 mm]]"]
# Mid rise, L2: half of what OpenFOAM was off by without its force in balance with the pressure
# (docs/openfoam.md).
APART = 0.12


class BothFluids(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.out = Path(testing.new_folder()) / "out"
        cls.done = called(testing.SMALL, "--out", cls.out, *WORDS)
        assert cls.done.code == 0, cls.done.err
        cls.rows = {row["probe"]: row for row in runs.read_rows(cls.out / "compare.csv")}
        testing.report(cls.done.out)

    def test_both_bend_alike(self):
        for probe in ("robot.mid_rise[m]", "robot.end_to_end[m]", "robot.energy_elastic[J]"):
            testing.report(f"{probe}: L2 {self.rows[probe]['l2[1]']}")
        apart = float(self.rows["robot.mid_rise[m]"]["l2[1]"])
        self.assertGreater(apart, 1e-4)  # two programs
        self.assertLess(apart, APART)

    def test_it_says_who_is_who_and_what_they_cost(self):
        rows = runs.read_rows(self.out / "cost.csv")
        self.assertEqual([(row["run"], row["fluid"]) for row in rows],
                         [("lattice", "lbm"), ("OpenFOAM", "openfoam")])
        for row in rows:
            self.assertGreater(float(row["processor[s]"]), 0)
        self.assertIn("is not known: neither run has one", self.done.out)
        self.assertRegex(self.done.out, r"OpenFOAM takes [\d.e+]+ times the wall time")
        self.assertTrue((self.out / "fields.png").exists())
        self.assertIn("The speed in the plane xz", (self.out / "compare.html").read_text())

    def test_again_it_runs_nothing(self):
        self.assertIn("completed in", self.done.out)
        again = called(testing.SMALL, "--out", self.out, *WORDS)
        self.assertEqual((again.code, again.out.count("completed in")), (0, 0), again.err)

    def test_what_openfoam_does_not_do(self):
        out = Path(testing.new_folder()) / "out"
        done = called(testing.SMALL, "--out", out, "--set", "fluid.refinement.levels=1")
        self.assertEqual((done.code, len(done.err.strip().splitlines())), (2, 1), done.err)
        self.assertIn("take fluid.grading", done.err)
        self.assertIn("--openfoam KEY=VALUE", done.err)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
