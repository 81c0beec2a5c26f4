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

// Profiles; all functions return one vector [A/m] per element, in the mesh's order.
std::vector<Vec3> uniform_magnetization(const Mesh& mesh, const Vec3& vector_a_m);
// Harmonic profile, eq. (10). Throws std::invalid_argument on a wavelength that is not
// positive or on wrong axes.
std::vector<Vec3> harmonic_magnetization(const Mesh& mesh,
                                         const HarmonicMagnetization& profile);
// The vector of the first domain that holds the element's centre; zero if none does.
// Throws std::invalid_argument if a domain is the first one of no element.
std::vector<Vec3> domain_magnetization(const Mesh& mesh,
                                       std::span<const MagneticDomain> domains);
// The vector of each element's region. Throws std::invalid_argument, with the regions
// that there are, if the mesh has no regions, a region has no vector or a name is no
// region.
std::vector<Vec3> region_magnetization(const Mesh& mesh,
                                       const std::map<std::string, Vec3>& vector_a_m);

// Magnetisation along a curve. Throws std::invalid_argument if neither the options nor
// the mesh have a curve, or if two of its points coincide.
std::vector<Vec3> curve_magnetization(const Mesh& mesh, const CurveMagnetization& wanted);
// Magnetisation away from a centre or an axis. Throws std::invalid_argument on an element
// whose middle lies on the centre or the axis.
std::vector<Vec3> radial_magnetization(const Mesh& mesh,
                                       const RadialMagnetization& wanted);

// Rows of a table of vectors: with a point for each, or with one row per element and no
// points.
struct MagnetizationRows {
    std::vector<Vec3> point_m, vector_a_m;
};

// Reads a CSV file (table_file.h) with a header of names and units and one row per
// vector. Columns, in any order:
//
//   Mx[A/m],My[A/m],Mz[A/m]                   one row per element, in the mesh's order
//   x[m],y[m],z[m],Mx[A/m],My[A/m],Mz[A/m]    points in the body's frame: each element
//                                             takes the vector of the point nearest to
//                                             its centre, the first of equals
//
// Throws std::invalid_argument, with file and line, on a column, unit or number that is
// not allowed.
MagnetizationRows read_magnetization(const std::filesystem::path& file);

// The vectors of a file for the mesh's elements. Throws std::invalid_argument as
// read_magnetization does; on a number of rows other than that of the elements; and if
// the nearest point is farther from an element than half the body's diagonal (a table of
// another body or unit).
std::vector<Vec3> table_magnetization(const Mesh& mesh,
                                      const std::filesystem::path& file);

}  // namespace magfsi::structure
