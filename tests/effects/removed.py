#!/usr/bin/python3
"""An absent effect costs nothing: a scene without it executes the same instructions in its
steps as in a program from which the effect's folder and its registration line are removed.

    MAGFSI_BIN=build/release/bin tests/effects/removed.py            of all effects
    MAGFSI_BIN=build/release/bin tests/effects/removed.py drag       of this one

CTest runs a slice of it."""

import os
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

STRUCTURE = ("magfsi-structure", "structure/lammps/effects.inc",
             HERE.parent / "scenes/every_structure_effect.yaml", {"time.end": "50 us"})
FLUID = ("magfsi-fluid-lbm", "fluid_lbm/effects.inc", HERE / "still_fluid.yaml",
         {"time.end": "20 ms", "fluid.boundaries": "{x_min: periodic, x_max: periodic}"})

# Effect: (program, list, scene, settings of all runs, settings that take it out of the scene)
# The scenes of the structure have every effect but the one that is looked at.
EFFECTS = {
    "drag": (*STRUCTURE, {"damping": "null"}),
    "gravity": (*STRUCTURE, {"gravity": "null"}),
    "platform": (*STRUCTURE, {"platform": "null"}),
    "contact": (*STRUCTURE, {"contact": "null"}),
    "free_slip": (*FLUID, {}),
    "moving_wall": (*FLUID, {}),
    "velocity_inlet": (*FLUID, {}),
    "pressure_outlet": (*FLUID, {}),
}
# Two counts of one program differ by less than 0.01 %: what the clock decides, such as the
# lines of progress. 0.1 % is what is asked for.
BOUND = 1e-3


def chosen():
    """The effects named on the command line, or all."""
    names = [word for word in sys.argv[1:] if not word.startswith("-")]
    for name in names:
        if name not in EFFECTS:
            sys.exit(f"no effect {name}; there are {', '.join(EFFECTS)}")
    return names or list(EFFECTS)


class Removed(unittest.TestCase):
    def test_is_the_same_as_absent(self):
        for effect in NAMES:
            with self.subTest(effect):
                program, registry, scene, common, absent = EFFECTS[effect]
                settings = {**common, **absent}
                here = instructions.of_steps(magfsi.BIN / program, scene, settings)
                gone = instructions.of_steps(variant.without(program, registry, effect), scene,
                                             settings)
                magfsi.report(f"{effect}: {here} instructions absent, {gone} removed: "
                              f"{100 * (here / gone - 1):+.4f} %")
                self.assertLess(abs(here / gone - 1), BOUND)

    def test_the_count_sees_an_effect_that_does_nothing(self):
        """A drag of rate 0 changes no velocity, and is seen all the same."""
        program, _, scene, common, absent = EFFECTS["drag"]
        null = instructions.of_steps(magfsi.BIN / program, scene,
                                     {**common, "damping.rate": "0 1/s"})
        none = instructions.of_steps(magfsi.BIN / program, scene, {**common, **absent})
        magfsi.report(f"drag of rate 0: {100 * (null / none - 1):+.3f} % of the instructions")
        self.assertGreater(null / none - 1, BOUND)

    def test_removed_and_asked_for_is_refused(self):
        program, registry, scene, common, _ = EFFECTS["drag"]
        gone = variant.without(program, registry, "drag")
        result = magfsi.finish(magfsi.start([gone, scene, "--out", magfsi.new_folder(),
                                             *magfsi.overrides(common)]), 0, "", 120)
        self.assertNotEqual(result.code, 0)
        self.assertIn("drag is asked for, and this program was built without it",
                      result.out + result.err)


if __name__ == "__main__":
    NAMES = chosen()
    unittest.main(argv=sys.argv[:1])
