# SPDX-License-Identifier: GPL-2.0-or-later
"""How far the probes of two runs are apart, and whether that is within their error bars: numbers, a
table and a sentence.

Runs have their rows at times of their own. They are compared at those of the run that has fewer in
the time that both have, where the other is on straight lines between its rows."""
import csv
import math
from dataclasses import dataclass, field

import numpy as np

from magfsi import curves, units
from magfsi.compare import sides as reading
from magfsi.cost import probes as choosing
from magfsi.cost.report import percent
from magfsi.study import norms
from magfsi.study.study_file import Reference

TABLE = ("probe", "unit", "first", "first_bar", "second", "second_bar", "difference",
         "difference of largest[1]", "l2[1]", "largest[1]", "within bars", "remark")
TINY = 1e-300  # in place of a bar of zero
SAME = 1e-9  # of the time that both have: rows at the same times
NAMED = 4  # probes in a sentence
COMPONENT = 0.3  # of its vector's largest: less is a small one


@dataclass
class Row:
    """One probe. Of a place (com_z) its change counts; relative numbers are of the first run."""
    column: str
    values: tuple = (math.nan, math.nan)  # at the end
    scale: float = math.nan  # the first's largest magnitude
    l2: float = math.nan
    most: float = math.nan  # the largest difference at any time
    bars: tuple = (None, None)  # reading.Bar of each
    why: str = ""  # there are no relative numbers

    @property
    def unit(self):
        return curves.unit_of(self.column)

    @property
    def difference(self):
        return self.values[1] - self.values[0]

    @property
    def sizes(self):
        return [bar.size if bar else None for bar in self.bars]

    def within(self):
        """Whether the bars overlap; None where one of them is not known."""
        if None in self.sizes or not math.isfinite(self.difference):
            return None
        return abs(self.difference) <= sum(self.sizes)

    def value_words(self, which):
        """"1.19 mm ± 0.15 mm"."""
        size = self.sizes[which]
        return units.with_unit(self.values[which], self.unit, 4) + (
            "" if size is None else f" ± {units.with_unit(size, self.unit)}")

    def words(self):
        return f"{curves.plain(self.column)}, {self.value_words(0)} and {self.value_words(1)}"

    def remark(self):
        told = zip(("first", "second"), self.bars)
        return self.why or "; ".join(f"{which}: {bar.why}" for which, bar in told
                                     if bar and bar.why)


@dataclass
class Comparison:
    sides: list  # of two reading.Side
    span: tuple  # the time that both have [s]
    rows: list = field(default_factory=list)
    zero: list = field(default_factory=list)  # columns that are nothing in both
    alone: list = field(default_factory=list)  # of each run the columns that the other has not

    def is_constant(self, column):
        """In both runs, with the same value."""
        values = np.concatenate([side.probes.columns[column] for side in self.sides])
        return bool(np.ptp(values) <= curves.ROUNDING * np.abs(values).max())

    def compared(self):
        return [row for row in self.rows if not row.why]

    def with_bars(self):
        """Rows that have a bar in both runs, those that are furthest apart for it first."""
        known = [row for row in self.rows if row.within() is not None]
        return sorted(known, key=lambda row: -abs(row.difference) / (sum(row.sizes) or TINY))


def _norm(column, kind, span):
    norm = choosing.norm_of(column, kind, span[0] * (1 - SAME))
    norm.end_s = span[1] * (1 + SAME)
    return norm


def _relative(column, kind, sides, courses, span):
    """An error of the second by a norm of studies, with the first as the reference, at the times of
    the run that has fewer rows."""
    norm = _norm(column, kind, span)
    first, second = courses
    if len(second[0]) <= len(first[0]):
        norm.reference = Reference(finest={})
        return norms.error(norm, sides[1], first)
    norm.reference = Reference(times=list(first[0]), values=list(first[1]))
    return norms.error(norm, sides[1])


def _bar(side, column, sides, span):
    """A bar is of a run's last value, and tells nothing of one that is earlier by more than the time
    between rows."""
    bar = side.bars.get(column)
    between = max(np.median(np.diff(one.times)) for one in sides)
    if bar and side.times[-1] > span[1] + between * (1 + SAME):
        return reading.Bar(None, f"its bar is of {units.with_unit(side.times[-1], 's')}")
    return bar


def _row(column, sides, span):
    row = Row(column, bars=tuple(_bar(side, column, sides, span) for side in sides))
    try:
        courses = [norms.course(side, _norm(column, reading.AT_THE_END, span)) for side in sides]
        if not all(np.isfinite(values).all() for _, values in courses):
            raise norms.NoError("it has values that are not finite")
        at = min(times[-1] for times, _ in courses)
        row.values = tuple(float(np.interp(at, *course)) for course in courses)
        row.scale = float(np.abs(courses[0][1]).max())
        with np.errstate(all="ignore"):  # of a course that is zero
            row.l2, row.most = (_relative(column, kind, sides, courses, span)
                                for kind in ("l2", "max"))
    except norms.NoError as why:
        row.why = str(why) if row.scale != 0 else "the first is zero"
    return row


