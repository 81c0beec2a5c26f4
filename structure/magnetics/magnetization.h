// Magnetisation profiles, evaluated at the centres of the undeformed elements.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// M(s) = amplitude [cos(2 pi s / wavelength + phase) along + sin(...) into] with s from
// the body's lowest coordinate on the axis `along`: the strip's profile, eq. (10).
struct Harmonic {
    double amplitude_a_m = 0;
    double wavelength_m = 0;
    double phase_rad = 0;
    int along = 0;  // axes: 0 x, 1 y, 2 z
    int into = 2;
};

// Holds the centres inside the box (bounds included) and the polygon of the x-y plane; an
// absent box or an empty polygon does not restrict.
struct Domain {
    std::optional<std::array<Vec3, 2>> box_m;
    std::vector<std::array<double, 2>> polygon_xy_m;
    Vec3 vector_a_m{};
};

// One vector [A/m] an element, element by element of the mesh.
std::vector<Vec3> uniform_magnetization(const Mesh& mesh, const Vec3& vector_a_m);
// Throws std::invalid_argument on a wavelength that is not positive or wrong axes.
std::vector<Vec3> harmonic_magnetization(const Mesh& mesh, const Harmonic& profile);
// The first domain that holds a centre wins. Throws std::invalid_argument that names the
// element and its centre where none does.
std::vector<Vec3> domain_magnetization(const Mesh& mesh, std::span<const Domain> domains);
// The vector of each element's region. Throws std::invalid_argument that names the
// regions there are where the mesh has none, one has no vector or a name is not one.
std::vector<Vec3> region_magnetization(const Mesh& mesh,
                                       const std::map<std::string, Vec3>& vector_a_m);

Vec3 element_centre(const Mesh& mesh, std::size_t element);

}  // namespace magfsi::structure
