# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of a design, one file that fetches nothing: target and reached shapes over each other, the
magnetisation as arrows, errors, history, what it costs to make."""
import base64
import html
import io

import numpy as np

from magfsi.design.mesh_file import boundary
from magfsi.design.objective import Points

INK, WANTED, FIELD = "0.25", "#d55e00", "#0072b2"
COLOURS = "hsv"  # of directions in the plane


def _plane(problem, search, state):
    """Axes of the picture: those of the design's plane, or those along which the shapes are largest."""
    axes = problem.wanted.magnetization.axes
    if len(axes) == 2:
        return list(axes)
    extent = np.max([np.ptp(x, axis=0) for x in state.x], axis=0)
    return sorted(np.argsort(extent)[-2:])


def _sections(problem, vectors, x, axes, count=24):
    """Places and magnetisation in the deformed body, means over parts along the longest axis."""
    program = problem.program
    elements = np.array(program.facts["element_nodes"])
    along = int(np.argmax(np.ptp(program.rest, axis=0)))
    s = program.centres[:, along]
    part = np.minimum(((s - s.min()) / max(np.ptp(s), 1e-30) * count).astype(int), count - 1)
    rest, now = program.rest[elements], x[elements]
    # The mean deformation gradient of each element, by its half edges.
    sign = np.array([[1 if a >> d & 1 else -1 for a in range(8)] for d in range(3)])
    before, after = np.einsum("da,eai->eid", sign, rest), np.einsum("da,eai->eid", sign, now)
    turned = np.einsum("eij,ej->ei", after @ np.linalg.inv(before), vectors)
    weight = np.bincount(part, program.volumes, count)
    good = weight > 0

    def mean(values):
        return np.bincount(part, program.volumes * values, count)[good] / weight[good]

    places = np.stack([mean(now.mean(axis=1)[:, d]) for d in axes], axis=1)
    arrows = np.stack([mean(turned[:, d]) for d in axes], axis=1)
    return places, arrows


def _draw_pose(axes_of_figure, problem, objective, vectors, x, field, title, axes):
    program = problem.program
    elements = np.array(program.facts["element_nodes"])
    skin = boundary(elements)
    from matplotlib.collections import PolyCollection

    axes_of_figure.add_collection(PolyCollection(1e3 * x[skin][:, :, axes], facecolors="0.82",
                                                 edgecolors="none"))
    for term in objective.terms:
        if isinstance(term, Points):
            axes_of_figure.plot(*(1e3 * term.places(x)[:, axes].T), color=INK, lw=0.8,
                                marker="" if term.curve else "o", ms=3, label="reached", zorder=3)
            axes_of_figure.plot(*(1e3 * term.goal[:, axes].T), color=WANTED, lw=1.6,
                                ls=(0, (3, 3)) if term.curve else "",
                                marker="" if term.curve else "x", label="wanted", zorder=4)
    places, arrows = _sections(problem, vectors, x, axes)
    angle = np.degrees(np.arctan2(arrows[:, 1], arrows[:, 0])) % 360
    size = max(np.linalg.norm(arrows, axis=1).max(), 1e-30)
    length = 1e3 * problem.length_m
    axes_of_figure.quiver(*(1e3 * places.T), *(arrows / size).T, angle, cmap=COLOURS, clim=(0, 360),
                          angles="xy", scale_units="xy", scale=1 / (0.12 * length), pivot="mid",
                          width=0.011, zorder=5)
    shown = np.concatenate([1e3 * x[:, axes]] + [1e3 * t.goal[:, axes] for t in objective.terms
                                                 if isinstance(t, Points)])
    low, high = shown.min(axis=0) - 0.08 * length, shown.max(axis=0) + 0.08 * length
    way = field[axes] / max(np.linalg.norm(field), 1e-30) * 0.2 * length
    middle = np.array([low[0] - 0.15 * length, high[1] - 0.15 * length])
    axes_of_figure.annotate("", middle + way / 2, middle - way / 2,
                            arrowprops={"arrowstyle": "-|>", "color": FIELD, "lw": 1.8})
    axes_of_figure.text(*(middle - [0, 0.13 * length]), "B", color=FIELD, ha="center", va="top")
    axes_of_figure.set_xlim(low[0] - 0.3 * length, high[0])
    axes_of_figure.set_ylim(low[1], high[1])
    axes_of_figure.set_title(title, fontsize=10)
    axes_of_figure.set_aspect("equal")
    axes_of_figure.set_xlabel(f"{'xyz'[axes[0]]} [mm]")
    axes_of_figure.set_ylabel(f"{'xyz'[axes[1]]} [mm]")


