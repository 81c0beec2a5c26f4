# SPDX-License-Identifier: GPL-2.0-or-later
"""On the same ranks a run that goes on from a checkpoint leaves the bytes of the one that was not
interrupted: time series, fields and the next checkpoints."""

import unittest
from pathlib import Path

import scenes
from scenes import COUPLED, EVERY, FLUID, REFINED, RIGID, RIGID_PARTS, STRUCTURE, testing


class SameBytes(unittest.TestCase):
    def same(self, scene, settings, end, ranks):
        whole = scenes.good(scene, settings, testing.new_folder(), ranks)
        parts = scenes.interrupted(scene, settings, end, ranks)
        coupled = "structure=" in ranks and "fluid=" in ranks
        scenes.assert_same_bytes(self, whole, parts, 2 if coupled else 1)
        first, second = whole.summary(), parts.summary()
        self.assertEqual(second["outcome"], "completed")
        for key in ("steps", "simulated_s", "probes", "scene_hash"):
            self.assertEqual(second[key], first[key], key)
        self.assertLess(scenes.restarted_at(parts), second["steps"])
        return parts

    # The ends lie between two checkpoints and between two probe rows.
    def test_swimmer(self):
        self.same(testing.SMALL, COUPLED, "1.375 ms", "structure=1,fluid=1")

    def test_swimmer_on_several_ranks(self):
        self.same(testing.SMALL, COUPLED, "1.375 ms", "structure=2,fluid=3")

    # The memory of the slip goes on; row sums are those of the positions.
    def test_swimmer_without_slip(self):
        no_slip = {**COUPLED, "coupling.immersed_boundary.forcing": "no_slip"}
        self.same(testing.SMALL, no_slip, "1.375 ms", "structure=2,fluid=3")
        self.same(testing.SMALL, {**no_slip, "coupling.scheme": "implicit"}, "1.375 ms",
                  "structure=1,fluid=1")

    def test_swimmer_with_extrapolated_velocity(self):
        self.same(testing.SMALL, {**COUPLED, "coupling.sampled_velocity": "linear"},
                  "1.375 ms", "structure=1,fluid=1")

    # What the steps before have taught goes on, to the last bit.
    def test_swimmer_in_the_implicit_scheme(self):
        implicit = {**COUPLED, "coupling.scheme": "implicit"}
        self.same(testing.SMALL, implicit, "1.375 ms", "structure=2,fluid=3")
        self.same(testing.SMALL, {**implicit, "coupling.iteration.acceleration": "aitken"},
                  "1.375 ms", "structure=1,fluid=1")

    # Viscosity, field gradient, drag, a rough platform, contact.
    def test_every_effect_of_a_solid(self):
        self.same(EVERY, STRUCTURE, "7.2 ms", "structure=1")

    # Contact adds forces in the order of the nodes' numbers.
    def test_solid_on_several_ranks(self):
        self.same(EVERY, STRUCTURE, "7.2 ms", "structure=3")

    # Orientation and angular momentum, to the last bit; the bodies' own and a region's.
    def test_rigid_parts(self):
        self.same(RIGID, RIGID_PARTS, "7.2 ms", "structure=1")

    def test_rigid_parts_on_several_ranks(self):
        self.same(RIGID, RIGID_PARTS, "7.2 ms", "structure=3")

    # Their places are those of the step's number.
    def test_a_moved_rigid_part(self):
        moved = {**RIGID_PARTS, "bodies.ball": RIGID_PARTS["bodies.ball"].replace(
            ", angular_velocity: [30 rad/s, 90 rad/s, 20 rad/s]}", "}, moved: {formula: {x: 1 mm*sin(2*pi*"
            "90 Hz*t), z: 0.2 m/s*t}, turning: {axis: [1, 2, 3], about: [0 mm, 4 mm, 0 mm], angle: "
            "300 rad/s*t}}")}
        for ranks in ("structure=1", "structure=3"):
            self.same(RIGID, moved, "7.2 ms", ranks)

    # Its place is that of the step's number.
    def test_a_moved_face(self):
        wave = "{amplitude: [0.1 mm, 0 m, 0.2 mm], frequency: 100 Hz, phase: -90 deg}"
        for scene, settings, body, end, ranks in (
                (EVERY, STRUCTURE, "strip", "7.2 ms", "structure=1"),
                (testing.SMALL, COUPLED, "robot", "1.375 ms", "structure=2,fluid=2")):
            self.same(scene, {**settings, f"bodies.{body}.prescribed_motion":
                              f"[{{face: x_min, oscillation: {wave}}}]"}, end, ranks)

    # The checkpoint lies between two rows: what has been summed for the mean goes on.
    def test_means_of_forces(self):
        self.same(testing.SMALL, {**COUPLED, "probes.every": "1 ms", "probes.mean_forces": "true",
                                  "probes.bodies": "[com, fluid_force]"}, "1.375 ms",
                  "structure=2,fluid=1")

    # Patches stand where they stood; checkpoints come after whole steps of all levels.
    def test_swimmer_in_a_refined_grid(self):
        self.same(testing.SMALL, REFINED, "1.375 ms", "structure=2,fluid=3")

    def test_two_bodies_with_a_patch_each(self):
        self.same(testing.SMALL, {**REFINED, **testing.SECOND}, "1.375 ms",
                  "structure=2,fluid=3")
        self.same(testing.SMALL, {**REFINED, "coupling.scheme": "implicit",
                                  "fluid.refinement": "{levels: 2}"}, "1.375 ms",
                  "structure=1,fluid=1")

    def test_fluid(self):
        self.same(testing.SMALL, FLUID, "1.375 ms", "fluid=2")

    # The step of the checkpoint, 25, is odd: the other arrangement of the populations.
    def test_fluid_in_single_precision(self):
        self.same(testing.SMALL, {**FLUID, "fluid.precision": "float",
                                 "checkpoint.every": "0.625 ms"}, "0.75 ms", "fluid=1")


    # What a formula gives is that of the step's number: the field, and an inlet's velocity.
    def test_formulas_of_time(self):
        pulse = "{formula: 1 + 0.5*sin(2*pi*400 Hz*t)}"
        self.same(testing.SMALL, {**FLUID, "fluid.boundaries.x_min.velocity_inlet.course": pulse},
                  "1.375 ms", "fluid=2")
        self.same(testing.SMALL, {**COUPLED, "magnetic_field":
                                  "{formula: {x: 10 mT*sin(2*pi*400 Hz*t), z: 5 mT}}"},
                  "1.375 ms", "structure=1,fluid=1")


