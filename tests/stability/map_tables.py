# SPDX-License-Identifier: GPL-2.0-or-later
"""The stability map in numbers: every cell as a row, and the shares by axis."""
import collections
import csv

ENDS = ("right", "stopped", "refused", "wrong")


def end(kind):
    return kind if kind in ENDS else "stopped"


def write_cells(studies, path):
    errors = sorted({key for study in studies for row in study.rows for key in row
                     if key.startswith("error_")})
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["study", "cell", "end", *errors, "core[s]", "cause"])
        for study in studies:
            for values, kind, row in study.cells:
                cell = row.get("cell") or "; ".join(
                    f"{axis} {value}" for axis, value in zip(study.axes, values))
                numbers = [row.get(e) and f"{float(row[e]):.2g}" for e in errors]
                cause = row["cause"] if end(kind) != "right" else ""
                writer.writerow([study.name, cell, end(kind), *numbers,
                                 row["core[s]"] and f"{float(row['core[s]']):.2f}", cause])


def _counts(cells):
    return collections.Counter(end(kind) for _, kind, _ in cells)


def _totals(studies):
    lines = [f"| study | cells | {' | '.join(ENDS)} |", "|---" * (2 + len(ENDS)) + "|"]
    total = collections.Counter()
    for study in studies:
        counts = _counts(study.cells)
        total.update(counts)
        lines.append(f"| {study.name} | {len(study.cells)} | "
                     + " | ".join(str(counts[e]) for e in ENDS) + " |")
    lines.append(f"| all | {total.total()} | " + " | ".join(str(total[e]) for e in ENDS) + " |")
    return lines


def _causes(studies, causes):
    found = collections.Counter(kind for s in studies for _, kind, _ in s.cells)
    return [f"| {words} | {found[letter]} |" for letter, words, _ in causes if found[letter]]


def _by_axis(studies):
    """Right runs of all, value by value of every axis."""
    lines = ["| study | axis | right of all runs, by value |", "|---|---|---|"]
    for study in studies:
        for i, axis in enumerate(study.axes):
            shares = []
            for value in study.values(i):
                cells = [c for c in study.cells if c[0][i] == value]
                shares.append(f"{value}: {_counts(cells)['right']}/{len(cells)}")
            lines.append(f"| {study.name} | {axis} | {', '.join(shares)} |")
    return lines


def page(studies, causes):
    studies = list(studies)
    seconds = sum(float(r["core[s]"] or 0) for s in studies for r in s.rows)
    return "\n".join([
        "# The stability map in numbers", "",
        "Written by `tests/stability/draw_map.py`; every run is a row of a [table](cells.csv).",
        f"Processor time of all runs: {seconds / 60:.0f} min.", "", *_totals(studies), "",
        "| cause of a stop | runs |", "|---|---|", *_causes(studies, causes), "",
        *_by_axis(studies), ""])
