#!/usr/bin/python3
"""What each effect costs on a small reference scene, on against off: prints docs/effects.md.

    MAGFSI_BIN=build/release/bin tests/bench/effects/costs.py > docs/effects.md

Instructions are those within the steps (valgrind's callgrind). Seconds are of processor time of the
whole run, start-up included: medians of pairs on, off, on, off, ..."""

import functools
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

os.environ["MAGFSI_BIN"] = str(Path(os.environ.get("MAGFSI_BIN", "build/release/bin")).resolve())
for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"):
    os.environ.setdefault(name, "1")
os.environ["OMP_NUM_THREADS"] = "1"
TESTS = Path(__file__).resolve().parents[2]
sys.path += [str(TESTS / "support"), str(TESTS / "effects")]
import instructions
import magfsi_runs as magfsi

PAIRS = int(os.environ.get("MAGFSI_PAIRS", "5"))

FREE = {"magnetic_field": "null", "gravity": "null", "damping": "null", "platform": "null",
        "contact": "null", "probes": "null", "bodies.strip.material.viscosity": "null",
        "bodies.strip.magnetization": "null"}
MAGNET = {"bodies.strip.magnetization": "{harmonic: {amplitude: 62 kA/m, phase: 45 deg}}",
          "magnetic_field": "{constant: {magnitude: 17 mT, direction: 45 deg}}"}
FALL = {"gravity": "{acceleration: 9.81 m/s2}"}
GROUND = {**FALL, "platform": "{point: [0 mm, 0 mm, 0.11 mm]}"}
LID = "fluid.boundaries.z_max"
SIDES = "fluid.boundaries"
STRUCTURE_SCENE = TESTS / "scenes/every_structure_effect.yaml"
FLUID_SCENE = TESTS / "effects/still_fluid.yaml"

# What: (with, without); the scene otherwise bare.
STRUCTURE = {
    "viscosity": ({"bodies.strip.material.viscosity": "5 Pa s"}, {}),
    "magnetic field": (MAGNET, {}),
    "field gradient": ({**MAGNET, "magnetic_field.gradient.matrix": "[[1 T/m, 0 T/m, 0 T/m], "
                        "[0 T/m, 0 T/m, 0 T/m], [0 T/m, 0 T/m, -1 T/m]]"}, MAGNET),
    "gravity": (FALL, {}),
    "damping": ({"damping.rate": "10 1/s"}, {}),
    "platform": (GROUND, FALL),
    "friction": ({**GROUND, "platform.friction": "0.3"}, GROUND),
    "contact": ({"contact": "{}"}, {}),
    "clamps": ({"bodies.strip.clamps": "[x_min]"}, {}),
    "rollers": ({"bodies.strip.rollers": "[{face: x_min, axis: x}]"}, {}),
    "probes, every 10 steps": ({"probes": "{every: 10 us, bodies: [com, shape]}"}, {}),
    "structure fields, every 10 steps": ({"output.structure.every": "10 us"}, {}),
}
FLUID = {
    "body force": ({"fluid.body_force": "[1 N/m3, 0 N/m3, 0 N/m3]"}, {}),
    "eddy viscosity": ({"fluid.smagorinsky.constant": "0.1"}, {}),
    "moving wall": ({LID: "{no_slip: {velocity: [0.01 m/s, 0 m/s, 0 m/s]}}"}, {}),
    "free slip, one side": ({LID: "free_slip"}, {}),
    "inlet and outlet": ({SIDES: "{x_min: {velocity_inlet: {velocity: [0.01 m/s, 0 m/s, "
                          "0 m/s]}}, x_max: pressure_outlet}"}, {}),
    "obstacle": ({"fluid.obstacles.ball.sphere":
                  "{centre: [16 mm, 16 mm, 16 mm], diameter: 10 mm}"}, {}),
    "probes, every 10 steps": ({"probes": "{every: 5 ms, fluid: [kinetic_energy]}"}, {}),
    "fluid fields, every 10 steps": ({"output.fluid": "{every: 5 ms, fields: [velocity]}"}, {}),
    "checkpoint, every 10 steps": ({"checkpoint.every": "5 ms"}, {}),
}
PARTS = [
    ("structure", "magfsi-structure", STRUCTURE, STRUCTURE_SCENE,
     # One step for all, so that a stiffer scene has no more of them.
     {**FREE, "time.step": "1 us"}, {"time.end": "50 us"}, {"time.end": "5 ms"}),
    ("fluid", "magfsi-fluid-lbm", FLUID, FLUID_SCENE,
     {"fluid.box": "[32 mm, 32 mm, 32 mm]"}, {"time.end": "10 ms"}, {"time.end": "100 ms"}),
]


def seconds(program, scene, settings):
    """(processor seconds, bytes) of a run."""
    folder = Path(magfsi.new_folder())
    command = [magfsi.BIN / program, scene, "--out", folder, "--progress", "plain",
               *magfsi.overrides(settings)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = magfsi.Run(0, "", "", 0, folder).summary()
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            next(iter(summary["memory_bytes"].values())))


@functools.cache
def count(program, scene, settings):
    return instructions.of_steps(magfsi.BIN / program, scene, dict(settings))


def row(name, program, scene, on, off, short, long):
    counts = [count(program, scene, tuple({**s, **short}.items())) for s in (on, off)]
    pairs = [[seconds(program, scene, {**s, **long}) for s in (on, off)] for _ in range(PAIRS)]
    time = [statistics.median(pair[i][0] for pair in pairs) for i in (0, 1)]
    memory = [statistics.median(pair[i][1] for pair in pairs) for i in (0, 1)]
    return (f"| {name} | {100 * (counts[0] / counts[1] - 1):+.2f} % | {time[1]:.2f} | "
            f"{time[0] - time[1]:+.2f} | {(memory[0] - memory[1]) / 1e6:+.2f} |")


HEAD = """# What effects cost

Each effect on a small reference scene, on against off. An effect that is off costs nothing:
`tests/effects/removed.py` ([adding_an_effect.md](adding_an_effect.md)). Instructions are those
within the steps, start and end apart; seconds are processor time of a longer run with start-up,
medians of {pairs} pairs on and off in turn; memory is the largest resident.

Made by

    MAGFSI_BIN=build/release/bin tests/bench/effects/costs.py > docs/effects.md
"""
INTRO = {
    "structure": """
## Structure

A bare strip of 20 x 8 elements in LAMMPS, one rank, steps of 1 us; the platform touches from the
start.
""",
    "fluid": """
## Fluid

32 x 32 x 32 cells between walls at rest, one rank, avx2 under callgrind.
""",
}


def main():
    print(HEAD.format(pairs=PAIRS))
    for part, program, effects, scene, common, short, long in PARTS:
        print(INTRO[part])
        print("| effect | instructions | seconds without | seconds more | MB more |")
        print("|---|---|---|---|---|")
        for name, (on, off) in effects.items():
            print(row(name, program, scene, {**common, **on}, {**common, **off}, short, long),
                  flush=True)


if __name__ == "__main__":
    main()
