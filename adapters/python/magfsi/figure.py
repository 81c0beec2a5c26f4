# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi figure RUN ... --columns a,b --width 85mm: curves of runs for a paper, as PDF and SVG."""
import argparse
import sys
from pathlib import Path

import matplotlib
import numpy as np

from magfsi import curves, plot, runs, units
from magfsi.report import data

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

KINDS = (".pdf", ".svg", ".png", ".eps")
INCH, MOST_M, LEAST_M = 0.0254, 0.5, 0.02
SHARE = 0.62  # of the width: the height of one pair of axes
DOTS = 600  # an inch, of PNG
LINE, CURVE = 0.5, 1.0  # points
# Nothing of the day or the machine: the same run gives the same bytes.
METADATA = {".pdf": {"CreationDate": None, "Producer": None, "Creator": "magfsi"}, ".svg": {"Date": None, "Creator": "magfsi"},
            ".png": {"Software": None}, ".eps": {"Creator": "magfsi"}}


def for_print(height_pt):
    """matplotlib's settings: letters of this height in points, thin lines, fonts that editors and
    printers have."""
    return {"font.size": height_pt, "axes.labelsize": height_pt, "axes.titlesize": height_pt,
            "xtick.labelsize": 0.9 * height_pt, "ytick.labelsize": 0.9 * height_pt, "legend.fontsize": 0.9 * height_pt,
            "font.family": "sans-serif", "font.sans-serif": ["Arial", "Helvetica", "Liberation Sans", "DejaVu Sans"],
            "axes.linewidth": LINE, "xtick.major.width": LINE, "ytick.major.width": LINE, "xtick.major.size": 2.5,
            "ytick.major.size": 2.5, "xtick.direction": "in", "ytick.direction": "in", "lines.linewidth": CURVE,
            "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
            "pdf.fonttype": 42, "ps.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "magfsi",
            "axes.unicode_minus": True, "mathtext.default": "regular"}


def length(text):
    """85mm, 3.35in or 8.5 cm in m."""
    text = text.strip().lower()
    found = (float(text[:-2]) * INCH, "m") if text.endswith("in") and text[:-2].strip().replace(".", "", 1).isdigit() \
        else units.parse(text)
    if not found or found[1] != "m" or not LEAST_M <= found[0] <= MOST_M:
        raise argparse.ArgumentTypeError(f"'{text}': write a length from 20mm to 500mm, as 85mm, 8.5cm or 3.35in")
    return found[0]


def points(text):
    try:
        value = float(text.removesuffix("pt"))
    except ValueError:
        value = 0
    if not 4 <= value <= 24:
        raise argparse.ArgumentTypeError(f"'{text}': write points from 4 to 24, as 8")
    return value


def grouped(names):
    """[(unit, columns)], a pair of axes for each unit."""
    found = {}
    for name in names:
        found.setdefault(curves.unit_of(name), []).append(name)
    return list(found.items())


def labels(names):
    """{column: what the legend says}: without the body where all columns are of one."""
    owners = {curves.plain(name).rpartition(".")[0] for name in names}
    return {name: (curves.plain(name).rpartition(".")[2] if len(owners) == 1 else curves.plain(name).replace(".", ": "))
            .replace("_", " ") for name in names}


def draw_unit(axes, read, unit, names, titles, words_of):
    """read: [Probes]; words_of: the columns in words. Columns are colours, runs are dashes; a legend where there is something to tell
    apart. titles: of the runs."""
    values = {(r, name): probes.columns[name] for r, probes in enumerate(read) for name in names
              if name in probes.columns}
    largest = max(np.abs(v[np.isfinite(v)]).max(initial=0) for v in values.values())
    factor, shown = units.scaled(largest, unit)
    for (r, name), course in values.items():
        i = names.index(name)
        look = curves.style(i, CURVE) if len(read) == 1 else {**curves.style(i, CURVE), "ls": curves.DASHES[r % 6]}
        look["lw"] = max(0.6, CURVE * (1.3 - 0.2 * max(i, r)))
        words = [words_of[name]] if len(names) > 1 else []
        words += [titles[r]] if len(read) > 1 else []
        axes.plot(read[r].x, factor * course, label=", ".join(words), marker="o" if len(course) == 1 else None,
                  ms=3, **look)
    what = words_of[names[0]] if len(names) == 1 else curves.KINDS.get(unit, "")
    axes.set_ylabel(f"{what} [{shown}]" if shown else what)
    axes.ticklabel_format(axis="y", useOffset=False)
    if len(values) > 1:  # above, not on, the curves
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, borderaxespad=0.2, handlelength=2.2,
                    columnspacing=1, labelspacing=0.2)


