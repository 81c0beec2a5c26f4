# SPDX-License-Identifier: GPL-2.0-or-later
"""A robot meshed from the closed surface of an STL file bends as one of a box of the same shape; one
whose surface the cubes can only step along comes near with the square of the number of cubes across."""

import math
import re
import unittest
from pathlib import Path

from magfsi import surfaces, testing

SIZE_MM, EDGE_MM = (6, 1.5, 0.75), 0.375
SHEAR_PA, LAME_PA, DENSITY, GRAVITY = 33e3, 660e3, 1860, 0.05
SCENE = """
name: cantilever
time: {end: 1 s, equilibrium: {}}
bodies:
  bar:
    mesh: {MESH}
    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}
    HELD
gravity: {acceleration: ACCELERATION m/s2, direction: [0, SIDE, DOWN]}
probes: {every: 1 s, bodies: [max_displacement]}
"""
FLOATS = """
name: floats
time: {end: 10 ms}
bodies:
  bar:
    mesh: {MESH}
    material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1000 kg/m3}
    initial: {position: [1.2 mm, 1.2 mm, 1.2 mm]}
gravity: {acceleration: 9.81 m/s2, direction: [0, 0, -1]}
fluid: {box: [2.4 mm, 2.4 mm, 2.4 mm], spacing: 0.1 mm, density: 1000 kg/m3, viscosity: 1 mm2/s, expected_speed: 0.02 m/s}
probes: {every: 1 ms, bodies: [speed]}
"""


def block(size, low=(0, 0, 0)):
    return surfaces.block(low, [x + edge for x, edge in zip(low, size)])


def rolled(triangles, angle):
    """Turned about x."""
    c, s = math.cos(angle), math.sin(angle)
    return [[(x, c * y - s * z, s * y + c * z) for x, y, z in t] for t in triangles]


def rod(length, diameter, sides=64):
    ring = [(0.5 * diameter * math.cos(2 * math.pi * i / sides),
             0.5 * diameter * math.sin(2 * math.pi * i / sides)) for i in range(sides)]
    triangles = []
    for i, (a, b) in enumerate(zip(ring, ring[1:] + ring[:1])):
        p, q = (0, *a), (0, *b)
        r, s = (length, *a), (length, *b)
        triangles += [[p, r, s], [p, s, q], [(0, 0, 0), p, q], [(length, 0, 0), s, r]]
    return triangles


