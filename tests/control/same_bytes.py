# SPDX-License-Identifier: GPL-2.0-or-later
"""With a controller, too, a run leaves the same bytes: those of the scene's own law where it returns
that law; those of the run that was not interrupted where it goes on from a checkpoint."""
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "restart"))

import scenes  # noqa: E402
from scripts import ALONE, COUPLED, EVERY, WITH_A_STATE, of, testing, with_control  # noqa: E402

LAW = '{"plane": "xz", "constant": {"magnitude": "10 mT", "direction": "50 deg"}}'
PROBES = ["robot.com_z", '"kinetic_energy[J]"', '"interface.momentum_mismatch[1]"']


class OwnLaw(unittest.TestCase):
    def test_of_the_scene_returned(self):
        for ranks in "structure=1,fluid=1", "structure=2,fluid=2":
            own = testing.good_run(testing.SMALL, COUPLED, ranks)
            steered = testing.good_run(testing.SMALL, with_control(COUPLED, of(f"return {LAW}"),
                                                                   "0.5 ms", PROBES), ranks)
            testing.check_same_files(self, scenes.results(steered.folder), scenes.results(own.folder))

    def test_a_law_that_leaves_the_plane_out_has_the_scenes(self):
        turned = {**ALONE, "magnetic_field.plane": "yz"}
        law = '{"constant": {"magnitude": "17 mT", "direction": "45 deg"}}'
        own = testing.good_run(EVERY, turned)
        steered = testing.good_run(EVERY, with_control(turned, of(f"return {law}")))
        testing.check_same_files(self, scenes.results(steered.folder), scenes.results(own.folder))

    def test_three_components(self):
        own = testing.good_run(EVERY, {**ALONE, "magnetic_field.constant": "",
                                       "magnetic_field.vector": "[3 mT, -2 mT, 4 mT]"})
        steered = testing.good_run(EVERY, with_control(ALONE, of(
            "import numpy\nreturn numpy.array([3e-3, -2e-3, 4e-3])")))
        first, second = own.probes(), steered.probes()
        # Of the first row, before anything moves, the field is the scene's.
        for name in "field[T]", "field_x[T]", "field_y[T]", "field_z[T]":
            self.assertEqual(second[name][1:], first[name][1:], name)
        # The first half step is of the scene's field, which differs by four times this one: 1e-4 of
        # the speed after 10 ms each, 1e-3 in all.
        self.assertLess(testing.difference(first, second, "strip.bend[rad]"), 3e-3)


class GoesOn(unittest.TestCase):
    """Checkpoints come each 0.5 ms, calls each 0.2 ms: some fall together, some do not."""

    def same(self, scene, settings, end, ranks, probes):
        settings = with_control(settings, WITH_A_STATE, "0.2 ms", probes)
        whole = scenes.good(scene, settings, testing.new_folder(), ranks)
        parts = scenes.interrupted(scene, settings, end, ranks)
        scenes.assert_same_bytes(self, whole, parts, 2 if "fluid" in ranks else 1)
        fields = set(whole.probes()["field_x[T]"])
        self.assertGreater(len(fields), 5, "it steers")

    def test_coupled_between_calls_and_at_one(self):
        for ranks, end in (("structure=1,fluid=1", "1.375 ms"), ("structure=2,fluid=2", "1.1 ms")):
            self.same(testing.SMALL, scenes.COUPLED, end, ranks, PROBES[:2])

    def test_repeated_steps(self):
        self.same(testing.SMALL, {**scenes.COUPLED, "coupling.scheme": "implicit"}, "1.1 ms",
                  "structure=1,fluid=1", PROBES[:1])

    def test_alone(self):
        alone = {**ALONE, "time.end": "3 ms", "probes.every": "0.1 ms", "probes.energy_audit": "true",
                 "checkpoint.every": "0.5 ms", "output.structure.every": "0.5 ms"}
        self.same(EVERY, alone, "1.1 ms", "structure=1", ["strip.com_x"])


class Absent(unittest.TestCase):
    def test_no_process_and_no_task(self):
        run = testing.good_run(EVERY, ALONE)
        for word in "magfsi.controller", "ask controller":
            self.assertNotIn(word, run.out)
        steered = testing.good_run(EVERY, with_control(ALONE, of("return 0, 0, 1e-3")))
        for word in "magfsi.controller", "ask controller":
            self.assertIn(word, steered.out)


class Page(unittest.TestCase):
    def test_its_example_steers(self):
        """docs/control.md"""
        script = (testing.ROOT / "docs/control.md").read_text().split("```python\n")[1].split("```")[0]
        run = testing.good_run(testing.SMALL, with_control(COUPLED, script, "0.5 ms",
                                                           ["robot.com_z", "robot.speed_z"]))
        probes = run.probes()
        # What it has returned of what it saw, up to here proportional: the sum is 1e-3 of the error.
        at = probes["t[s]"].index(max(t for t in probes["t[s]"] if t < 1e-3))
        seen = 0.004 - probes["robot.com_z[m]"][5]
        self.assertAlmostEqual(probes["field_z[T]"][at], 0.01 + (2 + 2 * 10e-3) * seen, delta=2e-5)


if __name__ == "__main__":
    unittest.main()