def compare(sides):
    """A Comparison. Raises NotARun."""
    span = reading.common_span(sides)
    first, second = (list(side.probes.columns)[1:] for side in sides)
    both = [column for column in first if column in second
            and not choosing.NOT_PHYSICS.search(column)
            and not curves.is_told_by_a_displacement(column, first)]
    # What is zero by symmetry in one run and not in the other is looked at.
    present = {column for side in sides for column in choosing.chosen(side, [])}
    rows = [_row(column, sides, span) for column in both if column in present]
    alone = [[c for c in first if c not in second], [c for c in second if c not in first]]
    return Comparison(sides, span, rows, [c for c in both if c not in present], alone)


def sampling(found):
    """How courses with rows at different times were compared."""
    begin, end = found.span[0] * (1 - SAME), found.span[1] * (1 + SAME)
    times = [side.times[(side.times >= begin) & (side.times <= end)] for side in found.sides]
    counts = [len(t) for t in times]
    if counts[0] == counts[1] and np.abs(times[0] - times[1]).max() <= SAME * found.span[1]:
        return "Both have their rows at the same times."
    fewer = int(counts[1] <= counts[0])
    names = [side.name for side in found.sides]
    return (f"Their rows are at different times ({counts[0]} and {counts[1]} in the time that both "
            f"have): compared at those of {names[fewer]}, where {names[1 - fewer]} is "
            "interpolated, on straight lines between its rows.")


def _largest(rows):
    """Of the rows that say how bodies move, or without bodies of all, the one that is furthest in
    L2. A small component of a vector is not looked at: nearly all of it may be the error of a large
    one."""
    scale = {}
    for row in rows:
        key = choosing.vector_of(row.column)
        scale[key] = max(scale.get(key, 0.0), row.scale)
    rows = [row for row in rows if row.scale >= COMPONENT * scale[choosing.vector_of(row.column)]]
    names = choosing.headline([row.column for row in rows])
    return max((row for row in rows if row.column in names), key=lambda row: row.l2)


def _how_far(found):
    rows = found.compared()
    if not rows:
        return "No probe of theirs can be compared."
    worst = _largest(rows)
    what = "a movement" if worst.unit == "m" else "a probe"
    return (f"The largest difference of {what} is {percent(worst.l2)} in L2, of "
            f"{curves.plain(worst.column)}.")


def _named(rows):
    more = f" and {len(rows) - NAMED} more" if len(rows) > NAMED else ""
    return "; ".join(row.words() for row in rows[:NAMED]) + more


def _who_has_none(found):
    have = [side.name for i, side in enumerate(found.sides)
            if any(row.sizes[i] is not None for row in found.rows)]
    return {0: "neither run has one", 1: f"only {''.join(have)} has one"}.get(
        len(have), "no probe has one in both runs")


def sentence(found):
    """(whether they agree within their bars, None where that is not known; in words)."""
    known = found.with_bars()
    if not known:
        return None, ("Whether they agree within their error bars is not known: "
                      f"{_who_has_none(found)}. {_how_far(found)}")
    apart = [row for row in known if not row.within()]
    count = f"{len(known)} probe{'s' if len(known) > 1 else ''} with a bar in both runs"
    if apart:
        are = "are" if len(apart) > 1 else "is"
        return False, (f"They do not agree within their error bars: of {count} {len(apart)} {are} "
                       f"further apart at the end than both bars together: {_named(apart)}. "
                       f"{_how_far(found)}")
    return True, (f"They agree within their error bars: of {count} none is further apart at the "
                  f"end than both bars together; nearest to that is {known[0].words()}. "
                  f"{_how_far(found)}")


def endings(found):
    """Sentences of runs that are not complete."""
    return [f"{side.name} is not complete ({side.outcome()}): compared until "
            f"{units.with_unit(found.span[1], 's')}." for side in found.sides if side.outcome()]


def _number(value, digits=9):
    return "" if value is None or not math.isfinite(value) else f"{value:.{digits}g}"


def write_csv(found, path):
    """A row a probe, in SI units; shares are of the first run."""
    with open(path, "w", newline="") as file:
        for which, side in zip(("first", "second"), found.sides):
            words = f"{side.name}, {side.folder}"
            file.write(f"# {which}: {' '.join(words.split())}\n")
        file.write(f"# from {found.span[0]:.9g} s to {found.span[1]:.9g} s; values are of the end, "
                   "of a place its change\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(TABLE)
        for row in found.rows:
            within = {True: "yes", False: "no", None: ""}[row.within()]
            share = row.difference / row.scale if row.scale else None
            values = [word for value, size in zip(row.values, row.sizes)
                      for word in (_number(value), _number(size, 3))]
            writer.writerow([row.column, row.unit, *values, _number(row.difference),
                             *(_number(value, 4) for value in (share, row.l2, row.most)), within,
                             row.remark()])
