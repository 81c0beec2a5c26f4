# SPDX-License-Identifier: GPL-2.0-or-later
"""A study as runs.csv, one row a run, and as a short page."""
import csv

from magfsi.study import findings, marked, product, store

NOTHING = ""


def _axis_columns(study):
    for name, axis in study.axes.items():
        unit = axis.unit
        yield (f"{name}[{unit}]" if unit else name), name, unit


def error_column(study, norm):
    return "error[1]" if len(study.norms) == 1 else f"error_{norm.name}[1]"


def _measured(run):
    """Columns that the axes may or may not name as well."""
    s, fluid, structure = run.summary, run.summary.get("fluid"), run.summary.get("structure")
    steps = s.get("steps", 0)
    return {
        "spacing[m]": fluid["spacing_m"] if fluid else NOTHING,
        "step[s]": s["simulated_s"] / steps if steps else NOTHING,
        "cells[1]": fluid["cells"] if fluid else NOTHING,
        "elements[1]": structure["elements"] if structure else NOTHING,
        "ranks[1]": sum(s["ranks"].values()) if s.get("ranks") else NOTHING,
        "wall[s]": s.get("wall_s", NOTHING), "core[s]": run.record.get("core_s", NOTHING),
        "steps[1]": steps or NOTHING, "substeps[1]": s.get("substeps", NOTHING),
        "iterations[1]": s["iterations"]["mean"] if s.get("iterations") else NOTHING,
        "mlups": fluid["mlups"] if fluid else NOTHING,
        "memory[B]": sum(s["memory_bytes"].values()) if s.get("memory_bytes") else NOTHING,
        "predicted[s]": s.get("predicted", {}).get("wall_s") or NOTHING,
    }


def _cell_text(value):
    return f"{value:.6g}" if isinstance(value, float) else value


def row(study, run):
    out = {}
    for column, axis, unit in _axis_columns(study):
        setting = run.cell.settings[axis]
        out[column] = setting.value if unit else setting.label
    for norm in study.norms:
        out[error_column(study, norm)] = run.errors.get(norm.name, NOTHING)
    for column, value in _measured(run).items():
        out.setdefault(column, value)
    out["outcome"] = run.record["outcome"]
    cause = run.record.get("cause", "")
    notes = sorted(set(run.notes.values()))
    out["cause"] = cause or "; ".join(notes)
    if study.right_within:
        out["verdict"] = findings.verdict(study, run)
    return {key: _cell_text(value) for key, value in out.items()}


def write_csv(study, runs, path):
    rows = [row(study, run) for run in runs]
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_csv(study, path):
    """The runs as write_csv left them: what a figure takes."""
    def key(settings):
        return tuple(str(_cell_text(settings[axis].value if unit else settings[axis].label))
                     for _, axis, unit in _axis_columns(study))
    known = {key(cell.settings): cell for cell in product.cells(study)}
    found = []
    with open(path, newline="") as file:
        for entry in csv.DictReader(file):
            cell = known.get(tuple(entry[column] for column, _, _ in _axis_columns(study)))
            if cell is None:
                raise marked.InputError(f"{path}: found a run that {study.file} does not have")
            run = store.Run(cell, record={"outcome": entry["outcome"], "core_s": float(entry["core[s]"] or "nan")},
                            summary={"wall_s": float(entry["wall[s]"] or "nan")})
            run.order_axis = study.order_axis
            run.errors = {norm.name: float(entry[error_column(study, norm)]) for norm in study.norms
                          if entry[error_column(study, norm)] != NOTHING}
            found.append(run)
    return found


def _where_and_when(runs):
    def words(key):
        return ", ".join(sorted({r.record[key] for r in runs if key in r.record}))
    return f"{words('date')}, on {words('machine')}"


def busy(study, runs):
    """A sentence if other work shared the cores; empty otherwise."""
    loads = [r.record["load_before"] for r in runs if "load_before" in r.record]
    worst = max(loads, default=0)
    # One run leaves a load of its own ranks behind it.
    ranks = max((sum(r.facts["ranks"].values()) for r in runs if r.facts), default=1)
    if worst <= ranks + 0.5:
        return ""
    effect = ("processor time suffers from it less than time does, but where it takes memory "
              "bandwidth it may double" if study.cost == "core" else
              "seconds are too high by an unknown factor")
    return f"The machine had other work (load up to {worst:.1f}): {effect}."


