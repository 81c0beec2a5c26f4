# SPDX-License-Identifier: GPL-2.0-or-later
"""What the runs of a star tell of each probe: limit, error of the scene as it is, the share of
each parameter, and where the fit does not hold."""
import math
from dataclasses import dataclass, field

import numpy as np

from magfsi.cost import fit as fitting
from magfsi.cost import parameters as numerical
from magfsi.cost import probes
from magfsi.study.norms import NoError

SEEN = 0.005  # of the probe's scale: an arm that changes it by less is no cause of doubt
LEAST_ORDER = 0.5  # seen along an arm; below, the value has no limit that it tends to
FALLS = 0.5  # order with which what a step does that does not settle falls with the spacing
REVERSAL = 0.2  # of an arm's range: more is no monotonous course
# The error of an arm that the fit does not describe, in its range: Eca and Hoekstra's factor of safety
# for data that do not converge with one order.
SAFETY = 3.0
SCATTER = 0.1  # of the scale: where that is less, values that turn back widen the bar, no more


@dataclass
class Fault:
    parameter: str
    why: str
    span: float = 0.0  # of the values along the arm
    scatter: bool = False  # it widens the bar only


@dataclass
class Probe:
    column: str
    norm: str
    fit: fitting.Fit
    scale: float  # that relative errors are of
    limit: float
    limit_bar: float
    value: float  # of the scene as it is, run or predicted
    was_run: bool
    error: float  # of that value, signed
    error_bar: float  # of that error
    shares: dict = field(default_factory=dict)  # parameter: its part of the error, signed
    faults: list = field(default_factory=list)
    scatter: list = field(default_factory=list)  # faults that widen the bars only

    @property
    def scatter_bar(self):
        """What arms that the fit does not describe add to each bar."""
        return SAFETY * sum(f.span for f in [*self.faults, *self.scatter])

    @property
    def bar(self):
        """Within which the value's true error lies."""
        return abs(self.error) + self.error_bar

    @property
    def unit(self):
        return self.column[self.column.find("[") + 1:-1] if "[" in self.column else ""


def measures(scene, variants):
    """Sizes of settings as Fit takes them: for each parameter (measures, settings)."""
    return [np.array([v.sizes[p.name] for v in variants]).T for p in scene.parameters]


def seen_order(sizes, values):
    """p of Q + c u^p through an arm of three runs or more; None where they tell none."""
    if len(values) < 3 or np.ptp(values) == 0:
        return None
    best = None
    for p in np.linspace(0.02, 8, 200):
        x = np.column_stack([np.ones(len(sizes)), sizes**p])
        off = np.linalg.lstsq(x, values, rcond=None)
        left = values - x @ off[0]
        if best is None or left @ left < best[0]:
            best = left @ left, p
    return best[1]


def _falls_with_spacing(variants, values):
    """Whether the step's effect is less at a finer spacing, by the run finer in both: it then is
    a part of the spacing's error."""
    both = next((i for i, v in enumerate(variants) if v.part == "spacing and step"), None)
    if both is None:
        return False
    corner = variants[both].setting
    centre = next(v.setting for v in variants if v.part == "centre")

    def at(**changed):
        wanted = {**centre, **changed}
        return next((values[i] for i, v in enumerate(variants) if v.setting == wanted), None)
    coarse = [at(), at(step=corner["step"])]
    fine = [at(spacing=corner["spacing"]), values[both]]
    if None in coarse or None in fine:
        return False
    ratio = (fine[1] - fine[0]) / (coarse[1] - coarse[0])
    return abs(ratio) < (centre["spacing"] / corner["spacing"])**FALLS


def _arm_fault(name, sizes, values, scale):
    """What is wrong with the course of values along an arm, from coarse to fine."""
    steps = np.diff(values)
    span = np.ptp(values)
    if span < SEEN * scale or len(values) < 2:
        return None
    ahead = np.sign(values[-1] - values[0])
    back = max(0, *(-ahead * steps)) if len(steps) > 1 else 0
    shown = ", ".join(f"{v:.5g}" for v in values)
    if back > REVERSAL * span:
        return Fault(name, f"the values do not tend to one side as it is refined: {shown}", span,
                     SAFETY * span < SCATTER * scale)
    order = seen_order(sizes, values)
    if order is not None and order < LEAST_ORDER:
        return Fault(name, f"the values do not settle as it is refined: {shown}; order seen "
                     f"{order:.1f}", span)
    return None


