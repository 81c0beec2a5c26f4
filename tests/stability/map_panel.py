# SPDX-License-Identifier: GPL-2.0-or-later
"""The stability map as pictures: a panel for each study, a tile for each run, its letter legible in grey."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.patches import Patch

TILE_IN = (0.33, 0.24)
HEAD_IN, FOOT_IN, GAP_IN, SIDE_IN = 0.44, 0.5, 0.3, 0.12
WIDTH_IN, LETTER_IN, LINE_IN = 8.6, 0.067, 0.22  # LETTER_IN: of the mean letter of labels
LONG = 4  # letters of a column's label that is slanted
# Okabe and Ito's, paler where most tiles are.
RIGHT, STOPPED, REFUSED, WRONG = "#b7d7ea", "#f0b04a", "#e4e4e4", "#c00000"


def _tile(axes, x, y, kind):
    colour = {"right": RIGHT, "refused": REFUSED, "wrong": WRONG}.get(kind, STOPPED)
    axes.add_patch(plt.Rectangle((x - 0.46, y - 0.44), 0.92, 0.88, facecolor=colour, edgecolor="none"))
    letter = {"right": "", "refused": "\u2013", "wrong": "\u00d7"}.get(kind, kind)
    axes.text(x, y, letter, ha="center", va="center_baseline", fontsize=9.5, weight="bold",
              color="w" if kind == "wrong" else "0.1")


def _rows(study):
    return list(dict.fromkeys(tuple(values[1:]) for values, _, _ in study.cells))


def _left(study):
    """Inches of the labels of rows, with their heading."""
    words = [", ".join(row) for row in _rows(study)] + [", ".join(study.axes[1:])]
    return 0.15 + LETTER_IN * max(map(len, words))


def _size(study):
    """Of the tiles alone."""
    return len(study.values(0)) * TILE_IN[0], len(_rows(study)) * TILE_IN[1]


def _width(study):
    title = LETTER_IN * 1.1 * len(_title(study))
    return max(_left(study) + max(_size(study)[0], LETTER_IN * len(study.axes[0])), title)


def _title(study):
    right = sum(kind == "right" for _, kind, _ in study.cells)
    return f"{study.name.replace('_', ' ')}: {right} of {len(study.cells)} right"


def _panel(axes, study):
    across, rows = study.values(0), _rows(study)
    for values, kind, _ in study.cells:
        _tile(axes, across.index(values[0]), rows.index(tuple(values[1:])), kind)
    long = max(map(len, across)) > LONG
    axes.set_xticks(range(len(across)), across, rotation=45 if long else 0, ha="right" if long else "center",
                    rotation_mode="anchor")
    axes.set_yticks(range(len(rows)), [", ".join(row) for row in rows])
    axes.set(xlim=(-0.5, len(across) - 0.5), ylim=(len(rows) - 0.5, -0.5))
    axes.set_xlabel(study.axes[0], labelpad=2)
    axes.tick_params(length=0, pad=3)
    for y in range(1, len(rows)):
        if rows[y][0] != rows[y - 1][0] and len(rows[0]) > 1:
            axes.axhline(y - 0.5, color="0.5", lw=0.6)
    axes.annotate(", ".join(study.axes[1:]), (0, 1), xytext=(-3, 3), textcoords="offset points", ha="right",
                  va="bottom", xycoords="axes fraction", color="0.4")
    for side in axes.spines.values():
        side.set_visible(False)


def _shelves(studies):
    """Lists of studies that stand side by side, the tall ones together."""
    shelves = []
    for study in sorted(studies, key=lambda s: -_size(s)[1]):
        for shelf in shelves:
            if sum(map(_width, shelf)) + len(shelf) * GAP_IN + _width(study) <= WIDTH_IN - 2 * SIDE_IN:
                shelf.append(study)
                break
        else:
            shelves.append([study])
    return shelves


def _foot(shelf):
    """Slanted labels of columns take more."""
    longest = max(max(map(len, s.values(0))) for s in shelf)
    return FOOT_IN + (0.7 * LETTER_IN * longest if longest > LONG else 0)


def _handles(studies, causes):
    seen = {kind for s in studies for _, kind, _ in s.cells}
    handles = [Patch(color=RIGHT, label="right")]
    handles += [Patch(color=STOPPED, label=f"{letter}: stopped, {what}") for letter, what, _ in causes if letter in seen]
    handles += [Patch(color=REFUSED, label="\u2013: refused before the start")] if "refused" in seen else []
    return handles + ([Patch(color=WRONG, label="\u00d7: wrong")] if "wrong" in seen else [])


def draw(studies, causes, path):
    plt.rcParams.update({"font.size": 8.5, "font.family": "DejaVu Sans"})
    shelves = _shelves(studies)
    handles = _handles(studies, causes)
    legend_in = 0.2 + LINE_IN * -(-len(handles) // 2)
    height = legend_in + sum(HEAD_IN + max(_size(s)[1] for s in shelf) + _foot(shelf) + 0.1 for shelf in shelves)
    figure = plt.figure(figsize=(WIDTH_IN, height))
    figure.legend(handles=handles, ncols=2, loc="upper left", frameon=False, fontsize=9, borderaxespad=0, handlelength=1.2,
                  bbox_to_anchor=(SIDE_IN / WIDTH_IN, 1 - 0.08 / height))
    top = height - legend_in
    for shelf in shelves:
        left = SIDE_IN
        for study in shelf:
            wide, tall = _size(study)
            box = ((left + _left(study)) / WIDTH_IN, (top - HEAD_IN - tall) / height, wide / WIDTH_IN, tall / height)
            _panel(figure.add_axes(box), study)
            figure.text(left / WIDTH_IN, (top - 0.1) / height, _title(study), fontsize=9.5, weight="bold", va="center")
            left += _width(study) + GAP_IN
        top -= HEAD_IN + max(_size(s)[1] for s in shelf) + _foot(shelf) + 0.1
    figure.savefig(path, dpi=160)
    plt.close(figure)
