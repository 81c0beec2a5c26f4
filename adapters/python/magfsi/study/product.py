# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs that a study asks for: the product of its axes, less pairs and skips."""
import itertools
import math
from dataclasses import dataclass

from magfsi.study import marked
from magfsi.study.expression import Formula, formula


def _number(formula, settings, mark, what):
    """Of the axes' values, in SI where they carry units."""
    try:
        number = float(formula(**{axis: s.value for axis, s in settings.items()}))
    except (TypeError, ValueError, IndexError, ZeroDivisionError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        mark.refuse(f'{what}"{formula.text}", which is no number for '
                    + ", ".join(s.label for s in settings.values()),
                    "a formula that is one for each run")
    return number


@dataclass
class Derived:
    """A value of the scene that follows from the axes: viscosity from relaxation time and lattice
    speed."""
    formula: Formula
    unit: str
    mark: marked.Value

    def text(self, settings):
        """What --set takes, for one cell."""
        return f"{_number(self.formula, settings, self.mark, ''):.9g} {self.unit}".strip()


def read_derived(value, axes):
    """{key of the scene: Derived} of a map of key: {formula, unit}."""
    out = {}
    for key, entry in value.entries().items():
        keys = entry.keys(("formula", "unit"), ("formula",))
        out[key] = Derived(formula(keys["formula"], list(axes)),
                           keys["unit"].scalar() if keys["unit"] else "", keys["formula"])
    return out


@dataclass
class Cell:
    """One run to be: a setting of each axis."""
    settings: dict  # axis: Setting
    sets: dict  # what goes to --set
    ranks: str
    size: float | None  # of what is refined

    def label(self, axis):
        return self.settings[axis].label

    def text(self):
        return ", ".join(f"{axis} {s.label}" for axis, s in self.settings.items())


def _groups(study):
    """Lists of axes that vary together."""
    groups = [list(pair) for pair in study.pairs]
    paired = {name for pair in groups for name in pair}
    groups += [[name] for name in study.axes if name not in paired]
    return groups


def _skipped(study, settings):
    return any(all(settings[axis].label in labels for axis, labels in rule.items())
               for rule in study.skip)


def _cell(study, settings):
    sets, ranks = dict(study.sets), study.ranks
    for setting in settings.values():
        for key, text in setting.sets.items():
            if key == "ranks":
                ranks = text
            else:
                sets[key] = text
    sets |= {key: value.text(settings) for key, value in study.derived.items()}
    size = _number(study.size, settings, study.top, "the size ") if study.size else None
    return Cell(settings, sets, ranks, size)


def cells(study):
    """In the order of the file, the last axis first to change."""
    groups = _groups(study)
    choices = [range(len(study.axes[group[0]].settings)) for group in groups]
    out = []
    for picked in itertools.product(*choices):
        chosen = {name: study.axes[name].settings[i]
                  for group, i in zip(groups, picked) for name in group}
        settings = {name: chosen[name] for name in study.axes}
        if not _skipped(study, settings):
            out.append(_cell(study, settings))
    return out
