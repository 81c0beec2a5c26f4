# SPDX-License-Identifier: GPL-2.0-or-later
"""What a study file says."""
import re
from dataclasses import dataclass, field
from pathlib import Path

from magfsi.study import marked
from magfsi.study.expression import Formula, formula
from magfsi.study.foreign_table import Table, TableFault
from magfsi.study.product import read_derived
from magfsi.units import parse

NORMS = ("final", "max", "max_relative", "l2", "peak", "mean", "amplitude", "gain", "rise",
         "largest")
WITHOUT_REFERENCE = ("gain", "rise", "largest")


@dataclass
class Setting:
    """A value of an axis: how it is called, what it sets, and its place in the file."""
    label: str
    sets: dict  # key path: text for --set; "ranks" is the option of that name
    value: object  # number in SI, list of numbers, or text: for formulas and figures
    mark: marked.Value


@dataclass
class Axis:
    name: str
    settings: list
    unit: str | None  # of all values, None where they are words or lists
    key_mark: marked.Value | None  # where all settings are of one key


@dataclass
class Reference:
    """Exactly one of: a number, a formula of t, a table, tables by an axis, the finest run."""
    number: float | None = None
    formula: Formula | None = None
    times: list | None = None
    values: list | None = None
    by_axis: str = ""
    tables: dict | None = None  # label of that axis: reference
    finest: dict | None = None  # axis: label that the finest run has


@dataclass
class Norm:
    name: str
    terms: list  # (weight, column of probes.csv), to be summed; a formula of axes may weigh
    norm: str
    reference: Reference | None  # None: of WITHOUT_REFERENCE
    change: bool = False  # of the probe since its first row
    factor: float = 1.0
    start_s: float = float("-inf")
    end_s: float = float("inf")
    mark: marked.Value = None

    @property
    def probe(self):
        def words(weight):
            if isinstance(weight, Formula):
                return f" + ({weight.text}) * "
            return {1.0: " + ", -1.0: " - "}.get(weight, f" + {weight:g} * ")
        return "".join(words(w) + n for w, n in self.terms).removeprefix(" + ")


@dataclass
class Study:
    file: Path
    name: str
    scene: Path
    sets: dict
    ranks: str
    limit_s: float
    axes: dict
    pairs: list
    skip: list
    order_axis: str | None
    size: Formula | None
    expected: dict
    series: list
    norms: list
    targets: list
    right_within: dict  # by norm; empty: no verdict
    derived: dict
    refusals_are_rows: bool
    cost: str
    remark: str  # ends results.md
    top: marked.Value = field(repr=False, default=None)
    scene_mark: marked.Value = field(repr=False, default=None)


def _common_unit(values):
    units = {v[1] for v in values if v}
    return units.pop() if len(units) == 1 and all(values) else None


def _plain(value):
    """A list of numbers, a number, or the text."""
    if value.is_list():
        numbers = [parse(item.text()) for item in value.items()]
        return [n[0] for n in numbers] if all(numbers) else value.text()
    number = parse(value.text())
    return number[0] if number else value.text()


def _setting(key, value):
    label = "default" if value.is_null() else value.text()
    return Setting(label, {key: "" if value.is_null() else value.text()}, _plain(value), value)


def _axis(name, value):
    keys = value.keys(("key", "values"), ("values",))
    if not name.isidentifier() or name in ("t", "wall", "core", "error"):
        value.refuse(f'the axis "{name}"', "a name of letters, digits and _, a letter first, "
                     "other than t, wall, core, error")
    if keys["key"]:
        key = keys["key"].scalar()
        settings = [_setting(key, item) for item in keys["values"].items("a list of values")]
    else:
        settings = []
        for label, entry in keys["values"].entries("a list with key, or a map of name: "
                                                   "{path.to.key: value}").items():
            sets = {k: "" if v.is_null() else v.text() for k, v in entry.entries().items()}
            number = parse(label)
            settings.append(Setting(label, sets, number[0] if number else label, entry))
    if not settings:
        keys["values"].refuse("no values", "at least one")
    unit = _common_unit([parse(s.label) for s in settings])
    return Axis(name, settings, unit, keys["key"])


