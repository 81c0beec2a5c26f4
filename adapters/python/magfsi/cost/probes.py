# SPDX-License-Identifier: GPL-2.0-or-later
"""Which numbers of a run are looked at: a norm of each probe's course."""
import re

import numpy as np

from magfsi import runs
from magfsi.study import norms
from magfsi.study.study_file import Norm

NORMS = ("final", "peak", "mean", "amplitude")
NOTHING = 1e-3  # of the largest component of its vector: zero by symmetry
MOVES = re.compile(r"_[xyz]\[m\]$")  # a place: its change counts, wherever the scene is put
NOT_PHYSICS = re.compile(r"^(t\[|interface\.)|residual|mismatch")


class NoProbe(Exception):
    """There is none of that name."""


def norm_of(column, kind, start_s=None):
    norm = Norm(column, [(1.0, column)], kind, None, change=bool(MOVES.search(column)))
    if start_s is not None:
        norm.start_s = start_s
    return norm


def value(run, norm):
    """(number, largest magnitude of the course)."""
    _, course = norms.course(run, norm)
    return float(norms.one_number(norm.norm, course)), float(np.abs(course).max())


def vector_of(column):
    """One name for the components of a vector."""
    return re.sub(r"_(u?)[xyz]\[", r"_\1[", column)


def _present(run):
    """Columns of a run that are not zero by symmetry."""
    found = {}
    for column in runs.read_table(run.folder / "probes.csv"):
        if not NOT_PHYSICS.search(column):
            found[column] = value(run, norm_of(column, "final"))[1]
    largest = {}
    for column, size in found.items():
        key = vector_of(column)
        largest[key] = max(largest.get(key, 0), size)
    return [c for c, size in found.items() if size > NOTHING * largest[vector_of(c)]]


def chosen(run, wanted):
    """Columns by their names, with or without unit; without names, all that are there."""
    if not wanted:
        return _present(run)
    columns = list(runs.read_table(run.folder / "probes.csv"))[1:]
    out = []
    for name in wanted:
        match = [c for c in columns if name in (c, c.split("[")[0])]
        if not match:
            raise NoProbe(f'--probe: found "{name}"; allowed ' + ", ".join(columns))
        out += match
    return out


def headline(columns):
    """Of those, the ones that a tolerance is for, where the user names none: how bodies move;
    without bodies, all."""
    moves = [c for c in columns if c.endswith("[m]")]
    return moves or columns
