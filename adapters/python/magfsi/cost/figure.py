# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against seconds: the runs, the cheapest settings, and the scene as it is."""
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

from magfsi.cost import variants as making  # noqa: E402

INK, GREY, PALE = "0.1", "0.45", "0.75"
TOLERANCES = (0.10, 0.05, 0.02, 0.01)
# Where a label may stand about its point, in points; the nearest free one is taken.
AROUND = [(dx * far, dy * far) for far in (1, 1.5, 2.2, 3, 4) for dx, dy in
          ((8, 8), (8, -8), (-8, 8), (-8, -8), (0, 12), (0, -12), (14, 0), (-14, 0))]


def _seconds(result):
    """Of each run as a run of the whole, by the cost model as the runs have corrected it: what
    else the machine did meanwhile is not in the figure."""
    corrected, end = making.correction(result.variants), result.scene.facts["scene"]["time"]["end"]
    return np.array([making.START_UP_S + corrected * making.work_s(v.facts)
                     * end / v.facts["scene"]["time"]["end"] for v in result.done])


def _bounds(probe):
    """Of the errors of the runs, by the limit and its bar."""
    return (np.abs(probe.fit.values - probe.limit) + probe.limit_bar) / probe.scale


def _front(result):
    """(seconds, bounds) of the settings that none beats, from cheap to dear."""
    settings = result.settings
    own = int(np.argmin(np.abs(np.log(settings.factors)).sum(axis=1)))
    facts = result.scene.variant(result.scene.own_setting()).facts
    work = settings.corrected * making.work_s(facts)
    seconds = making.START_UP_S + work * settings.rough / settings.rough[own]
    x, y = [], []
    for i in np.argsort(seconds, kind="stable"):
        if not y or settings.bounds[i] < y[-1]:
            x.append(seconds[i])
            y.append(settings.bounds[i])
    return np.array(x), np.array(y)


def _free(box, taken, points):
    inside = ((points[:, 0] > box.x0) & (points[:, 0] < box.x1)
              & (points[:, 1] > box.y0) & (points[:, 1] < box.y1))
    return not inside.any() and not any(box.overlaps(other) for other in taken)


def _label(axes, labels, drawn):
    """labels: (text, (x, y), colour). drawn: pixels that no label may cover."""
    taken, frame = [], axes.get_window_extent()
    for text, at, colour in labels:
        for offset in AROUND:
            note = axes.annotate(text, at, xytext=offset, textcoords="offset points", fontsize=7.5,
                                 color=colour, va="center",
                                 ha="left" if offset[0] > 0 else
                                 "right" if offset[0] < 0 else "center")
            box = note.get_window_extent().padded(2)
            whole = frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and \
                box.y1 <= frame.y1
            if whole and _free(box, taken, drawn):
                taken.append(box)
                break
            note.remove()


def _pixels(axes, x, y):
    """Of a line through the points, closely."""
    at = axes.transData.transform(np.column_stack([x, y]))
    if len(at) < 2:
        return at
    parts = [np.linspace(a, b, 60) for a, b in zip(at, at[1:])]
    return np.concatenate(parts)


def _plain(value, _=None):
    return f"{value:g}"


def _axes_of(axes, x, y):
    axes.set(xscale="log", yscale="log", xlabel="seconds of the whole run",
             ylabel="bound of the error [%]")
    axes.set_xlim(min(x) / 1.6, max(x) * 2.2)
    axes.set_ylim(min([*y, 0.9]) / 1.5, max([*y, 12]) * 1.6)
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        axis.set_major_formatter(FuncFormatter(_plain))
        narrow = high / low < 100
        axis.set_minor_locator(LogLocator(subs=(2, 5) if narrow else range(2, 10), numticks=99))
        axis.set_minor_formatter(FuncFormatter(_plain) if narrow else NullFormatter())
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _targets(axes):
    for share in TOLERANCES:
        axes.axhline(100 * share, color=PALE, lw=0.6, zorder=0)
        axes.text(1.01, 100 * share, f"{100 * share:g} %", fontsize=7, color=GREY, va="center",
                  transform=axes.get_yaxis_transform())


def draw(result, path):
    probe = max(result.headline, key=lambda p: p.bar / p.scale)
    x, error = _seconds(result), _bounds(probe)
    front = _front(result) if result.settings else (np.array([]), np.array([]))
    own = next((i for i, v in enumerate(result.done)
                if v.setting == result.scene.own_setting()), None)
    bound = 100 * probe.bar / probe.scale
    figure, axes = plt.subplots(figsize=(5.6, 4))
    shown = 100 * np.concatenate([error, front[1][front[1] < 1]])
    _axes_of(axes, np.concatenate([x, front[0][front[1] < 1]]), [*shown, bound])
    _targets(axes)
    axes.plot(x, 100 * error, "o", ms=4.5, color=GREY, mew=0, zorder=3)
    labels = []
    dear = int(np.argmax(x))
    if len(front[0]):
        axes.plot(front[0], 100 * front[1], "-", color=INK, lw=1.4, zorder=2)
        middle = max(0, len(front[0]) - 2)
        labels.append(("the cheapest settings", (front[0][middle], 100 * front[1][middle]),
                       INK))
    if own is not None:
        axes.plot(x[own], bound, "*", ms=12, color=INK, mew=0, zorder=4)
        labels.insert(0, ("this scene", (x[own], bound), INK))
    labels.append(("runs made", (x[dear], 100 * error[dear]), GREY))
    axes.set_title(f"{result.scene.facts['name']}: {probe.column}, {probe.norm}"
                   + ("" if len(front[0]) else "; no tolerance is promised"), loc="left",
                   fontsize=9)
    figure.tight_layout()
    figure.canvas.draw()
    lines = [([x[own]], [bound]) if own is not None else ([], []), (front[0], 100 * front[1]),
             *((axes.get_xlim(), [100 * share] * 2) for share in TOLERANCES)]
    _label(axes, labels, np.concatenate(
        [axes.transData.transform(np.column_stack([x, 100 * error])),
         *(_pixels(axes, *line) for line in lines if len(line[0]))]))
    figure.savefig(path, dpi=170)
    plt.close(figure)
