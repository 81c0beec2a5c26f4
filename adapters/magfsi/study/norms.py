"""How far a run is from the reference: one number."""
import csv
import math

import numpy as np


class NoError(Exception):
    """There is none, and why."""


def check_probes(study, run):
    """A probe that a completed run does not have is a mistake in the study."""
    if not run.completed():
        return
    with open(run.folder / "probes.csv", newline="") as file:
        names = next(csv.reader(file), [])
    for norm in study.norms:
        if norm.probe not in names:
            norm.mark.refuse(f'"{norm.probe}"', "a column of probes.csv: " + ", ".join(names[1:]))


def course(run, norm):
    """(times, values) of the norm's probe."""
    try:
        with open(run.folder / "probes.csv", newline="") as file:
            names, *rows = list(csv.reader(file))
    except (OSError, ValueError) as error:
        raise NoError("the run left no probes.csv") from error
    if norm.probe not in names:
        raise NoError(f'no probe "{norm.probe}"; there are {", ".join(names)}')
    column = names.index(norm.probe)
    table = np.array([[float(row[0]), float(row[column])] for row in rows if len(row) > column])
    table = table.reshape(-1, 2)
    times, values = table[:, 0], table[:, 1] * norm.factor
    if norm.change and len(values):
        values = values - values[0]
    kept = times >= norm.start_s
    if kept.sum() < 2:
        raise NoError("fewer than two rows of probes")
    return times[kept], values[kept]


def _expected(reference, run, times, finest):
    """(times, values) to compare with; a single number has no times."""
    if reference.number is not None:
        return None, np.array([reference.number])
    if reference.formula:
        values = {axis: s.value for axis, s in run.cell.settings.items()}
        return times, np.broadcast_to(reference.formula(t=times, **values), times.shape)
    if reference.values is not None:
        t, v = np.array(reference.times), np.array(reference.values)
        inside = (t >= times[0] - 1e-9 * times[-1]) & (t <= times[-1] * (1 + 1e-9))
        if not inside.any():
            raise NoError("the table and the run have no time in common")
        return t[inside], v[inside]
    t, v = finest
    inside = times <= t[-1] * (1 + 1e-9)
    return times[inside], np.interp(times[inside], t, v)


def _one_number(norm, values):
    if norm == "final":
        return values[-1]
    if norm == "mean":
        return values.mean()
    if norm == "peak":
        return values[np.abs(values).argmax()]
    return (values.max() - values.min()) / 2  # amplitude


def error(norm, run, finest=None):
    """Relative, without dimension. finest: (times, values) of the reference run."""
    times, values = course(run, norm)
    at, expected = _expected(norm.reference, run, times, finest)
    if norm.norm in ("final", "mean", "peak", "amplitude"):
        found = (np.interp(at[-1], times, values) if norm.norm == "final" and at is not None
                 else _one_number(norm.norm, values))
        wanted = expected[0] if at is None else _one_number(norm.norm, expected)
        result = abs(found - wanted) / abs(wanted)
    else:
        apart = np.interp(at, times, values) - expected
        if norm.norm == "max":
            result = np.abs(apart).max() / np.abs(expected).max()
        elif norm.norm == "l2":
            result = math.sqrt((apart**2).sum() / (expected**2).sum())
        else:
            known = expected != 0
            result = np.abs(apart[known] / expected[known]).max()
    if not math.isfinite(result):
        raise NoError("the error is not finite")
    return float(result)