class Voxels(unittest.TestCase):
    def setUp(self):
        self.folder = Path(testing.new_folder())

    def run_with(self, mesh, run=testing.good_run, gravity=9.81, angle=0.0, held="clamps: [x_min]"):
        scene = self.folder / "scene.yaml"
        scene.write_text(SCENE.replace("MESH", mesh).replace("ACCELERATION", f"{gravity}").replace("HELD", held)
                         .replace("SIDE", f"{math.sin(angle)}").replace("DOWN", f"{-math.cos(angle)}"))
        return run(scene)

    def bend(self, mesh, **loads):
        return self.run_with(mesh, **loads).probes()["bar.max_displacement[m]"][-1]

    def from_file(self, triangles, spacing, unit="1 mm"):
        surfaces.write_stl(self.folder / "robot.stl", triangles)
        return f"voxels: {{file: robot.stl, spacing: {spacing}, unit: {unit}}}"

    def test_bends_as_the_box(self):
        def of_box(*elements):
            return self.bend("box: {size: [%g mm, %g mm, %g mm], elements: %s}"
                             % (*SIZE_MM, list(elements)))

        box = of_box(*(round(s / EDGE_MM) for s in SIZE_MM))
        # Anywhere in its file's frame, in millimetres.
        shape = block(SIZE_MM, (-3.1, 7, 0.123))
        same = self.bend(self.from_file(shape, "0.375 mm"))
        cubes, flat = self.bend(self.from_file(shape, "0.1875 mm")), of_box(24, 6, 4)
        testing.report(f"bends by {1e3 * box:.6f} mm, from the file {1e3 * same:.6f}; by cubes half as "
                       f"large {1e3 * cubes:.6f}, a box of flatter elements {1e3 * flat:.6f}")
        # Places of a file in float: 1e-7 of its size, and the bend goes with the length's fourth
        # power.
        self.assertAlmostEqual(same / box, 1, delta=1e-5)
        self.assertAlmostEqual(cubes / flat, 1, delta=0.01)

    def check_errors(self, name, bends, exact_m, share):
        """Bends by the number n of cubes across: right within this share of 1 / n^2."""
        for across, bend_m in bends.items():
            error = bend_m / exact_m - 1
            testing.report(f"{name}, {across} cubes across: {100 * error:+.2f} %")
            self.assertLess(abs(error), share / across**2)

    def test_a_box_rolled_against_its_cubes(self):
        """Its sides are steps, of cubes that have a part of the material: their second moment of area is off by
        some cubes' at the rim, n^2 / 4 of n^4 / 12 for n cubes across, of either sign."""
        shape, angle = rolled(block(SIZE_MM), math.radians(30)), math.radians(30)
        coarse, fine = (self.bend("box: {size: [6 mm, 1.5 mm, 0.75 mm], elements: %s}" % elements, gravity=GRAVITY)
                        for elements in ("[24, 6, 4]", "[48, 12, 8]"))
        bends = {n: self.bend(self.from_file(shape, f"{SIZE_MM[2] / n} mm"), gravity=GRAVITY, angle=angle)
                 for n in (4, 5, 6, 8)}
        # Bricks' errors fall with the square of their edges. Seen: +0.8, +2.5, +0.4, -0.4 %; the second
        # moments alone +0.7, +2.8, +1.8, -0.6 %.
        self.check_errors("rolled by 30 degrees", bends, fine + (fine - coarse) / 3, 0.65)

    def test_a_round_rod(self):
        """Against a slender beam with Cowper's shear coefficient (J. Appl. Mech. 33 (1966) 335) under its
        weight. Its foot may narrow, as that of the beam: a clamped one makes the bend 2.4 % less."""
        length, diameter = 8, 1
        young = SHEAR_PA * (3 * LAME_PA + 2 * SHEAR_PA) / (LAME_PA + SHEAR_PA)
        nu = LAME_PA / (2 * (LAME_PA + SHEAR_PA))
        area, second = math.pi / 4 * (1e-3 * diameter)**2, math.pi / 64 * (1e-3 * diameter)**4
        load, span = DENSITY * GRAVITY * area, 1e-3 * length
        shear = 6 * (1 + nu) / (7 + 6 * nu)
        exact = load * span**4 / (8 * young * second) + load * span**2 / (2 * shear * SHEAR_PA * area)
        faces = ", faces: {level: {box: [[0 mm, -1 mm, 0 mm], [0 mm, 1 mm, 0 mm]]}, " \
            "upright: {box: [[0 mm, 0 mm, -1 mm], [0 mm, 0 mm, 1 mm]]}}}"
        held = "rollers: [{face: x_min, axis: x}, {face: level, axis: z}, {face: upright, axis: y}]"
        bends = {n: self.bend(self.from_file(rod(length, diameter), f"{diameter / n} mm")[:-1] + faces,
                              gravity=GRAVITY, held=held)
                 for n in (4, 6, 8, 10, 12)}
        # Seen: -0.8, -4.3, -1.0, -0.1, +0.7 %, and 0.0 % at 16. Second moments alone: -1.5, -5.0, -1.7,
        # -0.6, 0.0, -0.6 %.
        self.check_errors("round rod", bends, exact, 1.6)

    def test_parts_by_shapes(self):
        """A box of cubes with a stiff and heavy half, against the block that it is; the parts are named by the
        same shapes."""
        parts = ("regions: {stiff: {box: [[%g mm, -9 mm, -9 mm], [99 mm, 9 mm, 9 mm]]}}\n"
                 "    material_regions: [{region: stiff, shear_modulus: 330 kPa, lame_lambda: 6.6 MPa, "
                 "density: 3720 kg/m3}]\n    clamps: [x_min]")
        half = round(SIZE_MM[0] / EDGE_MM / 2) * EDGE_MM
        box = self.bend("box: {size: [%g mm, %g mm, %g mm], elements: %s}"
                        % (*SIZE_MM, [round(s / EDGE_MM) for s in SIZE_MM]), held=parts % half)
        cubes = self.bend(self.from_file(block(SIZE_MM), "0.375 mm"), held=parts % half)
        plain = self.bend(self.from_file(block(SIZE_MM), "0.375 mm"))
        testing.report(f"bends by {1e3 * box:.6f} mm, cubes {1e3 * cubes:.6f}, of one material "
                       f"{1e3 * plain:.6f}")
        self.assertAlmostEqual(cubes / box, 1, delta=1e-5)  # as test_bends_as_the_box
        self.assertGreater(abs(cubes / plain - 1), 0.1)

    def rolled_block(self):
        """Its size [mm], and a scene in which it floats."""
        size = (1.2, 0.8, 0.5)
        scene = self.folder / "scene.yaml"
        mesh = self.from_file(rolled(block(size), math.radians(30)), "0.13 mm")
        scene.write_text(FLOATS.replace("MESH", mesh))
        return size, scene

    def test_mass_and_volume_are_the_surfaces(self):
        """Whatever the volume of the cubes: 9.8 % too large here."""
        size, scene = self.rolled_block()
        text = testing.output_of(testing.BIN / "magfsi", "explain", scene)
        mass = float(re.search(r"mass (\S+) mg", text)[1])
        cubes, weighed = map(float, re.search(r"surface's: (\S+) %, weighed by what they hold of it: (\S+) %",
                                              text).groups())
        testing.report(f"mass {mass} mg of {math.prod(size)}; cubes {cubes} % too many, weighed {weighed} %")
        self.assertGreater(abs(cubes), 5)
        # Well below one sixteenth of a cube, of 218 cubes.
        self.assertLess(abs(weighed), 100 / 16 / 218)
        self.assertAlmostEqual(mass / math.prod(size), 1, delta=1 / 16 / 218 + 5e-4)  # four digits

    def test_it_floats_in_its_own_volume(self):
        """As heavy as water, it stays where it is: buoyancy is that of the same volume."""
        _, scene = self.rolled_block()

        def sinks(density):
            return -testing.good_run(scene, {"bodies.bar.material.density": f"{density} kg/m3"},
                                     ranks="structure=1,fluid=1").probes()["bar.speed_z[m/s]"][-1]

        floating, heavier = sinks(1000), sinks(1050)
        testing.report(f"speed of fall {1e6 * floating:.2f} um/s, 5 % heavier {1e6 * heavier:.1f}")
        # As heavy as what rounding leaves over, of 5 %.
        self.assertLess(abs(floating), 2 * heavier / 16 / 218 / 0.05)

    def test_a_named_face(self):
        """Held by the lower half of its length it is a bar of half the length: a sixteenth of the bend."""
        whole = self.bend(self.from_file(block(SIZE_MM), "0.25 mm"), gravity=GRAVITY)
        mesh = self.from_file(block(SIZE_MM, (1, 1, 1)), "0.25 mm")[:-1]
        held = mesh + ", faces: {root: {box: [[1 mm, 1 mm, 1 mm], [4 mm, 2.5 mm, 1.75 mm]]}}}"
        scene = self.folder / "scene.yaml"
        scene.write_text(SCENE.replace("MESH", held).replace("ACCELERATION", f"{GRAVITY}")
                         .replace("SIDE", "0").replace("DOWN", "-1").replace("HELD", "clamps: [root]"))
        half = testing.good_run(scene).probes()["bar.max_displacement[m]"][-1]
        testing.report(f"half the length bends by 1 / {whole / half:.1f} of the whole")
        # The clamp's own give and shear count for more in the shorter one.
        self.assertAlmostEqual(half / whole, 1 / 16, delta=0.2 / 16)
        refused = self.folder / "refused.yaml"
        refused.write_text(scene.read_text().replace("[1 mm, 1 mm, 1 mm]", "[3.9 mm, 5 mm, 1 mm]")
                           .replace("[4 mm, 2.5 mm", "[4 mm, 6 mm"))
        testing.check_refused(self, testing.run(refused), "holds no node")

    def test_refusals(self):
        cubes = block((1, 1, 1))
        for triangles, spacing, unit, word in (
                (block(SIZE_MM), "0.375 mm", "1 m", "more than"),
                (cubes + block((1, 1, 1), (3, 0, 0)), "0.5 mm", "1 mm", "2 parts that no face joins"),
                (cubes + block((1, 1, 1), (1, 1, 0)), "0.5 mm", "1 mm", "2 parts that no face joins"),
                (cubes[:-1], "0.5 mm", "1 mm", "closed")):
            run = self.run_with(self.from_file(triangles, spacing, unit), testing.run)
            testing.check_refused(self, run, word)
            self.assertIn("scene.yaml:6:", run.err)


if __name__ == "__main__":
    testing.main()
