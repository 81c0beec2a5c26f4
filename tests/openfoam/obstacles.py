# SPDX-License-Identifier: GPL-2.0-or-later
"""Obstacles with OpenFOAM, body-fitted: drag against a benchmark, against a mesh made apart from
ours, against the balance of momentum and against the lattice; restart and stock programs."""

import unittest
from pathlib import Path

import stock_case
from magfsi import testing

# Schaefer and Turek's flow 2D-1 (1996): a cylinder in a channel at Reynolds number 20. Drag
# coefficient 5.5795 and lift coefficient 0.010619 by Nabh's spectral elements (1998).
CYLINDER = """
name: cylinder
time: {end: 4 s, step: 10 ms}
fluid:
  solver: openfoam
  box: [2.2 m, 0.02 m, 0.41 m]
  spacing: 10 mm
  density: 1 kg/m3
  viscosity: 1e-3 m2/s
  boundaries:
    x_min: {velocity_inlet: {velocity: [0.2 m/s, 0 m/s, 0 m/s], profile: parabolic}}
    x_max: pressure_outlet
    y_min: periodic
    y_max: periodic
  initial_velocity: [0.2 m/s, 0 m/s, 0 m/s]
  obstacles: {rod: {cylinder: {centre: [0.2 m, 0 m, 0.2 m], diameter: 0.1 m, axis: y}}}
probes: {every: 0.5 s, fluid: [obstacle_force, max_speed]}
"""
# The flap of a duct, as in a steady body-fitted mesh made by hand for simpleFoam: 51.6 uN at
# 0.1 mm, 52.3 at 0.067 mm.
FLAP = """
name: flap
time: {end: 120 ms, step: 0.5 ms}
fluid:
  solver: openfoam
  box: [10 mm, 4 mm, 4 mm]
  spacing: 0.2 mm
  density: 1000 kg/m3
  viscosity: 4 mm2/s
  boundaries:
    x_min: {velocity_inlet: {velocity: [60 mm/s, 0 m/s, 0 m/s], profile: parabolic, ramp: 20 ms}}
    x_max: pressure_outlet
  obstacles: {flap: {box: [[3 mm, 1 mm, 0 m], [3.4 mm, 3 mm, 2 mm]]}}
probes: {every: 20 ms, fluid: [obstacle_force, kinetic_energy]}
"""
# Bodies of all kinds in a duct that is a plane of symmetry all around.
BODIES = """
name: bodies
time: {end: 60 ms, step: 1 ms}
fluid:
  solver: openfoam
  box: [8 mm, 4 mm, 4 mm]
  spacing: 0.25 mm
  density: 1000 kg/m3
  viscosity: 10 mm2/s
  expected_speed: 60 mm/s
  boundaries:
    x_min: {velocity_inlet: {velocity: [20 mm/s, 0 m/s, 0 m/s]}}
    x_max: pressure_outlet
    y_min: free_slip
    y_max: free_slip
    z_min: free_slip
    z_max: free_slip
  initial_velocity: [20 mm/s, 0 m/s, 0 m/s]
  obstacles: OBSTACLES
probes:
  every: 30 ms
  fluid: [obstacle_force, kinetic_energy, mass]
  integrals:
    before: {plane: {axis: x, at: 0.5 mm}}
    behind: {plane: {axis: x, at: 7.5 mm}}
"""
SHAPES = {
    "ball": "{ball: {sphere: {centre: [3 mm, 2 mm, 2 mm], diameter: 2 mm}}}",
    "rod": "{rod: {cylinder: {centre: [3 mm, 2 mm, 2 mm], diameter: 1.5 mm, axis: y}}}",
    "box": "{box: {box: [[2.5 mm, 1 mm, 1 mm], [3.5 mm, 3 mm, 3 mm]]}}",
    "off the planes": "{box: {box: [[2.4 mm, 1.1 mm, 1.1 mm], [3.4 mm, 3.1 mm, 3.1 mm]]}}",
    "stl": "{stl: {stl: {file: octahedron.stl, unit: 1 mm, shift: [3 mm, 2 mm, 2 mm]}}}",
    "two": "{box: {box: [[2 mm, 0 m, 0 m], [2.5 mm, 4 mm, 1 mm]]}, "
           "ball: {sphere: {centre: [5 mm, 2 mm, 2 mm], diameter: 2 mm}}}",
}


def write(text, folder):
    file = Path(folder) / "scene.yaml"
    file.write_text(text)
    return file


def octahedron(file, radius=1.2):
    ends = (radius, -radius)
    facets = []
    for i, x in enumerate(ends):
        for j, y in enumerate(ends):
            for k, z in enumerate(ends):
                a, b, c = (x, 0, 0), (0, y, 0), (0, 0, z)
                facets.append((a, c, b) if (i + j + k) % 2 else (a, b, c))
    file.write_text("solid o\n" + "".join(
        "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {a} {b} {c}\n" for a, b, c in f) +
        "endloop\nendfacet\n" for f in facets) + "endsolid o\n")


