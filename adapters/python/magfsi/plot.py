# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi plot RUN [--out FILE]: one picture of any run: shapes of its bodies, and every probe."""
import argparse
import sys
import textwrap
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_rgb
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import curves, plotting, runs, units
from magfsi.curves import COLOURS
from magfsi.report import data, fields, shapes

INSTANTS = 7
COLUMNS = 3
MOST_PANELS = 30
PALE = 0.75
FIELD = "#a14a00"


def views(folder, most=INSTANTS, begin=0.0, end=np.inf):
    """[(time, points (nodes, 3) in m)] at even instants, faces, and the body of each face."""
    try:
        stored = [(t, file) for t, file in runs.frames(folder) if file.exists() and begin <= t <= end]
    except OSError:
        return [], None, None
    if not stored:
        return [], None, None
    chosen = [stored[i] for i in fields.spread(len(stored), most)]
    grid = plotting.read_grid(chosen[0][1])
    faces, elements, nodes = fields.surface(grid)
    bodies = grid.GetCellData().GetArray("body")
    body = np.zeros(len(faces), int) if bodies is None else vtk_to_numpy(bodies)[elements]
    read = [(t, vtk_to_numpy(plotting.read_grid(file).GetPoints().GetData())[nodes])
            for t, file in chosen]
    return read, faces, body.astype(int)


def plane_of(scene, found):
    """The two axes to look at: of the field's plane, or without it those of most motion."""
    plane = scene.get("magnetic_field", {}).get("plane")
    if plane in ("xy", "xz", "yz"):
        return ["xyz".index(axis) for axis in plane]
    points = np.array([p for _, p in found])
    moved = np.ptp(points - points[0], axis=(0, 1)) + 1e-3 * np.ptp(points, axis=(0, 1))
    return sorted(np.argsort(moved)[1:])


def draw_shapes(axes, scene, found, faces, body, across=None):
    across = plane_of(scene, found) if across is None else across
    for i, (_, points) in enumerate(found):
        pale = PALE * (1 - i / max(1, len(found) - 1))
        for number in np.unique(body):
            colour = np.array(to_rgb(COLOURS[number % len(COLOURS)]))
            mine = 1e3 * points[faces[body == number]][:, :, across]
            axes.add_collection(PolyCollection(mine, facecolors=[pale + (1 - pale) * colour],
                                               linewidths=0))
    every = np.concatenate([p for _, p in found])
    lines = shapes.wires(scene, every.min(axis=0), every.max(axis=0))
    axes.add_collection(LineCollection([1e3 * np.array(line)[:, across] for line in lines],
                                       colors=plotting.GREY, linewidths=0.5))
    axes.set(xlabel=f"{'xyz'[across[0]]} [mm]", ylabel=f"{'xyz'[across[1]]} [mm]")
    axes.autoscale_view()
    axes.margins(0.05)
    axes.set_aspect("equal", adjustable="datalim")
    plotting.clean(axes)
    return across


def draw_instants(axes, probes, found, across, field=True):
    """A bar of the times, and the field at the last of them as an arrow with its value."""
    times = probes.per_second * np.array([t for t, _ in found])
    unit = probes.second
    if probes.axis[0] != "time" and len(probes.x):
        times, unit = np.interp(times, probes.per_second * probes.columns["t[s]"], probes.x), probes.axis[1]
    blue = np.array(to_rgb(COLOURS[0]))
    map_ = LinearSegmentedColormap.from_list("", [PALE + (1 - PALE) * blue, blue])
    if times[-1] != times[0]:
        bar = axes.figure.colorbar(ScalarMappable(Normalize(0, 1), map_), ax=axes, shrink=0.8, aspect=25, pad=0.02)
        bar.set_ticks([0, 1])
        bar.set_ticklabels([f"{times[0]:.4g}", f"{times[-1]:.4g}"])
        bar.outline.set_linewidth(0.4)
        bar.set_label(f"{probes.axis[0]} [{unit}]" if unit else probes.axis[0], labelpad=-8)
    columns = {name: list(values) for name, values in probes.columns.items()}
    field = data.uniform_field(probes.scene, columns) if columns and field else None
    if field is None or not np.abs(field).max() > 0:
        return
    last = field[np.abs(probes.columns["t[s]"] - found[-1][0]).argmin()]
    tip = last[across] / np.linalg.norm(field, axis=1).max()
    box = axes.inset_axes([0.0, 1.02, 0.1, 0.16])  # above the shapes
    box.set(xlim=(-1.1, 1.1), ylim=(-1.1, 1.1), aspect="equal")
    box.set_axis_off()
    if np.linalg.norm(tip) > 0.02:
        plotting.arrow(box, tip, -tip, FIELD, 1.0)
    axes.text(0.12, 1.1, f"B = {units.with_unit(np.linalg.norm(last), 'T')} at the last shape", color=FIELD,
              transform=axes.transAxes, va="center")


