# SPDX-License-Identifier: GPL-2.0-or-later
"""What a search found: a table, a figure, and the best as a scene."""
import csv
import os
import shlex
import sys

import yaml

from magfsi import units
from magfsi.optimize.search import Point, ranked, run_at
from magfsi.study import store

SHOWN = 5


class Finalist:
    """One of the best, repeated finer: how far its value is from known, and by another fluid."""

    def __init__(self, point):
        self.point, self.finer, self.check = point, None, None

    @property
    def value(self):
        return self.finer.value if self.finer and self.finer.good else self.point.value

    @property
    def bar(self):
        """What refinement still changed; infinite where the finer run has no value."""
        if not self.finer:
            return 0.0
        return abs(self.finer.value - self.point.value) if self.finer.good else float("inf")


def finalists(search, points, out):
    """The best few, the best by their finer values first; the first of them once with `check`."""
    some = [Finalist(p) for p in ranked(points, search)[:search.finer[1] if search.finer else 1]]
    if search.finer:
        for finalist in some:
            finalist.finer = _again(search, finalist.point, out, search.finer[0])
        some.sort(key=lambda f: (f.bar == float("inf"),
                                 -f.value if search.maximize else f.value))
    if search.check and some:
        some[0].check = _again(search, some[0].point, out, search.check)
    return some


def _again(search, point, out, more):
    print(f"run {point.number + 1} again with {', '.join(f'{k}={v}' for k, v in more.items())}",
          flush=True)
    found = Point(point.number, point.values, run_at(search, point.values, out, more))
    found.evaluate(search)
    return found


def tie(some):
    """The winner and who cannot be told from it: bars that touch."""
    if len(some) < 2:
        return []
    first = some[0]
    return [f for f in some[1:] if abs(f.value - first.value) <= f.bar + first.bar]


def _numbers(search, point):
    return [search.parameters[n].text(v) for n, v in point.values.items()]


def write_runs(search, points, path):
    with open(path, "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["run", *(f"{n}[{p.unit}]" if p.unit else n
                                for n, p in search.parameters.items()),
                       *search.measures, "objective", "good", "why", "folder"])
        for p in points:
            values = [v if isinstance(v, str) else v / search.parameters[n].size
                      for n, v in p.values.items()]
            rows.writerow([p.number + 1, *values,
                           *(p.measured.get(n, "") for n in search.measures),
                           "" if p.value is None else p.value, int(p.good), p.why,
                           p.run.key])


def _best_table(search, some):
    head = ["run", *search.parameters, "objective"]
    head += ["finer", "bar"] if search.finer else []
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for f in some:
        row = [str(f.point.number + 1), *_numbers(search, f.point), f"{f.point.value:.5g}"]
        if search.finer:
            row += [f"{f.finer.value:.5g}" if f.finer.good else f.finer.why, f"{f.bar:.2g}"]
        lines.append("| " + " | ".join(row) + " |")
    return "\n".join(lines)


def page(search, points, some):
    good = sum(p.good for p in points)
    kind = "largest" if search.maximize else "smallest"
    text = [f"# {search.name}", "",
            f"    {shlex.join(['./magfsi', 'optimize', *sys.argv[1:]])}", "",
            f"{len(points)} runs by {search.method}, {good} of them good; the {kind} "
            f"`{search.objective.text}`:", ""]
    if not some:
        reasons = sorted({p.why for p in points})
        return "\n".join(text + [f"None is good: {'; '.join(reasons[:SHOWN])}", ""])
    text += [_best_table(search, some), ""]
    equal = tie(some)
    if equal:
        others = ", ".join(str(f.point.number + 1) for f in equal)
        text += [f"A tie: run {others} cannot be told from run {some[0].point.number + 1}, for "
                 "what refinement changes is more than what sets them apart.", ""]
    if some[0].check:
        check = some[0].check
        found = f"{check.value:.5g}" if check.good else f"no value ({check.why})"
        text += [f"Run {some[0].point.number + 1} with "
                 + ", ".join(f"`{k}: {v}`" for k, v in search.check.items()) + f": {found}.", ""]
    return "\n".join(text + ["![Values run by run, and by parameter](search.png)", ""])


def best_scene(search, point, path):
    """The scene with the point's settings, paths of files as seen from the new place."""
    scene = store.scene_file(search.scene)
    tree = yaml.safe_load(scene.read_text())
    for key, text in search.cell(point.values).sets.items():
        *above, last = key.split(".")
        node = tree
        for word in above:
            node = node.setdefault(word, {}) if not isinstance(node.get(word), dict) \
                else node[word]
        if text == "":
            node.pop(last, None)
        else:
            node[last] = yaml.safe_load(text)
    _move_files(tree, scene.parent, path.parent)
    path.write_text(f"# Run {point.number + 1} of the search {search.name}: "
                    f"{search.objective.text} = {point.value:.6g}\n"
                    + yaml.safe_dump(tree, sort_keys=False, allow_unicode=True,
                                     default_flow_style=None, width=100))


