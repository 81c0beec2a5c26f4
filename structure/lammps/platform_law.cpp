// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/platform_law.h"

#include <algorithm>
#include <cmath>

#include "base/fitted/constants.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Stick point of a node at its first touch: x moved back along v to where the node passed
// through the plane, by one step at most.
StickPoint touched(const Vec3& x_m, const Vec3& v_m_s, double gap_m, double approach_m_s,
                   double dt_s) {
    StickPoint out{x_m, true};
    const double way = approach_m_s * dt_s;
    if (!(way > 0)) return out;
    const double since = dt_s * std::min(1.0, -gap_m / way);
    out.at_m -= since * v_m_s;
    return out;
}

// Adds the friction force and the energy of its spring; drags the stick point if it
// slides.
void add_friction(const Platform& platform, double area_m2, const Vec3& x_m,
                  StickPoint& stick, PlatformContact& out) {
    Vec3 slip = x_m - stick.at_m;
    slip -= dot(slip, platform.normal) * platform.normal;
    const double length = norm(slip);
    if (length == 0) return;
    const double spring = platform.stiffness_pa_m * area_m2;
    const double most = platform.friction * out.normal_n / spring;
    const double kept = std::min(1.0, most / length);
    if (kept < 1) {
        stick.at_m = x_m - kept * slip;
        out.slid_j = spring * kept * length * (1 - kept) * length;
    }
    out.force_n -= spring * kept * slip;
    out.energy_j += 0.5 * spring * kept * length * kept * length;
}

}  // namespace

PlatformContact frictionless_contact(const Platform& platform, double area_m2,
                                     const double* x_m, const double* v_m_s) {
    const Vec3 x = vector_at(x_m), v = vector_at(v_m_s);
    PlatformContact out;
    out.gap_m += dot(x - platform.point_m, platform.normal);  // never -0
    if (!(out.gap_m < 0)) return out;
    const double spring = platform.stiffness_pa_m * area_m2;
    const double approach = -dot(v, platform.normal);
    out.normal_n =
        std::max(0.0, -spring * out.gap_m + platform.damping_pa_s_m * area_m2 * approach);
    out.energy_j = 0.5 * spring * out.gap_m * out.gap_m;
    out.force_n = out.normal_n * platform.normal;
    return out;
}

PlatformContact platform_contact(const Platform& platform, double area_m2,
                                 const double* x_m, const double* v_m_s, double dt_s,
                                 StickPoint& stick) {
    PlatformContact out = frictionless_contact(platform, area_m2, x_m, v_m_s);
    if (!(out.gap_m < 0)) {
        stick.held = false;
        return out;
    }
    const Vec3 x = vector_at(x_m), v = vector_at(v_m_s);
    if (!stick.held) stick = touched(x, v, out.gap_m, -dot(v, platform.normal), dt_s);
    add_friction(platform, area_m2, x, stick, out);
    return out;
}

double platform_stiffness_pa_m(const Material& material, double thickness_m) {
    if (!(thickness_m > 0)) {
        refuse("thickness of {:g} m found, it must be positive", thickness_m);
    }
    return fitted::platform_stiffness *
           (material.lame_lambda_pa + 2 * material.shear_modulus_pa) / thickness_m;
}

Platform with_stiffness(const Platform& platform, std::span<const Body> bodies) {
    Platform out = platform;
    if (out.stiffness_pa_m > 0) return out;
    for (const Body& body : bodies) {
        const double thickness_m = std::ranges::min(bounds(body.mesh.nodes).extent_m());
        for (const Material& material : pressing_materials(body, bodies)) {
            out.stiffness_pa_m = std::max(out.stiffness_pa_m,
                                          platform_stiffness_pa_m(material, thickness_m));
        }
    }
    if (!(out.stiffness_pa_m > 0))
        refuse(
            "a platform without stiffness found, and no body has a modulus from which "
            "it would follow; give the stiffness");
    return out;
}

}  // namespace magfsi::structure
