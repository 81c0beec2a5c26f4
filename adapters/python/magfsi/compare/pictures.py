# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of two runs: every probe of both over each other, and their fields side by side."""
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import curves, plot, plotting, runs, units
from magfsi.report import fields

INSTANTS = 3
PANELS = 30  # of one picture
SIDE = 200  # pixels of a slice
AROUND = 0.7  # of the bodies' extent, shown about them
SAME = 1e-6  # of the end: stored instants are the same
DOTS = 150  # an inch
BODIES = ("0.15", curves.COLOURS[1])  # of the first run and of the second
DASHES = ("-", (0, (4, 1.5)))
LETTERS = {"font.size": 7, "axes.linewidth": 0.6, "axes.titlesize": 8, "legend.fontsize": 6.5}


# --- curves ---

def _course(side, column, begin):
    """Of a place its change, as in the table."""
    values = side.probes.columns[column]
    return values - np.interp(begin, side.times, values) if curves.is_place(column) else values


def _draw_panel(axes, found, title, unit, some):
    """Columns are colours, runs are dashes; the error bars of the last values stand at the end."""
    drawn = [(r, i, label, column, _course(side, column, found.span[0]))
             for i, (label, column) in enumerate(some) for r, side in enumerate(found.sides)]
    largest = max(np.abs(values[np.isfinite(values)]).max(initial=0) for *_, values in drawn)
    factor, shown = units.scaled(largest, unit)
    rows = {row.column: row for row in found.rows}
    for r, i, label, column, values in drawn:
        side, row = found.sides[r], rows[column]
        # Milliseconds beside seconds.
        x = side.probes.x * found.sides[0].probes.per_x / side.probes.per_x
        colour = curves.COLOURS[i % len(curves.COLOURS)]
        axes.plot(x, factor * values, color=colour, ls=DASHES[r], lw=1.3 - 0.3 * r,
                  label=side.name if len(some) == 1 else f"{label}, {side.name}")
        if row.sizes[r] is not None:
            axes.errorbar([np.interp(found.span[1], side.times, x)], [factor * row.values[r]],
                          [factor * row.sizes[r]], color=colour, lw=0.8, capsize=2.5 + 1.5 * r)
    if all(curves.is_place(column) for _, column in some):
        title = title.removesuffix(", displacement") + ", from the start"
    axes.set(title=title, xlabel=found.sides[0].probes.axis_label(),
             ylabel=f"[{shown}]" if shown else "")
    axes.ticklabel_format(axis="y", useOffset=False)
    axes.legend(frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.03), borderaxespad=0.2,
                handlelength=2.4, labelspacing=0.3, handletextpad=0.5)
    plotting.clean(axes)


