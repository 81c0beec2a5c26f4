# SPDX-License-Identifier: GPL-2.0-or-later
"""The cheapest setting within a tolerance, by the fitted errors and the cost model."""
import itertools
import math
from dataclasses import dataclass

import numpy as np

from magfsi.cost import variants as making

TOLERANCES = (0.10, 0.05, 0.02, 0.01)
FINER = 8.0  # than the scene, at most
OPTIONS = 10  # of a parameter: all of a few, a selection of many
ASKED = 6  # settings whose cost the model is asked for, of those that look cheapest
BLOCK = 2000  # settings at a time: memory


@dataclass
class Advice:
    tolerance: float
    setting: dict = None  # None: no setting is promised, and why not
    seconds: float = math.nan
    memory: float = None
    error: float = math.nan  # bound on the relative error of the worst probe
    why: str = ""


def _options(parameter, reach):
    """Factors of the runs (reach), and finer ones; of the step none, which may act through the
    relaxation time."""
    most = max(reach) if parameter.name == "step" else FINER
    factors = [f for f in parameter.factors
               if min(reach) * (1 - 1e-9) <= f <= most * (1 + 1e-9)]
    while len(factors) > OPTIONS:
        factors = [f for i, f in enumerate(factors) if i % 2 == 0 or f == 1]
        if all(b / a > 1.4 for a, b in zip(factors, factors[1:])):
            break
    return factors


def _sizes(parameters, factors):
    """As result.measures, without asking the program. factors: (settings, parameters)."""
    column = {p.name: 1 / factors[:, k] for k, p in enumerate(parameters)}
    out = []
    for p in parameters:
        size = column[p.name]
        if p.name == "step":
            out.append(np.array([size, size * column["spacing"]]))
        elif p.name == "outer spacing":
            out.append(np.array([size * column["spacing"]]))
        else:
            out.append(np.array([size]))
    return out


def sizes_of(parameters, setting):
    """Of one setting."""
    return _sizes(parameters, np.array([[setting[p.name] for p in parameters]]))


class Settings:
    """Those between which a choice is made, with the errors of each probe and a rough price."""

    def __init__(self, scene, variants, probes):
        self.scene, self.probes = scene, probes
        self.names = [p.name for p in scene.parameters]
        done = [v for v in variants if v.run.completed()]
        reach = {n: [v.setting[n] for v in done] for n in self.names}
        options = [_options(p, reach[p.name]) for p in scene.parameters]
        self.factors = np.array(list(itertools.product(*options)) or [[]])
        self.length_share = (scene.facts["scene"]["time"]["end"]
                             / done[0].facts["scene"]["time"]["end"])
        self.corrected = making.correction(variants)
        self.bounds = self._bounds()
        self.rough = np.exp(np.log(self.factors) @ self._exponents(done))

    def _bounds(self):
        """Largest relative error over the probes, of each setting."""
        worst = np.zeros(len(self.factors))
        for first in range(0, len(self.factors), BLOCK):
            block = slice(first, first + BLOCK)
            sizes = _sizes(self.scene.parameters, self.factors[block])
            for probe in self.probes:
                errors, bars = probe.fit.errors(sizes)
                worst[block] = np.maximum(
                    worst[block], (np.abs(errors) + bars + probe.scatter_bar) / probe.scale)
        return worst

    def _exponents(self, done):
        """q of seconds ~ factor^q, by the cost model along each arm."""
        out = []
        for name in self.names:
            ends = [v for v in done if v.part in ("centre", name)]
            ends.sort(key=lambda v: v.setting[name])
            a, b = ends[0], ends[-1]
            grown = math.log(making.work_s(b.facts) / making.work_s(a.facts))
            out.append(max(0.05, grown / math.log(b.setting[name] / a.setting[name]))
                       if b.setting[name] > a.setting[name] else 1.0)
        return np.array(out)

    def price(self, setting):
        """(seconds, bytes or None) of the whole run."""
        facts = self.scene.variant(setting).facts
        return (making.START_UP_S + self.corrected * making.work_s(facts),
                making.memory_bytes(facts))

    def _named(self, row):
        return {n: float(f) for n, f in zip(self.names, self.factors[row])}

    def cheapest(self, tolerance):
        good = np.flatnonzero(self.bounds <= tolerance)
        if len(good) == 0:
            return Advice(tolerance, why="no setting that the fit covers is within it; the best "
                          f"has {100 * self.bounds.min():.2g} %")
        best = None
        for row in good[np.argsort(self.rough[good], kind="stable")][:ASKED]:
            try:
                seconds, memory = self.price(self._named(row))
            except making.CannotRun:
                continue
            if best is None or seconds < best.seconds:
                best = Advice(tolerance, self._named(row), seconds, memory,
                              float(self.bounds[row]))
        return best or Advice(tolerance, why="the program refuses what the fit proposes")


def advise(scene, variants, probes, faults, tolerances=TOLERANCES):
    """(Settings or None, an Advice for each tolerance)."""
    doubtful = list(faults) + [f for p in probes for f in p.faults]
    if doubtful:
        return None, [Advice(t, why=f"{doubtful[0].parameter}: {doubtful[0].why}")
                      for t in tolerances]
    settings = Settings(scene, variants, probes)
    return settings, [settings.cheapest(t) for t in tolerances]
