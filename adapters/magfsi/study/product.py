"""The runs that a study asks for: the product of its axes, less pairs and skips."""
import itertools
from dataclasses import dataclass


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
    size = None
    if study.size:
        try:
            size = float(study.size(**{a: s.value for a, s in settings.items()}))
        except (TypeError, ValueError, IndexError, ZeroDivisionError, OverflowError):
            study.top.refuse(f'the size "{study.size.text}", which is no number for '
                             + ", ".join(s.label for s in settings.values()),
                             "a formula that is one for each run")
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
