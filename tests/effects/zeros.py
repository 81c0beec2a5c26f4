# SPDX-License-Identifier: GPL-2.0-or-later
"""What is zero, or says what holds without it, changes nothing: probes are the same to the byte, or
to rounding where sums are taken in another order."""
import unittest
from pathlib import Path

from magfsi import testing

ROUNDING = 1e-11  # of the scale of a column: 1e-16 that some hundred steps multiply; a lift is 1e-3 of the drag
WORK_ROUNDING = 1e-8  # the work of 0.4 ms is 1e-7 of the energy in the field, of which it is a difference
SHORT = {"time.end": "0.4 ms"}
NO_VECTOR = "[0 {0}, 0 {0}, 0 {0}]"
DIPOLE = "dipole: {moment: [1 A m2, 0 A m2, 0 A m2]}, position: [30 mm, 0 mm, 0 mm]"


def zeros(unit):
    return NO_VECTOR.replace("{0}", unit)


# Of the small swimmer. Value, in a list: what it is compared with, in place of its absence.
COUPLED = {
    "damping": {"damping": "{rate: 0 1/s}"},
    "a gradient": {"magnetic_field.gradient.matrix": f"[{', '.join(3 * [zeros('T/m')])}]"},
    "a field that adds": {"magnetic_field.plus": f"[{{vector: {zeros('T')}}}]"},
    "an oscillating field": {"magnetic_field.plus": f"[{{oscillation: {{amplitude: {zeros('T')}, "
                                                   "frequency: 50 Hz}}]"},
    "a dipole of no moment": {"magnetic_field.sources.far": f"{{dipole: {{moment: {zeros('A m2')}}}, "
                                                           "position: [20 mm, 0 mm, 0 mm]}"},
    "an initial velocity": {"fluid.initial_velocity": zeros("m/s")},
    "a wall that does not move": {"fluid.boundaries.z_max.no_slip.velocity": zeros("m/s")},
    "a rotation": {"bodies.robot.initial.rotation": "{plane: xz, angle: 0 deg}"},
    "contact that is not met": {"contact": "{distance: 0.3 mm, friction: 0.5}"},
}
# Sums of other loops.
TO_ROUNDING = {"a force on the fluid": {"fluid.body_force": zeros("N/m3")}}

# With a source of the field: what moves, turns or scales it not at all; the work of one that
# changes with time is summed in another way.
MOVED = {
    "no way": f"{{{DIPOLE}, motion: {{oscillation: {{amplitude: {zeros('m')}, frequency: 9 Hz}}}}}}",
    "no turn": f"{{{DIPOLE}, rotation: {{axis: [0, 0, 1], angle: 0 deg}}}}",
    "its own strength": f"{{{DIPOLE}, strength: {{formula: 1}}}}",
}

STREAM = """
name: stream
time: {end: 20 ms}
fluid:
  box: [12 mm, 6 mm, 6 mm]
  spacing: 0.5 mm
  density: 1000 kg/m3
  viscosity: 4 mm2/s
  expected_speed: 0.2 m/s
  boundaries:
    x_min: {velocity_inlet: {velocity: [0.1 m/s, 0 m/s, 0 m/s], ramp: 10 ms}}
    x_max: {pressure_outlet: {}}
  obstacles: {ball: {sphere: {centre: [4 mm, 2.7 mm, 3.2 mm], diameter: 2 mm}}}
probes: {every: 2 ms, fluid: [obstacle_force, kinetic_energy, mass, max_speed]}
"""
INLET = "fluid.boundaries.x_min.velocity_inlet"
STREAMS = {
    "no pressure at the outlet": {"fluid.boundaries.x_max.pressure_outlet.pressure": "0 Pa"},
    "no swing of the inlet": {f"{INLET}.course": "{oscillation: {mean: 1, amplitude: 0, frequency: 9 Hz}}"},
    "a course of 1": {f"{INLET}.course": "{formula: 1}"},
}
STREAMS_TO_ROUNDING = {
    "a Carreau fluid of one viscosity": {"fluid.rheology": "{carreau: {infinite_viscosity: 4 mm2/s, time: 1 s, "
                                                          "exponent: 0.5}}"},
    "a power law of exponent 1": {"fluid.rheology": "{power_law: {exponent: 1, rate: 10 1/s, "
                                                   "least: 0.4 mm2/s, most: 40 mm2/s}}"},
    "an eddy viscosity of 1e-18 of a cell's": {"fluid.smagorinsky.constant": "1e-9"},
    "a force on the fluid": {"fluid.body_force": zeros("N/m3")},
}


class Zeros(unittest.TestCase):
    def compare(self, scene, base, cases, bound=0.0):
        plain = testing.good_run(scene, base)
        for name, settings in cases.items():
            with self.subTest(name):
                other = testing.good_run(scene, {**base, **settings})
                if bound == 0:
                    self.assertEqual((other.folder / "probes.csv").read_bytes(),
                                     (plain.folder / "probes.csv").read_bytes())
                    continue
                worst, column = testing.worst_difference(plain.probes(), other.probes())
                testing.report(f"{name}: {worst:.1e} in {column}")
                self.assertLessEqual(worst, bound, column)

    def test_beside_a_swimmer(self):
        self.compare(testing.SMALL, SHORT, COUPLED)
        self.compare(testing.SMALL, SHORT, TO_ROUNDING, ROUNDING)

    def test_beside_a_swimmer_with_the_penalty(self):
        penalty = {**SHORT, "coupling.immersed_boundary.forcing": "penalty"}
        self.compare(testing.SMALL, penalty, {"damping": COUPLED["damping"]})

    def test_of_a_source(self):
        source = "magnetic_field.sources.far"
        self.compare(testing.SMALL, {**SHORT, source: f"{{{DIPOLE}}}"},
                     {name: {source: text} for name, text in MOVED.items()}, WORK_ROUNDING)

    def test_in_a_stream(self):
        scene = Path(testing.new_folder()) / "scene.yaml"
        scene.write_text(STREAM)
        self.compare(scene, {}, STREAMS)
        self.compare(scene, {}, STREAMS_TO_ROUNDING, ROUNDING)


if __name__ == "__main__":
    unittest.main()
