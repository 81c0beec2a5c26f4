# SPDX-License-Identifier: GPL-2.0-or-later
"""What the runs of a study tell: errors, order, price, the cheapest setting."""
import math

from magfsi.study import norms
from magfsi.study.norms import NoError


def _reference_run(norm, run, runs):
    """The finest completed run with the axes that the reference names; the others as in run,
    save the one that is refined."""
    wanted = norm.reference.finest
    def alike(other):
        return all(other.cell.label(axis) == wanted.get(axis, run.cell.label(axis))
                   for axis in run.cell.settings if axis != run.order_axis or axis in wanted)
    candidates = [r for r in runs if r.completed() and alike(r)]
    return min(candidates, key=lambda r: r.cell.size) if candidates else None


def add_errors(study, runs):
    """To each completed run; the reference run itself gets none."""
    for run in runs:
        run.order_axis = study.order_axis
    for norm in study.norms:
        for run in runs:
            if not run.completed():
                continue
            try:
                finest = None
                if norm.reference and norm.reference.finest is not None:
                    other = _reference_run(norm, run, runs)
                    if other is None:
                        raise NoError("no completed run to compare with")
                    if other is run or other.key == run.key:
                        raise NoError("reference")
                    run.compared_size = other.cell.size
                    finest = norms.course(other, norm)
                run.errors[norm.name] = norms.error(norm, run, finest)
            except NoError as why:
                run.notes[norm.name] = str(why)


def verdict(study, run):
    """right, wrong, or how it ended; for studies that say what is right."""
    if not run.completed():
        return run.record["outcome"]
    if all(note == "reference" for note in run.notes.values()) and not run.errors:
        return "reference"
    if run.notes and any(note != "reference" for note in run.notes.values()):
        return "wrong"
    good = all(run.errors[name] <= share for name, share in study.right_within.items()
               if name in run.errors)
    return "right" if good else "wrong"


def series(study, runs):
    """{label: runs with an error, from coarse to fine}."""
    groups = {}
    for run in runs:
        label = ", ".join(run.cell.label(axis) for axis in study.series) or "all"
        groups.setdefault(label, []).append(run)
    for group in groups.values():
        group.sort(key=lambda r: -(r.cell.size or 0))
    return groups


def cost(study, run):
    return run.record["core_s"] if study.cost == "core" else run.summary.get("wall_s", math.nan)


def with_errors(runs, norm):
    return [r for r in runs if norm.name in r.errors]


def pareto(study, runs, norm):
    """Runs than which none is both cheaper and more accurate, from cheap to dear."""
    front, best = [], math.inf
    for run in sorted(with_errors(runs, norm), key=lambda r: (cost(study, r), r.errors[norm.name])):
        if run.errors[norm.name] < best:
            front.append(run)
            best = run.errors[norm.name]
    return front


def _order_against(e1, h1, e2, h2, h_reference):
    """p of error = C (h^p - h_reference^p): what a run of finite size leaves to compare with."""
    def ratio(p):
        return (h1**p - h_reference**p) / (h2**p - h_reference**p)
    low, high = 0.01, 12.0
    if not ratio(low) < e1 / e2 < ratio(high):
        return None
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if ratio(middle) < e1 / e2 else (low, middle)
    return (low + high) / 2


def order(group, norm):
    """Observed, from the two finest runs with an error; None where they tell none."""
    known = [r for r in with_errors(group, norm) if r.cell.size and r.errors[norm.name] > 0]
    if norm.reference and norm.reference.finest is not None:
        # At the reference's own size the error of both is compared, and tells no order.
        known = [r for r in known if r.cell.size > r.compared_size * (1 + 1e-9)]
    if len(known) < 2 or known[-2].cell.size == known[-1].cell.size:
        return None
    coarse, fine = known[-2:]
    e1, e2 = coarse.errors[norm.name], fine.errors[norm.name]
    h1, h2 = coarse.cell.size, fine.cell.size
    if norm.reference and norm.reference.finest is not None:
        return _order_against(e1, h1, e2, h2, fine.compared_size)
    return math.log(e1 / e2) / math.log(h1 / h2)


def start_up_s(runs):
    """Processor time before the steps: what is left of the run with the shortest steps."""
    known = [r for r in runs if r.completed() and r.summary.get("wall_s")]
    if not known:
        return 0
    shortest = min(known, key=lambda r: r.summary["wall_s"])
    return max(0, shortest.record["core_s"] - shortest.summary["wall_s"])


def steps_s(run, start_up):
    """Of the steps: processor time less start-up, or wall time, to which other work on the machine
    adds; whichever is less."""
    wall = run.summary.get("wall_s", math.nan)
    core = run.record["core_s"] - start_up
    return min(wall, core) if core > 0 else wall


def updates(run):
    """Of cells, or without a fluid of elements, in all steps; None for an equilibrium."""
    s, fluid, structure = run.summary, run.summary.get("fluid"), run.summary.get("structure")
    if fluid:
        return fluid["cells"] * s["steps"] * (s["iterations"]["mean"] if s.get("iterations") else 1)
    return structure["elements"] * s["substeps"] if structure and s.get("substeps") else None


def finest_two(group):
    """Completed, of different sizes; None where there are none."""
    known = [r for r in group if r.completed() and r.cell.size]
    return known[-2:] if len(known) > 1 and known[-2].cell.size != known[-1].cell.size else None


def exponent(pair, value):
    """q of value ~ size^-q, through a coarse and a fine run."""
    coarse, fine = pair
    return math.log(value(fine) / value(coarse)) / math.log(coarse.cell.size / fine.cell.size)


def cheapest(study, runs, norm, most):
    good = [r for r in with_errors(runs, norm) if r.errors[norm.name] <= most]
    return min(good, key=lambda r: cost(study, r)) if good else None
