# SPDX-License-Identifier: GPL-2.0-or-later
"""The result in words, as tables, and as a figure."""
import csv
import math

from magfsi.cost import parameters as numerical
from magfsi.cost import variants as making

FEW = 12  # probes in the text; the table has all


def percent(share, signed=False):
    digits = 2 if abs(share) < 0.995 else 3
    return f"{100 * share:{'+' if signed else ''}.{digits}g} %"


def duration(seconds):
    if seconds < 120:
        return f"{seconds:.2g} s"
    return f"{seconds / 60:.2g} min" if seconds < 7200 else f"{seconds / 3600:.2g} h"


def size(bytes_):
    return f"{bytes_ / 1e6:.3g} MB" if bytes_ else "memory not known"


def described(scene, setting):
    """A setting in the scene's own values, where it differs."""
    facts = scene.variant(setting).facts
    words = [f"{p.name} {p.words(facts)}" for p in scene.parameters]
    return ", ".join(words) or "the scene's own"


def _table(rows):
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return ["  " + "  ".join(word.ljust(w) for word, w in zip(row, widths)).rstrip()
            for row in rows]


def _probe_rows(scene, found):
    head = ["probe", "value", "limit", "error of the value"]
    rows = [head + [f"from {p.name}" for p in scene.parameters]]
    for p in found[:FEW]:
        rows.append([p.column, f"{p.value:.5g}" + ("" if p.was_run else " (fitted)"),
                     f"{p.limit:.5g} +- {p.limit_bar:.2g}",
                     f"{percent(p.error / p.scale, True)} +- {percent(p.error_bar / p.scale)}"
                     + (" (doubtful)" if p.faults else ""),
                     *(percent(s / p.scale, True) for s in p.shares.values())])
    return rows


def _advice_lines(scene, advice):
    lines = [f"  within {percent(a.tolerance)}: {duration(a.seconds)}, {size(a.memory)}: "
             f"{described(scene, a.setting)}" for a in advice if a.setting]
    for why in dict.fromkeys(a.why for a in advice if not a.setting):
        shares = ", ".join(percent(a.tolerance) for a in advice if a.why == why)
        lines.append(f"  within {shares}: none is promised. {why}")
    return lines


def _of_probes(result, which):
    return [f"  {f.parameter}: {p.column}: {f.why}" for p in result.probes
            for f in getattr(p, which)]


def text(result):
    """All of it, for people. result: cost.Result."""
    scene, done = result.scene, [v for v in result.variants if v.run.completed()]
    took = sum(v.run.record["elapsed_s"] for v in done)
    lines = [f"{len(done)} of {len(result.variants)} runs, {duration(took)} in all (budget "
             f"{duration(result.budget_s)}), on {result.length_words}.", "",
             f"Probes by their {result.norm} value; errors in parts of the largest value of the "
             "course; a place (such as com_z) counts by its change.",
             *_table(_probe_rows(scene, result.probes))]
    if len(result.probes) > FEW:
        lines.append(f"  and {len(result.probes) - FEW} more, in cost.csv")
    lines += ["", "The cheapest settings for " + ", ".join(p.column for p in result.headline)
              + " (the whole run):", *_advice_lines(scene, result.advice)]
    faults = [f"  {f.parameter}: {f.why}" for f in result.faults] + _of_probes(result, "faults")
    if faults:
        lines += ["", "Where the fit does not hold, and no tolerance is promised:", *faults[:FEW]]
    scatter = _of_probes(result, "scatter")
    if scatter:
        lines += ["", "Not as the fit supposes, but little: bars are wider by three times the range of",
                  *scatter[:FEW]]
    left = numerical.not_varied(scene.facts["scene"])
    if left:
        lines += ["", "Not varied, its error is not in the figures: " + "; ".join(left)]
    if not scene.facts.get("predicted"):
        lines += ["", "This machine is not calibrated: seconds are from these runs alone; "
                  "./magfsi bench --calibrate"]
    return "\n".join(lines) + "\n"


def write_runs(result, path):
    names = [p.name for p in result.scene.parameters]
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([f"{n}, times finer" for n in names]
                        + ["part", "predicted[s]", "took[s]", "outcome", "--set"]
                        + [p.column for p in result.probes])
        for v in result.variants:
            i = result.done.index(v) if v in result.done else None
            writer.writerow([f"{v.setting[n]:.6g}" for n in names]
                            + [v.part, f"{making.seconds(v.facts):.3g}",
                               f"{v.run.record.get('elapsed_s', math.nan):.3g}",
                               v.run.record.get("outcome", "not run"),
                               " ".join(f"{k}={x}" for k, x in v.sets.items())]
                            + [f"{p.fit.values[i]:.9g}" if i is not None else ""
                               for p in result.probes])


def write_probes(result, path):
    names = [p.name for p in result.scene.parameters]
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["probe", "norm", "value", "bar", "limit", "limit_bar", "error[1]",
                         "error_bar[1]", *(f"from {n}[1]" for n in names), "doubt"])
        for p in result.probes:
            writer.writerow([p.column, p.norm, f"{p.value:.9g}", f"{p.bar:.3g}", f"{p.limit:.9g}",
                             f"{p.limit_bar:.3g}", f"{p.error / p.scale:.3g}",
                             f"{p.error_bar / p.scale:.3g}",
                             *(f"{s / p.scale:.3g}" for s in p.shares.values()),
                             "; ".join(f"{f.parameter}: {f.why}" for f in p.faults)])
