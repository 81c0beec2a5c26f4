# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run refuses because of the mesh or the material, check refuses in the same words; and
what check calls good starts."""

import re
import subprocess
import unittest
from pathlib import Path

from magfsi import surfaces, testing

SCENE = """
name: strict
time: {end: 1 s, equilibrium: {method: newton}}
bodies:
  b:
    mesh: {gmsh: {file: MESH, unit: 1 mm}}
    element: assumed_strain
    material: {shear_modulus: 330 kPa, lame_lambda: 6.6 MPa, density: 1860 kg/m3}
    clamps: [left]
gravity: {acceleration: 1 m/s2}
probes: {every: 1 s, bodies: [max_displacement]}
"""
STREAM = """
time: {end: 1 s}
fluid:
  box: [8 mm, 4 mm, 4 mm]
  spacing: 0.5 mm
  density: 1000 kg/m3
  viscosity: 4 mm2/s
  expected_speed: 0.2 m/s
  boundaries:
    x_min: {velocity_inlet: {velocity: [0.1 m/s, 0 m/s, 0 m/s], ramp: RAMP}}
    x_max: {pressure_outlet: {}}
probes: {every: 100 ms, fluid: [mass]}
"""
AT = "{tip: {body: b, at: [40 mm, 0 mm, 0 mm]}}"


def bars(lengths, gap):
    """Gmsh file of bars of 2 x 2 cubes one behind the other, the first one's left a face."""
    nodes, cubes, left = [], [], []
    start = 0
    for length in lengths:
        first = len(nodes) + 1
        nodes += [(start + i, j, k) for k in range(3) for j in range(3)
                  for i in range(length + 1)]
        at = lambda i, j, k: first + i + (length + 1) * (j + 3 * k)
        for k in range(2):
            for j in range(2):
                left += [(at(0, j, k), at(0, j + 1, k), at(0, j + 1, k + 1),
                          at(0, j, k + 1))] if start == 0 else []
                cubes += [tuple(at(i + di, j + dj, k + dk) for dk in (0, 1)
                                for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)))
                          for i in range(length)]
        start += length + gap
    elements = [f"3 2 2 2 {' '.join(map(str, q))}" for q in left]
    elements += [f"5 2 1 1 {' '.join(map(str, q))}" for q in cubes]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '3 1 "bar"',
             '2 2 "left"', "$EndPhysicalNames", "$Nodes", len(nodes)]
    lines += [f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(nodes, 1)]
    lines += ["$EndNodes", "$Elements", len(elements)]
    lines += [f"{i} {element}" for i, element in enumerate(elements, 1)]
    return "\n".join(map(str, lines + ["$EndElements", ""]))


def outcome(command, mesh, settings):
    folder = Path(testing.new_folder())
    folder.mkdir(exist_ok=True)
    (folder / "body.msh").write_text(mesh)
    (folder / "scene.yaml").write_text(SCENE.replace("MESH", str(folder / "body.msh")))
    words = [testing.BIN / "magfsi", command, folder / "scene.yaml"]
    words += ["--out", folder / "run"] if command == "run" else []
    done = subprocess.run(list(map(str, words + testing.overrides(settings))),
                          capture_output=True, text=True, timeout=120, check=False)
    return done.returncode, done.stdout + done.stderr


class CheckAndRun(unittest.TestCase):
    def refused(self, words, settings, lengths=(6,)):
        for command in ("check", "run"):
            code, text = outcome(command, bars(lengths, 1), settings)
            self.assertEqual(code, 2, f"{command}: {text}")
            self.assertIn(words, text, command)

    def test_a_clamp_that_the_mesh_lacks(self):
        self.refused("body b is clamped at lef, but its faces are left",
                     {"bodies.b.clamps": "[lef]"})

    def test_loose_parts(self):
        for method in ("newton", "dynamics"):
            # The second bar begins at 7 mm.
            self.refused("body b is in 2 parts that share no node, and the part with the "
                         "element at (0.0075, 0.0005, 0.0005) m is not held",
                         {"time.equilibrium.method": method}, (6, 5))

    def test_weight_that_nothing_holds(self):
        self.refused("body b has weight but no clamp", {"bodies.b.clamps": ""})

    def test_a_point_outside_the_mesh(self):
        self.refused("lies in no element", {"probes.points": AT})

    def test_no_lame_lambda_is_a_material(self):
        sag = {}
        for k in ("0 Pa", "1 Pa"):
            settings = {"bodies.b.material.lame_lambda": k}
            self.assertEqual(outcome("check", bars((6,), 1), settings)[0], 0)
            code, text = outcome("run", bars((6,), 1), settings)
            self.assertEqual(code, 0, text)
            run = Path(re.search(r"results in (\S+)", text).group(1))
            sag[k] = float((run / "probes.csv").read_text().split()[-1].split(",")[1])
        # lambda / G = 3e-6 changes Young's modulus by a third of that.
        self.assertAlmostEqual(sag["0 Pa"] / sag["1 Pa"], 1, delta=1e-5)


