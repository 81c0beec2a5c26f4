# SPDX-License-Identifier: GPL-2.0-or-later
"""Which runs to make of a scene: a star about a coarse setting, whose arms each refine one
parameter, and runs that refine all, so that all together fit a budget by the cost model."""
import math
import os
import statistics
import subprocess
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from magfsi import runs
from magfsi.cost import parameters as numerical
from magfsi.study import store
from magfsi.study.product import Cell

START_UP_S = 0.4  # of a job of processes
COARSENINGS = (1, 1.25, 1.5, 2, 2.5, 3, 4)  # of the star's centre against the scene
KEPT_WHOLE = 1.5  # a leading part is better than a coarser centre than this
SPARE = 0.85  # of the budget: predictions are off by some 10 %
MIN_ROWS = 8  # of probes, in a leading part
TRIAL_S = 6.0  # by the prices below, of the run that tells how fast an uncalibrated machine is
FRACTIONS = (1, 1 / 2, 1 / 4, 1 / 8, 1 / 16, 1 / 32, 1 / 64)
# Seconds of a machine that nobody has calibrated: a cell's and an element's update, a step of
# LAMMPS, an equilibrium a node^1.3.
CELL_S = {"lbm": 2e-8, "openfoam": 1.5e-6}
ELEMENT_S, SUBSTEP_S, NODE_S = 8e-8, 3e-5, 1e-6


class CannotRun(Exception):
    """What the program says of a setting."""


@dataclass
class Named(Cell):
    words: str = ""

    def text(self):
        return self.words


@dataclass
class Variant:
    setting: dict  # parameter: how many times finer than the scene
    sets: dict
    facts: dict
    part: str  # of the star
    run: store.Run = None
    sizes: dict = field(default_factory=dict)

    def text(self):
        found = [f"{name} x {1 / f:.3g}" for name, f in self.setting.items() if f != 1]
        return ", ".join(found) or "the scene's own"


def uncalibrated_s(facts):
    scene = facts["scene"]
    end, fluid = scene["time"]["end"], scene.get("fluid")
    elements = sum(math.prod(numerical.element_counts(b["mesh"]) or [1000])
                   for b in scene.get("bodies", {}).values())
    if "equilibrium" in scene["time"]:
        points = end / scene["probes"]["every"] if "probes" in scene else 1
        return points * NODE_S * (2 * elements)**1.3
    seconds = 0
    if fluid:
        cells = math.prod(side / fluid["spacing"] for side in fluid["box"])
        finer = 2**numerical.levels(scene)
        steps = end / facts["fluid"]["step_s"] / finer
        seconds += steps * cells * CELL_S[fluid["solver"]] * finer**1.5
    if elements:
        seconds += end / facts["structure"]["step_s"] * (SUBSTEP_S + elements * ELEMENT_S)
    return seconds


def work_s(facts):
    """Of the steps."""
    predicted = facts.get("predicted", {}).get("wall_s")
    return max(1e-3, predicted or facts["slower"] * uncalibrated_s(facts))


def seconds(facts):
    """Of a run, start-up included."""
    return START_UP_S + work_s(facts)


def memory_bytes(facts):
    return sum(facts.get("predicted", {}).get("memory_bytes", {}).values()) or None


