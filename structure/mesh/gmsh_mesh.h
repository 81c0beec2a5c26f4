// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of Gmsh, read by Gmsh's own library. SI.
#pragma once

#include <filesystem>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Mesh of a file, and remarks for its user.
struct GmshMesh {
    Mesh mesh;
    int unused_nodes = 0;  // number of nodes of no hexahedron, which were dropped
    std::vector<int> part_elements;  // number of elements of each connected part
};

// Reads a .msh file (versions 2.2 and 4.1, text or binary). Coordinates are multiplied by
// `metres_per_unit` (1e-3 for a mesh in millimetres). Physical groups of volumes become
// regions ("unnamed" for volumes in no group, if there are groups), those of surfaces
// named faces, those of curves and points named points. A group without a name is named
// by its number. The curve "centre_line" becomes the centre line.
//
// Elements are numbered from 0 by volume, in Gmsh's order, and nodes by Gmsh's number;
// elements are turned by oriented(). Throws std::runtime_error, with the file, what was
// found and what to do, if the file is no mesh of Gmsh, has no hexahedra or elements of
// other kinds or orders, a volume is in two groups, a group has no node of the body, or
// refuse_broken_mesh refuses it.
GmshMesh read_gmsh_mesh(const std::filesystem::path& file, double metres_per_unit);

}  // namespace magfsi::structure
