# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against seconds, both logarithmic, with the Pareto front. Series differ in colour by the first of
their axes, in dashes by the second, in marks by the third."""
import math
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.patheffects import withStroke  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

from magfsi.study import findings  # noqa: E402
from magfsi.study.tables import percent  # noqa: E402

INK, GREY = "0.1", "0.45"
MARKERS = "os^Dv<>phX*P"
# Okabe and Ito's, then Tol's muted ones: told apart by colour-blind readers.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#332288", "#882255", "#777777", "#999933")
LINES = ("-", (0, (4, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))
NORMS = {"final": "at the end", "l2": "root mean square", "max_relative": "largest, relative", "max": "largest"}


def _plain(value, _=None):
    return f"{value:g}"


def _short(label):
    """Numbers such as 0.1666666667 in four digits."""
    return re.sub(r"\d+\.\d{5,}", lambda number: f"{float(number.group()):.4g}", label)


def _is_number(label):
    return re.fullmatch(r"[-+0-9.eE]+( \S+)?", label) is not None


def _looks(study, runs):
    """{series: (words, colour, dashes, mark, filled)}; an axis of which all runs have one value is left out."""
    groups = findings.series(study, runs)
    values = {axis: list(dict.fromkeys(run.cell.label(axis) for run in runs)) for axis in study.series}
    varied = [axis for axis in study.series if len(values[axis]) > 1]
    found = {}
    for series, group in groups.items():
        labels = {axis: group[0].cell.label(axis) for axis in varied}
        at = [values[axis].index(labels[axis]) for axis in varied] + [0, 0, 0]
        words = ", ".join(f"{axis} {label}" if _is_number(label) else label for axis, label in labels.items())
        mark = at[2] if len(varied) > 2 else at[0]
        found[series] = (_short(words) or study.name, COLOURS[at[0] % len(COLOURS)], LINES[at[1] % len(LINES)],
                         MARKERS[mark % len(MARKERS)], at[1] == 0)
    return found


def _points(study, group, norm):
    known = [r for r in findings.with_errors(group, norm) if r.errors[norm.name] > 0]
    return ([findings.cost(study, r) for r in known],
            [100 * r.errors[norm.name] for r in known], known)


def _spread(heights, gap):
    """Moved apart to at least gap, in their order, as little as it takes."""
    order = sorted(range(len(heights)), key=lambda i: heights[i])
    out = list(heights)
    for _ in range(200):
        moved = False
        for low, high in zip(order, order[1:]):
            short = gap - (out[high] - out[low])
            if short > 1e-9:
                out[low] -= short / 2
                out[high] += short / 2
                moved = True
        if not moved:
            break
    return out


def _label_series(axes, ends):
    """Names beside the axes at the right, each tied to the end of its line."""
    to_axes = axes.transData + axes.transAxes.inverted()
    at = [to_axes.transform(end) for _, end, _ in ends]
    pixels = axes.get_window_extent().height
    heights = _spread([y for _, y in at], 11.5 * axes.figure.dpi / 72 / pixels)
    for (label, end, colour), height in zip(ends, heights):
        axes.annotate(label, end, xytext=(1.03, height), textcoords="axes fraction",
                      fontsize=8, color=colour, va="center", annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "color": colour, "lw": 0.4, "alpha": 0.6,
                                  "relpos": (0, 0.5), "shrinkA": 1, "shrinkB": 4})


# Of a label from its point, [pt], with the side of it that is there.
PLACES = ((-6, -7, "right", "top"), (6, 7, "left", "bottom"), (-6, 7, "right", "bottom"),
          (6, -7, "left", "top"), (0, -10, "center", "top"), (0, 10, "center", "bottom"),
          (-12, 0, "right", "center"), (12, 0, "left", "center"), (-6, -20, "right", "top"),
          (0, 24, "center", "bottom"), (-16, 16, "right", "bottom"), (12, -16, "left", "top"))


def _place_labels(axes, labels, others):
    """Each where the fewest lines, points and labels cross it. labels: (text, x, y); others: boxes
    of text that is there."""
    renderer = axes.figure.canvas.get_renderer()
    taken = list(others)
    for text, *at in labels:
        tried = []
        for dx, dy, ha, va in PLACES:
            label = axes.annotate(text, at, xytext=(dx, dy), textcoords="offset points",
                                  fontsize=7, color=INK, ha=ha, va=va, zorder=5,
                                  path_effects=[withStroke(linewidth=2.5, foreground="w")])
            box = label.get_window_extent(renderer).padded(2)
            crossed = sum(box.overlaps(b) for b in taken) + sum(
                line.get_transform().transform_path(line.get_path())
                .intersects_bbox(box, filled=False)
                for line in axes.lines) + (box.x0 < axes.bbox.x0 or box.x1 > axes.bbox.x1)
            tried.append((crossed, len(tried), box, label))
        _, _, box, best = min(tried, key=lambda t: t[:2])
        for *_, label in tried:
            if label is not best:
                label.remove()
        taken.append(box)


def _front(study, axes, runs, norm):
    """(text, x, y) of what is to be written at the front."""
    front = [r for r in findings.pareto(study, runs, norm) if r.errors[norm.name] > 0]
    x = [findings.cost(study, r) for r in front]
    y = [100 * r.errors[norm.name] for r in front]
    axes.step(x, y, where="post", color=INK, lw=2.2, alpha=0.25, zorder=1,
              solid_capstyle="round")
    axes.plot(x, y, "o", ms=9, mfc="none", mec=INK, mew=0.8, zorder=4)
    varied = study.order_axis or next(iter(study.axes))
    labels, shown = [], None
    for run, cost, error in zip(front, x, y):
        if run.cell.label(varied) != shown:  # not another setting of the same
            shown = run.cell.label(varied)
            labels.append((_short(shown), cost, error))
    return labels


def _limits(axes, runs, study, norm):
    x, y, _ = _points(study, runs, norm)
    axes.set_xlim(min(x) / 2.2, max(x) * 1.6)
    axes.set_ylim(min([*y, *(100 * t for t in study.targets)]) / 2,
                  max([*y, 100 * study.targets[0]]) * 1.6)


def _what(norm):
    probe = norm.probe.split("[")[0]
    return f"error of {norm.name.replace('_', ' ')} ({probe}, {NORMS.get(norm.norm, norm.norm.replace('_', ' '))}) [%]"


def _panel(study, axes, runs, norm, looks):
    axes.set(xscale="log", yscale="log",
             xlabel=("processor time [s]" if study.cost == "core" else "wall time [s]"),
             ylabel=_what(norm))
    _limits(axes, runs, study, norm)
    ends = []
    groups = [(label, *_points(study, group, norm))
              for label, group in findings.series(study, runs).items()]
    front = findings.pareto(study, runs, norm)
    for label, x, y, known in (g for g in groups if g[1]):
        words, colour, dashes, mark, filled = looks[label]
        first = any(run in front for run in known)  # those that pay are drawn with more weight
        axes.plot(x, y, ls=dashes if study.size else "", marker=mark, ms=5 if first else 4, color=colour,
                  mfc=colour if filled else "w", mew=0 if filled else 1, lw=1.6 if first else 0.8, zorder=3)
        ends.append((words, (x[-1], y[-1]), colour))
    labels = _front(study, axes, runs, norm)
    for target in study.targets:
        axes.axhline(100 * target, color=GREY, lw=0.6, ls=(0, (1, 2)), zorder=0)
        axes.text(0.005, 100 * target, percent(target), fontsize=7, color=GREY, va="bottom",
                  transform=axes.get_yaxis_transform())
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        axis.set_major_formatter(FuncFormatter(_plain))
        narrow = high / low < 100  # one decade or two have no labels enough
        axis.set_minor_locator(LogLocator(subs=(2, 5) if narrow else range(2, 10), numticks=99))
        axis.set_minor_formatter(FuncFormatter(_plain) if narrow else NullFormatter())
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    return ends, labels


def draw(study, runs, path):
    """False if there is nothing to draw."""
    norms = [n for n in study.norms
             if any(r.errors.get(n.name, 0) > 0 and math.isfinite(findings.cost(study, r))
                    for r in runs)]
    if not norms:
        return False
    plt.rcParams.update({"font.size": 8, "axes.linewidth": 0.6, "xtick.major.width": 0.6,
                         "ytick.major.width": 0.6})
    looks = _looks(study, runs)
    longest = max(len(words) for words, *_ in looks.values())
    beside_in = 0.3 + 0.067 * longest  # of 8 pt characters
    width_in = 5.0 + beside_in
    figure, axes = plt.subplots(len(norms), 1, figsize=(width_in, 4.0 * len(norms)),
                                squeeze=False)
    panels = [(room, _panel(study, room, runs, norm, looks)) for room, norm in zip(axes.flat, norms)]
    numbers = study.order_axis or next(iter(study.axes))
    ring = Line2D([], [], marker="o", ms=9, mfc="none", mec=INK, mew=0.8, color=INK, alpha=0.5, lw=2.2)
    number = Line2D([], [], marker="$12$", ms=9, color=INK, lw=0, mew=0)
    figure.legend([ring, number], ["none is cheaper and nearer (Pareto front)", numbers.replace("_", " ")], ncols=2,
                  loc="upper left", frameon=False, fontsize=8, borderaxespad=0.3, handlelength=2)
    height_in = figure.get_size_inches()[1]
    figure.tight_layout(rect=(0, 0, 5.0 / width_in, 1 - 0.3 / height_in))
    figure.canvas.draw()
    for room, (ends, labels) in panels:
        _place_labels(room, labels, [t.get_window_extent() for t in room.texts])
        _label_series(room, ends)
    figure.savefig(path, dpi=180)
    plt.close(figure)
    return True
