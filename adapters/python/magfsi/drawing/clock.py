# SPDX-License-Identifier: GPL-2.0-or-later
"""How an instant of a run is called: its time in the unit of the scene, or, of equilibria, what is
varied from one to the next."""
import numpy as np
import yaml

from magfsi import units
from magfsi.drawing.actors import unpacked


def scene_unit(run):
    """(factor, unit) in which the scene writes its end; by size where it does not say."""
    try:
        text = yaml.safe_load(run["scene"])["time"]["end"]
    except (yaml.YAMLError, TypeError, KeyError):
        text = ""
    for line in run["overrides"]:
        key, _, value = line.partition("=")
        text = value if key.strip() == "time.end" else text
    match = units.PATTERN.match(str(text).strip())
    size = units.size_of(match.group(2)) if match else None
    if size and size[0] == "s":
        return 1 / size[1], match.group(2).replace("u", "\u00b5")
    return units.scaled(run["end"] or 0.0, "s")


class Clock:
    def __init__(self, run):
        self.factor, self.unit = scene_unit(run)
        self.load = run["load"]
        if self.load:
            rows = next(c for c in run["probes"]["columns"] if c["name"] == "t[s]")
            self.times = unpacked(rows["values"], "<f4") + rows["base"]
            self.values = unpacked(self.load["values"], "<f4")

    def text(self, time):
        if not self.load:
            return f"t = {self.factor * time:.4g} {self.unit}"
        value, unit = float(np.interp(time, self.times, self.values)), self.load["unit"]
        return f"{self.load['name']} {units.with_unit(value, unit, 4)}"
