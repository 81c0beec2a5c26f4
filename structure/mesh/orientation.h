// Numbering of the corners of hexahedra that other programs made.
#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// From the order of VTK and Gmsh (round the bottom, then round the top) to ours.
Hexahedron lexicographic(const Hexahedron& round);

// The right-handed one of the 48 numberings of the same hexahedron (in lexicographic
// order, of any handedness) whose local axes lie closest to x, y and z: a block gets the
// numbering of box_mesh, however its elements were turned or mirrored.
Hexahedron oriented(const std::vector<Vec3>& nodes_m, const Hexahedron& element);

}  // namespace magfsi::structure
