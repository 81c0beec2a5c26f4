// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/platform.h"

#include <algorithm>

#include "structure/refuse.h"

namespace magfsi::structure {

double platform_stiffness_pa_m(const Material& material, double thickness_m) {
    if (!(thickness_m > 0)) {
        refuse("thickness of {:g} m found, it must be positive", thickness_m);
    }
    return 0.5 * (material.lame_lambda_pa + 2 * material.shear_modulus_pa) / thickness_m;
}

Platform with_stiffness(const Platform& platform, std::span<const Body> bodies) {
    Platform out = platform;
    if (out.stiffness_pa_m > 0) return out;
    for (const Body& body : bodies) {
        const double thickness_m = std::ranges::min(bounds(body.mesh.nodes).extent_m());
        for (const Material& material : used_materials(body)) {
            out.stiffness_pa_m = std::max(out.stiffness_pa_m,
                                          platform_stiffness_pa_m(material, thickness_m));
        }
    }
    return out;
}

}  // namespace magfsi::structure
