# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes gripper.msh and ball.msh beside itself: a cross of four arms and a ball of hexahedra, in mm."""
import itertools
import math
import pathlib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ARM, HALF, THICK = 2.5, 0.5, 0.2
ALONG, ACROSS = 10, 4  # elements of an arm
DIAMETER, PARTS, LAYERS = 2.0, 6, 2
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


class Mesh:
    def __init__(self):
        self.numbers, self.elements, self.faces = {}, [], []

    def node(self, x):
        return self.numbers.setdefault(tuple(round(float(c), 9) + 0.0 for c in x), len(self.numbers) + 1)

    def block(self, at, counts, region):
        """Hexahedra between at(i, j, k)."""
        for cell in itertools.product(*map(range, counts)):
            x = [np.array(at(*np.add(cell, c)), float) for c in CORNERS]
            if np.linalg.det([x[1] - x[0], x[3] - x[0], x[4] - x[0]]) < 0:
                x = x[4:] + x[:4]
            self.elements.append((region, [self.node(c) for c in x]))

    def face(self, at, counts, name):
        for i, j in itertools.product(*map(range, counts)):
            self.faces.append((name, [self.node(at(i + a, j + b)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]))

    def write(self, file):
        names = sorted({(3, n) for n, _ in self.elements} | {(2, n) for n, _ in self.faces})
        tags = {name: i + 1 for i, (_, name) in enumerate(names)}
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
        lines += [f'{dim} {tags[name]} "{name}"' for dim, name in names]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.numbers))]
        lines += [f"{i} {x:.9g} {y:.9g} {z:.9g}" for (x, y, z), i in self.numbers.items()]
        cells = [(5, tags[n], e) for n, e in self.elements] + [(3, tags[n], f) for n, f in self.faces]
        lines += ["$EndNodes", "$Elements", str(len(cells))]
        lines += [f"{i} {kind} 2 {tag} {tag} " + " ".join(map(str, e)) for i, (kind, tag, e) in enumerate(cells, 1)]
        file.write_text("\n".join([*lines, "$EndElements", ""]))


def cross():
    mesh, edge = Mesh(), 2 * HALF / ACROSS
    mesh.block(lambda i, j, k: (edge * i - HALF, edge * j - HALF, THICK * k), (ACROSS, ACROSS, 1), "hub")
    for name, z in ("bottom", 0), ("top", THICK):
        mesh.face(lambda i, j, z=z: (edge * i - HALF, edge * j - HALF, z), (ACROSS, ACROSS), name)
    for name, (cos, sin) in {"east": (1, 0), "north": (0, 1), "west": (-1, 0), "south": (0, -1)}.items():
        def at(i, j, k, cos=cos, sin=sin):
            x, y = HALF + ARM * i / ALONG, edge * j - HALF
            return cos * x - sin * y, sin * x + cos * y, THICK * k
        half = ALONG // 2
        mesh.block(at, (half, ACROSS, 1), name)
        mesh.block(lambda i, j, k, at=at, half=half: at(i + half, j, k), (half, ACROSS, 1), f"{name} tip")
    return mesh


def ball():
    """A cube, swollen towards a ball, in shells; of the ball's volume, though its faces are flat."""
    mesh = Mesh()
    t = [math.tan(math.pi / 4 * (2 * i / PARTS - 1)) for i in range(PARTS + 1)]

    def inner(x):
        out = max(map(abs, x))
        round_ = 0.6 * out / max(np.linalg.norm(x), 1e-12) * np.array(x)
        return (1 - 0.5 * out) * 0.45 * np.array(x) + 0.5 * out * round_

    mesh.block(lambda i, j, k: inner((t[i], t[j], t[k])), (PARTS,) * 3, "ball")
    for axis, side in itertools.product(range(3), (-1, 1)):
        def shell(i, j, k, axis=axis, side=side):
            x = np.roll([side, t[i], t[j]], axis)
            return (1 - k / LAYERS) * inner(x) + k / LAYERS * x / np.linalg.norm(x)
        mesh.block(shell, (PARTS, PARTS, LAYERS), "ball")
    return mesh


def scaled(mesh, volume):
    """Each corner moved out from the middle, so that the elements fill the volume."""
    places = np.array(list(mesh.numbers))
    x, signs = places[np.array([e for _, e in mesh.elements]) - 1], 2 * np.array(CORNERS) - 1
    found = 0
    for point in itertools.product((-1 / math.sqrt(3), 1 / math.sqrt(3)), repeat=3):
        f = 1 + signs * point
        slopes = np.stack([signs[:, d] * f[:, (d + 1) % 3] * f[:, (d + 2) % 3] / 8 for d in range(3)])
        found += np.linalg.det(slopes @ x).sum()
    mesh.numbers = {tuple((volume / found)**(1 / 3) * place): i for i, place in enumerate(places, 1)}
    return mesh


if __name__ == "__main__":
    cross().write(HERE / "gripper.msh")
    scaled(ball(), math.pi / 6 * DIAMETER**3).write(HERE / "ball.msh")
