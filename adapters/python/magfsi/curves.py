# SPDX-License-Identifier: GPL-2.0-or-later
"""A run's probes as curves, for `plot` and `figure`: which, over what, in which unit, in which line."""
import difflib
import fnmatch

import numpy as np

from magfsi import runs, units
from magfsi.drawing.actors import unpacked
from magfsi.drawing.clock import scene_unit
from magfsi.report import data

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"]  # Okabe and Ito's
DASHES = ["-", (0, (5, 2)), (0, (1.2, 1.4)), (0, (7, 2, 1.5, 2)), (0, (3, 1, 1, 1, 1, 1)), (0, (9, 3))]
# What is less is rounding, as on the page (report/curves.js): of the largest on the same axis, of a
# place, of a quantity without unit.
ROUNDING, OF_A_PLACE, NOTHING = 1e-6, 1e-9, 1e-12
KINDS = {"m": "lengths", "m/s": "velocities", "N": "forces", "N m": "torques", "J": "energies", "T": "field",
         "rad": "angles", "1": "ratios", "1/s": "rates", "m3/s": "flows", "Pa": "pressures", "kg m/s": "momenta",
         "N s": "impulses", "rad/s": "rates of turning"}


def unit_of(name):
    return name.rstrip("]").partition("[")[2]


def plain(name):
    return name.partition("[")[0]


def style(i, width=1.0):
    """Colour, dashes and width of a curve: each is narrower than the one below it, so that of equal
    curves all are seen."""
    return {"color": COLOURS[i % len(COLOURS)], "ls": DASHES[i % len(DASHES)],
            "lw": width * max(0.8, 2.2 - 0.4 * i) if i < len(DASHES) else 0.8 * width, "zorder": 2 + 0.01 * i}


class Probes:
    """Of a run folder: `columns` {name: array}, and the horizontal axis: `axis` (name, unit), `x`, of
    which an SI unit is `per_x`."""

    def __init__(self, folder):
        self.folder = folder
        self.scene = data.read_json(folder / "scene.json", None)
        if self.scene is None:
            raise data.NotARun(f"{folder}: found no scene.json; allowed are folders that "
                               "./magfsi run has written")
        try:
            table = runs.read_table(folder / "probes.csv", float)
        except (OSError, ValueError):
            table = {}
        self.columns = {name: np.array(values) for name, values in table.items()} if table.get("t[s]") else {}
        last = (data.read_json(folder / "run.json", []) or [{}])[-1]
        text = folder / "scene.yaml"
        self.run = {"scene": text.read_text(errors="replace") if text.exists() else "",
                    "overrides": last.get("overrides", []), "end": self.scene.get("time", {}).get("end")}
        self.per_second, self.second = scene_unit(self.run)
        self.axis, self.x = ("time", self.second), np.array([])
        if self.columns:
            self._choose_axis()

    def _choose_axis(self):
        """The time in the unit of the scene; of equilibria what is varied."""
        time = self.columns["t[s]"]
        self.x, self.per_x = self.per_second * time, self.per_second
        lists = {name: list(values) for name, values in self.columns.items()}
        load = data.load(self.scene, lists, list(range(len(time))))
        if load:
            values = unpacked(load["values"], "<f4")
            factor, unit = units.scaled(float(np.abs(values).max(initial=0)), load["unit"])
            self.axis, self.x, self.per_x = (load["name"], unit), factor * values, factor

    def axis_label(self):
        name, unit = self.axis
        return f"{name} [{unit}]" if unit else name

    def between(self, begin, end):
        """Only the rows of these times [s]."""
        if self.columns:
            inside = (self.columns["t[s]"] >= begin * (1 - 1e-9)) & (self.columns["t[s]"] <= end * (1 + 1e-9))
            self.columns = {name: values[inside] for name, values in self.columns.items()}
            self.x = self.x[inside]

    def chosen(self, words):
        """Names of columns, each by its name with or without unit, or by a pattern: robot.com_*."""
        names = [name for name in self.columns if name != "t[s]"]
        found = []
        for word in words:
            fit = [n for n in names if word in (n, plain(n)) or fnmatch.fnmatchcase(n, word) or
                   fnmatch.fnmatchcase(plain(n), word)]
            if not fit:
                near = difflib.get_close_matches(word, [plain(n) for n in names], 3, 0.4)
                raise data.NotARun(f"{self.folder}/probes.csv: found no column '{word}'; " + (
                    f"did you mean {', '.join(near)}? " if near else "") + f"it has {len(names)}, the first is "
                    f"{names[0] if names else 'not there'}")
            found += [n for n in fit if n not in found]
        return found


def panels(columns):
    """[(title, unit, [(label, column)])]: a vector's or quaternion's components together, and what else an owner
    has in one unit. Of a point its displacement, not its place besides. No title is there twice."""
    groups = {}
    for name in columns:
        if name == "t[s]":
            continue
        owner, dot, quantity = plain(name).rpartition(".")
        stem, _, part = quantity.rpartition("_")
        quaternion = stem.endswith("rigid_q") and part == "w"
        vector = quaternion or part.lstrip("u") in ("x", "y", "z") and len(part) <= 2
        if is_told_by_a_displacement(name, columns):
            continue
        if vector:
            title = f"{owner}{dot}{stem}" + (", displacement" if part.startswith("u") else "")
        else:
            title = owner
        groups.setdefault((title, unit_of(name)), []).append((part if vector else quantity, name))
    found = [(plain(some[0][1]) if len(some) == 1 else title or "fluid", unit, some)
             for (title, unit), some in groups.items()]
    titles = [title for title, _, _ in found]
    return [(title if titles.count(title) == 1 else f"{title}, {_kind(unit, some)}", unit, some)
            for title, unit, some in found]


def _kind(unit, some):
    if all(label in ("x", "y", "z", "w") for label, _ in some):
        return "components"
    return KINDS.get(unit, units.typeset(unit)) if len(some) > 1 else "magnitude"


def is_place(name):
    """A component of a position: its change from the start is what is looked at."""
    stem, _, part = plain(name).rpartition("_")
    return unit_of(name) == "m" and part in ("x", "y", "z") and bool(stem)


def is_told_by_a_displacement(name, columns):
    """Of a point's place its change is a column of its own."""
    stem, _, part = plain(name).rpartition("_")
    return part in ("x", "y", "z") and f"{stem}_u{part}[{unit_of(name)}]" in columns


def is_the_whole(columns, name):
    """Of a field along x its x is the same curve again."""
    stem, _, part = plain(name).rpartition("_")
    whole = columns.get(f"{stem}[{unit_of(name)}]")
    return part in ("x", "y", "z") and whole is not None and np.array_equal(whole, columns[name])


def shown(columns, some):
    """([(label, name, values)] to draw, [(name, value)] of what is constant or rounding)."""
    drawn, constant = [], []
    each = [(label, name, columns[name]) for label, name in some]
    finite = {name: values[np.isfinite(values)] for _, name, values in each}
    scale = max((np.abs(v).max(initial=0) for v in finite.values()), default=0.0)
    for label, name, values in each:
        if is_the_whole(columns, name):
            continue
        least = max(ROUNDING * scale, NOTHING if unit_of(name) == "1" else 0.0)
        if is_place(name):
            least = OF_A_PLACE * scale
        good = finite[name]
        if np.ptp(good) <= least if len(good) else True:
            value = float(np.median(good)) if len(good) else np.nan
            constant.append((name, 0.0 if abs(value) <= least else value))
        else:
            drawn.append((label, name, values - values[0] if is_place(name) else values))
    return drawn, constant
