# SPDX-License-Identifier: GPL-2.0-or-later
"""What a search file says."""
import re
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

from magfsi.study import marked
from magfsi.study.expression import Formula, formula
from magfsi.study.product import Cell
from magfsi.study.study_file import Norm, Setting, read_name, read_sets, read_terms, read_time
from magfsi.units import PATTERN, parse, size_of

METHODS = ("cmaes", "gaussian_process", "tpe", "random")
NUMBERS = ("final", "peak", "mean", "amplitude")
KEYS = ("name", "scene", "set", "parameters", "derived", "measures", "maximize", "minimize",
        "require", "method", "runs", "seed", "at_a_time", "stop_early", "ranks", "limit", "finer",
        "check")


@dataclass
class Parameter:
    """A range of numbers, or a choice of words."""
    name: str
    key: str  # of the scene; empty: for `derived` and formulas alone
    low: float = 0.0  # SI
    high: float = 0.0
    unit: str = ""  # as the file has it
    size: float = 1.0  # of that unit in SI
    start: float | None = None
    words: list | None = None
    mark: marked.Value = None

    def text(self, value):
        """As a scene has it."""
        return value if self.words else f"{value / self.size:.9g} {self.unit}".strip()

    def from_unit(self, part):
        """Methods search between 0 and 1 in each parameter, whatever its unit."""
        return part if self.words else self.low + part * (self.high - self.low)


@dataclass
class Template:
    """Text with formulas in braces: "[0 s, {rise} s, {rise + hold} s]"."""
    parts: list  # text and Formula in turn

    def text(self, values):
        return "".join(p if isinstance(p, str) else f"{float(p(**values)):.9g}"
                       for p in self.parts)


@dataclass
class Requirement:
    name: str
    formula: Formula
    at_least: float
    at_most: float


@dataclass
class Search:
    file: Path
    name: str
    scene: Path
    sets: dict
    parameters: dict
    derived: dict  # key of the scene: Template
    measures: dict  # name: Norm
    objective: Formula
    maximize: bool
    require: list
    method: str
    runs: int
    seed: int
    at_a_time: int
    stop_early: list  # times at which a run may turn out hopeless [s]
    ranks: str
    limit_s: float
    finer: tuple | None  # (sets, how many of the best)
    check: dict | None  # sets
    scene_mark: marked.Value = None

    def probed(self):
        """What norms.check_probes looks at."""
        return SimpleNamespace(norms=list(self.measures.values()))

    def cell(self, values, more=None):
        """The run of these values: {parameter: number in SI, or word}."""
        settings = {n: Setting(p.text(values[n]), {}, values[n], p.mark)
                    for n, p in self.parameters.items()}
        sets = dict(self.sets)
        sets |= {p.key: p.text(values[n]) for n, p in self.parameters.items() if p.key}
        sets |= {key: template.text(values) for key, template in self.derived.items()}
        return Cell(settings, {**sets, **(more or {})}, self.ranks, None)


def _range(name, key, keys):
    """Of numbers of one unit, in SI."""
    ends = [parse(item.text()) for item in keys["range"].items("a list of two numbers")]
    if len(ends) != 2 or not all(ends) or ends[0][1] != ends[1][1]:
        keys["range"].refuse(keys["range"].shown(), "two numbers of one unit: [1 mT, 20 mT]")
    (low, unit), (high, _) = ends
    written = PATTERN.match(keys["range"].items()[0].text()).group(2)
    if not low < high:
        keys["range"].refuse(f"an empty range, {keys['range'].text()}", "the smaller one first")
    start = None
    if keys["start"]:
        found = parse(keys["start"].scalar())
        if not found or found[1] != unit or not low <= found[0] <= high:
            keys["start"].refuse(keys["start"].shown(), f"a value in {keys['range'].text()}")
        start = found[0]
    return Parameter(name, key, low, high, written, size_of(written)[1], start,
                     mark=keys["range"])