PLATE = ("{mesh: {box: {size: [1 mm, 1 mm, 0.5 mm], elements: [3, 3, 2]}}, material: {shear_modulus: 33 kPa, "
         "lame_lambda: 660 kPa, density: 1860 kg/m3}, initial: {position: [4.1 mm, 2 mm, 4 mm]}}")
INLET = {"fluid.boundaries.x_min": "{velocity_inlet: {velocity: [1 mm/s, 0 m/s, 0 m/s]}}",
         "fluid.boundaries.x_max": "pressure_outlet"}


def controlled(script):
    file = Path(testing.new_folder()).with_suffix(".py")
    file.write_text(script)
    return {"control": f"{{script: {file}, every: 0.1 ms}}"}


BALL = "sphere: {centre: [6 mm, 1 mm, 2 mm], diameter: 1 mm}"
# In the fluid of the small swimmer.
EVERY = 1  # of what is refused in a fluid
IN_A_FLUID = {
    "an obstacle given twice": ({"fluid.obstacles": f"{{a: {{{BALL}}}, b: {{{BALL}}}}}"}, '"b"'),
    "an obstacle too thin for a cell": ({"fluid.obstacles": "{a: {box: [[6 mm, 1 mm, 2 mm], "
                                         "[7 mm, 2 mm, 2.01 mm]]}}"}, '"a"'),
    "an obstacle outside of the box": ({"fluid.obstacles": "{a: {sphere: {centre: [20 mm, 1 mm, 2 mm], "
                                        "diameter: 1 mm}}}"}, "outside"),
    "a shape of a body without a centre line": ({"bodies.robot.mesh": "{gmsh: {file: MESH, unit: 0.5 mm}}",
                                                 "probes.points": "null"}, "whose centre line has 0 points"),
    "a shape of too few elements": ({"bodies.robot.mesh.box.elements": "[2, 4, 1]"},
                                    "whose centre line has 3 points"),
    "a shape of cubes": ({"bodies.robot.mesh": "{voxels: {file: CUBE, unit: 1 mm, spacing: 0.25 mm}}",
                          "probes.points": "null"}, "whose centre line has 0 points"),
    "a shape of a ring": ({"bodies.robot.mesh": "{arc: {radius: 0.8 mm, angle: 360 deg, "
                           "section: [0.4 mm, 0.3 mm], elements: [16, 2, 2]}}", "probes.points": "null"}, "closed"),
    "two bodies in one place": ({"bodies.second": PLATE}, "passes through"),
    "two bodies in one place with contact": ({"bodies.second": PLATE, "contact": "{}"}, "passes through"),
    "a patch around a part of the body": ({"fluid.refinement": "{levels: 1, box: [[3 mm, 1 mm, 3 mm], "
                                           "[5 mm, 3 mm, 5 mm]]}"}, "come to the sides of the refined patch"),
    "an inlet behind an obstacle": ({**INLET, "fluid.obstacles": "{a: {box: [[-1 mm, -1 mm, -1 mm], "
                                     "[0.5 mm, 5 mm, 9 mm]]}}"}, "lies behind fluid.obstacles"),
    "a controller with a fault of syntax": (controlled("class Controller:\n    def step(self, time probes):\n"
                                                       "        return 0, 0, 0\n"), ":2: "),
    "a controller without its class": (controlled("x = 1\n"), "no class Controller"),
    "a controller of two arguments": (controlled("class Controller:\n    def step(self, time):\n"
                                                 "        return 0, 0, 0\n"), "step takes 2 arguments"),
}


