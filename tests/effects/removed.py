# SPDX-License-Identifier: GPL-2.0-or-later
"""An absent effect costs nothing: a scene without it executes the same instructions in its
steps as in a program that was built without the effect's files and its line in a list.

    ./magfsi python tests/effects/removed.py            of all effects
    ./magfsi python tests/effects/removed.py drag       of this one
    ./magfsi python tests/effects/removed.py Removed.test_is_the_same_as_absent    this test alone
"""

import functools
import re
import sys
import unittest
from dataclasses import dataclass
from pathlib import Path

from magfsi import instructions
from magfsi import testing
import variant
from variant import Removal

# What is asked for. Two counts of one program differ by less than a fifth of it.
BOUND = 1e-3
STRUCTURE, FLUID = "magfsi-structure", "magfsi-fluid-lbm"
# The lists of effects, each with the folder beside it; of outputs, by the program that writes.
STRUCTURE_LIST, FLUID_LIST = "structure/lammps/effects.inc", "fluid_lbm/effects.inc"
OUTPUT_LISTS = {STRUCTURE: "adapters/solvers/lammps/outputs.inc", FLUID: "adapters/solvers/fluids/outputs.inc"}

# Scenes with every effect but the one that is looked at, and settings that shorten them.
TESTS = testing.ROOT / "tests"
SCENES = {STRUCTURE: (TESTS / "scenes/every_structure_effect.yaml", {"time.end": "50 us"}),
          FLUID: (TESTS / "effects/still_fluid.yaml",
                  {"time.end": "20 ms",
                   "fluid.boundaries": "{x_min: periodic, x_max: periodic}"})}
COUPLED = (testing.SMALL, {"time.end": "0.2 ms"})


@dataclass(frozen=True)
class Case:
    """program: whose instructions are counted; settings: with which the scene is short and
    without the effect."""

    program: str
    scene: Path
    removal: Removal
    settings: dict
    coupled: bool = False


def case(program, registry, name, absent, files=(), coupled=False):
    """files: beside its own file or folder, what only the effect uses."""
    scene, short = COUPLED if coupled else SCENES[program]
    folder = registry.removesuffix(".inc")
    own = (f"{folder}/{name}.cpp", f"{folder}/{name}/*", *files)
    return Case(program, scene, Removal(name, own, registry),
                {**short, **absent}, coupled)


def of_structure(name, *files, **absent):
    return [case(STRUCTURE, STRUCTURE_LIST, name, absent, files)]


def of_fluid(name):
    return [case(FLUID, FLUID_LIST, name, {})]


def output(name, *files, absent=None, alone=(), coupled=()):
    """alone, coupled: the programs that write it, in a scene of their own and beside a partner."""
    return [case(program, OUTPUT_LISTS[program], name, absent or {}, files, beside)
            for beside, programs in ((False, alone), (True, coupled)) for program in programs]


BOTH = (STRUCTURE, FLUID)
EFFECTS = {
    "viscosity": of_structure("viscosity", **{"bodies.strip.material.viscosity": "null"}),
    "viscoelasticity": of_structure("viscoelasticity"),
    "magnetic_field": of_structure("magnetic_field", magnetic_field="null"),
    "turning_magnetization": of_structure("turning_magnetization"),
    "field_gradient": of_structure("field_gradient", **{"magnetic_field.gradient": "null"}),
    "field_sources": of_structure("field_sources"),
    "dipoles": of_structure("dipoles"),
    "gravity": of_structure("gravity", gravity="null"),
    "drag": of_structure("drag", damping="null"),
    "contact_load": of_structure("contact_load"),
    "platform": of_structure("platform", platform="null"),
    "contact": of_structure("contact", contact="null"),
    "walls": of_structure("walls"),
    "clamps": of_structure("clamps"),
    "rollers": of_structure("rollers"),
    "rigid_parts": of_structure("rigid_parts"),
    "quiet": of_structure("quiet"),
    "prescribed_motion": of_structure("prescribed_motion"),
    "moving_wall": of_fluid("moving_wall"),
    "free_slip": of_fluid("free_slip"),
    "velocity_inlet": of_fluid("velocity_inlet"),
    "pressure_outlet": of_fluid("pressure_outlet"),
    "overlap": output("overlap", "structure/mesh/proximity.*", "adapters/solvers/bodies/overlaps.*",
                      "adapters/solvers/bodies/solids_around.*", absent={"coupling.overlap": "allow"},
                      coupled=[STRUCTURE]),
    "probes": [*output("probes", alone=[FLUID]),
               *output("probes", absent={"probes": "null"}, alone=[STRUCTURE], coupled=BOTH)],
    "control": output("control", alone=[STRUCTURE]),
    "structure_fields": output("structure_fields", "adapters/solvers/bodies/structure_files.*",
                               alone=[STRUCTURE], coupled=[STRUCTURE]),
    "fluid_fields": output("fluid_fields", alone=[FLUID], coupled=[FLUID]),
    "own_files": output("own_files", alone=[FLUID], coupled=[FLUID]),
    "checkpoint": output("checkpoint", "coupler/checkpoint/checkpoints.*",
                         alone=BOTH, coupled=BOTH),
}


