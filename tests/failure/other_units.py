# SPDX-License-Identifier: GPL-2.0-or-later
"""Files whose lengths are in another unit than the scene says are refused at once, by every command
in the same words, with the likely unit; none takes the memory or the time of what they would be."""
import resource
import subprocess
import time
import unittest
from pathlib import Path

from magfsi import surfaces, testing

MEMORY_BYTES = 2 * 10**9  # of addresses, of which a check of the same scene with the right unit takes a quarter
LIMIT_S = 60  # for a busy machine; half a second where nothing else is to do
VERBS = ("check", "explain", "run")
MATERIAL = "material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}"
ALONE = f"time: {{end: 1 ms}}\nbodies: {{robot: {{mesh: {{gmsh: {{file: big.msh}}}}, {MATERIAL}}}}}\n"
# A hexahedron of 20 x 1 x 1.
BIG = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
8
1 0 0 0
2 20 0 0
3 20 1 0
4 0 1 0
5 0 0 1
6 20 0 1
7 20 1 1
8 0 1 1
$EndNodes
$Elements
1
1 5 2 0 1 1 2 3 4 5 6 7 8
$EndElements
"""


class OtherUnits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(testing.new_folder())
        cls.stl = cls.folder / "vessel.stl"  # 3 x 2 x 4 mm, in millimetres
        surfaces.write_stl(cls.stl, surfaces.block([5, 1, 2], [8, 3, 6]))
        cls.small = cls.folder / "metres.stl"
        surfaces.write_stl(cls.small, surfaces.block([5e-3, 1e-3, 2e-3], [8e-3, 3e-3, 6e-3]))
        cls.mesh = testing.ROOT / "tests/unit/mesh/two_cubes.msh"  # 2 x 1 x 1
        (cls.folder / "big.msh").write_text(BIG)
        (cls.folder / "alone.yaml").write_text(ALONE)

    def said(self, verb, settings, scene=testing.SMALL):
        words = [testing.BIN / "magfsi", verb, scene, *testing.overrides(settings)]
        if verb == "run":
            words += ["--out", Path(testing.new_folder()) / "run"]
        began = time.monotonic()
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS,
                                                                    (MEMORY_BYTES, MEMORY_BYTES)))
        self.assertLess(time.monotonic() - began, LIMIT_S)
        return done

    def refused(self, settings, *says, scene=testing.SMALL):
        for verb in VERBS:
            with self.subTest(verb=verb):
                done = self.said(verb, settings, scene)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                causes = [x for x in done.stderr.splitlines() if not x.startswith("warning: ")]
                self.assertEqual(len(causes), 1, done.stderr)
                for word in says:
                    self.assertIn(word, causes[0])

    def obstacle(self, file, unit=None):
        return {"fluid.obstacles": f"{{vessel: {{stl: {{file: {file}"
                f"{f', unit: {unit}' if unit else ''}}}}}}}"}

    def test_an_obstacle_in_millimetres(self):
        self.refused(self.obstacle(self.stl), "vessel.stl, which spans 3 x 2 x 4 m", "unit: 1 mm?")

    def test_an_obstacle_in_metres(self):
        self.refused(self.obstacle(self.small, "1 mm"), "metres.stl, which spans 3e-06", "unit: 1 m?")

    def test_a_body_of_cubes(self):
        self.refused({"bodies.robot.mesh": f"{{voxels: {{file: {self.stl}, spacing: 0.1 mm}}}}"},
                     "vessel.stl, 3 x 2 x 4 m large", "unit: 1 mm?")

    def test_a_mesh_in_a_fluid(self):
        self.refused({"bodies.robot.mesh": f"{{gmsh: {{file: {self.mesh}}}}}",
                      "probes.bodies": "[com]", "probes.points": "null"},
                     "two_cubes.msh, which spans 2 x 1 x 1 m", "unit: 1 mm?")

    def test_a_mesh_alone(self):
        self.refused({}, "big.msh, which spans 20 x 1 x 1 m", "unit: 1 mm?",
                     scene=self.folder / "alone.yaml")

    def test_the_right_unit_is_good(self):
        for settings in (self.obstacle(self.stl, "1 mm"), self.obstacle(self.small)):
            done = self.said("check", {**settings, "bodies.robot.initial.position":
                                       "[2.5 mm, 2 mm, 4 mm]"})
            self.assertEqual(done.returncode, 0, done.stderr)


class Explained(unittest.TestCase):
    """Of every file: extent, spacing, range of values, in SI; a warning where it does not fit."""

    def explained(self, unit, low, high, settings=None):
        folder = Path(testing.new_folder())
        rows = "".join(f"{x},{y},{z},0,0,{1 + x}\n" for x in (low, high) for y in (low, high)
                       for z in (low, high))
        (folder / "grid.csv").write_text(f"x[{unit}],y[{unit}],z[{unit}],Bx[mT],By[mT],Bz[mT]\n{rows}")
        (folder / "course.csv").write_text("t[ms],Bx[mT],By[mT],Bz[mT]\n0,0,0,1\n10,3,4,0\n")
        surfaces.write_stl(folder / "stone.stl", surfaces.block([6, 1, 2], [7, 2, 3]))
        scene = {"magnetic_field": f"{{vector_table: {{file: {folder}/course.csv}}, sources: "
                 f"{{g: {{grid: {{file: {folder}/grid.csv}}}}}}}}",
                 "fluid.obstacles": f"{{stone: {{stl: {{file: {folder}/stone.stl, unit: 1 mm}}}}}}"}
        words = [testing.BIN / "magfsi", "explain", testing.SMALL,
                 *testing.overrides({**scene, **(settings or {})})]
        return subprocess.run([str(word) for word in words], capture_output=True, text=True)

    def test_files(self):
        text = self.explained("mm", 0, 10).stdout
        for line in ("course.csv: field at 2 times, 0 s to 10 ms, |B| 1 mT to 5 mT",
                     "grid.csv: field at 2 x 2 x 2 points, x 0 m to 10 mm, y 0 m to 10 mm, z 0 m to "
                     "10 mm, spacing 10 mm x 10 mm x 10 mm, |B| 1 mT to 11 mT",
                     "stone.stl: surface of 12 triangles in 1 part, x 6 mm to 7 mm, y 1 mm to 2 mm, "
                     "z 2 mm to 3 mm, 1 mm3"):
            self.assertIn(line, text)
        self.assertNotIn("warning: the grid", text)
        self.assertNotIn("lies outside", text)

    def test_a_grid_in_another_unit(self):
        self.assertIn("times as long as body 'robot'; see that its lengths are in the right unit",
                      self.explained("m", 0, 10).stdout)
        done = self.explained("um", 0, 10)
        self.assertEqual(done.returncode, 2)
        self.assertIn("which reaches from 0 to 1e-05 m; take a larger grid, hold the body inside, or "
                      "see that the grid's lengths are in the right unit", done.stderr)

    def test_a_body_that_reaches_out_of_a_grid(self):
        """It lies at x from 2.25 mm on; the field is taken in the middles of its elements, from
        2.435 mm on."""
        self.assertIn("lies outside of the grid of the source 'g'",
                      self.explained("mm", 2.4, 10, {"bodies.robot.initial.position":
                                                     "[4.1 mm, 3.2 mm, 4 mm]"}).stdout)


if __name__ == "__main__":
    unittest.main()