class InAFluid(unittest.TestCase):
    def test_check_refuses_in_the_words_of_run(self):
        folder = Path(testing.new_folder())
        surfaces.write_stl(folder / "cube.stl", surfaces.block([0, 0, 0], [1, 1, 1]))
        for name, (settings, words) in list(IN_A_FLUID.items())[::EVERY]:
            with self.subTest(name):
                sets = [word.replace("MESH", str(testing.ROOT / "tests/unit/mesh/two_cubes.msh"))
                        .replace("CUBE", str(folder / "cube.stl"))
                        for word in testing.overrides(settings)]
                said = []
                for command in ("check", "explain", "run"):
                    more = ["--out", folder / "run"] if command == "run" else []
                    done = subprocess.run(list(map(str, [testing.BIN / "magfsi", command, testing.SMALL,
                                                         *more, *sets])),
                                          capture_output=True, text=True, timeout=120, check=False)
                    self.assertEqual(done.returncode, 2, f"{command}: {done.stdout}{done.stderr}")
                    said.append(done.stderr.strip().splitlines()[-1])
                self.assertIn(words, said[0])
                self.assertEqual(len(set(said)), 1, said)


class Seen(unittest.TestCase):
    """What is not wrong, but perhaps not meant, check and explain tell."""

    def test_parts_of_a_surface_planes_and_flow(self):
        folder = Path(testing.new_folder())
        folder.mkdir(exist_ok=True)
        surfaces.write_stl(folder / "two.stl", surfaces.block([6, 1, 1], [7, 2, 2])
                           + surfaces.block([6, 1, 6], [7, 3, 7]))
        settings = {**INLET, "fluid.obstacles": f"{{two: {{stl: {{file: {folder}/two.stl, unit: 1 mm}}}}, "
                    "wall: {box: [[-1 mm, -1 mm, -1 mm], [1 mm, 5 mm, 2 mm]]}}",
                    "probes.integrals": "{p: {plane: {axis: z, at: 6.5 mm}}}"}
        text = subprocess.run(list(map(str, [testing.BIN / "magfsi", "check", testing.SMALL,
                                             *testing.overrides(settings)])),
                              capture_output=True, text=True, check=True).stdout
        self.assertIn("surface of 24 triangles in 2 parts", text)
        self.assertNotIn("the plane of", text)
        settings["fluid.obstacles"] = "{all: {box: [[-1 mm, -1 mm, 6 mm], [9 mm, 5 mm, 7 mm]]}}"
        text = subprocess.run(list(map(str, [testing.BIN / "magfsi", "explain", testing.SMALL,
                                             *testing.overrides(settings)])),
                              capture_output=True, text=True, check=True).stdout
        self.assertIn("warning: the plane of probes.integrals.p lies within obstacles", text)
        self.assertIn("obstacles keep 12.5 % off", text)  # one of eight millimetres


class Inlets(unittest.TestCase):
    """A ramp as short as sound takes to cross the box makes the flow overshoot: explain says so,
    and the ramp that it names is not warned of."""

    def warned(self, ramp, *more):
        folder = Path(testing.new_folder())
        (folder / "scene.yaml").write_text(STREAM.replace("RAMP", ramp))
        text = subprocess.run([str(testing.BIN / "magfsi"), "explain", str(folder / "scene.yaml"), *more],
                              capture_output=True, text=True, check=True).stdout
        line, = (x for x in text.splitlines() if "sound crosses the box in" in x)
        return line

    def test_ramps(self):
        crossing = float(re.search(r"in ([\d.e+-]+) ms", self.warned("0 ms"))[1])
        advice = r"overshoots, and forces with it: a ramp of ([\d.]+) ms"
        for ramp, starts in (("0 ms", "the flow starts at once"), (f"{crossing} ms", "of the ramp")):
            line = self.warned(ramp)
            self.assertIn(starts, line)
            self.assertRegex(line, advice)
        enough = float(re.search(advice, line)[1])
        self.assertGreater(enough, 5 * crossing)
        self.assertNotIn("overshoots", self.warned(f"{1.01 * enough} ms"))
        self.assertIn("overshoots", self.warned(f"{0.9 * enough} ms"))

    def test_courses(self):
        crossing = float(re.search(r"in ([\d.e+-]+) ms", self.warned("0 ms"))[1])
        for times, overshoots in ((1, True), (20, False)):
            end = times * crossing
            for course in (f"{{table: {{time: [0 s, {end} ms], factor: [0, 1]}}}}",
                           f"{{formula: 1-exp(-t/({end} ms))}}"):
                line = self.warned("0 ms", "--set", "fluid.boundaries.x_min.velocity_inlet.course=" + course)
                self.assertEqual("overshoots" in line, overshoots, line)


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
