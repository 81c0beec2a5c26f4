# SPDX-License-Identifier: GPL-2.0-or-later
"""What a design file says."""
import csv
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from magfsi.study import marked
from magfsi.study.study_file import read_name, read_sets
from magfsi.units import parse

KEYS = ("name", "scene", "set", "body", "poses", "magnetization", "stiffness", "thickness", "tolerance")
POSE = ("field", "free", "largest", "curve", "points", "opening", "force")
AXES = {"x": 0, "y": 1, "z": 2}
PLANES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2), "space": (0, 1, 2)}
COLUMN = re.compile(r"([xyz])\s*[\[(](\w+)[\])]$")


@dataclass
class CurveGoal:
    """The centre line on a curve: points (n, 3) [m] of a polygon."""
    points_m: np.ndarray
    count: int
    weight: float
    mark: marked.Value


@dataclass
class PointGoal:
    at_m: np.ndarray  # of the body at rest
    to_m: np.ndarray
    weight: float
    mark: marked.Value


@dataclass
class OpeningGoal:
    between_m: np.ndarray  # (2, 3) of the body at rest
    distance_m: float
    weight: float
    mark: marked.Value


@dataclass
class ForceGoal:
    face: str
    direction: np.ndarray
    force_n: float
    weight: float
    mark: marked.Value


@dataclass
class Pose:
    name: str
    field_t: np.ndarray
    free: str  # "", direction, vector: of the field
    largest_t: float
    goals: list
    mark: marked.Value


@dataclass
class Magnetization:
    strength: float
    free: str  # vector (any up to the strength) or direction (of the strength)
    axes: tuple
    smoothing_m: float
    by: str  # element or region
    constant_along: list
    mirror: int | None
    mark: marked.Value


@dataclass
class FactorRange:
    regions: list
    low: float
    high: float
    mark: marked.Value


@dataclass
class DesignFile:
    file: Path
    name: str
    scene: Path
    sets: dict
    body: str
    poses: list
    magnetization: Magnetization
    stiffness: FactorRange | None
    thickness: FactorRange | None
    tolerance: float
    scene_mark: marked.Value = field(default=None, repr=False)


def quantity(value, unit, what):
    found = parse(value.scalar(what))
    if not found or found[1] != unit:
        value.refuse(value.shown(), what)
    return found[0]


def vector(value, unit, what):
    items = value.items(what)
    if len(items) != 3:
        value.refuse(f"{len(items)} of them", what)
    return np.array([quantity(item, unit, what) for item in items])


PLACE = "a place such as [10 mm, 0 mm, 0 mm]"
FIELD = "a field such as [0 mT, 0 mT, 20 mT]"


def _weight(value):
    if not value:
        return 1.0
    found = value.number()
    if not found > 0:
        value.refuse(value.shown(), "a number above 0")
    return found


def _count(value, default):
    if not value:
        return default
    found = value.number()
    if found != int(found) or not 2 <= found <= 1000:
        value.refuse(value.shown(), "a whole number from 2 to 1000")
    return int(found)


def read_curve(value, folder):
    """Points (n, 3) [m] of a CSV file with the columns x, y, z, of which those of zeros may be
    absent."""
    path = folder / value.scalar("a CSV file")
    try:
        with open(path, newline="") as file:
            rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    except (OSError, UnicodeDecodeError) as error:
        value.refuse(f"{path}, which cannot be read ({error})", "a CSV file of points")
    names = [COLUMN.match(name.strip()) for name in rows[0]] if rows else []
    units = [parse(f"1 {name[2]}") if name else None for name in names]
    if not names or any(not u or u[1] != "m" for u in units):
        value.refuse(f"{path} with the header {','.join(rows[0]) if rows else 'nothing'}",
                     "columns of x[mm], y[mm], z[mm] (or m, um)")
    points = np.zeros((len(rows) - 1, 3))
    for line, row in enumerate(rows[1:]):
        try:
            for name, (size, _), word in zip(names, units, row, strict=True):
                points[line, AXES[name[1]]] = float(word) * size
        except ValueError:
            value.refuse(f"row {line + 1} of {path}: {','.join(row)}", f"{len(names)} numbers")
    if len(points) < 2 or not np.isfinite(points).all():
        value.refuse(f"{path} with {len(points)} points", "two or more points of finite numbers")
    return points


def _curve(value, folder):
    keys = value.keys(("file", "points", "weight"), ("file",))
    return CurveGoal(read_curve(keys["file"], folder), _count(keys["points"], 41),
                     _weight(keys["weight"]), keys["file"])


def _point(value):
    keys = value.keys(("at", "to", "weight"), ("at", "to"))
    return PointGoal(vector(keys["at"], "m", PLACE), vector(keys["to"], "m", PLACE),
                     _weight(keys["weight"]), value)


