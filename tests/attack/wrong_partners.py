# SPDX-License-Identifier: GPL-2.0-or-later
"""Programs that do not belong together: each such job ends at once, with what is wrong."""

import unittest
from pathlib import Path

import attack
from attack import testing

FLUID_ALONE = {"bodies": "", "gravity": "", "magnetic_field": "", "probes": ""}


def program(name, folder, scene=testing.SMALL, settings=None, ranks=1):
    return ["-n", str(ranks), testing.BIN / name, scene, "--out", folder,
            *testing.overrides(settings or {"time.end": "2 ms"})]


def another(name):
    """A program of the same side under a name of its own."""
    link = Path(testing.new_folder()) / f"{name}-of-mine"
    link.symlink_to(testing.BIN / name)
    return link


class Jobs(unittest.TestCase):
    def ends(self, code, message, *programs):
        """Each program: (name, settings, ...) or ([words])."""
        folder = testing.new_folder() + "/run"
        words = ["mpirun", "--oversubscribe"]
        for i, one in enumerate(programs):
            named = one if isinstance(one, list) else program(one[0], folder, *one[1:])
            words += [":"] * (i > 0) + named
        ended = attack.finish(testing.start(words), folder)
        # Open MPI 5 ends a message of its own with a NUL character, which a line of ours may follow.
        lines = ended.err.replace("\0", "").splitlines()
        ours = [line for line in lines if line.startswith("magfsi ")]
        self.assertEqual(ended.code, code, ended.err)
        self.assertTrue(any(message in line for line in ours), ended.err)
        testing.report(ours[0])
        attack.wait_for(lambda: not attack.at_work(folder), "their end")

    def test_one_fluid_with_the_scene_of_another(self):
        openfoam = {"fluid.solver": "openfoam", "time.end": "2 ms"}
        for name, settings, solver in (("magfsi-fluid-openfoam", {"time.end": "2 ms"}, "lbm"),
                                       ("magfsi-fluid-lbm", openfoam, "openfoam")):
            if not (testing.BIN / name).exists():
                continue
            with self.subTest(name):
                self.ends(2, f"fluid.solver is {solver}; start magfsi-fluid-{solver}",
                          (name, testing.SMALL, {**settings, **FLUID_ALONE}))
                self.ends(2, f"fluid.solver is {solver}; start magfsi-fluid-{solver}",
                          ("magfsi-structure", testing.SMALL, settings),
                          (name, testing.SMALL, settings))

    def test_a_program_of_others(self):
        """Whether it is one of MPI or not, beside both sides or in the place of one."""
        for words in (["sleep", "600"], [testing.BIN / "magfsi-lammps"]):
            other = ["-n", "1", *words]
            with self.subTest(words):
                self.ends(4, f"none of magfsi's: -n 1 {' '.join(map(str, words))}",
                          ("magfsi-structure",), ("magfsi-fluid-lbm",), other)
                self.ends(4, "none of magfsi's", ("magfsi-structure",), other)
                self.ends(4, "none of magfsi's", other, ("magfsi-fluid-lbm",))

    def test_both_fluids_at_once(self):
        self.ends(4, "are both in this MPI job as the fluid", ("magfsi-structure",),
                  ("magfsi-fluid-lbm",), (another("magfsi-fluid-lbm"),))

    def test_two_programs_for_one_side(self):
        self.ends(4, "are both in this MPI job as the structure",
                  ("magfsi-structure",), (another("magfsi-structure"),))

    def test_one_side_of_two_scenes(self):
        self.ends(4, "disagree on the scene (hash)",
                  ("magfsi-fluid-lbm", testing.SMALL, {**FLUID_ALONE, "time.end": "2 ms"}),
                  ("magfsi-fluid-lbm", testing.SMALL, {**FLUID_ALONE, "time.end": "3 ms"}))

    def test_motion_by_the_solver_of_equilibria(self):
        self.ends(2, "start magfsi-structure for it",
                  ("magfsi-equilibrium", testing.SMALL, {"fluid": "", "probes": "",
                                                         "time.end": "2 ms"}))

    def test_equilibria_by_the_solver_of_motion(self):
        self.ends(2, "start magfsi-equilibrium for it",
                  ("magfsi-structure", testing.ROOT / "tutorials/beam/scene.yaml", {}))

    def test_a_fluid_that_the_scene_has_not(self):
        self.ends(2, "the scene has no fluid",
                  ("magfsi-fluid-lbm", testing.SMALL, {"fluid": "", "probes": ""}))


if __name__ == "__main__":
    unittest.main()
