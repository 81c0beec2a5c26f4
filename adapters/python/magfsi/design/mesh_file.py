# SPDX-License-Identifier: GPL-2.0-or-later
"""The mesh of a design whose thickness was free, as a Gmsh file that the scene reads."""
import numpy as np

# Corners of a hexahedron in Gmsh's order; ours number x fastest, then y, then z.
GMSH_ORDER = [0, 1, 3, 2, 4, 5, 7, 6]
SIDES = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]


def boundary(elements):
    """Quads (n, 4) that belong to one element alone."""
    sides = np.concatenate([elements[:, side] for side in SIDES])
    _, first, times = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    return sides[np.sort(first[times == 1])]


def thickened(program, factors):
    """Nodes at rest with the thickness times these factors of the regions: as with_thickness of
    structure/design does it."""
    rest, elements = program.rest.copy(), np.array(program.facts["element_nodes"])
    low, high = rest.min(axis=0), rest.max(axis=0)
    axis = int(np.argmin(high - low))
    of_elements = np.repeat(np.asarray(factors)[program.facts["region"]], 8)
    count = np.bincount(elements.ravel(), minlength=len(rest))
    mean = np.bincount(elements.ravel(), of_elements, len(rest)) / np.maximum(count, 1)
    middle = 0.5 * (low + high)[axis]
    rest[:, axis] = middle + np.where(count > 0, mean, 1) * (rest[:, axis] - middle)
    return rest


def gmsh_text(program, nodes):
    """Gmsh 2.2: regions are physical volumes, faces physical surfaces; lengths in m."""
    elements = np.array(program.facts["element_nodes"])
    regions = program.facts["regions"] or ["body"]
    region = program.facts["region"] or [0] * len(elements)
    skin = boundary(elements)
    faces = {name: skin[np.isin(skin, held).all(axis=1)]
             for name, held in program.facts["faces"].items()}
    faces = {name: quads for name, quads in faces.items() if len(quads)}
    names = [f'3 {i + 1} "{name}"' for i, name in enumerate(regions)]
    names += [f'2 {len(regions) + i + 1} "{name}"' for i, name in enumerate(faces)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names,
             "$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{i + 1} {x:.17g} {y:.17g} {z:.17g}" for i, (x, y, z) in enumerate(nodes)]
    cells = [(5, region[e] + 1, element[GMSH_ORDER]) for e, element in enumerate(elements)]
    cells += [(3, len(regions) + i + 1, quad) for i, quads in enumerate(faces.values()) for quad in quads]
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [f"{n + 1} {kind} 2 {tag} {tag} " + " ".join(str(node + 1) for node in corners)
              for n, (kind, tag, corners) in enumerate(cells)]
    return "\n".join([*lines, "$EndElements", ""])
