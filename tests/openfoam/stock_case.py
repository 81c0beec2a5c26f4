# SPDX-License-Identifier: GPL-2.0-or-later
"""The run folder's openfoam/ is a case that the stock programs run by themselves: blockMesh and
pimpleFoam give the flow that the run gave."""

import re
import subprocess
import unittest
from pathlib import Path

from magfsi import testing
from magfsi.witness import foam

FLUID = """
name: {name}
time: {{end: {end}}}
fluid:
  solver: openfoam
  spacing: 0.5 mm
  density: 1000 kg/m3
  viscosity: 1 mm2/s
{fluid}
probes: {{every: {end}, fluid: [kinetic_energy, max_speed]}}
"""
# A channel that is still speeding up, on a graded mesh: inlet with profile and ramp, symmetry.
CHANNEL = FLUID.format(name="channel", end="40 ms", fluid="""
  box: [8 mm, 4 mm, 5 mm]
  expected_speed: 30 mm/s
  grading: {uniform: [[2 mm, 0 mm, 1 mm], [4 mm, 2 mm, 3 mm]], growth: 1.3}
  boundaries:
    x_min: {velocity_inlet: {velocity: [20 mm/s, 0 m/s, 0 m/s], profile: parabolic, ramp: 60 ms}}
    x_max: {pressure_outlet: {}}
    y_max: free_slip
""")
# A round jet into a box.
JET = FLUID.format(name="jet", end="20 ms", fluid="""
  box: [5 mm, 4 mm, 4 mm]
  expected_speed: 60 mm/s
  boundaries:
    x_min: {velocity_inlet: {velocity: [20 mm/s, 0 m/s, 0 m/s], profile: plug,
                             disc: {centre: [2 mm, 2 mm], diameter: 2 mm}}}
    x_max: {pressure_outlet: {}}
""")
# A lid, a periodic axis and a force everywhere.
DRIVEN = FLUID.format(name="driven", end="100 ms", fluid="""
  box: [4 mm, 2 mm, 4 mm]
  expected_speed: 20 mm/s
  body_force: [0 N/m3, 30 N/m3, 0 N/m3]
  initial_velocity: [0 m/s, 1 mm/s, 0 m/s]
  boundaries:
    y_min: periodic
    y_max: periodic
    z_max: {no_slip: {velocity: [20 mm/s, 0 m/s, 0 m/s]}}
""")
# The same equations by the same code; solved to 1e-6 of their residual from other roundings.
BOUND = 1e-6


def run(program, case):
    done = subprocess.run([program, "-case", case], env=foam.environment(), capture_output=True,
                          text=True, timeout=120)
    if done.returncode != 0:
        raise AssertionError(f"{program}: {done.stdout[-2000:]}{done.stderr}")


def stock(case):
    run("blockMesh", case)
    run("pimpleFoam", case)


def energy(case):
    """Of the last velocities that were written [J]."""
    times = [p.name for p in case.iterdir() if re.fullmatch(r"[0-9.e-]+", p.name)]
    text = (case / max(times, key=float) / "U").read_text()
    text = text[text.index("internalField"):text.index("boundaryField")]
    speeds = [[float(x) for x in v.split()] for v in re.findall(r"\(([-0-9.e ]+)\)", text)]
    grading = (case / "system" / "blockMeshDict").read_text()
    axes = [[float(w) for w in re.findall(r"\(([-0-9.e]+) 1 1\)", line)]
            for line in grading.splitlines() if " 1 1)" in line]
    volumes = [a * b * c for c in axes[2] for b in axes[1] for a in axes[0]]
    return sum(500 * volume * sum(x * x for x in v)
               for volume, v in zip(volumes, speeds, strict=True))


class StockCase(unittest.TestCase):
    def same(self, text, ranks):
        scene = Path(testing.new_folder()) / "scene.yaml"
        scene.write_text(text)
        run = testing.good_run(scene, ranks=ranks)
        expected = run.probes()["kinetic_energy[J]"]
        case = run.folder / "openfoam"
        stock(case)
        found = energy(case)
        testing.report(f"{self.id().split('.')[-1]}: energy {expected[-1]:.6e} J, by stock pimpleFoam "
                      f"{found:.6e} J, {found / expected[-1] - 1:+.1e}")
        self.assertGreater(expected[-1], 2 * expected[0])
        self.assertAlmostEqual(found / expected[-1], 1, delta=BOUND)

    def test_channel(self):
        self.same(CHANNEL, "fluid=1")

    def test_jet(self):
        self.same(JET, "fluid=1")

    def test_driven_box_from_two_ranks(self):
        self.same(DRIVEN, "fluid=2")


if __name__ == "__main__":
    unittest.main()
