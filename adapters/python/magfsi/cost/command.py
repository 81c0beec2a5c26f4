# SPDX-License-Identifier: GPL-2.0-or-later
"""What ./magfsi cost and ./magfsi run --error have in common: the runs of a scene and what they
tell."""
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from magfsi.cost import advice as advising
from magfsi.cost import probes as choosing
from magfsi.cost import result as finding
from magfsi.cost import variants as making
from magfsi.study import store
from magfsi.study.norms import NoError

UNTOUCHED = 1e-7  # of the scale: a probe that no parameter changes, such as the field
TRIAL_LIMIT_S = 60.0
LIMIT = 5.0  # a run that takes so many times what it should, and 30 s, is ended


@dataclass
class Wish:
    """What a user asks for."""
    path: Path
    sets: dict = field(default_factory=dict)
    ranks: str = ""
    out: Path = None
    budget_s: float = 300.0
    probes: list = field(default_factory=list)
    norm: str = "final"
    start_s: float = None
    tolerances: tuple = advising.TOLERANCES


@dataclass
class Result:
    scene: making.Scene
    variants: list
    budget_s: float
    length_words: str
    norm: str
    start_s: float = None
    done: list = field(default_factory=list)  # of the variants
    probes: list = field(default_factory=list)
    headline: list = field(default_factory=list)
    faults: list = field(default_factory=list)  # of all probes
    settings: advising.Settings = None
    advice: list = field(default_factory=list)


def planned(wish, dry=False):
    """The scene and its variants, of which none is run yet, but for a trial of the machine's speed
    where that is not known. dry: not that either. Raises variants.CannotRun."""
    scene = making.Scene(wish.path, wish.sets, wish.ranks)
    if not scene.facts["scene"].get("probes"):
        raise making.CannotRun(f"{wish.path}: the scene has no probes, and so nothing to look at; "
                               "add the key probes")
    if not scene.parameters:
        raise making.CannotRun("the scene has no numerical parameter that this command varies")
    trial = making.trial(scene)
    if trial:
        making.to_run(scene, [trial], wish.out)
        if not dry:
            store.do(store.scene_file(wish.path), TRIAL_LIMIT_S, [trial.run], quiet=True)
        if store.is_done(trial.run):
            store.load(trial.run)
            scene.slower = making.correction([trial])
    variants, _, words = making.plan(scene, wish.budget_s)
    making.to_run(scene, variants, wish.out)
    return Result(scene, variants, wish.budget_s, words, wish.norm, wish.start_s)


def do(result, wish):
    """The runs that are missing."""
    longest = max(making.seconds(v.facts) for v in result.variants)

    def check(run):  # a wrong name shows with the first run, not after the last
        if run.completed():
            choosing.chosen(run, wish.probes)
    store.do(store.scene_file(wish.path), 30 + LIMIT * longest,
             [v.run for v in result.variants], check)
    result.done = [v for v in result.variants if v.run.completed()]
    if not result.done:
        raise making.CannotRun("no run completed: " + result.variants[0].run.record["cause"])


def conclude(result, wish):
    """Probes, faults and advice. Raises probes.NoProbe."""
    result.faults = finding.common_faults(result.scene, result.variants)
    columns = choosing.chosen(result.done[-1].run, wish.probes)
    for column in columns:
        try:
            probe = finding.analyse(result.scene, result.variants, column, wish.norm,
                                    wish.start_s)
            if column in wish.probes or np.ptp(probe.fit.values) > UNTOUCHED * probe.scale:
                result.probes.append(probe)
        except NoError as why:
            if wish.probes:
                raise making.CannotRun(f"{column}: {why}") from why
    wanted = columns if wish.probes else choosing.headline(columns)
    result.headline = [p for p in result.probes if p.column in wanted]
    if not result.headline:
        raise making.CannotRun("no probe of the scene changes; name one that does with --probe, or "
                               "give the scene a longer time.end")
    result.settings, result.advice = advising.advise(
        result.scene, result.variants, result.headline, result.faults, wish.tolerances)
    return result
