"""Values of a scene that follow from the axes: viscosity from relaxation time and lattice
speed."""
import math
from dataclasses import dataclass

import marked
from expression import Formula, formula


@dataclass
class Derived:
    formula: Formula  # of the axes' values, in SI where they carry units
    unit: str
    mark: marked.Value

    def text(self, settings):
        """What --set takes, for one cell."""
        try:
            number = float(self.formula(**{axis: s.value for axis, s in settings.items()}))
        except (TypeError, ValueError, IndexError, ZeroDivisionError, OverflowError):
            number = math.nan
        if not math.isfinite(number):
            self.mark.refuse(f'"{self.formula.text}", which is no number for '
                             + ", ".join(s.label for s in settings.values()),
                             "a formula that is one for each run")
        return f"{number:.9g} {self.unit}".strip()


def read(value, axes):
    """{key of the scene: Derived} of a map of key: {formula, unit}."""
    out = {}
    for key, entry in value.entries().items():
        keys = entry.keys(("formula", "unit"), ("formula",))
        out[key] = Derived(formula(keys["formula"], list(axes)),
                           keys["unit"].scalar() if keys["unit"] else "", keys["formula"])
    return out
