// Meshes of other programs, by way of the converter magfsi-mesh.
#pragma once

#include <string>

#include "structure/mesh/mesh.h"

namespace magfsi::bodies {

// Runs magfsi-mesh, which lies beside this program, and reads what it wrote. A process of
// its own: Gmsh's library and the ninety that come with it stay out of the solvers.
// Converted once for a file and unit, however often it is asked for. Throws
// std::invalid_argument with the converter's own message.
structure::Mesh converted_gmsh_mesh(const std::string& file, double unit_m);

}  // namespace magfsi::bodies
