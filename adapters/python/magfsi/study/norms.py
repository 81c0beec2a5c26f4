# SPDX-License-Identifier: GPL-2.0-or-later
"""How far a run is from the reference: one number."""
import functools
import math

import numpy as np

from magfsi import runs


class NoError(Exception):
    """There is none, and why."""


def check_probes(study, run):
    """A probe that a completed run does not have is a mistake in the study."""
    if not run.completed():
        return
    names = list(runs.read_table(run.folder / "probes.csv"))
    for norm in study.norms:
        for _, column in norm.terms:
            if column not in names:
                norm.mark.refuse(f'"{column}"',
                                 "a column of probes.csv: " + ", ".join(names[1:]))


@functools.lru_cache(2)
def _table(path, written_ns, size):
    """Read once for all norms of a run, until it is written again."""
    return runs.read_table(path, float)


def _columns(run, norm):
    """Times, and a row of values for each of the norm's terms."""
    path = run.folder / "probes.csv"
    try:
        state = path.stat()
        probes = _table(path, state.st_mtime_ns, state.st_size)
    except (OSError, ValueError) as error:
        raise NoError("the run left no probes.csv") from error
    for _, name in norm.terms:
        if name not in probes:
            raise NoError(f'no probe "{name}"; there are {", ".join(probes)}')
    times = np.array(probes["t[s]"])
    values = np.array([probes[name] for _, name in norm.terms])
    kept = (times >= norm.start_s) & (times <= norm.end_s)
    if kept.sum() < 2:
        raise NoError("fewer than two rows of probes between from and until; take a smaller "
                      "probes.every")
    axes = {axis: s.value for axis, s in run.cell.settings.items()}
    weights = np.array([[weight(**axes) if callable(weight) else weight]
                        for weight, _ in norm.terms])
    return times[kept], norm.factor * weights * values[:, kept]


def course(run, norm):
    """(times, values) of the norm's probe."""
    times, terms = _columns(run, norm)
    values = terms.sum(axis=0)
    return times, values - values[0] if norm.change else values


def gain(run, norm):
    """How far the sum rises above its start, or above its lowest value so far, over the largest
    change of one of its terms: 0 for a balance that only loses."""
    _, terms = _columns(run, norm)
    scale = np.abs(terms - terms[:, :1]).max()
    total = terms.sum(axis=0)
    if scale == 0:
        raise NoError("nothing happens")
    floor = total[0] if norm.norm == "gain" else np.minimum.accumulate(total)
    return _finite((total - floor).max() / scale)


def _expected(reference, run, times, finest):
    """(times, values) to compare with; a single number has no times."""
    if reference.tables:
        reference = reference.tables[run.cell.label(reference.by_axis)]
    if reference.number is not None:
        return None, np.array([reference.number])
    if reference.formula:
        values = {axis: s.value for axis, s in run.cell.settings.items()}
        return times, np.broadcast_to(reference.formula(t=times, **values), times.shape)
    if reference.values is not None:
        t, v = np.array(reference.times), np.array(reference.values)
        inside = (t >= times[0] - 1e-9 * times[-1]) & (t <= times[-1] * (1 + 1e-9))
        if not inside.any():
            raise NoError(f"the table is of {t[0]:g} s to {t[-1]:g} s and the run of "
                          f"{times[0]:g} s to {times[-1]:g} s: they have no time in common")
        return t[inside], v[inside]
    t, v = finest
    inside = times <= t[-1] * (1 + 1e-9)
    return times[inside], np.interp(times[inside], t, v)


def one_number(norm, values):
    if norm == "final":
        return values[-1]
    if norm == "mean":
        return values.mean()
    if norm == "peak":
        return values[np.abs(values).argmax()]
    return (values.max() - values.min()) / 2  # amplitude


def _finite(result):
    if not math.isfinite(result):
        raise NoError("the error is not finite")
    return float(result)


def error(norm, run, finest=None):
    """Relative, without dimension. finest: (times, values) of the reference run."""
    if norm.norm in ("gain", "rise"):
        return gain(run, norm)
    times, values = course(run, norm)
    if norm.norm == "largest":
        return _finite(np.abs(values).max())
    at, expected = _expected(norm.reference, run, times, finest)
    if norm.norm in ("final", "mean", "peak", "amplitude"):
        found = (np.interp(at[-1], times, values) if norm.norm == "final" and at is not None
                 else one_number(norm.norm, values))
        wanted = expected[0] if at is None else one_number(norm.norm, expected)
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
    return _finite(result)
