# SPDX-License-Identifier: GPL-2.0-or-later
"""A body from a file with four arms that are alike, in a field along its axis: so are their tips, by
the penalty and without slip."""
import itertools
import json
import unittest

import relations
from magfsi import testing


def star_surface(arm, thickness):
    """STL file of a star with four pointed arms of this length, in mm."""
    outline = [(arm, -0.2), (arm, 0.2), (0.4, 0.4), (0.2, arm), (-0.2, arm), (-0.4, 0.4),
               (-arm, 0.2), (-arm, -0.2), (-0.4, -0.4), (-0.2, -arm), (0.2, -arm), (0.4, -0.4)]
    triangles = []
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1]):
        a, b, c, d = (ax, ay, 0), (bx, by, 0), (bx, by, thickness), (ax, ay, thickness)
        triangles += [((0, 0, thickness), d, c), ((0, 0, 0), b, a), (a, b, c), (a, c, d)]
    path = f"{testing.new_folder()}/star.stl"
    with open(path, "w") as file:
        print("solid star", file=file)
        for corners in triangles:
            print("facet normal 0 0 0\nouter loop", file=file)
            for x in corners:
                print("vertex", *map(repr, x), file=file)
            print("endloop\nendfacet", file=file)
        print("endsolid star", file=file)
    return {"voxels": {"file": path, "unit": "1 mm", "spacing": "0.1 mm"}}


def plus_of_hexahedra(arm, thickness, layers):
    """Gmsh file of a plus with four arms of this length, in mm."""
    cell, half = 0.2, 2  # mm, cells
    end = round(arm / cell)
    numbers, elements = {}, []
    for i, j, k in itertools.product(range(-end, end), range(-end, end), range(layers)):
        if -half <= i < half or -half <= j < half:
            corners = [(i + a, j + b, k + c) for c in (0, 1)
                       for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            elements.append([numbers.setdefault(x, len(numbers) + 1) for x in corners])
    path = f"{testing.new_folder()}/plus.msh"
    with open(path, "w") as file:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes", file=file)
        print(len(numbers), file=file)
        for (i, j, k), number in numbers.items():
            print(number, cell * i, cell * j, thickness / layers * k, file=file)
        print("$EndNodes\n$Elements", file=file)
        print(len(elements), file=file)
        for number, nodes in enumerate(elements, 1):
            print(number, "5 2 1 1", *nodes, file=file)
        print("$EndElements", file=file)
    return {"gmsh": {"file": path, "unit": "1 mm"}}


def tips_of(mesh, forcing):
    """Of a body in a field along its axis, each arm with a magnetization outwards: its tips."""
    def arm(x, y):
        low, high = ((0.4, -0.4), (2, 0.4)) if x or y else ((-2, -2), (2, 2))
        corners = [(x * a - y * b, y * a + x * b) if x or y else (a, b) for a, b in (low, high)]
        return {"box": [[f"{value} mm" for value in (*map(end, zip(*corners)), 9 * sign)]
                        for end, sign in ((min, -1), (max, 1))],
                "vector": [f"{30 * x} kA/m", f"{30 * y} kA/m", "0 kA/m"]}
    f = relations.Frame((5, 5, 4))
    ways = {"east": (1, 0), "north": (0, 1), "west": (-1, 0), "south": (0, -1)}
    body = relations.block(f, [1, 1, 1], [1, 1, 1], [2.5, 2.5, 2]) | {"mesh": mesh()}
    body["magnetization"] = {"domains": [arm(*way) for way in (*ways.values(), (0, 0))]}
    points = {name: {"body": "body", "at": f.moved([1.4 * x, 1.4 * y, 0.1])}
              for name, (x, y) in ways.items()}
    path = f"{testing.new_folder()}/scene.yaml"
    with open(path, "w") as file:
        json.dump(relations.scene(f, 1, 0.25, bodies={"body": body}, probes={"points": points},
                        coupling={"immersed_boundary": {"forcing": forcing}},
                        magnetic_field={"vector": f.field([0, 0, 5])},
                        fluid=relations.fluid(f, 0.25, 1, 0.1, relations.NO_SLIP)), file)
    probes = testing.good_run(path).probes()
    tips = {}
    for name, (x, y) in ways.items():
        ux, uy, uz = (probes[f"{name}_u{axis}[m]"] for axis in relations.AXES)
        tips[name] = {"out_x[m]": [x * a + y * b for a, b in zip(ux, uy)],
                      "out_y[m]": [x * b - y * a for a, b in zip(ux, uy)], "out_z[m]": uz}
    return tips


class FourArms(unittest.TestCase):
    def compare(self, relation, expected, found):
        worst, column = testing.worst_difference(expected, found)
        testing.report(f"{relation}: {worst:.1e} in {column}")
        self.assertLessEqual(worst, relations.BOUND, column)

    def alike(self, mesh):
        for forcing in ("penalty", "no_slip"):
            self.alike_by(forcing, mesh)

    def alike_by(self, forcing, mesh):
        tips = tips_of(mesh, forcing)
        still = {column: [0.0] * len(values) for column, values in tips["east"].items()}
        self.assertGreater(testing.worst_difference(tips["east"], still)[0], 0.99)
        for name, tip in tips.items():
            aside = tip | {"out_y[m]": [-v for v in tip["out_y[m]"]]}
            self.compare(f"{forcing}, {name} and east", tips["east"], tip)
            self.compare(f"{forcing}, {name} and its mirror image", tip, aside)

    def test_of_a_surface(self):
        self.alike(lambda: star_surface(1.5, 0.2))

    def test_of_a_thick_surface(self):
        self.alike(lambda: star_surface(1.5, 0.7))

    def test_of_hexahedra(self):
        self.alike(lambda: plus_of_hexahedra(1.4, 0.2, 1))

    def test_of_hexahedra_in_two_layers(self):
        self.alike(lambda: plus_of_hexahedra(1.4, 0.2, 2))


if __name__ == "__main__":
    testing.main()
