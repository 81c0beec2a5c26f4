// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/effects/contact/contact_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/body.h"
#include "structure/mesh/surface.h"
#include "structure/refuse.h"

namespace magfsi::structure {

ContactForce contact_force(const ContactLaw& law, double areas_m4, double distance_m) {
    const double approach = law.distance_m - distance_m;
    if (!(approach > 0) || distance_m == 0) return {};
    const double spring = 6 * law.stiffness_pa_m * areas_m4 /
                          (std::numbers::pi * law.distance_m * law.distance_m);
    return {spring * approach, 0.5 * spring * approach * approach};
}

double friction_drag_kg_s(const ContactLaw& law, double area_m2, double mass_kg,
                          double dt_s) {
    const double coarse =
        6 * area_m2 / (std::numbers::pi * law.distance_m * law.distance_m);
    return 0.25 * mass_kg / dt_s * coarse / std::max(2.2, coarse);
}

Vec3 friction_force_n(const ContactLaw& law, double normal_n, double drag_kg_s,
                      const Vec3& past_m_s) {
    const double speed = std::hypot(past_m_s[0], past_m_s[1], past_m_s[2]);
    if (speed == 0) return {};
    const double drag = std::min(law.friction * normal_n / speed, drag_kg_s);
    return {-drag * past_m_s[0], -drag * past_m_s[1], -drag * past_m_s[2]};
}

double contact_distance_m(const std::vector<Body>& bodies) {
    double longest = 0;
    for (const Body& body : bodies) {
        const auto& x = body.mesh.nodes;
        for (const SurfaceQuad& quad : boundary_quads(body.mesh)) {
            for (std::size_t c = 0; c < 2; ++c) {
                const auto a = static_cast<std::size_t>(quad.node[c]);
                const auto b = static_cast<std::size_t>(quad.node[c + 2]);
                longest = std::max(longest, distance_m(x[a], x[b]));
            }
        }
    }
    return 0.75 * longest;
}

double contact_stiffness_pa_m(const std::vector<Body>& bodies, double distance_m) {
    if (bodies.empty() || !(distance_m > 0)) {
        refuse("contact needs at least one body and a positive distance");
    }
    double softest = INFINITY;
    for (const Body& body : bodies) {
        for (const Material& material : used_materials(body)) {
            softest = std::min(softest,
                               material.lame_lambda_pa + 2 * material.shear_modulus_pa);
        }
    }
    return 0.25 * softest / distance_m;
}

double contact_spring_pa_m(const Body& body, const ContactLaw& law) {
    const auto area = surface_areas(body.mesh.nodes, body.mesh.elements);
    const double largest = *std::ranges::max_element(area);
    const double coarse =
        6 * largest / (std::numbers::pi * law.distance_m * law.distance_m);
    return 2 * std::max(2.2, coarse) * law.stiffness_pa_m;
}

ContactLaw contact_law(const LammpsInput& input) {
    ContactLaw law = *input.contact;
    if (!(law.distance_m > 0)) law.distance_m = contact_distance_m(input.bodies);
    if (!(law.stiffness_pa_m > 0)) {
        law.stiffness_pa_m = contact_stiffness_pa_m(input.bodies, law.distance_m);
    }
    return law;
}

}  // namespace magfsi::structure
