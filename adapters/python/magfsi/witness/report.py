# SPDX-License-Identifier: GPL-2.0-or-later
"""What `magfsi witness` leaves: a table, series, a figure, and in words whether run and witness agree."""
import csv

import numpy as np

from magfsi import units
from magfsi.witness import compare

ROWS = 1200  # of series.csv and the figure


def write(recorded, solutions, chosen):
    """Writes the files into chosen.out; lines for the terminal."""
    fine = solutions[-1]
    end = fine.time[-1]
    begin, end = compare.window(recorded, end)
    run = compare.OfRun(recorded)
    period = recorded.period()
    width = min(period or end, end) / compare.MEAN_SHARE
    series = {"at": np.linspace(0, end, ROWS)}
    at = np.linspace(begin, end, ROWS)
    meshes = [compare.Series(s, at, width) for s in solutions]
    ratio = solutions[-1].cells / solutions[-2].cells if len(solutions) > 1 else None
    words = recorded.box.words()
    rows, mine = [], None
    if run.force is not None:
        mine = compare.Series(run, at, width)
        rows = compare.table(at, mine, meshes, ratio, recorded, chosen.run_bar)
    whole = [compare.Series(s, series["at"], width) for s in solutions]
    series["witness"] = whole
    series["run"] = compare.Series(run, series["at"], width) if run.force is not None else None
    write_table(chosen.out / "witness.csv", rows, at, meshes[-1], solutions, words, width)
    write_series(chosen.out / "series.csv", series, words, width)
    draw(chosen.out / "witness.png", recorded, series, solutions, begin)
    return [*lines(rows), *sentence(rows, run, (begin, end), recorded, solutions),
            f"{chosen.out / 'witness.csv'}, series.csv, witness.png"]


def shown(values, unit):
    """Numbers in the prefix of the largest: "156.3 \u00b1 0.7 uJ/m" of a value and its bar."""
    base = unit.removesuffix("/m")
    factor, prefix = units.scaled(max(map(abs, values)), base)
    numbers = [f"{factor * values[0]:.4g}", *(f"{factor * bar:.2g}" for bar in values[1:])]
    return " \u00b1 ".join(numbers) + f" {prefix}{'/m' if base != unit else ''}"


def with_bar(value, bar, unit):
    return shown([value] if bar is None else [value, bar], unit)


def lines(rows):
    for row in rows:
        verdict = {True: ": within the bars", False: ": beyond the bars", None: ""}[row.agrees()]
        share = f", {(row.run - row.witness) / row.size:+.1%}" + (
            " of its rms" if row.name.startswith("mean") else "") if row.size > 0 else ""
        if row.name.startswith("rms difference"):
            own = "" if row.witness_bar is None else f", bar of the meshes {shown([row.witness_bar], row.unit)}"
            yield f"  {row.name}: {with_bar(row.run, row.run_bar, row.unit)}{own}{share}{verdict}"
        else:
            yield (f"  {row.name}: run {with_bar(row.run, row.run_bar, row.unit)}, witness "
                   f"{with_bar(row.witness, row.witness_bar, row.unit)}{share}{verdict}")


def sentence(rows, run, between, recorded, solutions):
    """What was compared, how far apart, and whether that is within the bars."""
    if run.missing:
        yield f"not compared, since the run lacks {' and '.join(run.missing)}"
    fault, end = solutions[-1].fault, recorded.time[-1]
    if fault:
        yield (f"the mesh could follow to {1e3 * between[1]:.4g} ms, {between[1] / end:.0%} of the motion, and no "
               f"further: {fault}")
    judged = [row for row in rows if row.agrees() is not None]
    first = next((row for row in rows if row.name.startswith("work")), rows[0] if rows else None)
    if first is None:
        yield "the witness stands alone: there is nothing of the run to compare"
        return
    begin, end = (f"{1e3 * t:.4g}" for t in between)
    text = (f"from {begin} to {end} ms the {first.name} is "
            f"{with_bar(first.run, first.run_bar, first.unit)} of the run and "
            f"{with_bar(first.witness, first.witness_bar, first.unit)} of the witness "
            f"({first.run / first.witness - 1:+.1%})")
    if not judged:
        yield f"{text}; there are no bars to judge by: take --meshes 2"
        return
    beyond = [row.name for row in judged if not row.agrees()]
    if not beyond:
        yield f"{text}: they agree within the bars in all {len(judged)} quantities"
    else:
        yield (f"{text}: they do not agree within the bars in {len(beyond)} of {len(judged)} quantities ("
               + "; ".join(beyond) + ")")


def write_table(file, rows, at, fine, solutions, words, width):
    """Lines of comment say what was compared; without a run's forces the witness's values stand alone."""
    number = "{:.6g}".format
    with open(file, "w", newline="") as out:
        out.write(f"# A metre of strip, from {at[0]:.6g} to {at[-1]:.6g} s; series are Gaussian means of "
                  f"{width:.3g} s. Meshes: {', '.join(str(s.cells) for s in solutions)} cells in the thickness. "
                  "The difference of the last two over their ratio less 1 is witness_bar.\n")
        table = csv.writer(out)
        table.writerow(["quantity", "unit", "witness", "witness_bar", "run", "run_bar", "difference",
                        "within_bars"])
        for row in rows:
            bars = ["" if bar is None else number(bar) for bar in (row.witness_bar, row.run_bar)]
            table.writerow([row.name, row.unit, number(row.witness), bars[0], number(row.run), bars[1],
                            number(row.run - row.witness), {True: "yes", False: "no", None: ""}[row.agrees()]])
        if not rows:
            table.writerow(["work on the fluid", "J/m", number(fine.work[-1]), "", "", "", "", ""])
            for k, word in enumerate(words):
                table.writerow([f"rms force along {word}", "N/m", number(compare.rms(fine.force[:, k])),
                                *5 * [""]])


