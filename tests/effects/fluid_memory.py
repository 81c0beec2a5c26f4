# SPDX-License-Identifier: GPL-2.0-or-later
"""The fluid takes the memory that `explain` predicts: its populations and what the scene's
effects add, and hardly anything else. A process has its program and libraries besides, about
50 MB: they are what the same scene takes in a box of few cells, and are subtracted."""

import re
import subprocess
import unittest
from pathlib import Path

from magfsi import testing

SCENE = Path(__file__).resolve().parent / "still_fluid.yaml"
LARGE, SMALL = "[96 mm, 96 mm, 96 mm]", "[16 mm, 16 mm, 16 mm]"
EVERY = 1  # 3: each third of the cases
STEP = {"time.end": "1 ms"}  # two steps: all that is ever allocated is then there

SUMS = {"probes": "{every: 1 ms, fluid: [kinetic_energy]}"}
ENSTROPHY = {"probes": "{every: 1 ms, fluid: [enstrophy]}"}
CASES = {
    "nothing else": {},
    "float": {"fluid.precision": "float"},
    "sums": SUMS,
    "enstrophy": ENSTROPHY,
    "fields": {"output.fluid": "{every: 1 ms, fields: [velocity, vorticity]}"},
    "obstacle": {"fluid.obstacles.ball.sphere":
                 "{centre: [8 mm, 8 mm, 8 mm], diameter: 6 mm}"},
    "eddy viscosity, body force": {"fluid.smagorinsky.constant": "0.1",
                                   "fluid.body_force": "[1 N/m3, 0 N/m3, 0 N/m3]"},
}


# Beside a robot, spacings of a large and a small grid: what markers need is in it, and the
# ghost rows between two ranks.
COUPLED = {
    "swimmer": (testing.SWIMMER, "0.2 mm", "0.4 mm", 1),
    "swimmer, two ranks": (testing.SWIMMER, "0.16 mm", "0.32 mm", 2),
    "small swimmer": (testing.SMALL, "0.125 mm", "0.25 mm", 1),
    # The cut goes through the body, so that both ranks know all its markers. MPI's own buffers
    # for longer ghost rows are 0.3 to 1 MB a rank: little on grids as large as these.
    "small swimmer, two ranks": (testing.SMALL, "0.08 mm", "0.16 mm", 2),
}
FEW_STEPS = {"time.end": "0.1 ms", "output": "{}", "probes": "null"}


def predicted(settings, scene=SCENE, ranks="fluid=1"):
    text = subprocess.run([testing.BIN / "magfsi", "explain", scene, "--ranks", ranks,
                           *testing.overrides(settings)],
                          check=True, capture_output=True, text=True).stdout
    populations = float(re.search(r"memory: ([\d.]+) MB of populations", text)[1])
    return populations, float(re.search(r"at most ([\d.]+) MB beside", text)[1])


def measured(settings, scene=SCENE, ranks="fluid=1"):
    result = testing.good_run(scene, settings, ranks=ranks)
    return result.summary()["memory_bytes"]["fluid"] / 1e6


class Memory(unittest.TestCase):
    # Within 5 %, as is asked for; it is met within 2 %.
    def test_is_that_of_explain(self):
        for name, effect in list(CASES.items())[::EVERY]:
            with self.subTest(name):
                large, small = ({**STEP, **effect, "fluid.box": box} for box in (LARGE, SMALL))
                populations, most = (a - b for a, b in zip(predicted(large), predicted(small)))
                taken = measured(large) - measured(small)
                testing.report(f"{name}: {taken:.1f} MB, predicted {most:.1f} MB, "
                              f"populations {populations:.1f} MB")
                self.assertLess(abs(taken / most - 1), 0.05)
                if name in ("nothing else", "float", "sums"):
                    self.assertLess(taken / populations, 1.05)

    def test_is_that_of_explain_beside_a_robot(self):
        for name, (scene, fine, coarse, ranks) in COUPLED.items():
            with self.subTest(name):
                grids = [{**FEW_STEPS, "fluid.spacing": spacing} for spacing in (fine, coarse)]
                on = f"structure=1,fluid={ranks}"
                populations, most = (a - b for a, b in zip(*(predicted(grid, scene, on)
                                                             for grid in grids)))
                taken = measured(grids[0], scene, on) - measured(grids[1], scene, on)
                testing.report(f"{name}: {taken:.1f} MB, predicted {most:.1f} MB, "
                              f"populations {populations:.1f} MB")
                self.assertLess(abs(taken / most - 1), 0.05)


if __name__ == "__main__":
    testing.main(EVERY=EVERY)
