#!/usr/bin/python3
"""An absent effect costs nothing: a scene without it executes the same instructions in its
steps as in a program from which all that is the effect's own has been removed.

    MAGFSI_BIN=build/release/bin tests/effects/removed.py            of all effects
    MAGFSI_BIN=build/release/bin tests/effects/removed.py drag       of this one

CTest runs a slice of it."""

import functools
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

os.environ["MAGFSI_BIN"] = str(Path(os.environ.get("MAGFSI_BIN", "build/release/bin")).resolve())
for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"):
    os.environ.setdefault(name, "1")
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
sys.path.insert(0, str(HERE))
import instructions
import magfsi_runs as magfsi
import variant
from effects import ALWAYS_THERE, EFFECTS, of_explained

# What is asked for. Two counts of one program differ by less than a tenth of it.
BOUND = 1e-3


def chosen():
    """The effects named on the command line, or all."""
    names = [word for word in sys.argv[1:] if not word.startswith("-")]
    for name in names:
        if name not in EFFECTS:
            sys.exit(f"no effect {name}; there are {', '.join(EFFECTS)}")
    return names or list(EFFECTS)


NAMES = chosen()


@functools.cache
def counted(coupled, program, scene, settings):
    of = instructions.of_coupled_steps if coupled else instructions.of_steps
    return of(program, scene, dict(settings))


def count(case, program, settings):
    """Of scenes that many effects are absent from, once."""
    return counted(case.coupled, program, case.scene,
                   tuple({**case.absent, **settings}.items()))


# What may stand in the place of an object that is gone.
NOTHING = re.compile(r"nullptr|false|\b0\b|\{\}|std::vector<Vec3>\{\}|\"advance fluid\"|\s")


def letters(lines):
    return "".join(NOTHING.sub("", line[1:]) for line in lines)


def within(short, long):
    """Whether all its letters stand in the other, in that order."""
    rest = iter(long)
    return all(letter in rest for letter in short)


class Removed(unittest.TestCase):
    def test_is_the_same_as_absent(self):
        for effect in NAMES:
            for case in EFFECTS[effect]:
                with self.subTest(effect=effect, program=case.program):
                    self.compare(effect, case)

    def compare(self, effect, case):
        here = count(case, magfsi.BIN / case.program, {})
        gone = count(case, variant.without(case.program, case.removal), {})
        what = f"{effect}, {case.program}{', coupled' if case.coupled else ''}"
        magfsi.report(f"{what}: {here} instructions absent, {gone} removed: "
                      f"{100 * (here / gone - 1):+.4f} %")
        self.assertLess(abs(here / gone - 1), BOUND)

    @unittest.skipUnless("drag" in NAMES, "of drag")
    def test_the_count_sees_an_effect_that_does_nothing(self):
        """A drag of rate 0 changes no velocity, and is seen all the same."""
        case = EFFECTS["drag"][0]
        null = count(case, magfsi.BIN / case.program,
                     {"damping": "{rate: 0 1/s}"})
        none = count(case, magfsi.BIN / case.program, {})
        magfsi.report(f"drag of rate 0: {100 * (null / none - 1):+.3f} % of the instructions")
        self.assertGreater(null / none - 1, BOUND)

    @unittest.skipUnless("drag" in NAMES, "of drag")
    def test_removed_and_asked_for_is_refused(self):
        case = EFFECTS["drag"][0]
        gone = variant.without(case.program, case.removal)
        result = magfsi.finish(magfsi.start([gone, case.scene, "--out", magfsi.new_folder(),
                                             "--set", "time.end=50 us"]), 0, "", 120)
        self.assertNotEqual(result.code, 0)
        self.assertIn("drag is asked for, and this program was built without it",
                      result.out + result.err)


class Table(unittest.TestCase):
    def test_has_every_effect_that_explain_names(self):
        told = subprocess.run([magfsi.BIN / "magfsi", "explain", magfsi.SMALL], check=True,
                              capture_output=True, text=True).stdout
        lists = re.findall(r"^  (?:structure step|coupled step|fluid step|outputs): (.*)$",
                           told, re.M)
        self.assertEqual(len(lists), 4)
        names = [name for line in lists for name in re.split(r"; absent: |, ", line)]
        for name in set(names) - {*ALWAYS_THERE}:
            for effect in of_explained(name):
                self.assertIn(effect, EFFECTS)


class Patches(unittest.TestCase):
    def test_only_take_away(self):
        """What a patch leaves of each place was there before, but for includes and nothings."""
        for patch in sorted(variant.PATCHES.glob("*.patch")):
            for hunk in re.split(r"^@@.*$", patch.read_text(), flags=re.M)[1:]:
                lines = [line for line in re.split(r"^--- ", hunk, flags=re.M)[0].splitlines()
                         if not line.startswith("+#include")]
                old = letters(line for line in lines if line.startswith("-"))
                new = letters(line for line in lines if line.startswith("+"))
                with self.subTest(patch=patch.name, hunk=hunk):
                    self.assertTrue(within(new, old))

    def test_fit_the_sources(self):
        """All, whatever effects are counted: sources change more often than counts are made."""
        for name in EFFECTS:
            for case in EFFECTS[name]:
                with self.subTest(name):
                    variant.overlay(case.removal, Path(magfsi.new_folder()))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