def write_series(file, series, words, width):
    columns = {"t[s]": series["at"]}
    sources = {"witness": series["witness"][-1]}
    if len(series["witness"]) > 1:
        sources["coarser"] = series["witness"][-2]
    if series["run"] is not None:
        sources["run"] = series["run"]
    for name, source in sources.items():
        for k, word in enumerate(words):
            columns[f"{name}.force_{word}[N/m]"] = source.force[:, k]
        for what, unit in (("moment", "N m/m"), ("power", "W/m"), ("work", "J/m")):
            if getattr(source, what) is not None:
                columns[f"{name}.{what}[{unit}]"] = getattr(source, what)
    with open(file, "w", newline="") as out:
        out.write("# A metre of strip. Forces, moments about the centre of the cross-section and power are "
                  f"Gaussian means of {width:.3g} s.\n")
        csv.writer(out).writerow(columns)
        for row in zip(*columns.values()):
            out.write(",".join(f"{x:.7g}" for x in row) + "\n")


def _panels(recorded, series, fine, run):
    """[(what, unit, function of a Series)] of what is not none by symmetry."""
    words = recorded.box.words()
    panels = [(f"force along {w}", "N/m", lambda s, k=k: s.force[:, k]) for k, w in enumerate(words)]
    size = compare.rms(np.linalg.norm(fine.force, axis=1))
    if run is None or run.moment is not None:
        panels.append(("moment", "N m/m", lambda s: s.moment))
    limits = {"N/m": size, "N m/m": size * np.ptp(recorded.outline[0])}
    panels = [panel for panel in panels
              if max(compare.rms(panel[2](s)) for s in (fine, run or fine)) > compare.NOTHING * limits[panel[1]]]
    if run is None or run.work is not None:
        panels.append(("work on the fluid", "J/m", lambda s: s.work))
    return panels


def draw(file, recorded, series, solutions, begin):
    """The strip at some instants; forces, moment, work over time, the witness with its bar as a band."""
    from magfsi import plotting  # sets a backend without a screen
    import matplotlib.pyplot as plt
    time, fine = 1e3 * series["at"], series["witness"][-1]
    coarse = series["witness"][-2] if len(series["witness"]) > 1 else None
    run, panels = series["run"], _panels(recorded, series, fine, series["run"])
    plt.rcParams.update({"font.size": 8, "axes.labelsize": 8})
    figure, axes = plt.subplots(len(panels) + 1, 1, figsize=(6, 1.7 * len(panels) + 2.6), layout="constrained",
                                gridspec_kw={"height_ratios": [1.5, *len(panels) * [1]]})
    _draw_shapes(axes[0], recorded, np.linspace(begin, series["at"][-1], 5))
    for panel, (what, unit, of) in zip(axes[1:], panels):
        base = unit.removesuffix("/m")
        factor, prefix = units.scaled(np.abs(of(fine)).max(), base)
        if coarse is not None:
            bar = np.abs(of(fine) - of(coarse)) / (solutions[-1].cells / solutions[-2].cells - 1)
            panel.fill_between(time, factor * (of(fine) - bar), factor * (of(fine) + bar), color="0.8", lw=0,
                               label="its bar")
        panel.plot(time, factor * of(fine), color="0.1", lw=1.2, label="witness")
        if run is not None:
            panel.plot(time, factor * of(run), color="#d55e00", lw=1.0, label="run")
        panel.axvline(1e3 * begin, color="0.6", lw=0.6, ls=":")
        panel.set_ylabel(f"{what}\n[{prefix}/m]")
        plotting.clean(panel)
    axes[1].legend(frameon=False, ncols=3, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0)
    axes[-1].set_xlabel("time [ms]")
    figure.savefig(file, dpi=150)
    plt.close(figure)


def _draw_shapes(axes, recorded, times):
    """Strips that come back to the same place are one, with all their times."""
    words, strips = recorded.box.words(), []
    for t in times:
        outline = 1e3 * recorded.at(t)
        near = 0.02 * np.ptp(outline, axis=0).max()
        same = next((times for other, times in strips if np.abs(other - outline).max() < near), None)
        if same is None:
            strips.append((outline, [t]))
        else:
            same.append(t)
    for shade, (outline, at) in zip(np.linspace(0.8, 0.1, len(strips)), strips):
        axes.fill(*outline.T, facecolor=str(shade), label=", ".join(f"{1e3 * t:.3g}" for t in at) + " ms")
    axes.set_aspect("equal")
    axes.set_xlabel(f"{words[0]} [mm]")
    axes.set_ylabel(f"{words[1]} [mm]")
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