def draw_curves(found, out):
    """The files: every probe that both have, but for those that are nothing in both, or one and the
    same constant."""
    compared = {row.column for row in found.rows if not found.is_constant(row.column)}
    every = curves.panels([c for c in found.sides[0].probes.columns if c in compared])
    plt.rcParams.update(LETTERS)
    files = []
    for begin in range(0, len(every), PANELS):
        part = every[begin:begin + PANELS]
        rows = -(-len(part) // plot.COLUMNS)
        figure, grid = plt.subplots(rows, plot.COLUMNS, figsize=(11.5, 2.2 * rows + 0.3),
                                    squeeze=False, constrained_layout=True)
        for axes, panel in zip(grid.flat, part):
            _draw_panel(axes, found, *panel)
        for unused in list(grid.flat)[len(part):]:
            unused.set_axis_off()
        files.append(Path(out) / f"curves{f'_{len(files) + 1}' if files else ''}.png")
        figure.savefig(files[-1], dpi=DOTS)
        plt.close(figure)
    return files


# --- fields ---

def flows(side):
    """{time: files} of the flow on grids."""
    return dict(fields.flow_frames(side.folder))


def pairs(first, second, span, most=INSTANTS):
    """[(time in the first, time in the second)] of stored instants within the time of both: the
    same time where there are such, else near ones; evenly, without the start."""
    begin, end = span[0] * (1 - SAME), span[1] * (1 + SAME)
    first, second = (np.array([t for t in times if begin <= t <= end]) for times in (first, second))
    if not len(first) or not len(second):
        return []
    near = [(float(t), float(second[np.abs(second - t).argmin()])) for t in first]
    later = [pair for pair in near if min(pair) > span[0] + SAME * span[1]]
    found = [pair for pair in later if abs(pair[0] - pair[1]) <= SAME * span[1]] or later
    if len(found) > most:
        found = [found[i] for i in fields.spread(len(found), most + 1)[1:]]
    return found


class View:
    """Where the slices lie, and what of them is seen: around the bodies, without bodies the whole
    box."""

    def __init__(self, sides, plane=None):
        scene = sides[0].scene
        plane = plane or scene.get("magnetic_field", {}).get("plane", "xz")
        self.axis = next(a for a in range(3) if "xyz"[a] not in plane)
        self.across = [a for a in range(3) if a != self.axis]
        points = [points for side in sides for _, points in plot.views(side.folder)[0]]
        box = scene.get("fluid", {}).get("box")
        self.at = 0.5 * box[self.axis] if box else 0.0
        self.limits = [(0.0, box[a]) for a in self.across] if box else None
        if points:
            self.at = float(0.5 * (points[0].min(axis=0) + points[0].max(axis=0))[self.axis])
            self._around(np.concatenate(points), box)

    def _around(self, points, box):
        low, high = points.min(axis=0)[self.across], points.max(axis=0)[self.across]
        low, high = low - AROUND * (high - low).max(), high + AROUND * (high - low).max()
        if box:
            low, high = np.maximum(low, 0), np.minimum(high, np.array(box)[self.across])
        self.limits = list(zip(low.tolist(), high.tolist()))


class Slice:
    """A quantity in the plane of a view at one stored instant."""

    def __init__(self, files, view, quantity):
        made, self.origin, self.size = fields.one_slice(files, view.axis, view.at, SIDE)
        self.values = made.get(quantity)

    def middles(self):
        """Of the pixels, along both axes."""
        return [o + (np.arange(n) + 0.5) * length / n
                for o, length, n in zip(self.origin, self.size, self.values.shape[::-1])]

    def at(self, points):
        """Values on other points along both axes, on straight lines between the pixels."""
        own = self.middles()
        rows = np.array([np.interp(points[0], own[0], row) for row in self.values])
        return np.array([np.interp(points[1], own[1], column) for column in rows.T]).T

    def extent_mm(self):
        (x, z), (width, height) = self.origin, self.size
        return 1e3 * np.array([x, x + width, z, z + height])


def read_slices(sides, view, quantity, times):
    """[(slice of the first, slice of the second, values of the second less the first)] at each pair
    of times; empty where one of them has not that quantity."""
    stored, found = [flows(side) for side in sides], []
    for pair in times:
        first, second = (Slice(files[time], view, quantity) for files, time in zip(stored, pair))
        if first.values is None or second.values is None:
            return []
        found.append((first, second, second.at(first.middles()) - first.values))
    return found


def _ranges(slices, quantity):
    """(map, low, high) of the quantity and of its difference; what is beyond has the colour of the
    end."""
    def largest(arrays):
        every = np.abs(np.concatenate([values.ravel() for values in arrays]))
        return float(np.quantile(every, fields.SHARE_IN_COLOUR))
    high = largest([s.values for found in slices for s in found[:2]]) or 1.0
    apart = largest([found[2] for found in slices]) or high
    of_values = ("viridis", 0.0, high) if quantity == "speed" else ("coolwarm", -high, high)
    return of_values, ("coolwarm", -apart, apart)


def _draw_bodies(axes, side, time, view, colour):
    """At the stored instant nearest to a time, as seen across the plane."""
    stored = [(t, files[0]) for t, files in fields.stored_frames(side.folder, "structure.pvd")]
    if not stored:
        return
    (_, file), = plotting.nearest_frames(stored, [time])
    grid = plotting.read_grid(file)
    faces, _, nodes = fields.surface(grid)
    points = 1e3 * vtk_to_numpy(grid.GetPoints().GetData())[nodes]
    plotting.draw_faces(axes, points[faces][:, :, view.across], shade=colour, alpha=0.7)


def _draw_slice(axes, slice_, values, range_):
    map_, low, high = range_
    return axes.imshow(values, origin="lower", extent=slice_.extent_mm(), cmap=map_, vmin=low,
                       vmax=high, interpolation="nearest")


def _frame(axes, view, title):
    axes.set(title=title, xlabel=f"{'xyz'[view.across[0]]} [mm]",
             ylabel=f"{'xyz'[view.across[1]]} [mm]")
    axes.autoscale_view()
    if view.limits:
        axes.set(xlim=1e3 * np.array(view.limits[0]), ylim=1e3 * np.array(view.limits[1]))
    axes.set_aspect("equal")


def _draw_instant(row, sides, view, times, slices, ranges):
    """The first, the second, and the second less the first with the bodies of both; without slices
    the bodies alone. Returns the images."""
    images = []
    for column in range(2) if slices else ():
        images.append(_draw_slice(row[column], slices[column], slices[column].values, ranges[0]))
        _draw_bodies(row[column], sides[column], times[column], view, BODIES[0])
    if slices:
        images.append(_draw_slice(row[-1], slices[0], slices[2], ranges[1]))
    for side, time, colour in zip(sides, times, BODIES):
        _draw_bodies(row[-1], side, time, view, colour)
    names = [f"{side.name}, {units.with_unit(time, 's', 4)}" for side, time in zip(sides, times)]
    together = (f"{sides[1].name} less {sides[0].name}" if slices else
                f"{names[0]} (black); {names[1]} (orange)")
    for axes, title in zip(row, [*names, together] if slices else [together]):
        _frame(axes, view, title)
    return images


def draw_fields(found, out, quantity="speed", plane=None):
    """(the file or None, what it shows or why there is none)."""
    sides = found.sides
    view, times = View(sides, plane), pairs(*(flows(side) for side in sides), found.span)
    slices = read_slices(sides, view, quantity, times)
    if not slices:  # the bodies alone
        stored = [fields.stored_frames(side.folder, "structure.pvd") for side in sides]
        times = pairs(*([time for time, _ in frames] for frames in stored), found.span)
    if not times:
        return None, ("No fields in both runs after their start: output.fluid and output.structure "
                      "of the scene write them.")
    plt.rcParams.update(LETTERS)
    columns = 3 if slices else 1
    ratio = np.ptp(view.limits[1]) / np.ptp(view.limits[0]) if view.limits else 1.0
    height = (np.clip(3.6 * ratio, 1.2, 6) + 0.6) * len(times)
    figure, grid = plt.subplots(len(times), columns, squeeze=False, constrained_layout=True,
                                figsize=(3.9 * columns, height))
    ranges = _ranges(slices, quantity) if slices else None
    for i, row in enumerate(grid):
        images = _draw_instant(row, sides, view, times[i], slices[i] if slices else None, ranges)
    if slices:
        unit = units.typeset(fields.UNITS[quantity])
        for image, places, label in ((images[0], grid[:, :2], quantity),
                                     (images[2], grid[:, 2], "difference")):
            figure.colorbar(image, ax=places, label=f"{label} [{unit}]", location="bottom",
                            shrink=0.6, aspect=30)
    file = Path(out) / "fields.png"
    # The layout leaves the names of the bars below the page's edge.
    figure.savefig(file, dpi=DOTS, bbox_inches="tight")
    plt.close(figure)
    return file, _caption(quantity if slices else None, view, times)


def _caption(quantity, view, times):
    plane = "".join("xyz"[a] for a in view.across)
    at = f"{'xyz'[view.axis]} = {units.with_unit(view.at, 'm')}"
    what = (f"The {quantity} in the plane {plane} at {at}, and the bodies as seen across it"
            if quantity else f"The bodies of both, seen in {plane}")
    apart = max(abs(first - second) for first, second in times)
    if apart <= SAME * max(times[-1]):
        return f"{what}, at stored instants that both have."
    return (f"{what}, at the stored instants nearest to each other: up to "
            f"{units.with_unit(apart, 's')} apart, which is part of the difference.")
