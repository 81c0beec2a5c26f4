# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the origami's figure from a folder of runs.

    plot.py --run FOLDER               makes the runs: one for each mesh of the study
    plot.py FOLDER [--out figure.png]  draws them, and prints what it finds

(a) the folded plate; (b) magnetic forces on the nodes of the flat plate; (c) the angles between
neighbouring cells against the mesh.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import plotting
from magfsi.plotting import GREY, INK
from magfsi.runs import read_rows

HERE = pathlib.Path(__file__).resolve().parent
CELLS = 4
FIELD_T = 0.2
SHOWN = (8, 1)  # elements along a cell's side, layers
STUDY = ((2, 1), (4, 1), (6, 1), (8, 1), (12, 1), (4, 2), (6, 2), (8, 2))


def folder_of(runs, mesh):
    return runs / f"{mesh[0]}x{mesh[0]}x{mesh[1]}"


def run_all(runs):
    for mesh in STUDY:
        elements = f"[{mesh[0]}, {mesh[0]}, {mesh[1]}]"
        plotting.run(HERE / "scene.yaml", folder_of(runs, mesh),
                     [f"bodies.plate.mesh.oblique.elements={elements}",
                      "probes.every=500 ms", "output.structure.every=500 ms"])


class Plate:
    """Last state of a run: nodes as arrays (layer, row, column, 3)."""

    def __init__(self, run, mesh):
        grid = plotting.read_grid(plotting.frames(run)[-1][1])
        self.n, self.layers = mesh
        side = CELLS * self.n + 1
        shape = (self.layers + 1, side, side, 3)
        here = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        moved = vtk_to_numpy(grid.GetPointData().GetArray("displacement[m]")).astype(float)
        self.now, self.rest = here.reshape(shape), (here - moved).reshape(shape)
        self.elements = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 8)
        self.magnetization = vtk_to_numpy(grid.GetCellData().GetArray("magnetization_at_rest[A/m]"))

    def mid(self):
        """Nodes of the mid-surface: (row, column, 3)."""
        lower, upper = self.now[self.layers // 2], self.now[(self.layers + 1) // 2]
        return 0.5 * (lower + upper)

    def at(self, row, column):
        """Node of the mid-surface; row and column are counted in cells."""
        return self.mid()[round(row * self.n), round(column * self.n)]

    def normal(self, row, column):
        """Of a cell: across the lines between the middles of its opposite sides."""
        r, c = row + 0.5, column + 0.5
        across = np.cross(self.at(r, column + 1) - self.at(r, column),
                          self.at(row + 1, c) - self.at(row, c))
        return across / np.linalg.norm(across)

    def angle(self, one, other):
        """Between two cells; positive for a mountain, negative for a valley."""
        first, second = self.normal(*one), self.normal(*other)
        apart = (self.at(other[0] + 0.5, other[1] + 0.5)
                 - self.at(one[0] + 0.5, one[1] + 0.5))
        sense = np.sign(np.dot(second - first, apart))
        return sense * np.degrees(np.arccos(np.dot(first, second)))

    def oblique_folds(self):
        return [[self.angle((r, c), (r, c + 1)) for c in range(CELLS - 1)]
                for r in range(CELLS)]

    def straight_folds(self):
        return [[self.angle((r, c), (r + 1, c)) for c in range(CELLS)]
                for r in range(CELLS - 1)]

    def charges(self):
        """q_a = sum over elements of M . integral of grad N_a [A m]: force = q_a B."""
        corner = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1],
                           [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], dtype=float)
        x = self.rest.reshape(-1, 3)[self.elements]
        charge = np.zeros(self.rest.shape[:3]).ravel()
        for point in corner / np.sqrt(3):
            factor = 1 + corner * point
            local = corner / 8 * np.stack([factor[:, 1] * factor[:, 2],
                                           factor[:, 0] * factor[:, 2],
                                           factor[:, 0] * factor[:, 1]], axis=1)
            jacobian = np.einsum("ad,eac->edc", local, x)
            gradient = np.einsum("ad,ecd->eac", local, np.linalg.inv(jacobian))
            share = np.einsum("eac,ec->ea", gradient, self.magnetization)
            np.add.at(charge, self.elements, share * np.linalg.det(jacobian)[:, None])
        return charge.reshape(self.rest.shape[:3])

    def side_forces_n(self):
        """On the sides of the lowest left cell, from the nodes between their ends."""
        n, force = self.n, FIELD_T * np.abs(self.charges().sum(axis=0))
        whole = n / (n - 1)
        return {"oblique between cells": whole * force[1:n, n].sum(),
                "oblique on the outline": whole * force[1:n, 0].sum(),
                "straight between cells": whole * force[n, 1:n].sum(),
                "straight on the outline": whole * force[0, 1:n].sum()}

    def on_border(self):
        """Nodes on the outline of a cell: (row, column)."""
        on = np.arange(CELLS * self.n + 1) % self.n == 0
        return on[:, None] | on[None, :]