class Scene:
    """A scene whose variants are asked for."""

    def __init__(self, path, sets=None, ranks=""):
        self.path, self.ranks, self.known = path, ranks, {}
        self.slower = 1.0  # than the prices above, of a machine that is not calibrated
        self.own_sets = dict(sets or {})
        self.facts = self.explain({})
        scene = self.facts["scene"]
        self.scene_keys = set(scene)
        # Files and states cost time and tell nothing here.
        self.own_sets |= {key: "" for key in ("output", "checkpoint", "accuracy")
                          if key in scene and scene[key]}
        self.parameters = numerical.parameters(scene)

    def explain(self, sets):
        """Facts of the scene with other values; raises CannotRun."""
        key = tuple(sorted(sets.items()))
        if key not in self.known:
            try:
                self.known[key] = runs.explain(self.path, {**self.own_sets, **sets},
                                               self.ranks, as_json=True)
            except subprocess.CalledProcessError as error:
                self.known[key] = error.stderr.strip().splitlines()[-1]
        if isinstance(self.known[key], str):
            raise CannotRun(self.known[key])
        return self.known[key] | {"slower": self.slower}

    def variant(self, setting, part="", length=None):
        """length: [s] of the run, in place of the scene's."""
        more = {"time.end": f"{length:.12g} s"} if length else {}

        def explain(sets):
            return self.explain({**sets, **more})
        sets = numerical.sets_of(self.facts, setting, explain) | more
        facts = self.explain(sets)
        found = Variant(setting, {**self.own_sets, **sets}, facts, part)
        found.sizes = numerical.sizes(self.facts, facts, setting)
        return found

    def variants(self, wanted, length=None):
        """Of each (setting, part) its variant, or the CannotRun it ends with. A large mesh takes
        seconds to explain: as many at once as there are processors."""
        def one(setting_and_part):
            try:
                return self.variant(*setting_and_part, length)
            except CannotRun as error:
                return error
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            return list(pool.map(one, wanted))

    def own_setting(self):
        return {p.name: 1 for p in self.parameters}

    def lengths(self):
        """[s] of the whole and of leading parts, with what they are called."""
        scene = self.facts["scene"]
        end = scene["time"]["end"]
        out = [(end, "the whole run")]
        if "equilibrium" in scene["time"]:
            return out
        every = scene["probes"]["every"] if "probes" in scene else end
        period = period_of(scene)
        wanted = [(end * f, f"1/{round(1 / f)} of the run") for f in FRACTIONS[1:]]
        if period and period < end:  # parts of whole periods, or of less than one
            whole = [int(end / period * (1 - 1e-9) * f) for f in FRACTIONS]
            wanted = [w for w in wanted if w[0] < period]
            wanted += [(n * period, f"the first {n} periods" if n > 1 else "the first period")
                       for n in {*whole, 1} if n]
        for length, words in sorted(wanted, reverse=True):
            rows = round(length / every)
            if rows >= MIN_ROWS:
                out.append((rows * every, f"{words}, to {rows * every:.4g} s"))
        return out


def period_of(scene):
    """Of the field or of a motion; None without."""
    field_ = scene.get("magnetic_field", {})
    if field_.get("table", {}).get("repeat"):
        return field_["table"]["time"][-1]
    if "rotation" in field_:
        return 1 / abs(field_["rotation"]["frequency"] or math.inf) or None
    for body in scene.get("bodies", {}).values():
        for motion in body.get("prescribed_motion", []):
            course = motion.get("turning", motion)
            if "oscillation" in course:
                return 1 / course["oscillation"]["frequency"]
    return None


def _arm(parameter, centre):
    """Factors of an arm, the centre's first."""
    out = [centre]
    for share in parameter.shares[1:]:
        finer = parameter.nearest(centre / share, above=out[-1])
        if finer and finer <= 2.5 * centre / share:
            out.append(finer)
    return out


def _centre(scene, coarser):
    """So many times coarser than the scene, where that makes sense."""
    coarsest = {"step": numerical.COARSEST_STEP,
                "spacing": numerical.coarsest_spacing(scene.facts["scene"])}
    return {p.name: min(1, p.nearest(1 / min(coarser, coarsest.get(p.name, coarser))))
            for p in scene.parameters}


def star(scene, coarser):
    """Variants about a centre, each once."""
    centre = _centre(scene, coarser)
    settings = [(centre, "centre")]
    arms = {p.name: _arm(p, centre[p.name]) for p in scene.parameters}
    for name, arm in arms.items():
        settings += [({**centre, name: f}, name) for f in arm[1:]]
    middle = {name: arm[min(1, len(arm) - 1)] for name, arm in arms.items()}
    if "spacing" in arms:
        settings.append(({**centre, "spacing": middle["spacing"], "step": arms["step"][-1]},
                         "spacing and step"))
    finest = {name: arm[-1] for name, arm in arms.items()}
    if len(arms) > (2 if "spacing" in arms else 1):
        settings.append((middle if "spacing" in arms else finest, "all finer"))
    settings.append((scene.own_setting(), "present"))
    different = []
    for setting, part in settings:
        if all(setting != other for other, _ in different):
            different.append((setting, part))
    out = []
    for (setting, _), found in zip(different, scene.variants(different)):
        if not isinstance(found, CannotRun):
            out.append(found)
        elif setting in (centre, scene.own_setting()):
            raise found
    return out


