// SPDX-License-Identifier: GPL-2.0-or-later
// What material data sheets give, as the solvers take it.
#include <fmt/format.h>

#include <string>

#include "adapters/scene/checks.h"

namespace magfsi::scene {

namespace {

// Of a material's keys.
struct MaterialMarks {
    const Marks& marks;
    const std::string& body;
    std::string region;  // number in material_regions; empty: of the body

    bool has(const char* key) const {
        return region.empty()
                   ? marks.has({"bodies", body, "material", key})
                   : marks.has({"bodies", body, "material_regions", region, key});
    }
    const Origin& at(const char* key) const {
        return region.empty()
                   ? marks.value({"bodies", body, "material", key})
                   : marks.value({"bodies", body, "material_regions", region, key});
    }
};

void check(const MaterialMarks& at) {
    const char* pairs[][2] = {{"shear_modulus", "lame_lambda"},
                              {"youngs_modulus", "poissons_ratio"}};
    const auto& [ours, theirs] = pairs;
    const bool by_ours = at.has(ours[0]) || at.has(ours[1]);
    const bool by_theirs = at.has(theirs[0]) || at.has(theirs[1]);
    const char* second = at.has(theirs[0]) ? theirs[0] : theirs[1];
    require(!by_ours || !by_theirs, at.at(second),
            fmt::format("{} beside {}", second, at.has(ours[0]) ? ours[0] : ours[1]),
            "shear_modulus and lame_lambda, or youngs_modulus and poissons_ratio");
    for (const char* key : by_theirs ? theirs : ours)
        require(at.has(key), at.at(key), fmt::format("no key \"{}\"", key),
                "shear_modulus and lame_lambda, or youngs_modulus and poissons_ratio");
}

}  // namespace

void check_materials(const Scene& scene, const Marks& marks) {
    for (const Body& body : scene.bodies) {
        check({marks, body.name, ""});
        for (std::size_t i = 0; i < body.material_regions.size(); ++i)
            check({marks, body.name, std::to_string(i)});
    }
    if (!scene.fluid) return;
    const bool usual = marks.has({"fluid", "viscosity"});
    const bool dynamic = marks.has({"fluid", "dynamic_viscosity"});
    require(usual || dynamic, marks.value({"fluid", "viscosity"}), "no key \"viscosity\"",
            "viscosity, or dynamic_viscosity");
    require(!usual || !dynamic, marks.value({"fluid", "viscosity"}),
            "viscosity beside dynamic_viscosity", "one of the two");
}

}  // namespace magfsi::scene