class Series(unittest.TestCase):
    def test_two_restarts_and_rows_that_come_again(self):
        settings = {**COUPLED, "checkpoint.every": "0.5 ms", "probes.every": "25 us"}
        whole = scenes.good(testing.SMALL, settings, testing.new_folder())
        folder = testing.new_folder()
        scenes.good(testing.SMALL, {**settings, "time.end": "0.9 ms"}, folder)
        second = scenes.good(testing.SMALL, {**settings, "time.end": "1.9 ms"}, folder,
                             restart="latest")
        self.assertEqual(scenes.restarted_at(second), 20)
        third = scenes.good(testing.SMALL, settings, folder, restart="latest")
        self.assertEqual(scenes.restarted_at(third), 60)
        testing.check_same_files(self, scenes.results(folder), scenes.results(whole.folder))
        # One log for all.
        self.assertEqual((Path(folder) / "run.log").read_text().count("restart at step"), 2)

    def test_another_folder_takes_what_comes(self):
        first = testing.new_folder()
        scenes.good(testing.SMALL, {**COUPLED, "time.end": "1 ms"}, first)
        file = Path(first) / "checkpoint_0000000020_fluid.h5"
        result = scenes.good(testing.SMALL, {**COUPLED, "time.end": "1 ms"},
                             testing.new_folder(), restart=file)
        times = result.probes()["t[s]"]
        self.assertAlmostEqual(times[0], 0.6e-3, delta=1e-9)
        self.assertEqual(scenes.checkpoints(first)[0], file.name)


if __name__ == "__main__":
    unittest.main()