def draw_folded(figure, place, plate):
    axes = figure.add_axes(place, projection="3d", proj_type="ortho")
    mm = 1e3 * (plate.now - plate.now.reshape(-1, 3).mean(axis=0))
    top, bottom = mm[-1], mm[0]
    rings = [(s[:-1, :-1], s[:-1, 1:], s[1:, 1:], s[1:, :-1]) for s in (top, bottom)]
    faces = [np.stack(ring, axis=2).reshape(-1, 4, 3) for ring in rings]
    for edge in (np.s_[:, 0, :], np.s_[:, -1, :], np.s_[:, :, 0], np.s_[:, :, -1]):
        strip = mm[edge]
        faces.append(np.stack([strip[:-1, :-1], strip[:-1, 1:], strip[1:, 1:], strip[1:, :-1]],
                              axis=2).reshape(-1, 4, 3))
    faces = np.concatenate(faces)
    middle = faces.mean(axis=1)[:, 2]
    normal = np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    light = np.abs(normal @ np.array([-0.55, -0.35, 0.76]))
    level = (middle - middle.min()) / np.ptp(middle)
    shade = np.clip((0.45 + 0.5 * level) * (0.55 + 0.5 * light), 0, 1)
    axes.add_collection3d(Poly3DCollection(faces, facecolors=[str(s) for s in shade],
                                           edgecolors=[str(s) for s in shade], linewidths=0.3))
    axes.view_init(elev=38, azim=-62)
    reach = np.abs(mm).max(axis=(0, 1, 2))
    axes.set(xlim=(-reach[0], reach[0]), ylim=(-reach[1], reach[1]),
             zlim=(-reach[2], reach[2]))
    axes.set_box_aspect(reach, zoom=1.05)
    axes.set_xlabel("x [mm]", labelpad=-4)
    axes.set_ylabel("y [mm]", labelpad=-4)
    axes.set_zlabel("z [mm]", labelpad=-8)
    axes.tick_params(pad=-2, labelsize=7)
    axes.locator_params(axis="z", nbins=3)
    for pane in (axes.xaxis, axes.yaxis, axes.zaxis):
        pane.set_pane_color((1, 1, 1, 0))


