# SPDX-License-Identifier: GPL-2.0-or-later
"""Every test is in one tier; the table of claims in CONTRIBUTING.md names tests that are there, its walks
functions that are in the files beside them.

    tiers.py BUILD      the build's folder, whose tests are listed by ctest
"""
import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TIERS = ("quick", "short", "all", "long")
ROW = re.compile(r"^\| (?P<claim>[^|]+) \| (?P<small>[^|]+) \| (?P<whole>[^|]+) \|$", re.M)


def tiers_of_tests():
    listed = json.loads(subprocess.check_output(["ctest", "--test-dir", sys.argv[1],
                                                 "--show-only=json-v1"]))
    tiers = {}
    for test in listed["tests"]:
        labels = [label for p in test["properties"] if p["name"] == "LABELS" for label in p["value"]]
        tiers[test["name"]] = [label for label in labels if label in TIERS]
    return tiers


class Tiers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tiers = tiers_of_tests()

    def test_every_test_has_one(self):
        self.assertGreater(len(self.tiers), 100)
        for name, found in self.tiers.items():
            self.assertEqual(len(found), 1, f"{name}: {found}; allowed is one of {TIERS}")

    def names_of(self, cell):
        return re.findall(r"`([a-z0-9_]+)`", cell)

    def test_every_claim_has_a_small_case(self):
        text = (ROOT / "CONTRIBUTING.md").read_text()
        section = text.split("## Claims and their tests")[1].split("\n## ")[0]
        rows = [row for row in ROW.finditer(section) if "---" not in row[0] and "`" in row["small"]]
        self.assertGreater(len(rows), 25)
        # OpenFOAM's tests are there where OpenFOAM is.
        with_openfoam = any(name.startswith("openfoam_coupled") for name in self.tiers)
        for row in rows:
            for column, tiers in (("small", ("quick", "short")), ("whole", ("all", "long", "quick", "short"))):
                for name in self.names_of(row[column]):
                    if name.startswith("openfoam") and not with_openfoam:
                        continue
                    known = self.tiers.get(name) or self.tiers.get(name + "_1") or self.tiers.get(name + "_2")
                    self.assertIsNotNone(known, f"{row['claim']}: there is no test {name}")
                    self.assertIn(known[0], tiers, f"{row['claim']}: {name}")


class Walks(unittest.TestCase):
    def test_each_function_is_in_its_file(self):
        text = (ROOT / "CONTRIBUTING.md").read_text().split("## Three walks")[1].split("\n## ")[0]
        # "`Class::name` ... ([file](path))"; names in between say who calls it.
        steps = re.findall(r"`([\w:.]+)[^`]*`[^\[\]]*\(\[[^\]]+\]\(([^)]+)\)", text)
        self.assertGreater(len(steps), 20)
        for function, file in steps:
            name = re.split(r"::|\.", function)[-1]
            self.assertRegex((ROOT / file).read_text(), rf"\b{name}\b", f"{function} in {file}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