def _move_files(node, old, new):
    for key, value in node.items() if isinstance(node, dict) else ():
        if key in store.FILE_KEYS and isinstance(value, str):
            node[key] = os.path.relpath(old / value, new)
        _move_files(value, old, new)


def read_points(search, path):
    """The points as write_runs left them: what a figure takes."""
    points = []
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            columns = {n: f"{n}[{p.unit}]" if p.unit else n for n, p in search.parameters.items()}
            values = {n: row[columns[n]] if p.words else float(row[columns[n]]) * p.size
                      for n, p in search.parameters.items()}
            points.append(Point(int(row["run"]) - 1, values, store.Run(search.cell(values))))
            points[-1].value = float(row["objective"]) if row["objective"] else None
            points[-1].broken = 0.0 if row["good"] == "1" else 1.0
    return points


def shapes_of(search, point, out):
    """The folder of the best, run again with fields; None where that is not to be had."""
    facts = store.planned(store.scene_file(search.scene), search.cell(point.values), out).facts
    end_s = facts["scene"]["time"]["end"]
    run = run_at(search, point.values, out, {"output": f"{{structure: {{every: {end_s / 24!r} s}}}}"})
    return run.folder if run.completed() else None


def _draw_shapes(axes, folder, number):
    from magfsi import curves, plot

    probes = curves.Probes(folder)
    found, faces, body = plot.views(folder)
    across = plot.draw_shapes(axes, probes.scene, found, faces, body)
    plot.draw_instants(axes, probes, found, across, field=False)
    axes.set_title(f"the best, run {number}", fontsize=9)


COLUMNS, PANEL_IN = 3, (2.2, 2.4)
BEST = {"marker": "*", "ms": 12, "color": "#d55e00", "mec": "w", "mew": 0.6, "ls": ""}


def _draw_runs(axes, search, points, good, best):
    """Values run by run, and the best until then."""
    so_far = []
    for p in good:
        so_far.append(p.value if not so_far else (max if search.maximize else min)(so_far[-1], p.value))
    axes.plot([p.number + 1 for p in good], [p.value for p in good], "o", ms=3.5, color="0.55")
    axes.step([p.number + 1 for p in good], so_far, where="post", color="#0072b2", lw=1.5)
    if best:
        axes.plot([best.number + 1], [best.value], **BEST)
    for p in points:
        if not p.good:
            axes.axvline(p.number + 1, ymax=0.04, color="#d55e00", lw=1)
    axes.set_xlabel("run (ticks: no value)")


def draw(search, points, path, folder=None):
    """folder: of a run of the best, for its shapes."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    numbers = [p for p in search.parameters.values() if not p.words]
    good, count = [p for p in points if p.good], 1 + len(numbers) + bool(folder)
    best = ranked(points, search)[0] if good else None
    columns = min(COLUMNS, count)
    rows = -(-count // columns)
    plt.rcParams.update({"font.size": 8.5, "axes.linewidth": 0.6, "axes.spines.top": False, "axes.spines.right": False})
    figure, grid = plt.subplots(rows, columns, figsize=(PANEL_IN[0] * columns + 0.6, PANEL_IN[1] * rows),
                                squeeze=False, constrained_layout=True)
    places = list(grid.flat)
    for unused in places[count:]:
        unused.set_axis_off()
    _draw_runs(places[0], search, points, good, best)
    for number, (axes, p) in enumerate(zip(places[1:], numbers), 1):
        drawn = axes.scatter([q.values[p.name] / p.size for q in good], [q.value for q in good],
                             c=[q.number + 1 for q in good], s=16, cmap="viridis")
        if best:
            axes.plot([best.values[p.name] / p.size], [best.value], **BEST)
        axes.set_xlabel(f"{p.name.replace('_', ' ')} [{units.typeset(p.unit)}]" if p.unit else p.name)
        axes.sharey(places[0])
        axes.tick_params(labelleft=number % columns == 0)
    for row in range(rows):
        if row * columns <= len(numbers):
            places[row * columns].set_ylabel(search.objective.text)
    if folder and best:
        _draw_shapes(places[count - 1], folder, best.number + 1)
    if good and numbers:
        bar = figure.colorbar(drawn, ax=places[columns - 1] if rows > 1 else places[:count], label="run")
        bar.outline.set_linewidth(0.4)
    figure.savefig(path, dpi=150)
    plt.close(figure)
