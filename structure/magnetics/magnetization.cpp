#include "structure/magnetics/magnetization.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace magfsi::structure {
namespace {

// Even-odd rule: a ray towards larger x crosses the outline an odd number of times.
bool inside_polygon(std::span<const std::array<double, 2>> outline, const Vec3& point) {
    bool inside = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        const auto& [xi, yi] = outline[i];
        const auto& [xj, yj] = outline[j];
        if ((yi > point[1]) == (yj > point[1])) continue;
        if (point[0] < xi + (xj - xi) * (point[1] - yi) / (yj - yi)) inside = !inside;
    }
    return inside;
}

bool holds(const MagneticDomain& domain, const Vec3& point) {
    if (domain.box_m) {
        for (int d = 0; d < 3; ++d) {
            if (point[d] < (*domain.box_m)[0][d] || point[d] > (*domain.box_m)[1][d]) {
                return false;
            }
        }
    }
    return domain.polygon_xy_m.empty() || inside_polygon(domain.polygon_xy_m, point);
}

void check(const HarmonicMagnetization& profile) {
    const bool axes = profile.along >= 0 && profile.along <= 2 && profile.into >= 0 &&
                      profile.into <= 2 && profile.along != profile.into;
    if (!(profile.wavelength_m > 0) || !axes) {
        throw std::invalid_argument(fmt::format(
            "harmonic magnetisation with wavelength {:g} m and axes {} and {} found; the "
            "wavelength must be positive and the axes two different ones of 0, 1, 2",
            profile.wavelength_m, profile.along, profile.into));
    }
}

}  // namespace

Vec3 element_centre(const Mesh& mesh, std::size_t element) {
    Vec3 centre{};
    for (int node : mesh.elements[element]) {
        for (int d = 0; d < 3; ++d) centre[d] += 0.125 * mesh.nodes[node][d];
    }
    return centre;
}

std::vector<Vec3> uniform_magnetization(const Mesh& mesh, const Vec3& vector_a_m) {
    return std::vector<Vec3>(mesh.elements.size(), vector_a_m);
}

std::vector<Vec3> harmonic_magnetization(const Mesh& mesh,
                                         const HarmonicMagnetization& profile) {
    check(profile);
    double left_end = INFINITY;
    for (const Vec3& node : mesh.nodes)
        left_end = std::min(left_end, node[profile.along]);
    std::vector<Vec3> out(mesh.elements.size());
    for (std::size_t e = 0; e < out.size(); ++e) {
        const double s = element_centre(mesh, e)[profile.along] - left_end;
        const double angle =
            2 * std::numbers::pi * s / profile.wavelength_m + profile.phase_rad;
        out[e][profile.along] = profile.amplitude_a_m * std::cos(angle);
        out[e][profile.into] = profile.amplitude_a_m * std::sin(angle);
    }
    return out;
}

std::vector<Vec3> domain_magnetization(const Mesh& mesh,
                                       std::span<const MagneticDomain> domains) {
    std::vector<Vec3> out(mesh.elements.size());
    for (std::size_t e = 0; e < out.size(); ++e) {
        const Vec3 centre = element_centre(mesh, e);
        const auto owner = std::ranges::find_if(
            domains, [&](const MagneticDomain& domain) { return holds(domain, centre); });
        if (owner == domains.end()) {
            throw std::invalid_argument(
                fmt::format("element {} with its centre at ({:.6g}, {:.6g}, {:.6g}) m "
                            "lies in none of "
                            "the {} magnetisation domains; every element must lie in one",
                            e, centre[0], centre[1], centre[2], domains.size()));
        }
        out[e] = owner->vector_a_m;
    }
    return out;
}

std::vector<Vec3> region_magnetization(const Mesh& mesh,
                                       const std::map<std::string, Vec3>& vector_a_m) {
    if (mesh.region_names.empty()) {
        throw std::invalid_argument(
            "a magnetisation by region found for a mesh without regions");
    }
    const auto& names = mesh.region_names;
    for (const auto& [name, unused] : vector_a_m) {
        if (std::ranges::find(names, name) != names.end()) continue;
        throw std::invalid_argument(
            fmt::format("magnetisation of the region \"{}\" found; the mesh has {}", name,
                        fmt::join(names, ", ")));
    }
    for (const std::string& name : names) {
        if (vector_a_m.contains(name)) continue;
        throw std::invalid_argument(fmt::format(
            "no magnetisation of the region \"{}\" found; each of {} needs one", name,
            fmt::join(names, ", ")));
    }
    std::vector<Vec3> out(mesh.elements.size());
    for (std::size_t e = 0; e < out.size(); ++e) {
        out[e] = vector_a_m.at(names[mesh.region[e]]);
    }
    return out;
}

}  // namespace magfsi::structure