def _thin_sheets(scene, variants):
    """Bodies thinner than a cell of the finest run: it does not resolve them."""
    facts = scene.facts["scene"]
    if "fluid" not in facts or not facts.get("bodies"):
        return []
    spacing = min(numerical.finest_spacing(v.facts["scene"]) for v in variants)
    out = []
    for name, body in facts["bodies"].items():
        thin = numerical.thickness(body["mesh"])
        if thin and thin < spacing * (1 - 1e-9):
            out.append(Fault("spacing", f"{name} is {thin / spacing:.2f} cells thick in the "
                             "finest run: errors of sheets below one cell do not fall as the "
                             "fit supposes"))
    return out


def _diverged(variants):
    out = []
    for v in variants:
        if v.run.key and not v.run.completed() and v.run.record:
            worst = max(v.setting, key=lambda n: 1 / v.setting[n], default="")
            where = v.part if v.part in v.setting else worst
            out.append(Fault(where, f"the run with {v.text()} ended: {v.run.record['outcome']}: "
                             f"{v.run.record['cause'].split(';')[0]}"))
    return out


def common_faults(scene, variants):
    """Those of all probes."""
    return _thin_sheets(scene, variants) + _diverged(variants)


def _fitted(scene, done, values, sizes, scale):
    """(Fit, faults of its arms)."""
    names = [p.name for p in scene.parameters]
    settings = np.array([[1 / v.setting[n] for n in names] for v in done])
    faults, parameters = [], []
    for k, p in enumerate(scene.parameters):
        arm = fitting.arm(settings, k)
        fault = _arm_fault(p.name, sizes[k][0][arm], values[arm], scale)
        # With a body in the fluid a step that does not settle is a fault of the forcing: the
        # penalty's drag coefficient 2 rho h / dt is numerical.
        alone = p.name == "step" and not scene.facts["scene"].get("bodies")
        scaled = names.index("spacing") if alone else None
        scales = bool(fault) and scaled is not None and _falls_with_spacing(done, values)
        if fault and not scales:
            faults.append(fault)
        parameters.append(fitting.Parameter(p.name, sizes[k], p.nominal, scaled, scales))
    return fitting.Fit(parameters, values, scale, settings=settings), faults


def analyse(scene, variants, column, kind, start_s=None):
    """A Probe of the completed variants; raises NoError."""
    done = [v for v in variants if v.run.completed()]
    norm = probes.norm_of(column, kind, start_s)
    pairs = [probes.value(v.run, norm) for v in done]
    if not all(math.isfinite(value) for value, _ in pairs):
        raise NoError(f"a value of {column} is not finite")
    values = np.array([value for value, _ in pairs])
    scale = pairs[int(np.argmin([np.prod([s[0] for s in v.sizes.values()]) for v in done]))][1]
    if scale == 0 or len(done) < 2:
        raise NoError("nothing happens" if scale == 0 else "fewer than two runs completed")
    sizes = measures(scene, done)
    fit, faults = _fitted(scene, done, values, sizes, scale)
    own = [np.ones((len(s), 1)) for s in sizes]
    errors, bars = fit.errors(own)
    limit, limit_bar = fit.limit()
    present = [i for i, v in enumerate(done) if v.setting == scene.own_setting()]
    value = values[present[0]] if present else limit + errors[0]
    found = Probe(column, kind, fit, scale, limit, limit_bar, float(value), bool(present),
                  float(errors[0]), float(bars[0]), faults=[f for f in faults if not f.scatter],
                  scatter=[f for f in faults if f.scatter])
    found.limit_bar += found.scatter_bar
    found.error_bar += found.scatter_bar
    for k, p in enumerate(scene.parameters):
        found.shares[p.name] = float(fit.errors(own, only=k)[0][0])
    return found
