// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes that another program made: what can be wrong with them, and the numbering of
// their elements' corners.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Removes the nodes of no element and numbers the others anew, in their old order; named
// faces and points lose them too. Returns how many were removed.
int drop_unused_nodes(Mesh& mesh);

double shortest_edge_m(const Mesh& mesh);

// Two nodes no further apart than `tolerance_m`: parts that touch without being joined.
std::optional<std::array<int, 2>> coincident_nodes(const Mesh& mesh, double tolerance_m);

// Two elements of the same eight nodes.
std::optional<std::array<int, 2>> duplicate_elements(const Mesh& mesh);

// Of sets that are joined step by step, each a tree of which `parent` has the edges: the
// root of the tree with this node. Shortens the way there.
inline int root_of(std::vector<int>& parent, int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
}

// Number of the connected part of each element, from 0 in the order of the elements;
// elements are connected by any common node.
std::vector<int> connected_parts(const Mesh& mesh);
// The same by common faces only: elements on both sides of a hinge are apart.
std::vector<int> parts_joined_by_faces(const Mesh& mesh);

// Throws std::invalid_argument with advice on a mesh without elements, an inverted
// element, elements given twice, or nodes within a thousandth of the shortest edge.
// names: the numbers of elements in their file, or none.
void refuse_broken_mesh(const Mesh& mesh, std::span<const std::size_t> names = {});

// From the order of VTK and Gmsh (round the bottom, then round the top) to ours.
Hexahedron lexicographic(const Hexahedron& round);

// The right-handed one of the 48 numberings of the same hexahedron (in lexicographic
// order, of any handedness) whose local axes lie closest to x, y and z: a block gets the
// numbering of box_mesh, however its elements were turned or mirrored.
Hexahedron oriented(const std::vector<Vec3>& nodes_m, const Hexahedron& element);

}  // namespace magfsi::structure
