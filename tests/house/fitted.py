# SPDX-License-Identifier: GPL-2.0-or-later
"""Each number of base/fitted/constants.h says which tests hold it, which are there, and is used.

    fitted.py BUILD      the build's folder, whose tests are listed by ctest
"""
import re
import sys
import unittest
from pathlib import Path

from tiers import tiers_of_tests

ROOT = Path(__file__).resolve().parents[2]
HEADER = ROOT / "base/fitted/constants.h"
ROOMS = ("structure", "fluid_lbm", "coupler", "adapters")


def constants():
    """(names of numbers, tests in their comment) of each paragraph with numbers; None: no "Test:"."""
    for paragraph in HEADER.read_text().split("\n\n"):
        comment = " ".join(re.findall(r"^// ?(.*)$", paragraph, re.M))
        code = re.sub(r"^//.*\n", "", paragraph, flags=re.M)
        names = [name for statement in re.findall(r"inline constexpr [^;]*;", code)
                 for name in re.findall(r"(\w+)(?: = |\{)", statement)]
        tests = re.search(r"Test: ([\w, ]+)\.$", comment)
        if names:
            yield names, tests and tests[1].split(", ")


class Fitted(unittest.TestCase):
    def test_every_number_names_tests_that_are_there(self):
        known = tiers_of_tests()
        count = 0
        for names, tests in constants():
            count += len(names)
            self.assertTrue(tests, f"{names}: no line 'Test: NAME, NAME.' or 'Test: none.' at the end")
            for test in tests if tests != ["none"] else []:
                self.assertIn(test, known, f"{names}: there is no such test")
        self.assertGreater(count, 50)

    def test_every_number_is_used(self):
        words = {word for room in ROOMS for path in (ROOT / room).rglob("*")
                 if path.suffix in (".h", ".cpp") for word in re.findall(r"\w+", path.read_text())}
        for names, _ in constants():
            for name in names:
                self.assertTrue(name in words, f"{name} of {HEADER.name} is used nowhere")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
