// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/app/explain_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "adapters/scene/effective.h"
#include "adapters/solvers/bodies/filled_cubes.h"
#include "adapters/solvers/bodies/mesh_estimate.h"
#include "structure/lattice/element_advice.h"
#include "structure/lattice/inertia.h"
#include "structure/lattice/rigid_mass.h"
#include "structure/mesh/body_points.h"

namespace magfsi::launch {
namespace {

// Thresholds above which a mesh gets a warning: relative error of the displacements and
// of the moments of inertia.
constexpr double error_to_warn_of = 0.05;
constexpr double inertia_to_warn_of = 0.1;
// Differences of two models that are told, relative, where the mesh's own error is less.
constexpr double least_difference = 0.005;

std::string in_percent(double error) {
    return fmt::format("{:+.2g} %", 100 * error);
}

// The words say how a rigid part is held.
std::string words_of(const structure::Hinge&) {
    return ", on a hinge";
}
std::string words_of(const structure::Pivot&) {
    return ", on a pivot";
}
std::string words_of(const structure::RigidCourse& moved) {
    return fmt::format(", {}{}{} as prescribed", moved.way ? "moved" : "",
                       moved.way && moved.turning ? " and " : "",
                       moved.turning ? "turned" : "");
}

}  // namespace

std::string explain_error(const scene::Scene& scene, const scene::Body& body,
                          const structure::Body& solid) {
    const auto estimate = bodies::estimate_mesh_error(scene, body, solid);
    if (!estimate.not_made.empty())
        return fmt::format("    error of the displacements: not estimated, {}\n",
                           estimate.not_made);
    std::string text = fmt::format(
        "    error of the displacements: about {} (linear response to {}, "
        "against {})",
        in_percent(estimate.largest), estimate.loads, estimate.against);
    double worst = estimate.largest;
    for (const auto& [point, error] : estimate.points) {
        text += fmt::format(", of {} {}", point, in_percent(error));
        if (std::abs(error) > std::abs(worst)) worst = error;
    }
    text += "\n";
    const auto follows = bodies::difference_of_follows(scene, solid);
    if (follows && *follows > std::max(std::abs(worst), least_difference))
        text += fmt::format(
            "    magnetization follows the {}: by the {} displacements would be {:.2g} % "
            "other (bodies.{}.magnetization.follows)\n",
            name_of(solid.follows),
            name_of(structure::is_turned(solid)
                        ? structure::MagnetizationFollows::deformation
                        : structure::MagnetizationFollows::rotation),
            100 * *follows, body.name);
    if (std::abs(worst) <= error_to_warn_of) return text;
    return text +
           fmt::format(
               "    warning: body '{}' moves about {:.0f} % too {} on this mesh of "
               "{}: take finer elements{}\n",
               body.name, 100 * std::abs(worst), worst < 0 ? "little" : "far",
               scene::name_of(body.element),
               body.element == structure::ElementVariant::assumed_strain
                   ? ""
                   : ", more layers or element assumed_strain");
}

std::string explain_bricks(const structure::Body& solid, const structure::Box& box) {
    structure::Vec3 edges{};
    for (std::size_t d = 0; d < 3; ++d) edges[d] = box.size_m[d] / box.elements[d];
    const auto axis = std::ranges::min_element(box.size_m) - box.size_m.begin();
    const structure::ElementAdvice advice = structure::element_advice(
        solid.element, edges, static_cast<int>(axis), box.elements[axis], solid.material);
    return advice.text.empty()
               ? ""
               : fmt::format("    warning: body '{}': {}\n", solid.name, advice.text);
}

std::string explain_moments(const scene::Scene& scene, const structure::Body& solid) {
    const structure::Vec3 error = structure::inertia_error(solid);
    std::string text =
        fmt::format("    moments of inertia against the body's: x {}, y {}, z {}\n",
                    in_percent(error[0]), in_percent(error[1]), in_percent(error[2]));
    const bool turns = !scene.time.equilibrium && solid.clamps.empty();
    if (!turns || std::ranges::max(error) <= inertia_to_warn_of) return text;
    return text + fmt::format(
                      "    warning: body '{}' turns as if its inertia were {:.0f} % "
                      "larger: take {}finer elements\n",
                      solid.name, 100 * std::ranges::max(error),
                      solid.inertia == structure::Inertia::lumped
                          ? "inertia: corrected, or "
                          : "");
}

std::string explain_rigid_parts(const structure::Body& solid) {
    std::string text;
    for (std::size_t p = 0; p < solid.rigid_parts.size(); ++p) {
        const structure::RigidPart& part = solid.rigid_parts[p];
        const auto mass =
            structure::rigid_mass(solid, static_cast<int>(p), solid.mesh.nodes);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(mass.inertia_kg_m2);
        const Eigen::Vector3d moments = axes.eigenvalues();
        const std::string held =
            part.hold
                ? std::visit([](const auto& hold) { return words_of(hold); }, *part.hold)
                : "";
        text += fmt::format(
            "    rigid{}: mass {:.4g} mg with what its neighbours lend it, principal "
            "moments {:.4g}, {:.4g}, {:.4g} mg mm2{}\n",
            part.name.empty() ? "" : " " + part.name, 1e6 * mass.mass_kg,
            1e12 * moments[0], 1e12 * moments[1], 1e12 * moments[2], held);
    }
    return text;
}

std::string explain_regions(const structure::Mesh& mesh) {
    std::vector<std::string> regions;
    for (std::size_t r = 0; r < mesh.region_names.size(); ++r)
        regions.push_back(
            fmt::format("{} ({})", mesh.region_names[r],
                        std::ranges::count(mesh.region, static_cast<int>(r))));
    return fmt::format("    regions, with numbers of elements: {}\n",
                       fmt::join(regions, ", "));
}

std::string explain_voxels(const structure::Body& solid,
                           const structure::VoxelMesh& voxels) {
    const double volume_m3 = structure::volume_m3(solid.mesh);
    const double surface_m3 = bodies::surface_volume_m3(voxels);
    const double thin_m =
        std::ranges::min(structure::bounds(solid.mesh.nodes).extent_m());
    double weighed_m3 = solid.mesh.solid_share.empty() ? volume_m3 : 0;
    for (const double share : solid.mesh.solid_share)
        weighed_m3 += share * std::pow(voxels.spacing_m, 3);
    return fmt::format(
        "    cubes of {:.4g} mm, {:.0f} across the thinnest side; their volume against "
        "the surface's: {}, weighed by what they hold of it: {}\n",
        1e3 * voxels.spacing_m, thin_m / voxels.spacing_m,
        in_percent(volume_m3 / surface_m3 - 1), in_percent(weighed_m3 / surface_m3 - 1));
}

}  // namespace magfsi::launch
