# SPDX-License-Identifier: GPL-2.0-or-later
"""Meshes, surfaces and tables with faults, and sound ones, for advice_is_followed.py."""

import itertools
import shutil

from magfsi import testing

MESH = (testing.ROOT / "tests/unit/mesh/two_cubes.msh").read_text()


def box(low, high):
    """The triangles of a box, as vertices whose order is right-handed from outside."""
    ends = (low, high)
    triangles = []
    for axis, side in itertools.product(range(3), range(2)):
        b, c = [(axis + 1) % 3, (axis + 2) % 3][::1 if side else -1]
        corners = []
        for at in ((0, 0), (1, 0), (1, 1), (0, 1)):
            point = [0, 0, 0]
            point[axis], point[b], point[c] = ends[side][axis], ends[at[0]][b], ends[at[1]][c]
            corners.append(tuple(point))
        triangles += [corners[:3], [corners[0], *corners[2:]]]
    return triangles


def stl(triangles):
    facets = ("".join(["facet normal 0 0 0\nouter loop\n",
                       *(f"vertex {x} {y} {z}\n" for x, y, z in t), "endloop\nendfacet\n"]) for t in triangles)
    return f"solid s\n{''.join(facets)}endsolid s\n"


def surfaces():
    cube = box((0, 0, 0), (2, 2, 2))
    arms = box((0, 0, 0), (3, 1, 1)) + box((0, 0, 0), (1, 3, 1)) + box((2, 0, 0), (3, 3, 1))
    pair = box((0, 0, 0), (2, 2, 2)) + box((4, 0, 0), (6, 2, 2))
    text = stl(cube)
    return {"cube.stl": text, "open.stl": stl(cube[1:]), "turned.stl": stl([cube[0][::-1], *cube[1:]]),
            "cut.stl": text[:text.rindex("vertex")], "empty.stl": stl([]), "junk.stl": "ply\n",
            "comma.stl": text.replace("vertex 2 2 2", "vertex 2,0 2,0 2,0"),
            "infinite.stl": text.replace("vertex 2 2 2", "vertex inf 2 2"), "horseshoe.stl": stl(arms),
            "neck.stl": stl(pair + box((1, 0.85, 0.85), (5, 1.15, 1.15))),
            "thick_neck.stl": stl(pair + box((1, 0.5, 0.5), (5, 1.5, 1.5)))}


def meshes():
    second = "3 5 2 1 1 2 9 10 3 6 11 12 7"
    apart = MESH.replace("12 2 1 1\n", "12 2 1 1\n13 X 0 0\n14 X 1 0\n15 X 0 1\n16 X 1 1\n")
    apart = apart.replace("$Nodes\n12", "$Nodes\n16").replace(second, "3 5 2 1 1 13 9 10 14 15 11 12 16")
    apart = apart.replace("$Elements\n3", "$Elements\n4").replace("4 8 5\n", "4 8 5\n4 3 2 3 2 9 10 12 11\n")
    apart = apart.replace("$PhysicalNames\n2\n", '$PhysicalNames\n3\n2 3 "far"\n')
    lone = MESH.replace("$Nodes\n12", "$Nodes\n13").replace("12 2 1 1\n", "12 2 1 1\n13 9 9 9\n")
    lone = lone.replace("$Elements\n3", "$Elements\n4").replace(second, f"{second}\n4 15 2 7 7 13")
    tetrahedra = MESH.replace("2 5 2 1 1 1 2 3 4 5 6 7 8", "2 4 2 1 1 1 2 3 5").replace(
        second, "3 4 2 1 1 2 9 10 11")
    return {"good.msh": MESH, "good.mesh": MESH, "options.msh": MESH, "options.msh.opt": "",
            "old.msh": MESH.replace("2.2 0 8", "3.0 0 8"), "tetrahedra.msh": tetrahedra,
            "script.msh": "Point(1) = {0, 0, 0};\n", "lone.msh": lone,
            "tags.msh": MESH.replace("\n12 2 1 1", "\n2147483648 2 1 1").replace(" 12 7", " 2147483648 7"),
            "twice.msh": MESH.replace(second, "3 5 2 1 1 1 2 3 4 5 6 7 8"),
            "touching.msh": apart.replace("X", "1"), "gap.msh": apart.replace("X", "1.2")}


def grid(row, points=(-5, 0, 5), header="x[mm],y[mm],z[mm],Bx[mT],By[mT],Bz[mT]"):
    return "\n".join([header, *(row(*at) for at in itertools.product(points, repeat=3)), ""])


def tables():
    good = grid(lambda x, y, z: f"{x},{y},{z},1,2,3")
    tail = "\n".join(good.splitlines()[1:])
    magnetization = "x[{0}],y[{0}],z[{0}],Mx[kA/m],My[kA/m],Mz[kA/m]\n2,0.5,0.25,30,0,0\n"
    return {"grid.csv": good, "tall.csv": good.replace("5", "90"), "larger.csv": good.replace("5", "9"),
            "uneven.csv": good.replace("-5", "-6"),
            "gap.csv": good[:good.rindex("5,5,5")], "utf16.csv": good.encode("utf-16"),
            "comma.csv": grid(lambda x, y, z: f"{x},0,{y},0,{z},0,1,0,2,0,3,0"), "bare.csv": tail,
            "expression.csv": good.replace("Bx[mT]", "2*Bx[mT]"), "unit.csv": good.replace("Bx[mT]", "Bx[mV]"),
            "comment.csv": "% field in mT\n" + good.replace("[mT]", ""), "twice.csv": good.replace("By", "Bx"),
            "metres.csv": good.replace("mm", "m"), "word.csv": good.replace(",1,", ",one,"),
            "short.csv": good.replace(",2,3\n", ",2\n", 1), "none.csv": good.splitlines()[0],
            "far.csv": magnetization.format("m"), "near.csv": magnetization.format("mm"),
            "course.csv": "t[s],Bx[mT],By[mT],Bz[mT]\n0,0,0,1\n1,0,0,2\n", "inlet.csv": "t[s],factor\n0,0\n1,1\n"}


def write(folder):
    for name, text in (surfaces() | meshes() | tables()).items():
        (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    (folder / "folder.stl").mkdir()
    shutil.copy(testing.ROOT / "tests/unit/scene/complete/steer.py", folder)