def _parameter(name, value):
    keys = value.keys(("key", "range", "start", "values"))
    if not name.isidentifier():
        value.refuse(f'the parameter "{name}"', "a name of letters, digits and _, a letter first")
    if bool(keys["range"]) == bool(keys["values"]):
        value.refuse(f'"{name}" with {"both" if keys["range"] else "neither"} of range and values',
                     "one of them")
    key = keys["key"].scalar() if keys["key"] else ""
    if keys["range"]:
        return _range(name, key, keys)
    words = [item.text() for item in keys["values"].items()]
    if len(words) < 2:
        keys["values"].refuse(f"{len(words)} of them", "at least two")
    return Parameter(name, key, words=words, mark=keys["values"])


def _template(value, names):
    pieces = re.split(r"\{([^{}]*)\}", value.text())
    return Template([piece if i % 2 == 0 else formula(value, names, piece)
                     for i, piece in enumerate(pieces)])


def _measure(name, value, parameters):
    keys = value.keys(("probe", "number", "change", "from", "until"), ("probe", "number"))
    norm = Norm(name, read_terms(keys["probe"], parameters), keys["number"].choice(NUMBERS),
                None, mark=keys["probe"])
    norm.change = bool(keys["change"]) and keys["change"].choice(("true", "false")) == "true"
    norm.start_s = read_time(keys["from"], norm.start_s)
    norm.end_s = read_time(keys["until"], norm.end_s)
    if norm.start_s >= norm.end_s:
        keys["until"].refuse(keys["until"].shown(), "a time after `from`")
    return norm


def _requirement(name, value, names):
    keys = value.keys(("formula", "at_least", "at_most"), ("formula",))
    if not keys["at_least"] and not keys["at_most"]:
        value.refuse("no bound", "at_least, at_most or both")
    low, high = (keys[k].number() if keys[k] else s * float("inf")
                 for k, s in (("at_least", -1), ("at_most", 1)))
    return Requirement(name, formula(keys["formula"], names), low, high)


def _whole(value, default, least=1):
    if not value:
        return default
    number = value.number()
    if number != int(number) or number < least:
        value.refuse(value.shown(), f"a whole number of at least {least}")
    return int(number)


def _times(value):
    return sorted(read_time(item, None) for item in value.items("a list of times")) if value else []


def _finer(value):
    if not value:
        return None
    keys = value.keys(("set", "best"), ("set",))
    return read_sets(keys["set"]), _whole(keys["best"], 3, 2)


def read_search(path):
    """Throws marked.InputError."""
    path = Path(path)
    top = marked.read(path, "search")
    keys = top.keys(KEYS, ("scene", "parameters", "measures"))
    if bool(keys["maximize"]) == bool(keys["minimize"]):
        top.refuse("both maximize and minimize" if keys["maximize"] else "no objective",
                   "one of maximize and minimize: a formula of the measures")
    parameters = {n: _parameter(n, v) for n, v in keys["parameters"].entries().items()}
    if not parameters:
        keys["parameters"].refuse("no parameters", "at least one")
    numbers = [n for n, p in parameters.items() if not p.words]
    measures = {n: _measure(n, v, numbers) for n, v in keys["measures"].entries().items()}
    names = [*measures, *numbers]
    method = keys["method"].choice(METHODS) if keys["method"] else "cmaes"
    if method in ("cmaes", "gaussian_process") and len(numbers) < len(parameters):
        (keys["method"] or keys["parameters"]).refuse(
            f"{method} with parameters that are words", "tpe or random with them")
    return Search(
        path, read_name(keys["name"], path.stem), path.parent / keys["scene"].scalar(),
        read_sets(keys["set"]), parameters,
        {k: _template(v, numbers) for k, v in keys["derived"].entries().items()}
        if keys["derived"] else {}, measures,
        formula(keys["maximize"] or keys["minimize"], names), bool(keys["maximize"]),
        [_requirement(n, v, names) for n, v in keys["require"].entries().items()]
        if keys["require"] else [], method, _whole(keys["runs"], 60), _whole(keys["seed"], 1, 0),
        _whole(keys["at_a_time"], 1), _times(keys["stop_early"]),
        keys["ranks"].scalar() if keys["ranks"] else "", read_time(keys["limit"], 86400.0),
        _finer(keys["finer"]), read_sets(keys["check"].keys(("set",), ("set",))["set"])
        if keys["check"] else None, keys["scene"])
