# SPDX-License-Identifier: GPL-2.0-or-later
"""Derivatives of shapes and of supports' forces by everything that a designer may choose, by the
adjoint method, against central differences of equilibria that Newton's method finds anew."""
import unittest
from dataclasses import replace

import numpy as np

from designs import folder_with
from magfsi import testing
from magfsi.design.program import Design, Program

# Central differences of the sixth order of steps of some 3 % have an error of 1e-9 to 1e-7; smaller
# steps raise the rounding of supports' forces, which balance each other in a body that bends little.
STEP, BOUND = 0.03, 1e-6
GRADIENT = "vector: [0 mT, 0 mT, 0 mT], gradient: {matrix: [[0.4 T/m, 0.1 T/m, 0 T/m], [0.1 T/m, 0.3 T/m, 0.2 T/m], " \
           "[0 T/m, 0.2 T/m, -0.7 T/m]]}"
SOURCE = "sources: {magnet: {cylinder: {diameter: 8 mm, height: 8 mm, axis: [0, 0, 1], " \
         "remanence: [0 T, 0 T, 1.2 T]}, position: [10 mm, 0 mm, 30 mm]}}"
BODY = """name: body
time: {{end: 1 s, equilibrium: {{method: newton}}}}
bodies:
  body:
    mesh: {mesh}
    {regions}
    material: {{shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
    magnetization: {{uniform: [1 kA/m, 0 A/m, 0 A/m]}}
    clamps: [{clamp}]
gravity: {{acceleration: 0.3 m/s2}}
{field}
"""
BLOCK = ("{box: {size: [10 mm, 2 mm, 0.5 mm], elements: [16, 3, 2]}}",
         "regions: {near: {box: [[0 mm, 0 mm, 0 mm], [4 mm, 2 mm, 1 mm]]}, "
         "far: {box: [[4 mm, 0 mm, 0 mm], [10 mm, 2 mm, 1 mm]]}}", "x_min")
GMSH = (f"{{gmsh: {{file: {testing.ROOT}/tests/validation/materials/two_halves.msh, unit: 1 mm}}}}", "",
        "root")
VOXELS = (f"{{voxels: {{file: {testing.ROOT}/docs/examples/scenes/tetrahedron.stl, unit: 1 mm, "
          "spacing: 0.2 mm, faces: {foot: {box: [[-9 mm, -9 mm, -9 mm], [9 mm, 9 mm, 0.2 mm]]}}}}",
          "regions: {low: {box: [[-9 mm, -9 mm, -9 mm], [9 mm, 9 mm, 0.6 mm]]}, "
          "high: {box: [[-9 mm, -9 mm, 0.6 mm], [9 mm, 9 mm, 9 mm]]}}", "foot")


def program_of(mesh, field=""):
    file, regions, clamp = mesh
    text = BODY.format(mesh=file, regions=regions, clamp=clamp,
                       field=f"magnetic_field: {{plane: xz, {field}}}" if field else "")
    return Program(folder_with(scene_yaml=text) / "scene.yaml")


class Gradient(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(3)

    def tearDown(self):
        self.program.close()

    def start(self, mesh, strength, field=""):
        """A body in a field of 20 mT with a smooth magnetisation of this strength [A/m]."""
        program = self.program = program_of(mesh, field)
        place = program.centres / np.ptp(program.rest, axis=0).max()
        wave = self.random.normal(size=(3, 3)) * 2
        m = strength * np.cos(place @ wave + self.random.normal(size=3))
        factors = np.array([0.8, 1.3, 1.1][:len(program.facts["regions"])])
        self.design = Design(m, np.array([0.008, 0.005, 0.018]), factors, factors[::-1].copy())
        risen = program.rise(self.design)
        self.assertTrue(risen.reached, f"followed to {risen.share}")
        self.x = risen.x
        bend = np.linalg.norm(self.x - program.rest, axis=1).max() / np.ptp(program.rest, axis=0).max()
        count = 4
        held = np.array(program.facts["held"])
        nodes = self.random.choice(np.flatnonzero(held == 0), (count, 6))
        entries = [(row, 3 * n + self.random.integers(3), self.random.normal(), 0)
                   for row, line in enumerate(nodes) for n in line]
        # Uneven weights, as the sum of all supports is that of the loads, which a uniform field
        # does not change.
        held = np.flatnonzero(held)
        entries += [(count, 3 * n + d, self.random.normal(), 1) for n in held for d in range(3)]
        entries += [(count + 1, 3 * held[0] + 2, 1.0, 1)]
        self.entries, self.rows = np.array(entries), count + 2
        return bend

    def values(self, design):
        """Functionals of the equilibrium that is followed from the present one."""
        found = self.program.move(self.x, self.design, design)
        self.assertTrue(found.reached)
        support = self.program.support(found.x, design).ravel()
        out = np.zeros(self.rows)
        flat = found.x.ravel()
        for row, coordinate, weight, of_support in self.entries:
            out[int(row)] += weight * (support if of_support else flat)[int(coordinate)]
        return out

    def compare(self, name, changed, expected):
        """changed(h): the design at a step h of one."""
        f = {k: self.values(changed(k * STEP)) for k in (-3, -2, -1, 1, 2, 3)}
        found = (45 * (f[1] - f[-1]) - 9 * (f[2] - f[-2]) + f[3] - f[-3]) / (60 * STEP)
        # Lengths and forces apart.
        scale = np.abs(found)
        for part in (scale[:4], scale[4:]):
            part[:] = np.maximum(part, 1e-3 * part.max())
        error = np.abs(found - expected) / scale
        testing.report(f"{self.id().split('.')[-1]}, {name}: {error.max():.1e}")
        self.assertLess(error.max(), BOUND, f"{name}: {found} {expected}")

    def check(self):
        by_m, by_b, by_s, by_t = self.program.sensitivity(self.x, self.design, self.entries, self.rows)
        d = self.design
        way = self.random.normal(size=d.magnetization.shape) * np.abs(d.magnetization).max()
        self.compare("magnetisation", lambda h: replace(d, magnetization=d.magnetization + h * way),
                     np.einsum("rei,ei->r", by_m, way))
        way_b = np.array([0.006, -0.01, 0.012])
        self.compare("field", lambda h: replace(d, field=d.field + h * way_b), by_b @ way_b)
        way_s = 0.4 * self.random.normal(size=len(d.stiffness))
        self.compare("stiffness", lambda h: replace(d, stiffness=d.stiffness + h * way_s), by_s @ way_s)
        way_t = 0.2 * way_s
        self.compare("thickness", lambda h: replace(d, thickness=d.thickness + h * way_t), by_t @ way_t)

    def both(self, mesh, weak, strong, field=""):
        self.assertLess(self.start(mesh, weak, field), 0.1)
        self.check()
        self.program.close()
        self.assertGreater(self.start(mesh, strong, field), 0.2)
        self.check()

    def test_block(self):
        self.both(BLOCK, 2e2, 4e4)

    def test_block_in_a_gradient(self):
        self.both(BLOCK, 2e2, 4e4, GRADIENT)

    def test_block_with_a_magnet(self):
        self.both(BLOCK, 2e2, 4e4, SOURCE)

    def test_gmsh(self):
        self.both(GMSH, 1e3, 8e4)

    def test_voxels(self):
        self.start(VOXELS, 1e4)
        self.check()
        self.program.close()
        self.start(VOXELS, 2e5)
        self.check()


if __name__ == "__main__":
    unittest.main()
