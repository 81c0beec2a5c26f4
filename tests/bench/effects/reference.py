# SPDX-License-Identifier: GPL-2.0-or-later
"""The reference scenes of costs.py and what each effect adds to them."""

from magfsi import testing

TESTS = testing.ROOT / "tests"

FREE = {"magnetic_field": "null", "gravity": "null", "damping": "null", "platform": "null",
        "contact": "null", "probes": "null", "bodies.strip.material.viscosity": "null",
        "bodies.strip.magnetization": "null"}
MAGNET = {"bodies.strip.magnetization": "{harmonic: {amplitude: 62 kA/m, phase: 45 deg}}",
          "magnetic_field": "{constant: {magnitude: 17 mT, direction: 45 deg}}"}
FALL = {"gravity": "{acceleration: 9.81 m/s2}"}
GROUND = {**FALL, "platform": "{point: [0 mm, 0 mm, 0.11 mm]}"}
LID = "fluid.boundaries.z_max"
SIDES = "fluid.boundaries"

# What: (with, without); the scene otherwise bare.
STRUCTURE = {
    "viscosity": ({"bodies.strip.material.viscosity": "5 Pa s"}, {}),
    "magnetic field": (MAGNET, {}),
    "field gradient": ({**MAGNET, "magnetic_field.gradient.matrix": "[[1 T/m, 0 T/m, 0 T/m], "
                        "[0 T/m, 0 T/m, 0 T/m], [0 T/m, 0 T/m, -1 T/m]]"}, MAGNET),
    "field source, a cuboid magnet": (
        {**MAGNET, "magnetic_field": "{sources: {magnet: {cuboid: {size: [8 mm, 6 mm, 4 mm], "
         "remanence: [0 T, 0 T, 1.2 T]}, position: [0 mm, 0 mm, 40 mm]}}}"}, MAGNET),
    "field source, a coil": (
        {**MAGNET, "magnetic_field": "{sources: {coil: {coil: {diameter: 20 mm, axis: [0, 1, 0], "
         "current: 2 A, turns: 50}}}}"}, MAGNET),
    "dipoles, within the body": ({**MAGNET, "dipoles": "{within_bodies: true}"}, MAGNET),
    "gravity": (FALL, {}),
    "damping": ({"damping.rate": "10 1/s"}, {}),
    "platform": (GROUND, FALL),
    "friction": ({**GROUND, "platform.friction": "0.3"}, GROUND),
    "contact": ({"contact": "{}"}, {}),
    "clamps": ({"bodies.strip.clamps": "[x_min]"}, {}),
    "rollers": ({"bodies.strip.rollers": "[{face: x_min, axis: x}]"}, {}),
    "prescribed motion": ({"bodies.strip.prescribed_motion":
                           "[{face: x_min, oscillation: {amplitude: "
                           "[0 mm, 0 mm, 0.01 mm], frequency: 100 Hz}}]"}, {}),
    "probes, every 10 steps": ({"probes": "{every: 10 us, bodies: [com, shape]}"}, {}),
    "energy audit, every 10 steps": (
        {"probes": "{every: 10 us, bodies: [com], energy_audit: true}"},
        {"probes": "{every: 10 us, bodies: [com]}"}),
    "structure fields, every 10 steps": ({"output.structure.every": "10 us"}, {}),
    "checkpoint, every 10 steps": ({"checkpoint.every": "10 us"}, {}),
}
FLUID = {
    "body force": ({"fluid.body_force": "[1 N/m3, 0 N/m3, 0 N/m3]"}, {}),
    "bulk viscosity": ({"fluid.bulk_viscosity": "1000 mm2/s"}, {}),
    "eddy viscosity": ({"fluid.smagorinsky.constant": "0.1"}, {}),
    "rheology": ({"fluid.rheology.carreau": "{infinite_viscosity: 0.1 mm2/s, time: 1 s, exponent: 0.4}"},
                 {}),
    "moving wall": ({LID: "{no_slip: {velocity: [0.01 m/s, 0 m/s, 0 m/s]}}"}, {}),
    "free slip, one side": ({LID: "free_slip"}, {}),
    "inlet and outlet": ({SIDES: "{x_min: {velocity_inlet: {velocity: [0.01 m/s, 0 m/s, "
                          "0 m/s]}}, x_max: pressure_outlet}"}, {}),
    "obstacle": ({"fluid.obstacles.ball.sphere":
                  "{centre: [16 mm, 16 mm, 16 mm], diameter: 10 mm}"}, {}),
    "probe of a sum, every 10 steps": ({"probes": "{every: 5 ms, fluid: [kinetic_energy]}"},
                                       {}),
    "probe of the enstrophy, every 10 steps": ({"probes": "{every: 5 ms, fluid: [enstrophy]}"},
                                               {}),
    "probe of a plane's flow, every 10 steps": (
        {"probes": "{every: 5 ms, integrals: {middle: {plane: {axis: x, at: 16 mm}}}}"}, {}),
    "fluid fields, every 10 steps": ({"output.fluid": "{every: 5 ms, fields: [velocity]}"}, {}),
    "checkpoint, every 10 steps": ({"checkpoint.every": "5 ms"}, {}),
}
BOUNDARY = "coupling.immersed_boundary"
PENALTY = {f"{BOUNDARY}.forcing": "penalty"}
ROWS = {"probes": "{every: 0.1 ms, bodies: [com]}"}
COUPLED = {
    "buoyancy and gravity": ({}, {"gravity": "null"}),
    "no slip": ({}, PENALTY),
    "implicit scheme": ({"coupling.scheme": "implicit"}, {}),
    "linear velocity": ({"coupling.sampled_velocity": "linear"}, {}),
    "interface balance": ({"probes": "{every: 0.1 ms, bodies: [com], interface_balance: true}"},
                          ROWS),
    "energy audit, every 4 steps": (
        {"probes": "{every: 0.1 ms, bodies: [com], energy_audit: true}"}, ROWS),
    "probe of the fluid's force, every 4 steps": (
        {"probes": "{every: 0.1 ms, bodies: [com, fluid_force]}"}, ROWS),
    "obstacle": ({"fluid.obstacles.ball.sphere":
                  "{centre: [4 mm, 2 mm, 1.5 mm], diameter: 1.5 mm}"}, {}),
}
STRUCTURE_SCENE = TESTS / "scenes/every_structure_effect.yaml"
FLUID_SCENE = TESTS / "effects/still_fluid.yaml"
COUPLED_SCENE = testing.SMALL

# Without the other side, and with the LAMMPS step that the coupled scene has.
BODY_ALONE = {"fluid": "null", "probes": "null", "time.step": "4.1666667 us"}
FLUID_ALONE = {"bodies": "null", "magnetic_field": "null", "gravity": "null", "probes": "null"}
