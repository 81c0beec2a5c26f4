// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/effects/contact/contact_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/fitted/constants.h"
#include "structure/body.h"
#include "structure/mesh/surface.h"
#include "structure/refuse.h"

namespace magfsi::structure {

namespace {

// Spring constant k of a pair [N/m], areas_m4 = A_i A_j.
double spring_n_m(const ContactLaw& law, double areas_m4) {
    return 6 * law.stiffness_pa_m * areas_m4 /
           (std::numbers::pi * law.distance_m * law.distance_m);
}

}  // namespace

ContactForce contact_force(const ContactLaw& law, double areas_m4, double distance_m) {
    const double approach = law.distance_m - distance_m;
    if (!(approach > 0) || distance_m == 0) return {};
    const double spring = spring_n_m(law, areas_m4);
    return {spring * approach, 0.5 * spring * approach * approach};
}

double stuck_energy_j(const ContactLaw& law, double areas_m4, const StuckPair& stuck) {
    return 0.5 * spring_n_m(law, areas_m4) * stuck.slip_m * stuck.slip_m;
}

PairFriction pair_friction(const ContactLaw& law, double areas_m4, const Vec3& apart_m,
                           StuckPair& stuck) {
    PairFriction out;
    const double r = norm(apart_m);
    const double normal_n = contact_force(law, areas_m4, r).force_n;
    if (normal_n == 0) {
        if (stuck.held) out.lost_j = stuck_energy_j(law, areas_m4, stuck);
        stuck = {};
        return out;
    }
    if (!stuck.held) stuck = {apart_m, 0, true};
    double along = 0;  // s.n
    for (std::size_t d = 0; d < 3; ++d) along += stuck.apart_m[d] * apart_m[d] / r;
    const Vec3 across = stuck.apart_m - along * apart_m / r;
    const double slip = norm(across);
    const double spring = spring_n_m(law, areas_m4);
    const double most_n = law.friction * normal_n;
    if (slip == 0 || (along > 0 && spring * along / r * slip <= most_n)) {
        out.force_n = spring * along / r * across;
        stuck.slip_m = slip;
        return out;
    }
    along = std::max(along, r);
    const double kept = most_n / spring * r / along;
    out.force_n = most_n * across / slip;
    stuck.apart_m = along * apart_m / r + kept * across / slip;
    out.lost_j = std::max(0.0, 0.5 * spring * (slip - kept) * (stuck.slip_m + kept));
    stuck.slip_m = kept;
    return out;
}

double contact_distance_m(const std::vector<Body>& bodies) {
    double longest = 0;
    for (const Body& body : bodies) {
        const auto& x = body.mesh.nodes;
        for (const SurfaceQuad& quad : boundary_quads(body.mesh)) {
            for (std::size_t c = 0; c < 2; ++c) {
                const std::size_t a = quad.node[c];
                const std::size_t b = quad.node[c + 2];
                longest = std::max(longest, distance_m(x[a], x[b]));
            }
        }
    }
    return fitted::contact_distance * longest;
}

double contact_stiffness_pa_m(const std::vector<Body>& bodies, double distance_m) {
    if (bodies.empty() || !(distance_m > 0)) {
        refuse(
            "contact of {} bodies at a distance of {:g} m found; it needs a body or "
            "more, and a distance above 0 m",
            bodies.size(), distance_m);
    }
    double softest = INFINITY;
    for (const Body& body : bodies) {
        for (const Material& material : pressing_materials(body, bodies)) {
            softest = std::min(softest,
                               material.lame_lambda_pa + 2 * material.shear_modulus_pa);
        }
    }
    if (std::isinf(softest))
        refuse(
            "contact without stiffness found, and no body has a modulus from which it "
            "would follow; give the stiffness");
    return fitted::contact_stiffness * softest / distance_m;
}

double contact_spring_pa_m(const Body& body, const ContactLaw& law) {
    const auto area = surface_areas(body.mesh.nodes, body.mesh.elements);
    const double largest = *std::ranges::max_element(area);
    const double coarse =
        6 * largest / (std::numbers::pi * law.distance_m * law.distance_m);
    const double fine = law.friction > 0 ? 5.4 : 2.2;
    return 2 * std::max(fine, coarse) * law.stiffness_pa_m;
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
