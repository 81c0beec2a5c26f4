# SPDX-License-Identifier: GPL-2.0-or-later
"""Meshes, surfaces, tables and checkpoints with random damage: refused in one line, or read as
what they say; none crashes, hangs, or is taken for something else than it was."""

import os
import random
import shutil
import unittest
from pathlib import Path

import attack
from attack import testing
from magfsi import runs

FILES = 12  # of each kind
SEED = 1
MESH = testing.ROOT / "tests/unit/mesh/two_cubes.msh"
SCENE = """\
time: {end: 20 us}
bodies:
  cubes:
    mesh: {gmsh: {file: a.msh, unit: 1 mm}}
    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}
    magnetization: {table: {file: a.csv}}
"""
FLUID = """\
time: {end: 2 ms}
fluid:
  {box: [8 mm, 8 mm, 8 mm], spacing: 1 mm, density: 1000 kg/m3, viscosity: 10 mm2/s,
   expected_speed: 0.1 m/s, obstacles: {o: {stl: {file: a.stl, unit: 1 mm,
   shift: [4 mm, 4 mm, 4 mm]}}}}
"""
TABLE = "x[m],y[m],z[m],Mx[A/m],My[A/m],Mz[A/m]\n" + "".join(
    f"{x}e-3,0.5e-3,0.5e-3,{1000 * x},0,10\n" for x in (0.5, 1.5))


def tetrahedron():
    corners = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    text = "solid t\n"
    for face in faces:
        text += "facet normal 0 0 0\nouter loop\n" + "".join(
            "vertex {} {} {}\n".format(*corners[c]) for c in face) + "endloop\nendfacet\n"
    return text + "endsolid t\n"


def damaged(data, rng):
    """One to three of what happens to files."""
    data = bytearray(data)
    for _ in range(rng.randint(1, 3)):
        at = rng.randrange(max(1, len(data)))
        size = rng.randint(1, 1 + len(data) // 8)
        kind = rng.randrange(7)
        if kind == 0:
            data = data[:at]
        elif kind == 1 and data:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 2:
            data[at:at + size] = bytes(len(data[at:at + size]))
        elif kind == 3:
            data[at:at + size] = rng.randbytes(size)
        elif kind == 4:
            del data[at:at + size]
        elif kind == 5:
            data[at:at] = data[at:at + size]
        else:
            word = rng.choice([b"-1", b"1e308", b"nan", b"99999999999", b"2147483647", b"\n", b""])
            end = next((i for i in range(at, len(data)) if data[i:i + 1].isspace()), len(data))
            data[at:end] = word
    return bytes(data)


class Damaged(unittest.TestCase):
    def setUp(self):
        self.rng = random.Random(SEED)
        self.folder = Path(testing.new_folder())
        self.scene = self.folder / "scene.yaml"

    def check(self, name, whole):
        """All of a kind, by magfsi check."""
        (self.folder / name).write_bytes(whole)
        ended = self.magfsi()
        self.assertEqual(ended.code, 0, ended.err)
        refused = 0
        for n in range(FILES):
            (self.folder / name).write_bytes(damaged(whole, self.rng))
            ended = self.magfsi()
            with self.subTest(f"{name} {n}"):
                self.assertIn(ended.code, (0, 2), f"{ended.out}{ended.err}")
                self.assertEqual(len(testing.causes(ended)), ended.code // 2, ended.err)
            refused += ended.code == 2
        testing.report(f"{name}: {refused} of {FILES} refused, the others still meant something")
        self.assertGreater(refused, 0)

    def magfsi(self):
        words = runs.command("check", self.scene)
        return testing.finish(testing.start(words), 0, "unused", attack.PATIENCE_S)

    def test_meshes(self):
        self.scene.write_text(SCENE)
        (self.folder / "a.csv").write_text(TABLE)
        self.check("a.msh", MESH.read_bytes())

    def test_tables(self):
        self.scene.write_text(SCENE)
        shutil.copy(MESH, self.folder / "a.msh")
        self.check("a.csv", TABLE.encode())

    def test_surfaces(self):
        self.scene.write_text(FLUID)
        self.check("a.stl", tetrahedron().encode())

    def test_a_checkpoint_that_is_a_pipe(self):
        folder = self.folder / "run"
        short = {**attack.SETTINGS, "time.end": "0.5 ms"}
        self.assertEqual(attack.run(folder, short).code, 0)
        newest = max(folder.glob("checkpoint*_fluid.h5"))
        newest.unlink()
        os.mkfifo(newest)
        named = attack.run(testing.new_folder(), short, restart=str(newest))
        testing.check_refused(self, named, "is no regular file")
        self.assertEqual(attack.run(folder, short, restart="latest").code, 0)

    def test_checkpoints(self):
        """A checkpoint has checksums: what is damaged is skipped, and the end is the same."""
        folder = self.folder / "run"
        short = {**attack.SETTINGS, "time.end": "1 ms"}
        whole = attack.run(testing.new_folder(), short)
        self.assertEqual(whole.code, 0, whole.err)
        self.assertEqual(attack.run(folder, {**short, "time.end": "0.5 ms"}).code, 0)
        refused = 0
        for n in range(FILES):
            trial = self.folder / "trial"
            shutil.rmtree(trial, ignore_errors=True)
            shutil.copytree(folder, trial)
            victims = sorted(trial.glob("checkpoint*.h5"))
            for file in self.rng.sample(victims, self.rng.choice([1, 1, len(victims)])):
                file.write_bytes(damaged(file.read_bytes(), self.rng))
            ended = attack.run(trial, short, restart="latest")
            with self.subTest(f"checkpoint {n}"):
                self.assertIn(ended.code, (0, 2), ended.err)
                if ended.code == 0:
                    testing.check_same_files(self, attack.results(trial), attack.results(whole.folder))
                else:
                    testing.check_refused(self, ended, "--restart latest")
            refused += ended.code == 2
        testing.report(f"checkpoints: {refused} of {FILES} refused, the others went on")


if __name__ == "__main__":
    testing.main(FILES=FILES, SEED=SEED)
