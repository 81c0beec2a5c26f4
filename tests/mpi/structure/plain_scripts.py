# SPDX-License-Identifier: GPL-2.0-or-later
"""Scripts that people write for magfsi-lammps: what would be wrong without a word is refused with
what is allowed; `clear` keeps our styles; any path is one of a script."""
import re
import subprocess
import unittest
from pathlib import Path

from magfsi import testing

PROGRAM = testing.BIN / "magfsi-lammps"
BLOCK = ("--size 4e-3 1e-3 0.25e-3 --elements 8 2 1 --shear-modulus 33e3 --lame-lambda 660e3 "
         "--density 1860 --magnetization 62e3 0 0").split()
BODY = "fix beam all magttice beam.lattice 1 33e3 660e3"
# A stretched block that swings back: its energies are those of its elasticity.
SCRIPT = f"""\
units si
atom_style sphere
atom_modify map array sort 0 0.0
newton on
boundary s s s
comm_modify mode single cutoff 1.4e-3 vel yes
neighbor 1e-4 bin
neigh_modify once yes
read_data beam.data
{BODY}
fix integrate all nve
timestep 4e-6
thermo_style custom step pe ke
thermo_modify norm no format float %.15g
velocity all ramp vx 0 0.1 x 0 4e-3
region end block EDGE 1e-6 EDGE EDGE EDGE EDGE
group end region end
"""
RUN = "run 50\n"
END = "fix move end magttice/motion ramp 1e-4 0 0 1e-3"

EVERY = 1  # of what is wrong
# What is said, the line that is changed, and what it becomes.
WRONG = [(f"fix beam magttice found with units {units}; allowed is units si", "units si", f"units {units}")
         for units in ("real", "lj", "metal", "cgs", "micro")] + [
    ("fix beam magttice and fix two magttice are both for atoms from ID 1 on", BODY,
     f"{BODY}\n{BODY.replace('beam', 'two', 1)}"),
    # Nodes 28 to 81 of a second body that has the first one's file, and overlaps it by half.
    ("fix beam magttice and fix two magttice are both for atoms from ID 28 on", BODY,
     f"{BODY}\nfix two all magttice beam.lattice 28 33e3 660e3"),
    ("needs the command: newton on", "newton on", "newton off"),
    ("needs the command: atom_modify map array", "atom_modify map array sort 0 0.0",
     "atom_modify sort 0 0.0"),
    ("works with run_style verlet only", "timestep 4e-6", "timestep 4e-6\nrun_style respa 2 2"),
    ("has 54 nodes in its lattice file, but 48 atoms", "group end region end",
     "group end region end\ndelete_atoms group end"),
    ('fix d magttice/dipoles found no fix magttice with the words "dipoles d"', BODY,
     f"fix d all magttice/dipoles\n{BODY}"),
    ("there is no fix d of the style magttice/dipoles", BODY, f"{BODY} dipoles d"),
    ("fix p magttice/platform found no fix magttice", BODY,
     "fix p all magttice/platform 0 0 -1e-3 0 0 1 1e8"),
    ("fix move magttice/motion and fix integrate nve both move atom 1;", "group end region end",
     f"group end region end\n{END}"),
    # No step helps in a box of two elements.
    ("the box is periodic along y and", "boundary s s s", "boundary p p p"),
]


class Scripts(unittest.TestCase):
    def setUp(self):
        self.folder = Path(testing.new_folder()) / "mit Blank ü"
        self.folder.mkdir()
        testing.output_of(PROGRAM, "lattice", "beam", *BLOCK, cwd=self.folder)

    def lammps(self, script):
        (self.folder / "in.beam").write_text(script)
        return subprocess.run([PROGRAM, "-in", "in.beam", "-log", "none", "-nocite"], cwd=self.folder,
                              capture_output=True, text=True)

    def energies(self, script):
        """Of each run of the script: the lines of its thermodynamics."""
        done = self.lammps(script)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr)
        # LAMMPS of 2025 indents the line of names.
        found = re.findall(r"^ *Step .*\n((?:[ \d.e+-]+\n)+)Loop", done.stdout, re.M)
        self.assertTrue(found, done.stdout)
        return [each.split("\n") for each in found]

    def test_what_is_wrong_is_refused(self):
        for words, line, instead in WRONG[::EVERY]:
            with self.subTest(words):
                self.assertEqual(SCRIPT.count(f"{line}\n"), 1)
                done = self.lammps(SCRIPT.replace(f"{line}\n", f"{instead}\n") + RUN)
                self.assertNotEqual(done.returncode, 0, done.stdout)
                self.assertIn(words, done.stdout + done.stderr)

    def test_clear_keeps_the_styles(self):
        first, second = self.energies(f"{SCRIPT}{RUN}clear\n{SCRIPT}{RUN}")
        self.assertEqual(first, second)
        self.assertGreater(float(first[1].split()[1]), 0)

    def test_moved_nodes_that_nothing_else_moves(self):
        rest = "group rest subtract all end\n"
        script = SCRIPT.replace("fix integrate all nve\n", "") + f"{rest}fix integrate rest nve\n{END}\n"
        self.assertEqual(len(self.energies(script + RUN)), 1)

    def test_a_path_of_any_letters(self):
        """A script of the program itself has them as in URLs."""
        plain = self.energies(SCRIPT + RUN)
        (self.folder / "beam.lattice").rename(self.folder / "ein Balken ä.lattice")
        word = "ein%20Balken%20%C3%A4.lattice"
        self.assertEqual(self.energies(SCRIPT.replace("beam.lattice", word) + RUN), plain)


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
