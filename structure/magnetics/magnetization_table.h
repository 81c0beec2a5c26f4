// Magnetisation from a table of vectors.
#pragma once

#include <filesystem>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Reads a CSV file with a header of names and units and one row a vector; lines that are
// empty or begin with # are skipped. Columns, in any order:
//
//   Mx[A/m],My[A/m],Mz[A/m]                   one row an element, in the mesh's order
//   x[m],y[m],z[m],Mx[A/m],My[A/m],Mz[A/m]    points in the body's frame: each element
//                                             takes the vector of the point nearest to
//                                             its centre, the first of equals
//
// Lengths may be in m, mm or um, magnetisations in A/m or kA/m. Throws
// std::invalid_argument that names file and line on a column, unit or number that is not
// allowed; on a number of rows that is not that of the elements; and on points further
// from an element than half the body's diagonal (a table of another body or unit).
std::vector<Vec3> table_magnetization(const Mesh& mesh,
                                      const std::filesystem::path& file);

}  // namespace magfsi::structure