TESTS_BEGIN = "Removed."


def chosen():
    """The effects named on the command line, or all."""
    names = [word for word in sys.argv[1:] if not word.startswith(("-", TESTS_BEGIN))]
    for name in names:
        if name not in EFFECTS:
            sys.exit(f"no effect {name}; there are {', '.join(EFFECTS)}")
    return names or list(EFFECTS)


NAMES = chosen()


@functools.cache
def counted(coupled, program, scene, settings):
    """Of scenes that many effects are absent from, once."""
    of = instructions.of_coupled_steps if coupled else instructions.of_steps
    return of(program, scene, dict(settings))


def count(case, program, more=()):
    return counted(case.coupled, program, case.scene, tuple({**case.settings, **dict(more)}.items()))


class Removed(unittest.TestCase):
    def test_is_the_same_as_absent(self):
        for effect in NAMES:
            for case in EFFECTS[effect]:
                with self.subTest(effect=effect, program=case.program):
                    self.compare(effect, case)

    def compare(self, effect, case):
        here = count(case, testing.BIN / case.program)
        gone = count(case, variant.without(case.program, case.removal))
        what = f"{effect}, {case.program}{', coupled' if case.coupled else ''}"
        testing.report(f"{what}: {here} instructions absent, {gone} removed: "
                      f"{100 * (here / gone - 1):+.4f} %")
        self.assertLess(abs(here / gone - 1), BOUND)

    @unittest.skipUnless("drag" in NAMES, "of drag")
    def test_the_count_sees_an_effect_that_does_nothing(self):
        """A drag of rate 0 changes no velocity, and is seen all the same."""
        case = EFFECTS["drag"][0]
        null = count(case, testing.BIN / case.program, {"damping": "{rate: 0 1/s}"})
        none = count(case, testing.BIN / case.program)
        testing.report(f"drag of rate 0: {100 * (null / none - 1):+.3f} % of the instructions")
        self.assertGreater(null / none - 1, BOUND)

    @unittest.skipUnless("drag" in NAMES, "of drag")
    def test_removed_and_asked_for_is_refused(self):
        case = EFFECTS["drag"][0]
        gone = variant.without(case.program, case.removal)
        result = testing.finish(testing.start([gone, case.scene, "--out", testing.new_folder(),
                                             "--set", "time.end=50 us"]), 0, "", 120)
        self.assertNotEqual(result.code, 0)
        self.assertIn("drag is asked for, and this program was built without it",
                      result.out + result.err)

    def test_every_line_of_the_lists_is_an_effect_here(self):
        for registry in (STRUCTURE_LIST, FLUID_LIST, *OUTPUT_LISTS.values()):
            names = re.findall(r"^MAGFSI_\w+\((\w+)\)", (testing.ROOT / registry).read_text(), re.M)
            self.assertTrue(names, registry)
            for name in names:
                registries = {case.removal.registry for case in EFFECTS.get(name, ())}
                self.assertIn(registry, registries, name)


if __name__ == "__main__":
    TESTS = [word for word in sys.argv[1:] if word.startswith(TESTS_BEGIN)]
    unittest.main(argv=[sys.argv[0], *TESTS])
