# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost and error of the coupling schemes on the small swimmer at a fixed drag coefficient, as a
table. The reference is the implicit scheme at an eighth of the scene's step: what it shares with
the others, the lattice's own error of the step, is in all figures.

    ./magfsi python tests/bench/coupling/schemes.py
"""

import math
import resource

from magfsi import testing

STEP_US = 25
END = "2 ms"
COLUMNS = {"speed": "robot.speed_z[m/s]", "bend": "robot.bend[rad]"}
IMPLICIT = {"coupling.scheme": "implicit"}
SCHEMES = {
    "serial": {},
    "serial, linear": {"coupling.sampled_velocity": "linear"},
    "implicit, iqn_ils": IMPLICIT,
    "implicit, aitken": {**IMPLICIT, "coupling.iteration.acceleration": "aitken"},
}


def run(settings, parts):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = testing.good_run(testing.SMALL, {
        "time.end": END, "time.step": f"{STEP_US / parts} us",
        "coupling.immersed_boundary.forcing": "penalty",
        "coupling.immersed_boundary.strength": 1 / parts, **settings},
        "structure=1,fluid=1")
    return done, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def error(found, reference, column):
    pairs = list(zip(found[column], reference[column], strict=True))
    return (math.sqrt(sum((a - b)**2 for a, b in pairs) / len(pairs))
            / max(abs(b) for _, b in pairs))


def main():
    reference = run({**IMPLICIT, "coupling.iteration.velocity_tolerance": 1e-6}, 8)[0].probes()
    print("| scheme | step [us] | iterations a step | CPU [s] | error of the speed | of the bend |")
    print("|---|---|---|---|---|---|")
    for name, settings in SCHEMES.items():
        for parts in (1, 2, 4):
            done, seconds = run(settings, parts)
            iterations = done.summary().get("iterations", {"mean": 1})["mean"]
            errors = [f"{100 * error(done.probes(), reference, c):.2g} %"
                      for c in COLUMNS.values()]
            print(f"| {name} | {STEP_US / parts:g} | {iterations:.1f} | {seconds:.2f} | "
                  + " | ".join(errors) + " |", flush=True)


if __name__ == "__main__":
    main()
