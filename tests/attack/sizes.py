# SPDX-License-Identifier: GPL-2.0-or-later
"""Whatever the numbers and sizes in a scene or a command: refused in one line with what is
allowed, or answered. check and explain take seconds.

--every 5 takes each fifth number, size and file."""

import itertools
import os
import unittest
from pathlib import Path

from magfsi import runs, testing

EVERY = 1  # of the numbers, sizes and files
LIMIT_S = 120  # for a busy machine; 10 s on one with nothing else to do


class Sizes(unittest.TestCase):
    def magfsi(self, verb, scene, settings=None, more=()):
        words = [*runs.command(verb, scene, settings), *more]
        return testing.finish(testing.start(words), 0, "unused", LIMIT_S)

    def refused(self, scene, settings, message, verbs=("check", "explain"), more=()):
        for verb in verbs:
            testing.check_refused(self, self.magfsi(verb, scene, settings, more), message)

    def test_elements(self):
        for elements in ("[200, 100, 100]", "[1000, 1000, 1000]", "[100000, 100000, 100000]",
                         "[2147483647, 2147483647, 2147483647]")[::EVERY]:
            self.refused(testing.SMALL, {"bodies.robot.mesh.box.elements": elements}, "at most")

    def test_elements_of_a_plate(self):
        scene = testing.ROOT / "tutorials/origami/scene.yaml"
        self.refused(scene, {"bodies.plate.mesh.oblique.elements": "[1000, 1000, 1000]"},
                     "at most 250000")

    def test_markers(self):
        self.refused(testing.SMALL, {"fluid.spacing": "0.002 mm"}, "at most 500000")

    def test_cells(self):
        self.refused(testing.SMALL, {"fluid.box": "[8e3 mm, 4e3 mm, 8e3 mm]"}, "at most 1e+11")

    def test_cells_beyond_the_memory(self):
        self.refused(testing.SMALL, {"fluid.box": "[800 mm, 400 mm, 800 mm]"},
                     "of memory", ["run"])

    def test_numbers_at_the_ends_of_their_range(self):
        keys = ("time.end", "fluid.viscosity", "fluid.density", "fluid.expected_speed",
                "bodies.robot.material.density", "bodies.robot.material.shear_modulus",
                "gravity.acceleration", "probes.every")
        numbers = ("1e-308", "1e308", "1e400", "-1", "nan", "inf")
        for key, number in list(itertools.product(keys, numbers))[::EVERY]:
            unit = {"end": "s", "viscosity": "m2/s", "density": "kg/m3", "expected_speed": "m/s",
                    "shear_modulus": "Pa", "acceleration": "m/s2", "every": "s"}[
                        key.rsplit(".", 1)[1]]
            with self.subTest(f"{key}={number}"):
                ended = self.magfsi("check", testing.SMALL, {key: f"{number} {unit}"})
                self.assertIn(ended.code, (0, 2), ended.err)
                self.assertEqual(len(testing.causes(ended)), ended.code // 2,
                                 ended.err)

    def test_scene_files(self):
        folder = Path(testing.new_folder())
        many = "".join(f"  k{i}: 1\n" for i in range(100000))
        texts = {"keys": ("time: {end: 1 s}\n" + many.replace("  k", "k"), "more than 1000 keys"),
                 "names": ("time: {end: 1 s}\nbodies:\n" + many, "more than 1000 keys"),
                 "scalar": ("name: " + 50_000_000 * "a" + "\n", "at most 4000000 bytes"),
                 "items": ("time: [" + 300_000 * "1," + "1]\n", "200000 nodes"),
                 "depth": ("a: " + 100_000 * "[" + "\n", "no valid YAML"),
                 "aliases": ("a0: &a0 [x, x]\n" + "".join(
                     f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}, *a{i - 1}, *a{i - 1}]\n"
                     for i in range(1, 40)), "200000 nodes")}
        for name, (text, message) in list(texts.items())[::EVERY]:
            with self.subTest(name):
                scene = folder / f"{name}.yaml"
                scene.write_text(text)
                self.refused(scene, {}, message)

    def test_ranks(self):
        for ranks in ("fluid=40", "fluid=99999", "structure=200,fluid=1", "fluid=64",
                      "structure=99999999999999")[::EVERY]:
            with self.subTest(ranks):
                cores = len(os.sched_getaffinity(0))
                if ranks == "fluid=40" and cores > 9 or ranks == "fluid=64" and cores > 15:
                    continue  # allowed there
                self.refused(testing.SMALL, {}, "allowed", ("run", "explain"),
                             ["--ranks", ranks])

    def test_more_ranks_than_elements(self):
        two = {"bodies.robot.mesh.box.elements": "[2, 1, 1]", "fluid": "null", "probes": "null"}
        for verb in ("run", "explain"):
            self.refused(testing.SMALL, two, "2 elements in all", [verb],
                         ["--ranks", "structure=3"])
        self.refused(testing.ROOT / "tutorials/beam/scene.yaml", {}, "allowed is 1", ["run"],
                     ["--ranks", "structure=2"])

    def test_more_ranks_than_rows(self):
        scene = Path(testing.new_folder()) / "scene.yaml"
        scene.write_text("time: {end: 1 ms}\nfluid: {box: [8 mm, 1 mm, 1 mm], spacing: 1 mm, "
                         "density: 1000 kg/m3, viscosity: 10 mm2/s, expected_speed: 1 m/s, "
                         "boundaries: {y_min: periodic, y_max: periodic, z_min: periodic, "
                         "z_max: periodic}}\n")
        self.refused(scene, {}, "cannot be cut into 2 blocks", ["run"], ["--ranks", "fluid=2"])


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