def _opening(value):
    keys = value.keys(("between", "distance", "weight"), ("between", "distance"))
    ends = keys["between"].items("two places")
    if len(ends) != 2:
        keys["between"].refuse(f"{len(ends)} of them", "two places")
    distance = quantity(keys["distance"], "m", "a distance such as 2 mm")
    if distance < 0:
        keys["distance"].refuse(keys["distance"].shown(), "a distance of 0 or more")
    return OpeningGoal(np.array([vector(e, "m", PLACE) for e in ends]), distance,
                       _weight(keys["weight"]), value)


def _force(value):
    keys = value.keys(("face", "direction", "force", "weight"), ("face", "direction", "force"))
    direction = np.array([item.number() for item in keys["direction"].items("three numbers")])
    if len(direction) != 3 or not np.linalg.norm(direction) > 0:
        keys["direction"].refuse(keys["direction"].text(), "three numbers, not all zero")
    force = quantity(keys["force"], "N", "a force such as 1 mN")
    if force == 0:
        keys["force"].refuse(keys["force"].shown(), "a force other than 0")
    return ForceGoal(keys["face"].scalar(), direction / np.linalg.norm(direction), force,
                     _weight(keys["weight"]), value)


def _pose(name, value, folder):
    keys = value.keys(POSE, ("field",))
    field_t = vector(keys["field"], "T", FIELD)
    free = keys["free"].choice(("direction", "vector")) if keys["free"] else ""
    if not np.linalg.norm(field_t) > 0:
        keys["field"].refuse("a field of zero", FIELD + ": where it is free, the first guess")
    largest = quantity(keys["largest"], "T", "a magnitude such as 20 mT") if keys["largest"] else 0.0
    if keys["largest"] and (free != "vector" or largest < np.linalg.norm(field_t)):
        keys["largest"].refuse(keys["largest"].shown(), "with free: vector, and not below the field")
    goals = [_curve(keys["curve"], folder)] if keys["curve"] else []
    goals += [_point(v) for v in keys["points"].items("a list of points")] if keys["points"] else []
    goals += [_opening(keys["opening"])] if keys["opening"] else []
    goals += [_force(keys["force"])] if keys["force"] else []
    if not goals:
        value.refuse("no goal", "one or more of curve, points, opening, force")
    return Pose(name, field_t, free, largest, goals, value)


def _magnetization(value):
    keys = value.keys(("strength", "free", "plane", "smoothing", "by", "constant_along", "mirror"),
                      ("strength",))
    strength = quantity(keys["strength"], "A/m", "a strength such as 60 kA/m")
    if not strength > 0:
        keys["strength"].refuse(keys["strength"].shown(), "a strength above 0")
    smoothing = quantity(keys["smoothing"], "m", "a length such as 1 mm") if keys["smoothing"] else 0.0
    if smoothing < 0:
        keys["smoothing"].refuse(keys["smoothing"].shown(), "a length of 0 or more")
    along = [AXES[v.choice(tuple(AXES))] for v in keys["constant_along"].items("a list of axes")] \
        if keys["constant_along"] else []
    if len(along) == 3:
        keys["constant_along"].refuse("all three axes", "at most two")
    return Magnetization(
        strength, keys["free"].choice(("vector", "direction")) if keys["free"] else "vector",
        PLANES[keys["plane"].choice(tuple(PLANES))] if keys["plane"] else (0, 1, 2), smoothing,
        keys["by"].choice(("element", "region")) if keys["by"] else "element", along,
        AXES[keys["mirror"].choice(tuple(AXES))] if keys["mirror"] else None, value)


def _factors(value):
    keys = value.keys(("regions", "range"), ("regions", "range"))
    ends = [v.number() for v in keys["range"].items("two numbers")]
    if len(ends) != 2 or not 0 < ends[0] < ends[1]:
        keys["range"].refuse(keys["range"].text(), "two factors, [0.5, 2]")
    return FactorRange([v.scalar() for v in keys["regions"].items("a list of regions")], *ends,
                          keys["regions"])


def read_design(path):
    """Raises marked.InputError."""
    path = Path(path)
    top = marked.read(path, "design")
    keys = top.keys(KEYS, ("scene", "poses", "magnetization"))
    poses = [_pose(name, value, path.parent) for name, value in keys["poses"].entries().items()]
    if not poses:
        keys["poses"].refuse("no poses", "at least one")
    return DesignFile(
        path, read_name(keys["name"], path.stem), path.parent / keys["scene"].scalar(),
        read_sets(keys["set"]), keys["body"].scalar() if keys["body"] else "", poses,
        _magnetization(keys["magnetization"]),
        _factors(keys["stiffness"]) if keys["stiffness"] else None,
        _factors(keys["thickness"]) if keys["thickness"] else None,
        keys["tolerance"].share() if keys["tolerance"] else 0.01, keys["scene"])
