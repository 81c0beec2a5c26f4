// SPDX-License-Identifier: GPL-2.0-or-later
// Magnetisation profiles, evaluated at the centres of the undeformed elements.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// One vector [A/m] an element, element by element of the mesh.
std::vector<Vec3> uniform_magnetization(const Mesh& mesh, const Vec3& vector_a_m);
// Throws std::invalid_argument on a wavelength that is not positive or wrong axes.
std::vector<Vec3> harmonic_magnetization(const Mesh& mesh,
                                         const HarmonicMagnetization& profile);
// The first domain that holds a centre wins. Throws std::invalid_argument that names the
// element and its centre where none does.
std::vector<Vec3> domain_magnetization(const Mesh& mesh,
                                       std::span<const MagneticDomain> domains);
// The vector of each element's region. Throws std::invalid_argument that names the
// regions there are where the mesh has none, one has no vector or a name is not one.
std::vector<Vec3> region_magnetization(const Mesh& mesh,
                                       const std::map<std::string, Vec3>& vector_a_m);

// Throws std::invalid_argument where neither the options nor the mesh have a curve, or
// two of its points coincide.
std::vector<Vec3> curve_magnetization(const Mesh& mesh, const CurveMagnetization& wanted);
// Throws std::invalid_argument on an element whose middle is on the centre.
std::vector<Vec3> radial_magnetization(const Mesh& mesh,
                                       const RadialMagnetization& wanted);

// A file of vectors; of points, too, or one an element.
struct MagnetizationRows {
    std::vector<Vec3> point_m, vector_a_m;
};

// Reads a CSV file (table_file.h) with a header of names and units and one row a vector.
// Columns, in any order:
//
//   Mx[A/m],My[A/m],Mz[A/m]                   one row an element, in the mesh's order
//   x[m],y[m],z[m],Mx[A/m],My[A/m],Mz[A/m]    points in the body's frame: each element
//                                             takes the vector of the point nearest to
//                                             its centre, the first of equals
//
// Throws std::invalid_argument that names file and line on a column, unit or number that
// is not allowed.
MagnetizationRows read_magnetization(const std::filesystem::path& file);

// Throws std::invalid_argument as read_magnetization; on a number of rows that is not
// that of the elements; and on points further from an element than half the body's
// diagonal (a table of another body or unit).
std::vector<Vec3> table_magnetization(const Mesh& mesh,
                                      const std::filesystem::path& file);

Vec3 element_centre(const Mesh& mesh, std::size_t element);

}  // namespace magfsi::structure
