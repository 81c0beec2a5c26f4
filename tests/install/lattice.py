# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi lattice: what a scene has, as files for LAMMPS, and from those back into a scene: the same solid."""
import subprocess
import unittest
from pathlib import Path

from magfsi import runs, testing
from magfsi.testing import output_of


def solid(file):
    """{corners of an element, sorted, in nm: its magnetisation in A/m}"""
    lines = iter([line.split() for line in file.read_text().splitlines()
                  if line.strip() and not line.startswith("#")])
    nodes = [tuple(round(float(x) * 1e9) for x in next(lines)) for _ in range(int(next(lines)[1]))]
    elements = [next(lines) for _ in range(int(next(lines)[1]))]
    return {tuple(sorted(nodes[int(n)] for n in words[:8])): tuple(float(m) for m in words[8:11])
            for words in elements}


class Lattice(unittest.TestCase):
    def test_every_mesh_and_magnetisation_comes_back(self):
        for scene in ("tutorials/strip/scene.yaml", "tutorials/origami/scene.yaml", "docs/howto/cross.yaml",
                      "docs/examples/scenes/two_bodies.yaml"):
            folder = Path(testing.new_folder())
            output_of(runs.BIN / "magfsi", "lattice", testing.ROOT / scene, "--out", folder / "first")
            for file in sorted((folder / "first").glob("*.lattice")):
                with self.subTest(f"{scene}: {file.stem}"):
                    output_of(runs.BIN / "magfsi", "lattice", file, "--out", folder / "back")
                    (folder / "back/scene.yaml").write_text(
                        "time: {end: 1 ms}\nbodies:\n  again:\n"
                        f"    mesh: {{gmsh: {{file: {file.stem}.msh}}}}\n"
                        "    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}\n"
                        f"    magnetization: {{table: {{file: {file.stem}.csv}}}}\n")
                    output_of(runs.BIN / "magfsi", "lattice", folder / "back/scene.yaml", "--out", folder / "second")
                    there, again = solid(file), solid(folder / "second/again.lattice")
                    self.assertEqual(set(there), set(again))
                    for corners, magnetisation in there.items():
                        for a, b in zip(magnetisation, again[corners]):
                            self.assertAlmostEqual(a, b, delta=1e-9 * max(1, abs(a)))

    def test_its_script_runs(self):
        folder = Path(testing.new_folder())
        output_of(runs.BIN / "magfsi", "lattice", testing.ROOT / "tutorials/swimmer", "--set", "time.end=0.2 ms",
             "--out", folder)
        self.assertIn("Loop time", output_of(runs.BIN / "magfsi-lammps", "-in", folder / "lammps.in", "-log", "none"))

    def test_what_is_wrong_is_said(self):
        folder = Path(testing.new_folder())
        (folder / "torn.lattice").write_text("nodes 8\n0 0\n")
        for words in ([folder / "torn.lattice"], [folder / "none.lattice"],
                      [testing.ROOT / "docs/examples/scenes/flow.yaml"]):
            done = subprocess.run([runs.BIN / "magfsi", "lattice", *words, "--out", folder / "out"],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, words)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
