// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/overlaps.h"

#include <fmt/format.h>

#include <algorithm>

#include "structure/body.h"

namespace magfsi::bodies {

namespace {

// Distances in grid spacings. The fluid between surfaces closer than near_cells is not
// resolved; nodes may sink deep_cells into a side or an obstacle before it counts as an
// overlap.
constexpr double near_cells = 0.5, deep_cells = 0.05;

std::vector<const structure::Mesh*> meshes_of(std::span<const structure::Body> solids) {
    std::vector<const structure::Mesh*> meshes;
    for (const structure::Body& solid : solids) meshes.push_back(&solid.mesh);
    return meshes;
}

}  // namespace

Overlaps::Overlaps(const scene::Scene& scene, std::span<const structure::Body> solids,
                   std::span<const structure::Vec3> start_m)
    : has_contact_(scene.contact.has_value()),
      between_(meshes_of(solids), near_cells * scene.fluid->finest_spacing_m(),
               scene.fluid->period_m()),
      around_(scene, solids, start_m, near_cells * scene.fluid->finest_spacing_m(),
              deep_cells * scene.fluid->finest_spacing_m()) {
    for (const structure::Body& solid : solids) names_.push_back(solid.name);
}

std::string Overlaps::body(std::size_t number) const {
    return fmt::format("body '{}'", names_[number]);
}

std::string Overlaps::second(const std::array<std::size_t, 2>& of) const {
    return of[0] == of[1] ? "itself" : body(of[1]);
}

Overlaps::Found Overlaps::find(std::span<const structure::Vec3> nodes_m) const {
    Found found;
    found.bodies = between_.find(nodes_m);
    if (const auto& m = found.bodies.crossing) {
        found.overlap =
            told(fmt::format("{} passes through {}: its element {} through element {}",
                             body(m->body[0]), second(m->body), m->element[0] + 1,
                             m->element[1] + 1),
                 m->at_m, true);
        return found;
    }
    found.solids = around_.find(nodes_m, found.bodies.apart_m);
    if (const auto& m = found.solids.inside) {
        found.overlap = told(fmt::format("{} passes into {} with its element {}",
                                         body(m->body), m->what, m->element + 1),
                             m->at_m, m->yields_to_contact);
    }
    // Surfaces that touch must move by half an element to pass through each other.
    found.apart_m = std::max(found.solids.apart_m, 0.5 * between_.shortest_edge_m());
    return found;
}

std::string Overlaps::told(const std::string& what, const structure::Vec3& at_m,
                           bool contact_helps) const {
    const char* advice = !contact_helps ? "take another start, load or box"
                         : has_contact_
                             ? "take a larger contact.stiffness, finer elements or a "
                               "smaller load"
                             : "add the key contact, which keeps them apart, or take a "
                               "smaller load";
    return fmt::format(
        "{}, at ({:.4g}, {:.4g}, {:.4g}) mm; {}, or go on with coupling.overlap: allow",
        what, at_m[0] * 1e3, at_m[1] * 1e3, at_m[2] * 1e3, advice);
}

}  // namespace magfsi::bodies
