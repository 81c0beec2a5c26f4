# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi plot RUN [--out FILE]: one picture of any run: shapes of its bodies, and every probe."""
import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import plotting, runs
from magfsi.report import data, fields, shapes

INSTANTS = 7
COLUMNS = 3
MOST_PANELS = 30
CONSTANT = 1e-6
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"]  # Okabe and Ito's
PREFIXES = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "u", 1e-9: "n", 1e-12: "p"}


def scaled(values, unit):
    """(factor, unit) in which the largest is between 1 and 1000, for units that take a prefix."""
    largest = np.abs(values[np.isfinite(values)]).max(initial=0.0)
    if largest == 0 or unit not in ("m", "s", "m/s", "N", "J", "T", "Pa", "W"):
        return 1.0, unit
    size = max((s for s in PREFIXES if s <= largest * (1 + 1e-9)), default=1e-12)
    return 1 / size, PREFIXES[size] + unit


def panels(columns):
    """[(title, unit, [(label, column)])]: a vector's components together, and what else an owner
    has in one unit. Of a point its displacement, not its place besides."""
    groups = {}
    for name in columns:
        if name == "t[s]":
            continue
        word, _, unit = name.rstrip("]").partition("[")
        owner, dot, quantity = word.rpartition(".")
        stem, _, part = quantity.rpartition("_")
        vector = part.lstrip("u") in ("x", "y", "z") and len(part) <= 2
        if vector:
            if part in "xyz" and f"{owner}{dot}{stem}_u{part}[{unit}]" in columns:
                continue
            title = f"{owner}{dot}{stem}" + (" displacement" if part.startswith("u") else "")
        else:
            title = owner
        groups.setdefault((title, unit), []).append((part if vector else quantity, name))
    return [(some[0][1].partition("[")[0] if len(some) == 1 else title or "fluid", unit, some)
            for (title, unit), some in groups.items()]


def views(folder):
    """[(time, points (nodes, 3) in m)] at even instants, faces, and the body of each face."""
    try:
        stored = [(t, file) for t, file in runs.frames(folder) if file.exists()]
    except OSError:
        return [], None, None
    if not stored:
        return [], None, None
    chosen = [stored[i] for i in fields.spread(len(stored), INSTANTS)]
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


def draw_shapes(axes, scene, found, faces, body):
    across = plane_of(scene, found)
    for i, (_, points) in enumerate(found):
        pale = 0.75 * (1 - i / max(1, len(found) - 1))
        for number in np.unique(body):
            colour = np.array(plt.matplotlib.colors.to_rgb(COLOURS[number % len(COLOURS)]))
            mine = 1e3 * points[faces[body == number]][:, :, across]
            axes.add_collection(PolyCollection(mine, facecolors=[pale + (1 - pale) * colour],
                                               linewidths=0))
    every = np.concatenate([p for _, p in found])
    lines = shapes.wires(scene, every.min(axis=0), every.max(axis=0))
    axes.add_collection(LineCollection([1e3 * np.array(line)[:, across] for line in lines],
                                       colors=plotting.GREY, linewidths=0.5))
    axes.set(xlabel=f"{'xyz'[across[0]]} [mm]", ylabel=f"{'xyz'[across[1]]} [mm]",
             title=f"from {found[0][0]:.4g} s (pale) to {found[-1][0]:.4g} s")
    axes.autoscale_view()
    axes.margins(0.05)
    axes.set_aspect("equal", adjustable="datalim")
    plotting.clean(axes)


def draw_curves(axes, columns, title, unit, some):
    time = columns["t[s]"]
    per_time, time_unit = scaled(time, "s")
    values = np.array([columns[name] for _, name in some])
    factor, shown = scaled(values, unit)
    for i, ((label, _), row) in enumerate(zip(some, values)):
        axes.plot(per_time * time, factor * row, lw=1, color=COLOURS[i % len(COLOURS)],
                  ls="-" if i < len(COLOURS) else "--", label=label,
                  marker="o" if len(time) == 1 else None)
    axes.set(title=title, xlabel=f"time [{time_unit}]", ylabel=f"[{shown}]")
    axes.ticklabel_format(axis="y", useOffset=False)
    largest = np.abs(factor * values).max()
    if np.ptp(factor * values) < CONSTANT * largest:  # rounding is no curve
        axes.set_ylim(-1.2 * largest, 1.2 * largest)
    if len(some) > 1:
        axes.legend(fontsize=6, frameon=False)
    plotting.clean(axes)


def draw(folder, out):
    """Returns how many panels there are."""
    scene = data.read_json(folder / "scene.json", {})
    try:
        columns = {name: np.array(values) for name, values
                   in runs.read_table(folder / "probes.csv", float).items()}
    except (OSError, ValueError):
        columns = {}
    if not len(columns.get("t[s]", [])):
        columns = {}
    found, faces, body = views(folder)
    every = panels(columns)
    curves = every[:MOST_PANELS]
    if len(every) > len(curves):
        print(f"the first {len(curves)} of {len(every)} panels of probes")
    if not found and not curves:
        raise data.NotARun(f"{folder}: nothing to draw: no rows in probes.csv, no structure.pvd; "
                            "probes and output.structure in the scene write them")
    count = len(curves) + bool(found)
    rows = -(-count // COLUMNS)
    plt.rcParams.update({"font.size": 7, "axes.linewidth": 0.6, "axes.titlesize": 8})
    figure, grid = plt.subplots(rows, COLUMNS, figsize=(9.6, 2.3 * rows), squeeze=False,
                                constrained_layout=True)
    places = list(grid.flat)
    for unused in places[count:]:
        unused.set_axis_off()
    if found:
        draw_shapes(places[0], scene, found, faces, body)
    for axes, (title, unit, some) in zip(places[bool(found):], curves):
        draw_curves(axes, columns, title, unit, some)
    figure.savefig(out, dpi=150)
    plt.close(figure)
    return count


def main():
    options = argparse.ArgumentParser(prog="magfsi plot", description=__doc__)
    options.add_argument("run", type=Path, metavar="RUN", help="run folder")
    options.add_argument("--out", type=Path, help="the picture (default: overview.png in RUN)")
    chosen = options.parse_args()
    out = chosen.out or chosen.run / "overview.png"
    try:
        if not (chosen.run / "scene.json").is_file():
            raise data.NotARun(f"{chosen.run}: found no scene.json; allowed are folders that "
                               "./magfsi run has written")
        count = draw(chosen.run, out)
    except (data.NotARun, OSError, ValueError) as error:
        print(f"magfsi plot: {error}", file=sys.stderr)
        return runs.EXIT_INPUT
    print(f"{out}: {count} panels")
    return 0


if __name__ == "__main__":
    sys.exit(main())
