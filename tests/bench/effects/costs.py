# SPDX-License-Identifier: GPL-2.0-or-later
"""What each effect costs on a small reference scene, on against off: prints docs/lab/effects.md.

    ./magfsi python tests/bench/effects/costs.py > docs/lab/effects.md
    ... costs.py structure            one part of it: structure, fluid, coupled

Instructions are those within the steps (valgrind's callgrind), which are exact: of coupled scenes
each side's, without MPI. Seconds are of whole runs, start-up included, in pairs on, off, on, off,
...: processor time of the one process, or, where two wait for each other, the run's own wall
time."""

import functools
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

import reference
from magfsi import instructions, runs, testing

os.environ["OMP_NUM_THREADS"] = "1"

PAIRS = int(os.environ.get("MAGFSI_PAIRS", "5"))
STRUCTURE, FLUID = "magfsi-structure", "magfsi-fluid-lbm"


def alone(program):
    """(processor seconds, bytes) of a run of this program alone."""
    def measure(scene, settings):
        folder = Path(testing.new_folder())
        command = [testing.BIN / program, scene, "--out", folder, "--progress", "plain",
                   *testing.overrides(settings)]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
                memory(runs.Run(0, "", "", 0, folder)))
    return measure


def memory(run):
    return sum(run.summary()["memory_bytes"].values())


def together(scene, settings):
    """(wall seconds of the steps, bytes) of a run of both sides, one rank each."""
    run = testing.good_run(scene, settings, ranks="structure=1,fluid=1")
    return run.summary()["wall_s"], memory(run)


@functools.cache
def count(program, scene, settings):
    if program is None:
        return instructions.of_both_sides(scene, dict(settings))
    return [instructions.of_steps(testing.BIN / program, scene, dict(settings))]


def more(on, off):
    return f"{100 * (on / off - 1):+.2f} %"


def row(name, counts, measure, scene, on, off):
    pairs = [[measure(scene, settings) for settings in (on, off)] for _ in range(PAIRS)]
    differences = [pair[0][0] - pair[1][0] for pair in pairs]
    without = statistics.median(pair[1][0] for pair in pairs)
    bytes_ = [statistics.median(pair[i][1] for pair in pairs) for i in (0, 1)]
    print(f"| {name} | {' | '.join(counts)} | {without:.3f} | "
          f"{statistics.median(differences):+.3f} | {min(differences):+.3f} to "
          f"{max(differences):+.3f} | {(bytes_[0] - bytes_[1]) / 1e6:+.2f} |", flush=True)


def rows(program, measure, scene, effects, common, short, long):
    """short: settings of the runs that are counted; long: of those that are timed."""
    for name, (on, off) in effects.items():
        on, off = {**common, **on}, {**common, **off}
        counts = [count(program, scene, tuple({**s, **short}.items())) for s in (on, off)]
        row(name, [more(*pair) for pair in zip(*counts)], measure, scene,
            {**on, **long}, {**off, **long})


HEAD = """# What effects cost

The cost of each effect on a small reference scene: with it, compared with without it. That an effect which is a folder costs
nothing where it is off, `tests/effects/removed.py` shows ([adding_an_effect.md](../adding_an_effect.md)). Instructions are those
within the steps, start and end apart; seconds are of longer runs, medians of {pairs} pairs on and
off in turn, with the smallest and largest difference of a pair; memory is the largest resident.

Made by

```sh
./magfsi python tests/bench/effects/costs.py > docs/lab/effects.md
```

Every step of every scene checks for NaN: the structure at its nodes, the fluid within its
sweep. A scene cannot switch that off; it takes {watch}.
"""
TABLE = """
## {title}

{text}

| effect | {columns} | seconds without | more | from, to | MB more |
|---|{bars}---|---|---|---|
"""


def table(title, text, columns):
    print(TABLE.format(title=title, text=text, columns=" | ".join(columns),
                       bars="---|" * len(columns)), end="", flush=True)


def structure():
    table("Structure", "A bare strip of 20 x 8 elements in LAMMPS, one rank, 5000 steps of 1 us;\n"
          "the platform touches from the start. Processor time.", ["instructions"])
    # One step for all, so that a stiffer scene has no more of them.
    rows(STRUCTURE, alone(STRUCTURE), reference.STRUCTURE_SCENE, reference.STRUCTURE,
         {**reference.FREE, "time.step": "1 us"}, {"time.end": "50 us"}, {"time.end": "5 ms"})


def fluid():
    table("Fluid", "32 x 32 x 32 cells between walls at rest, one rank, 400 steps; avx2 under\n"
          "callgrind. Processor time.", ["instructions"])
    rows(FLUID, alone(FLUID), reference.FLUID_SCENE, reference.FLUID,
         {"fluid.box": "[32 mm, 32 mm, 32 mm]"}, {"time.end": "10 ms"}, {"time.end": "200 ms"})


def coupled():
    table("Coupled", "The small swimmer of the tests: 40 elements and 48 markers in 32 x 16 x 32\n"
          "cells, one rank a side, 160 coupled steps of 6 LAMMPS steps. Wall time of the steps.",
          ["instructions of the structure", "of the fluid"])
    scene, short, long = reference.COUPLED_SCENE, {"time.end": "0.2 ms"}, {"time.end": "4 ms"}
    bare = {"probes": "null"}
    boundary(scene, bare, short, long)
    rows(None, together, scene, reference.COUPLED, bare, short, long)


def boundary(scene, bare, short, long):
    """Against both sides alone, one after the other."""
    on = count(None, scene, tuple({**bare, **short}.items()))
    apart = [(STRUCTURE, reference.BODY_ALONE), (FLUID, reference.FLUID_ALONE)]
    off = [count(program, scene, tuple({**settings, **short}.items()))[0]
           for program, settings in apart]

    def measure(scene, settings):
        if settings is not None:
            return together(scene, settings)
        runs = [testing.good_run(scene, {**s, **long}) for _, s in apart]
        return sum(run.summary()["wall_s"] for run in runs), sum(map(memory, runs))

    row("immersed boundary", [more(*pair) for pair in zip(on, off)], measure, scene,
        {**bare, **long}, None)


def watch():
    """The share of the NaN checks in the instructions of the steps."""
    settings = {**reference.FREE, "time.step": "1 us", "time.end": "50 us"}
    node = instructions.share_of_steps(testing.BIN / STRUCTURE, reference.STRUCTURE_SCENE,
                                       settings, "atom_without_place")
    cell = instructions.share_of_steps(
        testing.BIN / FLUID, reference.FLUID_SCENE,
        {"fluid.box": "[32 mm, 32 mm, 32 mm]", "time.end": "10 ms"}, "check_divergence")
    return (f"{100 * node:.1f} % of the structure's instructions in steps of one LAMMPS step, and, "
            f"beside\nthe sweep's own, {100 * cell:.4f} % of the fluid's")


PARTS = {"structure": structure, "fluid": fluid, "coupled": coupled}


def main():
    for name in sys.argv[1:]:
        if name not in PARTS:
            sys.exit(f"no part {name}; there are {', '.join(PARTS)}")
    if not sys.argv[1:]:
        print(HEAD.format(pairs=PAIRS, watch=watch()), end="")
    for name in sys.argv[1:] or PARTS:
        PARTS[name]()


if __name__ == "__main__":
    main()
