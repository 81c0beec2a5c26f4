# SPDX-License-Identifier: GPL-2.0-or-later
"""Small scenes with checkpoints, and how to start and go on with them."""

from pathlib import Path

from magfsi import testing

RIGID = testing.ROOT / "tests/validation/rigid/beam.yaml"
EVERY = testing.ROOT / "tests/scenes/every_structure_effect.yaml"

# Overrides without a value take a key away.
COUPLED = {"time.end": "2 ms", "checkpoint.every": "0.5 ms",
           "output.structure.every": "0.25 ms", "output.fluid.every": "0.5 ms"}
STRUCTURE = {"time.end": "10 ms", "checkpoint.every": "2 ms", "probes.every": "0.5 ms",
             "output.structure.every": "1 ms"}
# A beam with a rigid magnet, drawn to the side as well, as what is zero by symmetry would be rounding,
# and a rigid ball that falls on a rough platform beside it. (Without the audit, whose residual is what
# rounding leaves of a balance.)
RIGID_PARTS = {"bodies.beam.rigid": "magnet", "magnetic_field.vector": "[0 T, 0.7 mT, 2 mT]",
               "probes.bodies": "[com, energy, rigid_motion]", "probes.energy_audit": "false",
               "bodies.ball": "{mesh: {ball: {diameter: 1 mm, elements: [2, 1]}}, material: "
                              "{density: 3000 kg/m3}, rigid: true, initial: {position: "
                              "[0 mm, 4 mm, -0.45 mm], angular_velocity: [30 rad/s, 90 rad/s, 20 rad/s]}}",
               "platform": "{point: [0 mm, 0 mm, -1 mm], friction: 0.3}",
               "gravity": "{acceleration: 9.81 m/s2}", "damping": "{rate: 5 1/s}",
               "contact": "{}", "time.end": "10 ms", "checkpoint.every": "2 ms",
               "probes.every": "0.5 ms", "output.structure.every": "1 ms"}
# A face is dragged through the box and the finer cells follow.
REFINED = {**COUPLED, "fluid.box": "[14 mm, 4 mm, 8 mm]",
           "fluid.refinement": "{levels: 1, margin: 0.75 mm}",
           "bodies.robot.prescribed_motion":
               "[{face: x_min, oscillation: {amplitude: [0.9 mm, 0 m, 0.5 mm], "
               "frequency: 100 Hz, phase: -90 deg}}]"}
FLUID = {"bodies": "", "gravity": "", "magnetic_field": "", "probes.bodies": "",
         "probes.points": "", "probes.interface_balance": "", "time.end": "2 ms",
         "checkpoint.every": "0.5 ms", "output.fluid.every": "0.5 ms",
         "probes.fluid": "[kinetic_energy, mass, max_speed, enstrophy, obstacle_force]",
         "fluid.smagorinsky.constant": "0.1",
         "fluid.obstacles.ball.sphere": "{centre: [4 mm, 2 mm, 4 mm], diameter: 1.5 mm}",
         # The ramp is longer than the run: the step number matters.
         "fluid.boundaries.x_min": "{velocity_inlet: {velocity: [0.1 m/s, 0 m/s, 0 m/s], "
                                   "ramp: 4 ms}}",
         "fluid.boundaries.x_max": "{pressure_outlet: {}}",
         "fluid.boundaries.z_min": "{no_slip: {velocity: [0.02 m/s, 0 m/s, 0 m/s]}}"}


def run(scene, settings, folder, ranks=None, restart=None):
    return testing.run(scene, settings, ranks, 300, folder, restart)


def good(scene, settings, folder, ranks=None, restart=None):
    return testing.good_run(scene, settings, ranks, 300, folder, restart)


def interrupted(scene, settings, end, ranks=None, new_ranks=None):
    """A run to `end` only, gone on with to the end of the scene."""
    folder = testing.new_folder()
    good(scene, {**settings, "time.end": end}, folder, ranks)
    return good(scene, settings, folder, new_ranks or ranks, restart="latest")


def results(folder):
    """Every file of physics: series, fields and their indices."""
    folder = Path(folder)
    names = ["probes.csv", "structure.pvd", "fluid.pvd"]
    files = [folder / n for n in names if (folder / n).exists()] + sorted(folder.glob("fields/*"))
    return {str(f.relative_to(folder)): f.read_bytes() for f in files}


def checkpoints(folder):
    return sorted(p.name for p in Path(folder).glob("checkpoint*.h5"))


def restarted_at(result):
    return result.summary()["extra"]["restarted_at_step"]


def assert_same_bytes(test, whole, parts, participants):
    """Results and the last two checkpoints of each participant."""
    expected, found = results(whole.folder), results(parts.folder)
    test.assertEqual(list(found), list(expected))
    test.assertGreater(len(expected), 3)
    for name, content in expected.items():
        test.assertEqual(found[name], content, name)
    kept = checkpoints(whole.folder)
    test.assertEqual(checkpoints(parts.folder), kept)
    test.assertEqual(len(kept), 2 * participants)
    for name in kept:
        test.assertEqual((Path(parts.folder) / name).read_bytes(),
                         (Path(whole.folder) / name).read_bytes(), name)
