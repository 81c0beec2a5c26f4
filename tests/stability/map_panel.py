# SPDX-License-Identifier: GPL-2.0-or-later
"""The stability map as pictures: a panel for each study, a mark for each run, legible in grey."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROW_IN, COLUMN_IN = 0.19, 0.33
LEFT_IN, HEAD_IN, FOOT_IN, GAP_IN = 2.6, 0.42, 0.62, 0.25
WIDTH_IN = 10.5


def _mark(axes, x, y, kind):
    if kind == "right":
        axes.plot(x, y, "o", color="0.1", ms=5.5)
    elif kind == "refused":
        axes.plot(x, y, "_", color="0.45", ms=7, mew=1.2)
    elif kind == "wrong":
        axes.plot(x, y, "X", color="#c00000", ms=9)
    else:
        axes.plot(x, y, "s", mfc="white", mec="0.35", ms=9, mew=0.8)
        axes.text(x, y - 0.03, kind, ha="center", va="center", fontsize=7, color="0.1")


def _panel(axes, study):
    across = study.values(0)
    rows = list(dict.fromkeys(tuple(values[1:]) for values, _, _ in study.cells))
    for values, kind, _ in study.cells:
        _mark(axes, across.index(values[0]), rows.index(tuple(values[1:])), kind)
    axes.set_xticks(range(len(across)), across, rotation=0 if max(map(len, across)) < 5 else 90)
    axes.set_yticks(range(len(rows)), [",  ".join(row) for row in rows])
    axes.set(xlim=(-0.6, len(across) - 0.4), ylim=(len(rows) - 0.4, -0.6))
    axes.set_xlabel(study.axes[0])
    right = sum(kind == "right" for _, kind, _ in study.cells)
    rows_are = f"\nrows: {',  '.join(study.axes[1:])}" if study.axes[1:] else ""
    axes.set_title(f"{study.name}: {right} of {len(study.cells)} right{rows_are}", loc="right", fontsize=7.5)
    axes.tick_params(length=2)
    for y in range(1, len(rows)):
        if rows[y][0] != rows[y - 1][0] and len(rows[0]) > 1:
            axes.axhline(y - 0.5, color="0.8", lw=0.6)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _size(study):
    rows = len({tuple(values[1:]) for values, _, _ in study.cells})
    return len(study.values(0)) * COLUMN_IN, rows * ROW_IN


def _columns(studies):
    """Into two columns of about the same height."""
    columns = ([], [])
    for study in sorted(studies, key=lambda s: -_size(s)[1]):
        min(columns, key=_height).append(study)
    return columns


def _height(column):
    return sum(_size(s)[1] + HEAD_IN + FOOT_IN + GAP_IN for s in column)


def draw(studies, causes, path):
    plt.rcParams.update({"font.size": 7, "font.family": "DejaVu Sans", "axes.linewidth": 0.5})
    columns = _columns(studies)
    legend_in = 0.4
    height = max(map(_height, columns)) + legend_in
    figure = plt.figure(figsize=(WIDTH_IN, height))
    for number, column in enumerate(columns):
        top = height - legend_in
        for study in column:
            wide, tall = _size(study)
            top -= HEAD_IN + tall
            box = ((number * WIDTH_IN / 2 + LEFT_IN) / WIDTH_IN, top / height, wide / WIDTH_IN,
                   tall / height)
            _panel(figure.add_axes(box), study)
            top -= FOOT_IN + GAP_IN
    seen = {kind for s in studies for _, kind, _ in s.cells}
    words = ["filled: right", *(["bar: refused before the start"] if "refused" in seen else []),
             *[f"{letter}: stopped, {what}" for letter, what, _ in causes if letter in seen],
             *(["cross: wrong"] if "wrong" in seen else [])]
    figure.text(0.02, 1 - 0.18 / height, ";   ".join(words), fontsize=8, va="center")
    figure.savefig(path, dpi=130)
    plt.close(figure)