def percent(value):
    return f"{100 * value:.3g} %"


def seconds(value):
    return f"{value:.3g} s"


def _number(value):
    return "" if value is None else f"{value:.2f}"


def _series_table(study, runs, norm):
    targets = [percent(t) for t in study.targets]
    expected = "".join(f" (expected {study.expected[k]:g})" if k in study.expected else ""
                       for k in ("order",))
    head = [", ".join(study.series) or "all", f"observed order{expected}",
            *[f"cheapest within {t}" for t in targets]]
    lines = [head, ["---"] * len(head)]
    groups = list(findings.series(study, runs).items())
    for label, group in groups + ([("**all**", runs)] if len(groups) > 1 else []):
        known = label != "**all**"
        line = [label, _number(findings.order(group, norm)) if known and study.size else ""]
        for target in study.targets:
            best = findings.cheapest(study, group, norm, target)
            line.append(f"{seconds(findings.cost(study, best))}: {best.cell.text()} "
                        f"({percent(best.errors[norm.name])})" if best else "none")
        lines.append(line)
    return [f"| {' | '.join(line)} |" for line in lines]


def _cost_line(study, label, pair, start_up):
    coarse, fine = (findings.updates(r) for r in pair)
    known = coarse and fine
    line = [label, f"{study.expected['cost']:g}" if "cost" in study.expected else "",
            _number(findings.exponent(pair, lambda r: findings.cost(study, r))),
            _number(findings.exponent(pair, lambda r: findings.steps_s(r, start_up))),
            _number(findings.exponent(pair, findings.updates)) if known else ""]
    return line + [f"{1e9 * findings.steps_s(r, start_up) / findings.updates(r):.3g}"
                   if known else "" for r in pair]


def _cost_table(study, runs):
    """What cost does with resolution, and of what parts: the rest is the price of an update."""
    pairs = [(label, findings.finest_two(group))
             for label, group in findings.series(study, runs).items()]
    if not study.size or not any(pair for _, pair in pairs):
        return []
    head = [", ".join(study.series) or "all", "expected",
            "processor time" if study.cost == "core" else "wall time", "without start-up",
            "updates of cells or elements", "an update, coarse [ns]", "fine [ns]"]
    lines = [head, ["---"] * len(head)]
    start_up = findings.start_up_s(runs)
    lines += [_cost_line(study, label, pair, start_up) for label, pair in pairs if pair]
    return ["", "Exponent q of cost = size^-q, through the two finest runs; cost is the number of "
            f"updates times the price of one, and start-up, {seconds(start_up)}.", "",
            *(f"| {' | '.join(line)} |" for line in lines)]


def page(study, runs, command):
    """Markdown: command, date, machine, a table for each error, what did not complete."""
    lines = [f"# {study.name}", "", f"`{command}`, {_where_and_when(runs)}. Seconds are "
             + ("processor time of all processes." if study.cost == "core" else
                "wall time of the steps, one run at a time.")]
    if busy(study, runs):
        lines += ["", busy(study, runs)]
    lines += ["", "![Error against seconds](figure.png)"]
    for norm in study.norms:
        lines += ["", f"Error `{norm.name}`: {norm.norm} of `{norm.probe}`.", "",
                  *_series_table(study, runs, norm)]
    lines += _cost_table(study, runs)
    if study.remark:
        lines += ["", study.remark]
    ended = [r for r in runs if not r.completed()]
    if study.right_within:
        counts = {}
        for run in runs:
            verdict = findings.verdict(study, run)
            counts[verdict] = counts.get(verdict, 0) + 1
        shares = ", ".join(f"{percent(share)} of {name}"
                           for name, share in study.right_within.items())
        lines += ["", f"Right within {shares}: "
                  + ", ".join(f"{n} {v}" for v, n in sorted(counts.items())) + "."]
    if ended:
        lines += ["", "Not completed:", ""]
        lines += [f"- {r.cell.text()}: {r.record['outcome']}: {r.record['cause']}"
                  for r in ended]
    return "\n".join(lines) + "\n"