class Benchmarks(unittest.TestCase):
    def test_a_cylinder_in_a_channel(self):
        probes = testing.good_run(write(CYLINDER, testing.new_folder())).probes()
        unit = 0.5 * 1 * 0.2**2 * 0.1 * 0.02  # 1/2 rho U^2 D W
        drag = probes["rod.drag[N]"][-1] / unit
        testing.report(f"drag coefficient {drag:.3f}, {drag / 5.5795 - 1:+.1%}; lift "
                       f"{probes['rod.lift[N]'][-1] / unit:.4f}")
        # Ten cells over the diameter, of second order: one over 10^2, times some 5.
        self.assertAlmostEqual(drag / 5.5795, 1, delta=0.05)

    def test_a_flap_in_a_duct(self):
        run = testing.good_run(write(FLAP, testing.new_folder()))
        force = run.probes()["flap.force_x[N]"]
        testing.report(f"flap: {force[-1] * 1e6:.2f} uN")
        self.assertAlmostEqual(force[-1] / force[-2], 1, delta=0.01)  # steady
        # Two cells in the thickness; the mesh made apart has four and still 1 % of error.
        self.assertAlmostEqual(force[-1] / 51.6e-6, 1, delta=0.05)


class Bodies(unittest.TestCase):
    def run_of(self, name, settings=None, **more):
        folder = Path(testing.new_folder())
        octahedron(folder / "octahedron.stl")
        scene = write(BODIES.replace("OBSTACLES", SHAPES[name]), folder)
        return testing.good_run(scene, settings, **more)

    def test_the_force_is_what_the_flow_loses(self):
        for name in SHAPES:
            with self.subTest(name):
                p = self.run_of(name).probes()
                lost = [p["before." + key][-1] - p["behind." + key][-1]
                        for key in ("momentum_flux_x[N]", "pressure[Pa]")]
                balance = lost[0] + lost[1] * 16e-6
                force = sum(values[-1] for key, values in p.items() if key.endswith(".force_x[N]"))
                testing.report(f"{name}: force {force * 1e6:.3f} uN, "
                               f"balance {force / balance - 1:+.2%}")
                # By continuity, to the tolerance of the pressure on a mesh with oblique faces.
                flow = p["before.flow[m3/s]"][-1]
                self.assertAlmostEqual(flow / (20e-3 * 16e-6), 1, delta=1e-4)
                # The planes' own sums are of second order at 8 cells to a body, and the last
                # unsteadiness of the flow between them is in it.
                self.assertAlmostEqual(force / balance, 1, delta=0.02)

    def test_the_lattice_says_the_same(self):
        """At 16 cells to a body. From 8 to 16 OpenFOAM's force on the ball grows by 8.6 %, so that
        3 % are left by its order two, the lattice's by 0.5 %; at the box's sharp edges OpenFOAM's
        by 7 %, the lattice's by 14 %, and the rest is of first order."""
        for name, bound in (("ball", 0.05), ("rod", 0.05), ("box", 0.08)):
            with self.subTest(name):
                forces = []
                for settings in ({"time.step": "0.5 ms"},
                                 {"fluid.solver": "lbm", "time.step": "null"}):
                    run = self.run_of(name, {"fluid.spacing": "0.125 mm", **settings})
                    forces.append(run.probes()[f"{name}.drag[N]"][-1])
                testing.report(f"{name}: openfoam / lbm - 1 = {forces[0] / forces[1] - 1:+.1%}")
                self.assertAlmostEqual(forces[0] / forces[1], 1, delta=bound)

    def test_a_restart_gives_the_same_bytes(self):
        scene = write(BODIES.replace("OBSTACLES", SHAPES["two"]), testing.new_folder())
        whole = testing.good_run(scene, {"checkpoint.every": "30 ms"})
        half = testing.good_run(scene, {"time.end": "30 ms", "checkpoint.every": "30 ms"})
        testing.good_run(scene, {"checkpoint.every": "30 ms"}, folder=half.folder, restart="latest")
        a, b = ((run.folder / "probes.csv").read_text() for run in (half, whole))
        self.assertEqual(a, b)

    def test_a_body_swims_beside_an_obstacle(self):
        run = testing.good_run(testing.SMALL, {
            "fluid.solver": "openfoam", "time.end": "1 ms", "probes.interface_balance": "true",
            "fluid.obstacles": "{step: {box: [[0 m, 0 m, 0 m], [2 mm, 4 mm, 1 mm]]}}"},
            "structure=1,fluid=1")
        self.assertGreater(run.probes()["kinetic_energy[J]"][-1], 0)
        testing.check_interface_balance(self, run, "beside an obstacle")

    def test_stock_programs_run_the_case(self):
        run = self.run_of("ball", {"fluid.openfoam.write.every": "60 ms"})
        case = run.folder / "openfoam"
        ours = (case / "0.06/U").read_text()
        stock_case.run("pimpleFoam", case)
        theirs = (case / "0.06/U").read_text()
        a, b = (speeds(text) for text in (ours, theirs))
        worst = max(abs(x - y) for x, y in zip(a, b, strict=True))
        testing.report(f"stock pimpleFoam: {worst:.1e} m/s of 20 mm/s")
        # The same equations from other roundings: the solvers' tolerances are left, 5e-5 of the speed.
        self.assertLess(worst, 1e-6)


def speeds(text):
    text = text[text.index("internalField"):text.index("boundaryField")]
    return [float(x) for row in text.splitlines() if row.startswith("(") and row.endswith(")")
            for x in row[1:-1].split()]


if __name__ == "__main__":
    unittest.main()
