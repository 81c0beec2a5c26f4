# SPDX-License-Identifier: GPL-2.0-or-later
"""Kernels, collisions, forcings and elements are ways to the same limit: where limits differ by
more than their bars, one of them is at fault, and none is a matter of choice."""
import dataclasses
from dataclasses import dataclass

from magfsi.cost import command
from magfsi.cost.variants import CannotRun

ELEMENTS = ("assumed_strain", "full")
IN_FLUID = (("coupling.immersed_boundary.forcing", ("penalty", "no_slip")),
            ("coupling.immersed_boundary.kernel", ("2-point", "3-point", "4-point")))
COLLISIONS = ("trt", "recursive_regularized")


@dataclass
class Model:
    key: str
    value: str
    result: command.Result = None
    refused: str = ""

    def text(self):
        return f"{self.key}={self.value}" if self.key else "as in the scene"


def _now(scene, key):
    """The value of a key in the scene in SI."""
    for part in key.split("."):
        scene = scene.get(part, {})
    return scene


def alternatives(scene):
    """[Model] other than the scene's own. scene: in SI."""
    keys = []
    if scene.get("bodies") and "fluid" in scene:
        keys += IN_FLUID
    if scene.get("fluid", {}).get("solver") == "lbm":
        keys.append(("fluid.collision", COLLISIONS))
    if scene.get("bodies") and "fluid" not in scene:
        keys += [(f"bodies.{name}.element", ELEMENTS) for name in scene["bodies"]]
    return [Model(key, value) for key, values in keys for value in values
            if value != _now(scene, key)]


def compare(wish, own):
    """The scene's own model first; own: its Result, not yet run."""
    models = [Model("", "", own), *alternatives(own.scene.facts["scene"])]
    share = dataclasses.replace(wish, budget_s=wish.budget_s / len(models))
    for model in models:
        one = dataclasses.replace(share, sets={**wish.sets, model.key: model.value}
                                  if model.key else wish.sets)
        try:
            model.result = command.planned(one)
            print(f"{model.text()}:", flush=True)
            command.do(model.result, one)
            command.conclude(model.result, one)
        except CannotRun as why:
            if not model.key:
                raise
            model.result, model.refused = None, str(why)
    return models


def _verdict(own, other):
    apart, bars = abs(other.limit - own.limit), own.limit_bar + other.limit_bar
    if own.faults or other.faults:
        return "one of the two has no limit"
    if apart > bars:
        return f"FAULT: the limits differ by {apart:.2g}, their bars make {bars:.2g}"
    return "agrees within the bars"


def text(models):
    lines = ["Limits by model; those that differ are a fault to report, not a choice:"]
    for own in models[0].result.headline:
        lines.append(f"{own.column}, {own.norm}")
        for model in models:
            if model.refused:
                lines.append(f"  {model.text()}: not run: {model.refused}")
                continue
            p = next((p for p in model.result.probes if p.column == own.column), None)
            if p is None:
                continue
            words = f"  {model.text()}: {p.limit:.5g} +- {p.limit_bar:.2g}"
            faults = [f.parameter for f in [*model.result.faults, *p.faults]]
            if faults:
                words += f" (doubtful: {', '.join(sorted(set(faults)))})"
            lines.append(words + ("" if p is own else f"; {_verdict(own, p)}"))
    return "\n".join(lines) + "\n"
