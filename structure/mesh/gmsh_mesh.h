// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of Gmsh, read by Gmsh's own library.
#pragma once

#include <filesystem>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

struct GmshMesh {
    Mesh mesh;
    int unused_nodes = 0;            // of no hexahedron: dropped
    std::vector<int> part_elements;  // elements of each connected part
};

// Reads a .msh file (versions 2.2 and 4.1, text or binary). Its coordinates are
// multiplied by `metres_per_unit` (1e-3 for a mesh in millimetres). Physical groups
// become: of volumes, regions ("unnamed" for volumes in none, where there are others); of
// surfaces, named faces; of curves and points, named points. A group without a name is
// named by its number. The curve "centre_line" becomes the centre line.
//
// Elements are numbered from 0 by volume and Gmsh's number, nodes by Gmsh's number, and
// turned by oriented(). Throws std::runtime_error that names the file, what was found and
// what to do: not a mesh of Gmsh, no hexahedra, elements of other kinds or orders, a
// volume in two groups, a group without a node of the body; what refuse_broken_mesh
// refuses.
GmshMesh read_gmsh_mesh(const std::filesystem::path& file, double metres_per_unit);

}  // namespace magfsi::structure
