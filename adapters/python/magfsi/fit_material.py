# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi fit-material DATA.csv ...: elastic constants and Maxwell branches of a rubber from measured
curves, as YAML for a scene, with a picture and the error of each curve.

Columns of a file: stretch (or shear, the tangent of the angle) and stress[Pa], nominal, with or without
time[s]; units as in a scene (kPa, ms). Lines of # are comments. Without times a curve is a slow, relaxed
one; FILE:rate=0.01 says that its rows follow each other at this rate of stretch [1/s], as in loops.
FILE:mode=equibiaxial (or pure_shear, uniaxial, shear) says how the specimen is loaded."""
import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from magfsi import rubber, runs, units

ROWS_BETWEEN = 8  # steps of a branch between two rows of a file
POISSON = 0.49  # of what is written: rubber's own is nearer to 0.5 and no curve here tells it


@dataclass
class Curve:
    name: str
    mode: str
    times_s: np.ndarray  # None: relaxed
    strain: np.ndarray  # stretch, or the tangent of shear
    stress_pa: np.ndarray

    def computed(self, law, branches):
        if self.times_s is None:
            return rubber.relaxed_stress(law, self.mode, self.strain)
        fine = np.linspace(0, len(self.strain) - 1, ROWS_BETWEEN * (len(self.strain) - 1) + 1)
        rows = np.arange(len(self.strain))
        # From the state at rest, which a file need not begin with.
        times = np.interp(fine, rows, self.times_s)
        strain = np.interp(fine, rows, self.strain)
        rest = 0.0 if self.mode == "shear" else 1.0
        times = np.concatenate([[times[0]], times])
        strain = np.concatenate([[rest], strain])
        return rubber.stress_over_time(law, branches, self.mode, times, strain)[1::ROWS_BETWEEN]

    def size(self):
        return np.abs(self.stress_pa).max()

    def error(self, law, branches):
        """Root of the mean square of the difference over the largest stress."""
        apart = self.computed(law, branches) - self.stress_pa
        return float(np.sqrt(np.mean(apart**2)) / self.size())


def stop(text):
    sys.exit(f"magfsi: fit-material: {text}")


def read_curve(word):
    """A file with what is said of it after a colon."""
    file, _, said = word.partition(":")
    path, options = Path(file), {}
    for entry in filter(None, said.split(",")):
        key, _, value = entry.partition("=")
        if key not in ("mode", "rate"):
            stop(f"{word}: found {key!r}; allowed are mode=... and rate=...")
        options[key] = value
    if not path.is_file():
        stop(f"{file}: no such file")
    table = runs.read_table(path, float)
    columns = {}
    for name, values in table.items():
        plain, _, unit = name.partition("[")
        unit = unit.rstrip("]")
        size = units.size_of(unit) if unit else ("1", 1.0)
        if size is None:
            stop(f"{file}: found the unit {unit!r} of {plain}; write it as in a scene, kPa for instance")
        columns[plain.strip()] = np.array(values, float) * size[1]
    strain = next((columns[k] for k in ("stretch", "shear") if k in columns), None)
    if strain is None or "stress" not in columns or len(strain) < 3:
        stop(f"{file}: found the columns {', '.join(table)}; needed are stretch or shear, and stress[Pa], in "
             "three rows or more")
    mode = options.get("mode", "shear" if "shear" in columns else "uniaxial")
    if mode not in rubber.MODES:
        stop(f"{word}: found the mode {mode!r}; allowed is {', '.join(rubber.MODES)}")
    times = columns.get("time")
    if "rate" in options:
        if times is not None:
            stop(f"{word}: has times, and a rate besides; leave the rate out")
        try:
            rate = float(options["rate"])
        except ValueError:
            rate = 0.0
        if not rate > 0:
            stop(f"{word}: found the rate {options['rate']!r}; a number above 0 is needed [1/s]")
        way = np.abs(np.diff(strain, prepend=0.0 if mode == "shear" else 1.0))
        times = np.cumsum(way) / rate
    if times is not None and (np.diff(times) < 0).any():
        stop(f"{file}: its times do not ascend")
    return Curve(path.stem, mode, times, strain, columns["stress"])


# --- the fit ---------------------------------------------------------------------------


def starts(kind, curves, rng):
    """Values to start from, as logarithms where they must be positive."""
    furthest = max(invariant(curve).max() for curve in curves)
    slope = max(curve.size() for curve in curves) / 3
    g = slope * rng.uniform(0.1, 1.0)
    if kind == "gent":
        return [np.log(g), np.log(furthest * rng.uniform(0.05, 1.0))]
    if kind == "yeoh":
        return [np.log(g), rng.uniform(-0.05, 0.05), np.log(1e-3 * rng.uniform(0.05, 5))]
    if kind == "arruda_boyce":
        return [np.log(g), np.log(np.sqrt(furthest / 3 + 1) * rng.uniform(0.02, 0.6))]
    return [np.log(g)]


def invariant(curve):
    if curve.mode == "shear":
        return curve.strain**2
    return (rubber.stretches_of(curve.mode, curve.strain)**2).sum(-1) - 3


def law_of(kind, x, furthest):
    """The law of the numbers x: limits lie beyond the furthest stretch of the data."""
    values = {"shear_modulus": float(np.exp(x[0]))}
    if kind == "gent":
        values["limit"] = float(furthest + np.exp(x[1]))
    elif kind == "yeoh":
        g = values["shear_modulus"]
        values["c3"] = float(g * np.exp(x[2]))
        # 1 + b s + c s^2 stays positive: b above -2 sqrt(c).
        least = -np.sqrt(1.5 * values["c3"] * g)
        values["c2"] = float(max(g * x[1], 0.999 * least))
    elif kind == "arruda_boyce":
        values["locking_stretch"] = float(np.sqrt(furthest / 3 + 1) + np.exp(x[1]))
    return rubber.Law(kind, values)


def branches_of(x):
    return [(float(np.exp(m)), float(np.exp(t))) for m, t in zip(x[0::2], x[1::2])]


@dataclass
class Fit:
    law: rubber.Law
    branches: list
    errors: list  # of each curve

    def worst(self):
        return float(np.sqrt(np.mean(np.square(self.errors))))


def fit(curves, kind, branch_count, tries=8):
    """The best of several starts, the same ones in every call."""
    rng = np.random.default_rng(1)
    furthest = max(invariant(curve).max() for curve in curves)
    own = 1 + len(rubber.LAWS[kind])
    timed = [c for c in curves if c.times_s is not None]

    def differences(x):
        law, branches = law_of(kind, x[:own], furthest), branches_of(x[own:])
        parts = [(c.computed(law, branches) - c.stress_pa) / c.size() / np.sqrt(len(c.strain))
                 for c in curves]
        return np.nan_to_num(np.concatenate(parts), nan=1e3, posinf=1e3, neginf=-1e3)

    best = None
    for _ in range(tries):
        x = starts(kind, curves, rng)
        if branch_count:
            shortest = min(np.diff(c.times_s)[np.diff(c.times_s) > 0].min() for c in timed)
            longest = max(np.ptp(c.times_s) for c in timed)
            times = np.exp(np.linspace(np.log(max(shortest, 1e-3 * longest)), np.log(longest), branch_count + 2))[1:-1]
            for time in times:
                x += [x[0] + rng.uniform(-1, 1), np.log(time) + rng.uniform(-0.5, 0.5)]
        found = least_squares(differences, x, method="trf", x_scale="jac", max_nfev=400)
        if best is None or found.cost < best.cost:
            best = found
    law, branches = law_of(kind, best.x[:own], furthest), sorted(branches_of(best.x[own:]), key=lambda b: b[1])
    return Fit(law, branches, [c.error(law, branches) for c in curves])


# --- results ---------------------------------------------------------------------------


def yaml_of(found, density):
    g = found.law.values["shear_modulus"]
    lines = [f"shear_modulus: {g:.6g} Pa",
             f"lame_lambda: {2 * g * POISSON / (1 - 2 * POISSON):.6g} Pa  # Poisson's ratio {POISSON}: no curve tells it",
             f"density: {density}"]
    if found.law.kind != "neo_hookean":
        own = ", ".join(f"{key}: {found.law.values[key]:.6g}{' ' + unit if unit else ''}"
                        for key, unit in rubber.LAWS[found.law.kind].items())
        lines.append(f"{found.law.kind}: {{{own}}}")
    if found.branches:
        lines.append("maxwell:")
        lines += [f"  - {{modulus: {m:.6g} Pa, time: {t:.6g} s}}" for m, t in found.branches]
    return "material:\n" + "".join(f"  {line}\n" for line in lines)


def draw(curves, found, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(1, len(curves), figsize=(3.4 * len(curves), 3), squeeze=False,
                                layout="constrained")
    for axis, curve, error in zip(axes[0], curves, found.errors):
        factor, unit = units.scaled(curve.size(), "Pa")
        by_time = curve.times_s is not None and np.ptp(curve.strain[len(curve.strain) // 10:]) == 0
        across = curve.times_s if by_time else curve.strain
        axis.plot(across, factor * curve.stress_pa, "o", ms=3, color="0.45", label="measured")
        axis.plot(across, factor * curve.computed(found.law, found.branches), color="C0",
                  label=f"{found.law.kind}, {100 * error:.2g} %")
        axis.set_xlabel("time [s]" if by_time else "shear" if curve.mode == "shear" else "stretch")
        axis.set_ylabel(f"nominal stress [{unit}]")
        axis.set_title(curve.name, fontsize=9)
        axis.legend(frameon=False, fontsize=8)
    figure.savefig(file, dpi=150)
    plt.close(figure)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="magfsi fit-material", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", nargs="+", metavar="FILE.csv[:mode=...,rate=...]")
    parser.add_argument("--law", choices=["best", *rubber.LAWS], default="best",
                        help="law of stiffening; best: that of the smallest error")
    parser.add_argument("--branches", type=int, default=None, metavar="N",
                        help="Maxwell branches; 2 where a curve has times or a rate, else none")
    parser.add_argument("--density", default="1000 kg/m3", help="written as it is")
    parser.add_argument("--out", type=Path, default=Path("material.yaml"), help="the YAML; its picture is beside it")
    given = parser.parse_args(arguments)
    curves = [read_curve(word) for word in given.data]
    timed = any(c.times_s is not None for c in curves)
    count = given.branches if given.branches is not None else 2 if timed else 0
    if not 0 <= count <= 8:
        stop(f"--branches: found {count}; allowed is 0 to 8")
    if count and not timed:
        stop("--branches: no curve has times or a rate, which branches could be fitted to")
    kinds = list(rubber.LAWS) if given.law == "best" else [given.law]
    fits = [fit(curves, kind, count) for kind in kinds]
    found = min(fits, key=Fit.worst)
    for one in sorted(fits, key=Fit.worst):
        print(f"{one.law.kind:13s} {100 * one.worst():.3g} % of the largest stress (rms)")
    for curve, error in zip(curves, found.errors):
        print(f"  {curve.name}: {100 * error:.3g} %")
    text = yaml_of(found, given.density)
    sources = ", ".join(c.name for c in curves)
    given.out.parent.mkdir(parents=True, exist_ok=True)
    given.out.write_text(f"# Fitted by magfsi fit-material to {sources}: rms {100 * found.worst():.3g} % of the largest "
                         f"stress.\n{text}")
    picture = given.out.with_suffix(".png")
    draw(curves, found, picture)
    print(text + f"written to {given.out}, picture {picture}")


if __name__ == "__main__":
    main()