def draw_curves(axes, probes, title, unit, drawn):
    """drawn: [(label, name, values)]."""
    largest = max(np.abs(values[np.isfinite(values)]).max(initial=0) for _, _, values in drawn)
    factor, shown = units.scaled(largest, unit)
    for i, (label, _, values) in enumerate(drawn):
        axes.plot(probes.x, factor * values, label=label, marker="o" if len(probes.x) == 1 else None,
                  **curves.style(i, 0.7))
    if all(curves.is_place(name) and values[0] == 0 for _, name, values in drawn):
        title = title.removesuffix(", displacement") + ", from the start"
    axes.set(title=title, xlabel=probes.axis_label(), ylabel=f"[{shown}]" if shown else "")
    axes.ticklabel_format(axis="y", useOffset=False)
    if len(drawn) > 1:  # beside the curves
        axes.legend(frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.03), borderaxespad=0.2, handlelength=2.2,
                    labelspacing=0.3, handletextpad=0.5)
    plotting.clean(axes)


def sorted_out(probes, words):
    """([(title, unit, drawn)], text of what does not change)."""
    columns = probes.columns if words is None else {name: probes.columns[name] for name in probes.chosen(words)}
    found, still = [], []
    if probes.axis[0] == "field":  # over itself it is a straight line
        columns = {name: values for name, values in columns.items() if not name.startswith("field")}
    for title, unit, some in curves.panels(columns):
        drawn, constant = curves.shown(columns, some)
        if drawn:
            found.append((title, unit, drawn))
        still += constant
    zero = [curves.plain(name) for name, value in still if value == 0]
    kept = [f"{curves.plain(name)} {units.with_unit(value, curves.unit_of(name))}" for name, value in still if value]
    return found, "; ".join(f"{what}: {', '.join(some)}" for what, some in (("constant", kept), ("zero", zero)) if some)


def draw(folder, out, words=None, ends=(0.0, np.inf), instants=INSTANTS, plane=None):
    """Returns how many panels there are. words: columns; ends: times [s]; instants: how many shapes."""
    probes = curves.Probes(folder)
    probes.between(*ends)
    found, faces, body = views(folder, instants, *ends) if instants else ([], None, None)
    every, still = sorted_out(probes, words) if len(probes.x) else ([], "")
    shown = every[:MOST_PANELS]
    if len(every) > len(shown):
        print(f"the first {len(shown)} of {len(every)} panels of probes; --columns chooses")
    if not found and not shown and not still:
        raise data.NotARun(f"{folder}: nothing to draw: no rows in probes.csv, no structure.pvd; "
                            "probes and output.structure in the scene write them")
    count = len(shown) + bool(found)
    rows = max(1, -(-count // COLUMNS))
    plt.rcParams.update({"font.size": 7, "axes.linewidth": 0.6, "axes.titlesize": 8, "legend.fontsize": 6.5})
    figure, grid = plt.subplots(rows, COLUMNS, figsize=(10.4, 2.2 * rows + 0.3), squeeze=False,
                                constrained_layout=True)
    places = list(grid.flat)
    for unused in places[count:]:
        unused.set_axis_off()
    if found:
        across = draw_shapes(places[0], probes.scene, found, faces, body,
                             None if plane is None else ["xyz".index(a) for a in plane])
        draw_instants(places[0], probes, found, across)
    for axes, (title, unit, drawn) in zip(places[bool(found):], shown):
        draw_curves(axes, probes, title, unit, drawn)
    if still:
        figure.supxlabel(textwrap.fill(still, 190, break_on_hyphens=False), x=0.01, ha="left", fontsize=6.5,
                         color=plotting.GREY)
    figure.savefig(out, dpi=150)
    plt.close(figure)
    return count


def words(text):
    """Of --columns: names or patterns between commas."""
    return [word.strip() for word in text.split(",") if word.strip()]


def add_interval(options):
    options.add_argument("--from", dest="begin", type=plotting.seconds, default=0.0, metavar="TIME",
                         help="where curves begin, as '20 ms'")
    options.add_argument("--to", dest="end", type=plotting.seconds, default=np.inf, metavar="TIME", help="where they end")


def main():
    options = argparse.ArgumentParser(prog="magfsi plot", description=__doc__)
    options.add_argument("run", type=Path, metavar="RUN", help="run folder")
    options.add_argument("--out", type=Path, help="the picture (default: overview.png in RUN)")
    options.add_argument("--columns", type=words, metavar="NAME,...",
                         help="of probes.csv, with or without their units, or patterns: 'tip_uz,robot.com_*' "
                         "(default: all)")
    add_interval(options)
    options.add_argument("--instants", type=int, default=INSTANTS, help=f"how many shapes, from 0 to 50 ({INSTANTS})")
    options.add_argument("--plane", choices=("xy", "xz", "yz"), help="in which the shapes are seen (default: the field's)")
    chosen = options.parse_args()
    if not (0 <= chosen.instants <= 50 and chosen.begin < chosen.end):
        options.error("--instants: allowed is 0 to 50; --from: what comes before --to")
    out = chosen.out or chosen.run / "overview.png"
    try:
        count = draw(chosen.run, out, chosen.columns, (chosen.begin, chosen.end), chosen.instants, chosen.plane)
    except (data.NotARun, OSError, ValueError) as error:
        print(f"magfsi plot: {error}", file=sys.stderr)
        return runs.EXIT_INPUT
    print(f"{out}: {count} panels")
    return 0


if __name__ == "__main__":
    sys.exit(main())
