// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of meshes that another program made, and the numbering of their elements'
// corners.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Removes nodes that belong to no element and renumbers the others in their old order,
// also in named faces and points. Returns the number of nodes removed.
int drop_unused_nodes(Mesh& mesh);

// Shortest edge of all elements [m]; infinite without elements.
double shortest_edge_m(const Mesh& mesh);

// Two nodes no farther apart than tolerance_m, if there are any: parts touch there
// without being joined.
std::optional<std::array<int, 2>> coincident_nodes(const Mesh& mesh, double tolerance_m);

// Two elements with the same eight nodes, if there are any.
std::optional<std::array<int, 2>> duplicate_elements(const Mesh& mesh);

// Root of the tree that contains a node, in a forest of disjoint sets where parent[n] is
// the parent of n and roots are their own parents (union-find). Halves the path on the
// way.
inline int root_of(std::vector<int>& parent, int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
}

// Number of the connected part of each element, from 0 in the order of the elements.
// Elements are connected by any common node.
std::vector<int> connected_parts(const Mesh& mesh);
// Number of the part of each element if only common faces connect: elements on both sides
// of a hinge are in different parts.
std::vector<int> parts_joined_by_faces(const Mesh& mesh);

// Throws std::invalid_argument, with advice, on a mesh without elements, an inverted
// element, two elements with the same nodes, or nodes within a thousandth of the shortest
// edge. names: numbers of the elements in their file, for messages; may be empty.
void refuse_broken_mesh(const Mesh& mesh, std::span<const std::size_t> names = {});

// Converts the corners' order of VTK and Gmsh (around the bottom, then around the top) to
// that of Hexahedron.
Hexahedron lexicographic(const Hexahedron& round);

// The right-handed one of the 48 numberings of the same hexahedron whose local axes are
// closest to x, y and z. element: lexicographic, of any handedness. A block gets the
// numbering of box_mesh, however its elements were turned or mirrored.
Hexahedron oriented(const std::vector<Vec3>& nodes_m, const Hexahedron& element);

}  // namespace magfsi::structure
