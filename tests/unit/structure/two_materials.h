// A bar along x, its halves (or layers) of two materials.
#pragma once

#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure::test {

inline constexpr Vec3 bar_size_m{8e-3, 1e-3, 0.5e-3};

// Four times as stiff and half as heavy as soft_material, of the same K / G.
inline Material stiff_material() {
    return {132e3, 2640e3, 930};
}

// soft_material below x = half the length, stiff_material beyond.
inline Body soft_and_stiff_bar(ElementVariant variant = ElementVariant::assumed_strain) {
    Body body;
    body.name = "bar";
    body.mesh = box_mesh({bar_size_m, {16, 2, 2}});
    body.material = soft_material();
    body.other_materials = {stiff_material()};
    body.element = variant;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const bool soft = element_centre(body.mesh, e)[0] < 0.5 * bar_size_m[0];
        body.element_material.push_back(soft ? 0 : 1);
    }
    return body;
}

}  // namespace magfsi::structure::test