def _table(value, axes, folder):
    keys = value.keys(("file", "time", "time_factor", "value", "value_factor"),
                      ("file", "time", "value"))
    path = folder / keys["file"].scalar()
    named = [axis for axis in axes if f"{{{axis}}}" in path.name]
    if named:  # a file for each value of that axis
        return Reference(by_axis=named[0], tables={
            s.label: _one_table(keys, path.with_name(path.name.replace(f"{{{named[0]}}}", s.label)))
            for s in axes[named[0]].settings})
    return _one_table(keys, path)


def _one_table(keys, path):
    columns = []
    try:
        table = Table(path)
        for which in ("time", "value"):
            name = keys[which].scalar()
            if name not in table.names:
                keys[which].refuse(f'"{name}"', f"a column of {path}: {', '.join(table.names)}")
            factor = keys[f"{which}_factor"]
            scale = factor.number() if factor else 1.0
            columns.append([scale * number for number in table.numbers(name)])
    except OSError as error:
        keys["file"].refuse(f"{path}: {error.strerror.lower()}", "a CSV file")
    except TableFault as fault:
        keys["file"].refuse(str(fault), "a table of numbers with a header")
    return Reference(times=columns[0], values=columns[1])


def _reference(value, axes, folder):
    if not value.is_map():
        if value.text() == "finest":
            return Reference(finest={})
        return Reference(number=value.number())
    kinds = ("value", "formula", "table", "finest")
    keys = value.keys(kinds)
    given = [k for k in kinds if keys[k]]
    if len(given) != 1:
        value.refuse(", ".join(given) or "none", f"exactly one of {', '.join(kinds)}")
    if keys["value"]:
        return Reference(number=keys["value"].number())
    if keys["formula"]:
        return Reference(formula=formula(keys["formula"], ["t", *axes]))
    if keys["table"]:
        return _table(keys["table"], axes, folder)
    return Reference(finest=_chosen(keys["finest"], axes, single=True))


def _chosen(value, axes, single=False):
    """{axis: label} or {axis: [labels]}, checked."""
    out = {}
    for name, chosen in value.entries().items():
        if name not in axes:
            chosen.refuse(f'the axis "{name}"', f"one of {', '.join(axes)}")
        labels = [s.label for s in axes[name].settings]
        several = chosen.is_list() and chosen.text() not in labels and not single
        wanted = chosen.items() if several else [chosen]
        for label in wanted:
            if label.text() not in labels:
                label.refuse(label.shown(), f"a value of this axis: {', '.join(labels)}")
        out[name] = [w.text() for w in wanted] if not single else wanted[0].text()
    return out


def _term(item, axes):
    """(weight, column) of "column", "- column", "0.5 * column" or "(1 - 1 / axis) * column"."""
    text = item.scalar()
    weight, star, column = text.rpartition(" * ")
    if not star:
        return (-1.0, text[1:].strip()) if text.startswith("-") else (1.0, text)
    try:
        return float(weight), column.strip()
    except ValueError:
        return formula(item, list(axes), weight), column.strip()


def read_terms(value, axes):
    """One column, or a list to be summed."""
    return [_term(item, axes) for item in (value.items() if value.is_list() else [value])]


def _norm(name, value, axes, folder):
    keys = value.keys(("probe", "norm", "reference", "change", "factor", "from"),
                      ("probe", "norm"))
    kind = keys["norm"].choice(NORMS)
    if (kind in WITHOUT_REFERENCE) == bool(keys["reference"]):
        value.refuse(f"{kind} with{'' if keys['reference'] else 'out'} a reference",
                     f"a reference for every norm but {', '.join(WITHOUT_REFERENCE)}")
    norm = Norm(name, read_terms(keys["probe"], axes), kind,
                _reference(keys["reference"], axes, folder) if keys["reference"] else None,
                mark=keys["probe"])
    if keys["change"]:
        norm.change = keys["change"].choice(("true", "false")) == "true"
    if keys["factor"]:
        norm.factor = keys["factor"].number()
    norm.start_s = read_time(keys["from"], norm.start_s)
    if norm.norm in ("max", "max_relative", "l2") and norm.reference.number is not None:
        keys["reference"].refuse("one number", f"a course in time for the norm {norm.norm}: "
                                 "formula, table or finest")
    return norm