def _draw_history(axes, search):
    seconds = [s.seconds for s in search.history]
    axes.semilogy(seconds, [100 * max(s.rms, 1e-9) for s in search.history], color=INK, lw=1.2)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("off by [% of the length]")
    other = axes.twinx()
    other.plot(seconds, [100 * s.share for s in search.history], color=FIELD, lw=1)
    other.set_ylabel("part of the way [%]", color=FIELD)
    axes.set_title("history", fontsize=10)


def figure(problem, search, state, facts):
    """PNG of all poses and the history."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    designs, axes = search.unknowns.designs(state.p), _plane(problem, search, state)
    count = len(search.poses) + 1
    columns = 2
    rows = -(-count // columns)
    picture = plt.figure(figsize=(3.6 * columns, 3.2 * rows), constrained_layout=True)
    grid = picture.add_gridspec(rows, columns)
    # The history takes what is left of the last row.
    places = [picture.add_subplot(grid[i // columns, i % columns]) for i in range(count - 1)]
    history = picture.add_subplot(grid[-1, (count - 1) % columns:])
    for place, pose, objective, x, d in zip(places, problem.wanted.poses, search.poses, state.x, designs):
        error = facts["poses"][pose.name]["error"]
        _draw_pose(place, problem, objective, d.magnetization, x, d.field,
                   f"{pose.name}: {100 * error:.2g} % of the length", axes)
    if any(isinstance(t, Points) for t in search.poses[0].terms):
        places[0].legend(fontsize=9, frameon=False, loc="lower left", borderaxespad=0.2, handlelength=1.6)
    _draw_history(history, search)
    data = io.BytesIO()
    picture.savefig(data, dpi=200, format="png")
    plt.close(picture)
    return data.getvalue()


def _table(head, rows):
    lines = ["".join(f"<th>{html.escape(str(c))}</th>" for c in head)]
    lines += ["".join(f"<td>{html.escape(str(c))}</td>" for c in row) for row in rows]
    return '<div class="wide"><table>' + "".join(f"<tr>{line}</tr>" for line in lines) + "</table></div>"


def _pose_rows(facts):
    for name, pose in facts["poses"].items():
        field = ", ".join(f"{1e3 * b:.4g}" for b in pose["field_t"])
        yield (name, f"({field}) mT", f"{100 * pose['error']:.3g} %",
               "yes" if pose["reached_by_rise"] else
               f"no: followed to {100 * pose['followed_by_the_field']:.0f} % of the field")


def assemble(problem, search, facts, picture):
    from magfsi.report import page as of_a_run  # VTK comes with it

    title = f"Design of {facts['name']}"
    shown = base64.b64encode(picture).decode()
    style = of_a_run.style() + "\nimg { display: block; max-width: 100%; background: #fff; }\n"
    policy = f"default-src 'none'; img-src data:; style-src {of_a_run.hash_of(style)}"
    cost = [("distinct directions (by a degree)", facts["directions"]),
            ("distinct vectors (by a degree and a hundredth)", facts["vectors"]),
            ("largest turn over a millimetre", f"{facts['largest_turn_deg_per_mm']:.3g} degrees"),
            ("unknowns", facts["unknowns"]),
            ("of these not seen by the fields", facts["null_space"])]
    parts = [f"<header><h1>{html.escape(title)}</h1></header><main>",
             f'<section><figure><img alt="target and reached shapes, magnetisation" '
             f'src="data:image/png;base64,{shown}"></figure>'
             "<p>Arrows: the magnetisation in the deformed body, means over cross-sections, the longest as long "
             "in each pose; colours: its direction.</p></section>",
             "<section><h2>Poses</h2>",
             _table(["pose", "field", "error", "reached by raising the field"], _pose_rows(facts)),
             "</section><section><h2>To make it</h2>", _table(["", ""], cost),
             f"<p>{len(search.history)} steps in {facts['seconds']:.0f} s</p></section></main>"]
    return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
            f"<title>{html.escape(title)}</title>\n<style>{style}</style>\n</head>\n<body>\n"
            + "\n".join(parts) + "\n</body>\n</html>\n")