def draw_forces(axes, plate):
    force_un = 1e6 * FIELD_T * plate.charges().sum(axis=0)  # through the thickness
    flat = 1e3 * plate.rest[0]
    corner = flat[::plate.n, ::plate.n]
    for line in list(corner) + list(corner.transpose(1, 0, 2)):
        axes.plot(line[:, 0], line[:, 1], color="0.7", lw=0.7, zorder=0)
    largest = np.abs(force_un).max()
    some = np.abs(force_un) > 1e-6 * largest
    size = 22 * np.abs(force_un) / largest
    for up, face in ((True, INK), (False, "white")):
        pick = some & ((force_un > 0) == up)
        axes.scatter(flat[pick][:, 0], flat[pick][:, 1], s=size[pick], facecolors=face,
                     edgecolors=INK, linewidths=0.6, zorder=2)
    axes.scatter(*flat[~some][:, :2].T, s=1, color="0.6", linewidths=0)
    for row in range(CELLS):
        for column in range(CELLS):
            half = plate.n // 2
            x, y, _ = flat[row * plate.n + half, column * plate.n + half]
            sense = 1 if column % 2 == 0 else -1
            lean = 1 if row % 2 == 0 else -1
            plotting.arrow(axes, (x + sense * 2.2, y - sense * lean * 1.27),
                           (x - sense * 2.2, y + sense * lean * 1.27), width=1.2)
    axes.set(aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    axes.set_title(f"filled: up, open: down; largest {1e-3 * largest:.0f} mN", fontsize=7.5,
                   color=GREY, loc="left", pad=3)
    plotting.clean(axes)


def extrapolated(found, k):
    """To elements of no length, from the two finest meshes of one layer: error ~ h^2."""
    (coarse, fine) = sorted(m[0] for m in found if m[1] == 1)[-2:]
    ratio = (fine / coarse) ** 2
    return (ratio * found[fine, 1][k] - found[coarse, 1][k]) / (ratio - 1)


def draw_angles(axes, found):
    marks = {1: ("o", "-"), 2: ("s", "--")}
    for name, values in (("across oblique borders", 0), ("across straight borders", 1)):
        for layers, (mark, dash) in marks.items():
            meshes = [m for m in found if m[1] == layers]
            h = [1 / m[0] for m in meshes]
            angle = [found[m][values] for m in meshes]
            axes.plot(h, angle, mark, ls=dash, color=INK, ms=4, lw=1,
                      mfc=INK if layers == 1 else "white")
        limit = extrapolated(found, values)
        axes.plot([0, 0.5], [limit, limit], color=GREY, lw=0.8, ls=":")
        axes.text(0.5, limit + (2 if limit > 45 else 13), name, ha="right", fontsize=7.5)
    every = [a for pair in found.values() for a in pair]
    axes.set(xlim=(0, 0.53), ylim=(0, max(every) + 20), xticks=[1 / 12, 1 / 6, 1 / 4, 1 / 2],
             xticklabels=["1/12", "1/6", "1/4", "1/2"], xlabel="element over cell side",
             ylabel="angle between cells [\N{DEGREE SIGN}]")
    axes.text(0.03, 36, "filled: one layer, open: two\ndotted: extrapolated", fontsize=7,
              color=GREY)
    plotting.clean(axes)


def is_miura(oblique, straight):
    """Oblique lines are mountains and valleys in turn; so are the pieces of a straight one."""
    columns = np.where(np.arange(CELLS - 1) % 2 == 0, 1, -1)
    pieces = (-1) ** np.add.outer(np.arange(CELLS - 1), np.arange(CELLS))
    return bool(abs(np.sum(np.sign(oblique) * columns)) == oblique.size
                and abs(np.sum(np.sign(straight) * pieces)) == straight.size)


def report(plates):
    found = {}
    for mesh, plate in plates.items():
        oblique, straight = np.array(plate.oblique_folds()), np.array(plate.straight_folds())
        found[mesh] = (abs(oblique[1, 1]), abs(straight[1, 1]))
        charge, border = plate.charges(), plate.on_border()
        inside = np.abs(charge[:, ~border]).max() / np.abs(charge).max()
        print(f"{mesh[0]} x {mesh[0]} x {mesh[1]} a cell: fold at the middle, oblique "
              f"{found[mesh][0]:.2f}, straight {found[mesh][1]:.2f} degrees; all oblique "
              f"{np.abs(oblique).min():.1f} to {np.abs(oblique).max():.1f}, straight "
              f"{np.abs(straight).min():.1f} to {np.abs(straight).max():.1f}; as Miura-ori: "
              f"{is_miura(oblique, straight)}; largest interior force over largest {inside:.1e}")
    exact = {row["side"]: float(row["force_N"]) for row in read_rows(HERE / "reference.csv")}
    for side, force in plates[min(plates)].side_forces_n().items():
        print(f"force on a side, {side}: {force:.5f} N, closed form {exact[side]:g} N")
    for k, name in enumerate(("oblique", "straight")):
        print(f"one layer, {name}: extrapolated {extrapolated(found, k):.2f} degrees")
    return found


def main():
    chosen = plotting.figure_options(__doc__)
    if chosen.run:
        run_all(chosen.folder)
    plates = {mesh: Plate(folder_of(chosen.folder, mesh), mesh) for mesh in STUDY
              if (folder_of(chosen.folder, mesh) / "structure.pvd").exists()}
    if not plates:
        plotting.needed(folder_of(chosen.folder, SHOWN) / "structure.pvd")
    found = report(plates)
    plt.rcParams.update({"font.size": 8, "axes.linewidth": 0.6})
    figure = plt.figure(figsize=(7.2, 5.6))
    shown = plates.get(SHOWN, plates[max(plates)])
    draw_folded(figure, [0.1, 0.46, 0.8, 0.56], shown)
    draw_forces(figure.add_axes([0.07, 0.07, 0.43, 0.37]), shown)
    draw_angles(figure.add_axes([0.61, 0.1, 0.37, 0.32]), found)
    plotting.letters(figure, {"a": (0.01, 0.97), "b": (0.01, 0.46), "c": (0.57, 0.46)})
    figure.savefig(chosen.out, dpi=200)
    print(chosen.out)


if __name__ == "__main__":
    main()
