// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies that cannot have an equilibrium, since nothing holds them.
#include <algorithm>
#include <cmath>

#include "structure/equilibrium/static_problem.h"
#include "structure/mesh/mesh_check.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Part of v along the unit vector n.
Eigen::Vector3d along(const Eigen::Vector3d& n, const Eigen::Vector3d& v) {
    return n.dot(v) * n;
}

// A field gradient, unlike a uniform field, has a net force on a body.
void refuse_to_be_carried(const Body& body, const HeldAxes& held) {
    if (held == HeldAxes{true, true, true}) return;
    refuse(
        "body {} is in a field gradient, which carries it away, and no clamp or roller "
        "holds it along every axis: clamp a face, or give it rollers along each axis",
        body.name);
}

}  // namespace

void refuse_to_fall(const Body& body, const HeldAxes& held, const Vec3& gravity_m_s2,
                    const Eigen::Vector3d& platform_normal) {
    const bool massive = std::ranges::any_of(
        used_materials(body), [](const Material& m) { return m.density_kg_m3 != 0; });
    Eigen::Vector3d falls = Eigen::Map<const Eigen::Vector3d>(gravity_m_s2.data());
    const double rounding = 1e-12 * falls.norm();
    for (int d = 0; d < 3; ++d) {
        if (held[d]) falls[d] = 0;
    }
    if (platform_normal.dot(falls) < 0) falls -= along(platform_normal, falls);
    for (int d = 0; d < 3; ++d) {
        if (!massive || std::abs(falls[d]) <= rounding) continue;
        refuse(
            "body {} has weight but no clamp, roller or level platform that holds it "
            "along {}: only the field may load a body along an axis on which it is free; "
            "hold it, or leave gravity out",
            body.name, "xyz"[d]);
    }
}

void require_held(const Body& body, const Vec3& gravity_m_s2,
                  const Surroundings& surroundings) {
    const std::vector<HeldAxes> held = held_axes(body);
    const std::vector<int> part = connected_parts(body.mesh);
    std::vector<HeldAxes> along(1 + static_cast<std::size_t>(std::ranges::max(part)));
    HeldAxes anywhere{};
    for (std::size_t e = 0; e < part.size(); ++e) {
        for (const int node : body.mesh.elements[e]) {
            for (std::size_t d = 0; d < 3; ++d) {
                if (!held[node][d]) continue;
                along[part[e]][d] = anywhere[d] = true;
            }
        }
    }
    const auto loose = std::ranges::find_if(along, [](const HeldAxes& a) {
        return a != HeldAxes{true, true, true};
    });
    if (along.size() > 1 && loose != along.end()) {
        const int number = loose - along.begin();
        const Vec3 there =
            element_centre(body.mesh, std::ranges::find(part, number) - part.begin());
        refuse(
            "body {} is in {} parts that share no node, and the part with the element "
            "at ({:.4g}, {:.4g}, {:.4g}) m is not held along every axis: join the parts "
            "in the mesh, clamp each, or make each a body of its own",
            body.name, along.size(), there[0], there[1], there[2]);
    }
    refuse_to_fall(body, anywhere, gravity_m_s2, normal_of(surroundings.platform));
    if (surroundings.gradient || surroundings.sources)
        refuse_to_be_carried(body, anywhere);
}

}  // namespace magfsi::structure
