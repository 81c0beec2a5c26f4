# SPDX-License-Identifier: GPL-2.0-or-later
"""What a search file may not say: one line with the place, exit code 2, nothing started."""
import os
import unittest
from pathlib import Path

from searches import TEXT, Search, testing


class Refused(unittest.TestCase):
    def refused(self, text, *words):
        search = Search(text)
        done = search.called()
        self.assertEqual(done.code, 2, done.err)
        self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
        for word in words:
            self.assertIn(word, done.err)
        self.assertFalse(search.records())

    def test_unknown_key(self):
        self.refused(TEXT + "methods: tpe\n", "study.yaml:16:1", '"methods"', 'did you mean "method"?')

    def test_unknown_parameter(self):
        self.refused(TEXT.replace("magnitude ** 2", "magnitud ** 2"), '"magnitud"',
                     "lift, magnitude, direction")

    def test_empty_range(self):
        self.refused(TEXT.replace("[0 mT, 0.4 mT]", "[0.4 mT, 0 mT]"), "study.yaml:10:",
                     "an empty range")

    def test_range_of_two_units(self):
        self.refused(TEXT.replace("[0 mT, 0.4 mT]", "[0 mm, 0.4 mT]"), "two numbers of one unit")

    def test_two_objectives(self):
        self.refused(TEXT + "minimize: lift\n", "both maximize and minimize")

    def test_two_methods(self):
        self.refused(TEXT + "method: [cmaes, tpe]\n", "cmaes, gaussian_process, tpe, random")

    def test_times_and_numbers_of_runs(self):
        self.refused(TEXT + "at_a_time: 0\n", "study.yaml:16:", "at least 1")
        self.refused(TEXT + "stop_early: [2 mm]\n", "study.yaml:16:", "a time such as")
        self.refused(TEXT.replace("number: final", "number: final, from: 2 s, until: 1 s"),
                     "a time after `from`")

    def test_words_with_cmaes(self):
        self.refused(TEXT.replace("parameters:", "parameters:\n  element: {key: bodies.beam.element, "
                                  "values: [full, assumed_strain]}"), "cmaes with parameters that are words")

    def test_absent_probe(self):
        search = Search(TEXT.replace("tip_uz[m]", "tip_uq[m]"))
        done = search.run()
        self.assertEqual(done.code, 2, done.err)
        self.assertIn('"tip_uq[m]"; allowed a column of probes.csv:', done.err)

    def test_scene_that_cannot_run(self):
        self.refused(TEXT.replace("magnetic_field.constant.magnitude", "magnetic_field.strength"),
                     "what cannot run")

    def test_another_search_in_the_same_folder(self):
        search = Search(TEXT.replace("runs: 30", "runs: 1"))
        search.good_run()
        search.file.write_text(search.file.read_text().replace("0.4 mT", "0.5 mT"))
        done = search.run()
        self.assertEqual(done.code, 2, done.err)
        self.assertIn("another --out", done.err)

    def test_package_that_is_missing(self):
        self.missing("optuna", TEXT)
        self.missing("sklearn", TEXT + "method: gaussian_process\n")

    def missing(self, package, text):
        search = Search(text)
        (search.folder / f"{package}.py").write_text(f"raise ImportError(name='{package}')\n")
        before = os.environ["PYTHONPATH"]
        os.environ["PYTHONPATH"] = f"{search.folder}:{before}"
        try:
            done = search.run()
        finally:
            os.environ["PYTHONPATH"] = before
        self.assertEqual(done.code, 1)
        self.assertIn(f"apt install python3-{package}", done.err)


if __name__ == "__main__":
    unittest.main()