def read_time(value, default):
    if not value:
        return default
    time = parse(value.scalar())
    if not time or time[1] != "s" or time[0] <= 0:
        value.refuse(value.shown(), "a time such as 10 min")
    return time[0]


def _order(value, axes):
    if not value:
        return None, None, {}
    keys = value.keys(("axis", "size", "expected", "expected_cost"), ("axis",))
    name = keys["axis"].choice(tuple(axes))
    if not keys["size"] and any(not isinstance(s.value, float) for s in axes[name].settings):
        keys["axis"].refuse(f'"{name}", whose values are no numbers',
                            "this with size: a formula such as 1 / " + name)
    size = formula(keys["size"], list(axes)) if keys["size"] else Formula(name)
    expected = {what: keys[key].number() for what, key in
                (("order", "expected"), ("cost", "expected_cost")) if keys[key]}
    return name, size, expected


def _names(value, axes):
    return [item.choice(tuple(axes)) for item in value.items()]


def _pairs(value, axes):
    pairs = []
    for item in value.items("a list of lists of axes"):
        names = _names(item, axes)
        if len({len(axes[n].settings) for n in names}) > 1:
            item.refuse("axes with " + ", ".join(str(len(axes[n].settings)) for n in names)
                        + " values", "axes of the same length")
        pairs.append(names)
    return pairs


def _right_within(value, norms):
    """One share for all errors, or a map of error: share; those that it leaves out do not
    judge."""
    if not value:
        return {}
    if not value.is_map():
        return {norm.name: value.share() for norm in norms}
    shares = value.entries()
    for name, share in shares.items():
        if name not in [norm.name for norm in norms]:
            share.refuse(f'the error "{name}"', f"one of {', '.join(n.name for n in norms)}")
    return {name: share.share() for name, share in shares.items()}


def read_name(value, default):
    """It names the run folder, runs/study_NAME."""
    name = value.scalar() if value else default
    if value and not re.fullmatch(r"[\w+=,.() -]{1,64}", name, re.ASCII):
        value.refuse(f'"{name}"', "at most 64 letters, digits, blanks and _ + = , . ( ) -")
    return name


def read_sets(value):
    """{path.to.key: text for --set}, where null takes a key away."""
    if not value:
        return {}
    return {k: "" if v.is_null() else v.text() for k, v in value.entries().items()}


KEYS = ("name", "scene", "set", "derived", "ranks", "limit", "axes", "pairs", "skip", "order",
        "series", "errors", "targets", "right_within", "refusals", "cost", "remark")


def read_study(path):
    """Throws marked.InputError."""
    path = Path(path)
    if path.is_dir():
        path = path / "study.yaml"
    top = marked.read(path)
    keys = top.keys(KEYS, ("scene", "axes", "errors"))
    folder = path.parent
    axes = {name: _axis(name, value) for name, value in keys["axes"].entries().items()}
    order_axis, size, expected = _order(keys["order"], axes)
    norms = [_norm(n, v, axes, folder) for n, v in keys["errors"].entries().items()]
    if not norms:
        keys["errors"].refuse("no errors", "at least one")
    if not order_axis and any(n.reference and n.reference.finest is not None for n in norms):
        keys["errors"].refuse("the reference finest", "it with order.axis, which says what is "
                              "fine")
    targets = [v.share() for v in keys["targets"].items()] if keys["targets"] else [
        0.1, 0.03, 0.01]
    return Study(
        path, read_name(keys["name"], path.resolve().parent.name),
        folder / keys["scene"].scalar(), read_sets(keys["set"]),
        keys["ranks"].scalar() if keys["ranks"] else "",
        read_time(keys["limit"], 86400.0), axes, _pairs(keys["pairs"], axes) if keys["pairs"] else [],
        [_chosen(v, axes) for v in keys["skip"].items()] if keys["skip"] else [],
        order_axis, size, expected,
        _names(keys["series"], axes) if keys["series"] else [n for n in axes if n != order_axis],
        norms, targets, _right_within(keys["right_within"], norms),
        read_derived(keys["derived"], axes) if keys["derived"] else {},
        bool(keys["refusals"]) and keys["refusals"].choice(("rows",)) == "rows",
        keys["cost"].choice(("wall", "core")) if keys["cost"] else "wall",
        keys["remark"].scalar().strip() if keys["remark"] else "", top,
        keys["scene"])
