// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/rigid_parts.h"

#include <algorithm>
#include <cmath>

#include "structure/lattice/rigid_mass.h"

namespace magfsi::bodies {

std::vector<RigidPartOfScene> rigid_parts_of(const Solids& solids) {
    std::vector<RigidPartOfScene> all;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        for (std::size_t p = 0; p < solids[b].rigid_parts.size(); ++p) {
            const std::string& region = solids[b].rigid_parts[p].name;
            all.push_back({b, static_cast<int>(p),
                           solids[b].name + (region.empty() ? "" : "." + region)});
        }
    }
    return all;
}

Eigen::Quaterniond turn_at_start(const scene::Placement& initial) {
    if (!initial.rotation) return Eigen::Quaterniond::Identity();
    const auto [first, second] = initial.rotation->plane;
    const Eigen::Vector3d axis =
        Eigen::Vector3d::Unit(first).cross(Eigen::Vector3d::Unit(second));
    return Eigen::Quaterniond(Eigen::AngleAxisd(initial.rotation->angle_rad, axis));
}

structure::Vec3 angles_rad(const Eigen::Quaterniond& q) {
    const double sine = 2 * (q.w() * q.y() - q.z() * q.x());
    return {std::atan2(2 * (q.w() * q.x() + q.y() * q.z()),
                       1 - 2 * (q.x() * q.x() + q.y() * q.y())),
            std::asin(std::clamp(sine, -1.0, 1.0)),
            std::atan2(2 * (q.w() * q.z() + q.x() * q.y()),
                       1 - 2 * (q.y() * q.y() + q.z() * q.z()))};
}

RigidKinetics::RigidKinetics(const Solids& solids,
                             std::span<const structure::Vec3> start_m)
    : parts_(rigid_parts_of(solids)) {
    std::vector<std::size_t> first{0};
    for (const structure::Body& solid : solids)
        first.push_back(first.back() + solid.mesh.nodes.size());
    for (const RigidPartOfScene& one : parts_) {
        const structure::Body& solid = solids[one.body];
        inertia_kg_m2_.push_back(structure::inertia_beyond_nodes_kg_m2(
            solid, one.part, start_m.subspan(first[one.body], solid.mesh.nodes.size())));
    }
}

double RigidKinetics::beyond_nodes_j(std::span<const structure::RigidPartMotion> motions,
                                     std::size_t body) const {
    double sum = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (parts_[i].body != body) continue;
        const structure::Vec3& w = motions[i].angular_velocity_rad_s;
        const Eigen::Vector3d at_start =
            motions[i].turn.conjugate() * Eigen::Vector3d(w[0], w[1], w[2]);
        sum += 0.5 * at_start.dot(inertia_kg_m2_[i] * at_start);
    }
    return sum;
}

double RigidKinetics::beyond_nodes_j(
    std::span<const structure::RigidPartMotion> motions) const {
    double sum = 0;
    const std::size_t bodies = parts_.empty() ? 0 : parts_.back().body + 1;
    for (std::size_t b = 0; b < bodies; ++b) sum += beyond_nodes_j(motions, b);
    return sum;
}

}  // namespace magfsi::bodies