def _affordable(variants, budget_s, share):
    """Without what alone takes most of the budget: the scene's own setting, or all finer. share:
    of the run that is to be run; None if it does not fit."""
    def total_s(some):
        return sum(START_UP_S + share * work_s(v.facts) for v in some)
    if total_s(variants) <= SPARE * budget_s:
        return variants
    lean = [v for v in variants if v.part not in ("present", "all finer")]
    if total_s(lean) > SPARE * budget_s:
        return None
    for v in variants:
        if v not in lean and total_s([*lean, v]) <= SPARE * budget_s:
            lean.append(v)
    return lean


class _Stars:
    """By how much coarser their centre is, made when they are asked for."""

    def __init__(self, scene):
        self.scene, self.made = scene, {}

    def fitting(self, coarser, budget_s, share):
        """Its variants that fit the budget, or None."""
        if coarser not in self.made:
            # Of all runs the centre is the cheapest; each arm has one more at least.
            centre = self.scene.variant(_centre(self.scene, coarser))
            runs_at_least = 1 + len(self.scene.parameters)
            if (START_UP_S + share * work_s(centre.facts)) * runs_at_least > budget_s:
                return None
            self.made[coarser] = star(self.scene, coarser)
        return _affordable(self.made[coarser], budget_s, share)


def plan(scene, budget_s):
    """(variants from cheap to dear, length [s] or None, words for it). The finest star that
    fits; where only a coarse one does, a leading part of the run."""
    lengths, stars, cannot = scene.lengths(), _Stars(scene), None
    whole = lengths[0][0]
    for most in (KEPT_WHOLE, COARSENINGS[-1]):
        for length, words in lengths:
            for coarser in (c for c in COARSENINGS if c <= most):
                try:
                    found = stars.fitting(coarser, budget_s, length / whole)
                except CannotRun as error:
                    cannot = cannot or error
                    continue
                if found:
                    if length < whole:
                        found = scene.variants([(v.setting, v.part) for v in found], length)
                        if cannot := next((v for v in found if isinstance(v, CannotRun)), None):
                            raise cannot
                    return sorted(found, key=lambda v: seconds(v.facts)), length, words
    if cannot:
        raise cannot
    raise CannotRun(f"no runs of this scene fit into {budget_s:g} s, even a hundredth of it on "
                    "coarse grids; take a larger --budget")


def trial(scene):
    """A short run of a coarser scene, from which the speed of a machine that is not calibrated
    follows; None where that is known, or where the whole scene is as short."""
    if scene.facts.get("predicted") or work_s(scene.facts) <= TRIAL_S:
        return None
    for coarser in sorted(COARSENINGS[:3], reverse=True):
        try:
            setting = _centre(scene, coarser)
            coarse_s = work_s(scene.variant(setting).facts)
        except CannotRun:  # its cells do not divide the box
            continue
        break
    whole, shortest = scene.lengths()[0][0], scene.lengths()[-1][0]
    length = next((at for at, _ in scene.lengths() if at / whole * coarse_s <= TRIAL_S), shortest)
    return scene.variant(setting, "trial", length)


def to_run(scene, variants, out):
    """Gives each variant its run in the store."""
    for v in variants:
        cell = Named({}, v.sets, scene.ranks, None, v.text())
        v.run = store.planned(store.scene_file(scene.path), cell, out)


def correction(variants):
    """What the steps of runs took over what was predicted."""
    known = [max(1e-3, v.run.summary["wall_s"]) / work_s(v.facts)
             for v in variants if v.run.completed() and "wall_s" in v.run.summary]
    return statistics.median(known[-3:]) if known else 1.0  # start-up rules the cheap ones
