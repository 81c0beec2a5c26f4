# SPDX-License-Identifier: GPL-2.0-or-later
"""One case of the Turek-Hron benchmark, or Schaefer and Turek's 2D-2, against its reference values.

    turek_hron.py CASE [--spacing mm] [--tolerance QUANTITY=fraction ...]

A fraction of the reference's magnitude; means of oscillations over the amplitude, and as
"..._mean_own" over themselves. Quantities
without a tolerance are reported only. The slab is one cell deep at any spacing.
"""

import argparse
import json
import sys
from pathlib import Path

from magfsi import testing

FOLDER = Path(__file__).resolve().parent
REFERENCE = json.loads((FOLDER / "reference.json").read_text())


def settings_of(case, spacing_mm):
    if case == "csm1":
        return {}
    depth = f"{spacing_mm} mm"
    length = "2.2 m" if case == "2d2" else "2.5 m"
    settings = {"fluid.spacing": depth, "fluid.box": f"[{length}, 410 mm, {depth}]"}
    if case.startswith("fsi"):
        middle = f"{spacing_mm / 2} mm"
        settings["bodies.flag.mesh.box.size"] = f"[350 mm, 20 mm, {depth}]"
        settings["bodies.flag.initial.position"] = f"[425 mm, 200 mm, {middle}]"
        settings["probes.points.A.at"] = f"[350 mm, 10 mm, {middle}]"
    return settings


def series(run, spacing_mm):
    """The quantities of the benchmark over time."""
    columns = run.probes()
    depth = 1e-3 * spacing_mm
    out = {"t": columns["t[s]"]}
    for name in ("ux", "uy"):
        if f"A_{name}[m]" in columns:
            out[name] = columns[f"A_{name}[m]"]
    # The fluid's force on all that it wets: obstacles and flag.
    for name, axis in (("drag", "x"), ("lift", "y")):
        parts = [columns[key] for key in columns
                 if key.endswith(f".force_{axis}[N]") or
                 key.endswith(f".fluid_force_{axis}[N]")]
        if parts:
            out[name] = [sum(now) / depth for now in zip(*parts)]
    return out


def beat(times, values, since):
    """Mean, amplitude and frequency of an oscillation from a time on."""
    chosen = [(t, v) for t, v in zip(times, values) if t >= since]
    low, high = min(v for _, v in chosen), max(v for _, v in chosen)
    mean = 0.5 * (low + high)
    rises = [t0 + (t1 - t0) * (mean - v0) / (v1 - v0)
             for (t0, v0), (t1, v1) in zip(chosen, chosen[1:]) if v0 < mean <= v1]
    periods = len(rises) - 1
    frequency = periods / (rises[-1] - rises[0]) if periods > 0 else 0
    return mean, 0.5 * (high - low), frequency


def figures(case, found):
    """(name, computed, reference, scale of the error) of each quantity."""
    rows = []
    for name, reference in REFERENCE[case].items():
        if isinstance(reference, float):
            rows.append((name, found[name][-1], reference, abs(reference)))
            continue
        # Two beats, once they repeat.
        got = beat(found["t"], found[name], found["t"][-1] - 1.1)
        if isinstance(reference, dict):  # of a cylinder alone
            of = {"max": got[0] + got[1], "frequency": got[2]}
            rows += [(f"{name}_{part}", of[part], wanted, wanted)
                     for part, wanted in reference.items()]
            continue
        scales = (reference[1], reference[1], reference[2])
        for part, value, wanted, scale in zip(("mean", "amplitude", "frequency"), got,
                                              reference, scales):
            rows.append((f"{name}_{part}", value, wanted, scale))
        rows.append((f"{name}_mean_own", got[0], reference[0], abs(reference[0])))
    return rows


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("case", choices=[key for key in REFERENCE if isinstance(REFERENCE[key], dict)])
    parser.add_argument("--spacing", type=float, default=10, metavar="mm")
    parser.add_argument("--tolerance", nargs="*", default=[])
    parser.add_argument("--set", nargs="*", default=[], help="more of the scene")
    arguments = parser.parse_args()
    settings = settings_of(arguments.case, arguments.spacing)
    settings.update(pair.split("=", 1) for pair in arguments.set)
    run = testing.good_run(FOLDER / f"{arguments.case}.yaml", settings, limit_s=7000)
    allowed = {key: float(value)
               for key, value in (pair.split("=") for pair in arguments.tolerance)}
    failed = []
    testing.report(f"{arguments.case}, spacing {arguments.spacing} mm, {run.seconds:.0f} s")
    for name, value, wanted, scale in figures(arguments.case, series(run, arguments.spacing)):
        error = (value - wanted) / scale
        testing.report(f"  {name:13} {value:11.5g}  reference {wanted:11.5g}  "
                      f"{100 * error:+6.2f} %")
        if name in allowed and not abs(error) <= allowed[name]:
            failed.append(f"{name} is off by {100 * error:.2f} %, allowed are "
                          f"{100 * allowed[name]:g} %")
    for name in allowed.keys() - {row[0] for row in figures(
            arguments.case, series(run, arguments.spacing))}:
        failed.append(f"no quantity {name}")
    for line in failed:
        testing.report(line)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
