# SPDX-License-Identifier: GPL-2.0-or-later
"""The two runs of a comparison: what each has left, how it is called, and its error bars."""
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from magfsi import curves, runs
from magfsi.cost import probes as choosing
from magfsi.report import data
from magfsi.study import norms, store

FLUIDS = {"lbm": "lattice", "openfoam": "OpenFOAM"}
AT_THE_END = "final"  # the number whose bars are compared
KNOWN = 1e-3  # of a probe's largest value: a cost result with another value is of another run


@dataclass
class Bar:
    """Within which the true error of a probe's last value lies."""
    size: float | None  # in the probe's unit; None: there is none
    why: str = ""  # there is none, or how far the cost result is from this run


@dataclass
class Side:
    """One run. It can be asked for norms (study.norms) as the run of a study is."""
    folder: Path
    probes: curves.Probes
    summary: dict
    starts: list  # of run.json
    name: str = ""
    bars: dict = field(default_factory=dict)  # {column: Bar}
    bars_from: str = ""  # in words
    cell: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(settings={}))

    @property
    def scene(self):
        return self.probes.scene

    @property
    def times(self):
        return self.probes.columns["t[s]"]

    def outcome(self):
        """Empty where it is complete."""
        found = self.summary.get("outcome", "not ended")
        cause = self.summary.get("cause", "")
        return "" if found == "completed" else found + (f": {cause}" if cause else "")

    def processor_s(self):
        """Of all its processes; None where nothing tells it."""
        sides = self.summary.get("processor_s")
        if sides:
            return sum(sides.values())
        return data.read_json(self.folder / store.RECORD, {}).get("core_s")

    def memory_bytes(self):
        return sum(self.summary.get("memory_bytes", {}).values()) or None

    def last_start(self):
        """Of run.json: command, machine and versions."""
        return (self.starts or [{}])[-1]


def read(folder):
    """Raises NotARun where there is no run folder, or one without probes."""
    probes = curves.Probes(folder)
    if len(probes.x) < 2:
        raise data.NotARun(f"{folder}/probes.csv: found {len(probes.x)} rows; allowed are two and "
                           "more, which the key probes of the scene writes")
    summary = data.read_json(folder / "summary.json", {})
    side = Side(folder, probes, summary, data.read_json(folder / "run.json", []))
    accuracy = summary.get("accuracy", {})
    found = {column: Bar(entry.get("bar"), entry.get("doubt", ""))
             for column, entry in accuracy.get("probes", {}).items()
             if entry.get("norm") == AT_THE_END}
    if found:
        side.bars, side.bars_from = found, "its summary.json (run --error)"
    return side


def largest(side, column):
    """Largest magnitude of a probe's course (of a place, of its change), which shares are of."""
    return choosing.value(side, choosing.norm_of(column, AT_THE_END))[1]


def _bar_of_cost(side, row):
    """A cost result is often of a leading part of the scene: its share is what holds here."""
    if row["doubt"]:
        return Bar(None, row["doubt"])
    last, scale = choosing.value(side, choosing.norm_of(row["probe"], AT_THE_END))
    share = abs(float(row["error[1]"])) + float(row["error_bar[1]"])
    off = abs(float(row["value"]) - last)
    return Bar(share * scale, "" if off <= KNOWN * scale else
               f"the cost result has {float(row['value']):.4g} in place of {last:.4g}")


def take_bars(side, folder):
    """Those of a folder that magfsi cost has written, for the same setting of the scene. Raises
    NotARun."""
    path = Path(folder) / "cost.csv"
    try:
        rows = runs.read_rows(path)
        found = {row["probe"]: _bar_of_cost(side, row) for row in rows
                 if row["norm"] == AT_THE_END and row["probe"] in side.probes.columns}
    except (OSError, KeyError, ValueError, norms.NoError) as error:
        raise data.NotARun(f"{path}: found no result of magfsi cost ({error}); allowed are folders "
                           "that it has written") from error
    if not found:
        raise data.NotARun(f"{path}: found no bar of a last value (--norm {AT_THE_END}) of a probe "
                           f"that {side.folder} has; allowed is a cost result of the same scene")
    side.bars, side.bars_from = found, str(path)


def _solver(side):
    return side.scene.get("fluid", {}).get("solver")


def give_names(sides, chosen=None):
    """Of the legends: those that are chosen, else what tells the two apart."""
    solvers = [FLUIDS.get(_solver(side), _solver(side)) for side in sides]
    paths = [side.folder.resolve().parts for side in sides]
    ends = [["/".join(path[-n:]) for path in paths] for n in range(1, max(map(len, paths)) + 1)]
    candidates = [solvers, [side.scene.get("name") for side in sides], *ends]
    names = chosen or next(c for c in candidates if None not in c and c[0] != c[1])
    for side, name in zip(sides, names):
        side.name = name


def common_span(sides):
    """The time that both have [s]. Raises NotARun."""
    begin = max(side.times[0] for side in sides)
    end = min(side.times[-1] for side in sides)
    rows = [np.count_nonzero((side.times >= begin * (1 - 1e-9)) & (side.times <= end * (1 + 1e-9)))
            for side in sides]
    if begin > end or min(rows) < 2:
        each = [f"{side.folder} (from {side.times[0]:.6g} s to {side.times[-1]:.6g} s)"
                for side in sides]
        raise data.NotARun(f"{each[0]} and {each[1]}: found fewer than two rows of probes in the "
                           "time that both have; allowed are runs of the same time, and a smaller "
                           "probes.every")
    return begin, end


def flat(values, above=""):
    """{path: value} of a scene as read; a list is one value."""
    found = {}
    for key, value in values.items():
        path = f"{above}{key}"
        found.update(flat(value, path + ".") if isinstance(value, dict) else {path: value})
    return found


def scene_differences(sides):
    """[(key, value of the first, of the second)], in SI units; None: it has no such key."""
    first, second = (flat(side.scene) for side in sides)
    return [(key, first.get(key), second.get(key)) for key in sorted({*first, *second})
            if first.get(key) != second.get(key)]
