# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs docs/examples/in.beam as its own head says and holds it to the reference."""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

script = Path(sys.argv[1])
program = Path(os.environ["MAGFSI_BIN"]) / "magfsi-lammps"
head = script.read_text().split("\n\n")[0]
command = re.search(r"magfsi-lammps (lattice.*?)\n#\s+magfsi-lammps -in", head, re.S)
words = command.group(1).replace("#", " ").split()

# Converged 3D finite elements (27-node hexahedra), Br B / (mu0 G) = 0.001.
reference = 0.342595

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([program, *words], cwd=folder, check=True)
    done = subprocess.run([program, "-in", script, "-log", "none", "-nocite"],
                          cwd=folder, check=True, capture_output=True, text=True)
found = float(re.search(r"m, ([0-9.]+) of the length\n", done.stdout).group(1))
print(f"tip displacement {found} of the length, reference {reference}")
# Two layers of assumed_strain elements, and what is left of the motion at a ratio of 2e-4.
assert abs(found / reference - 1) < 0.015, found

# Wrong arguments end with 2 and say what is missing.
refused = subprocess.run([program, "lattice", "beam"], capture_output=True, text=True)
assert refused.returncode == 2 and "--size" in refused.stderr, refused