def draw(folders, wanted, chosen):
    """A figure of these columns, to be closed."""
    read = [curves.Probes(folder) for folder in folders]
    for probes in read:
        probes.between(chosen.begin, chosen.end)
        if not len(probes.x):
            raise data.NotARun(f"{probes.folder}: no rows in probes.csv in this time")
        if probes.axis[0] != read[0].axis[0]:
            raise data.NotARun(f"{probes.folder} is over {probes.axis_label()}, {folders[0]} over {read[0].axis_label()}")
        probes.x = probes.x * read[0].per_x / probes.per_x  # milliseconds beside seconds
    wanted = read[0].chosen(wanted)
    groups = grouped(wanted)
    for probes in read[1:]:
        probes.chosen(wanted)
    plt.rcParams.update(for_print(chosen.font_size))
    width = chosen.width / INCH
    height = chosen.height / INCH if chosen.height else SHARE * width * (0.4 + 0.6 * len(groups))
    figure, grid = plt.subplots(len(groups), 1, sharex=True, figsize=(width, height), squeeze=False,
                                layout="constrained")
    figure.get_layout_engine().set(w_pad=0.02, h_pad=0.02)
    titles = chosen.names or [data.read_json(p.folder / "scene.json", {}).get("name", "") for p in read]
    if len(set(titles)) < len(read):
        titles = [p.folder.name for p in read]
    for axes, (unit, names) in zip(grid[:, 0], groups):
        draw_unit(axes, read, unit, names, titles, labels(wanted))
    grid[-1, 0].set_xlabel(read[0].axis_label())
    return figure


def parsed(arguments=None):
    options = argparse.ArgumentParser(prog="magfsi figure", description=__doc__)
    options.add_argument("runs", type=Path, metavar="RUN", nargs="+", help="run folders")
    options.add_argument("--columns", type=plot.words, metavar="NAME,...",
                         help="of probes.csv, with or without their units, or patterns: 'tip_uz,robot.com_*'")
    options.add_argument("--width", type=length, default=0.085, help="of the figure: 85mm (a column of most journals)")
    options.add_argument("--height", type=length, help="by the number of axes without it")
    options.add_argument("--font-size", type=points, default=8.0, metavar="POINTS", help="of the letters (8)")
    options.add_argument("--names", type=plot.words, metavar="NAME,...", help="of the runs, in the legend")
    plot.add_interval(options)
    options.add_argument("--out", type=Path, help=f"a file ({', '.join(KINDS)}), or a name without ending, which gets "
                         ".pdf and .svg (default: figure in the first RUN)")
    chosen = options.parse_args(arguments)
    if chosen.names and len(chosen.names) != len(chosen.runs):
        options.error(f"--names: found {len(chosen.names)}; allowed is one for each of the {len(chosen.runs)} runs")
    chosen.out = chosen.out or chosen.runs[0] / "figure"
    if chosen.out.suffix not in ("", *KINDS):
        options.error(f"--out: found '{chosen.out.suffix}'; allowed are {', '.join(KINDS)}, or none")
    return chosen


def main():
    chosen = parsed()
    files = [chosen.out] if chosen.out.suffix else [chosen.out.with_name(chosen.out.name + kind) for kind in KINDS[:2]]
    try:
        if not chosen.columns:
            names = curves.Probes(chosen.runs[0]).columns
            raise data.NotARun("--columns: found none; allowed are " + ", ".join(n for n in names if n != "t[s]"))
        figure = draw(chosen.runs, chosen.columns, chosen)
    except (data.NotARun, OSError, ValueError) as error:
        print(f"magfsi figure: {error}", file=sys.stderr)
        return runs.EXIT_INPUT
    try:
        for file in files:
            figure.savefig(file, dpi=DOTS, metadata=METADATA[file.suffix])
            print(file)
    except OSError as error:
        print(f"magfsi figure: {error}", file=sys.stderr)
        return 1
    finally:
        plt.close(figure)
    return 0


if __name__ == "__main__":
    sys.exit(main())
