#include <algorithm>

#include "coupler/scene/effective.h"

namespace magfsi::scene {

namespace {

struct Effect {
    const char* name;
    bool (*active)(const Scene&);
};

bool any_body(const Scene& scene, bool (*test)(const Body&)) {
    return std::ranges::any_of(scene.bodies, test);
}

bool has_moving_wall(const Scene& scene) {
    return scene.fluid && std::ranges::any_of(scene.fluid->boundaries, [](const auto& b) {
               return b.kind == BoundaryKind::no_slip && b.velocity_m_s != Vec3{};
           });
}

bool has_opening(const Scene& scene) {
    return scene.fluid && std::ranges::any_of(scene.fluid->boundaries, [](const auto& b) {
               return b.kind == BoundaryKind::velocity_inlet ||
                      b.kind == BoundaryKind::pressure_outlet;
           });
}

// A coupled step: the structure's substeps, each with the immersed boundary's force, then
// the fluid.
constexpr Effect effects[] = {
    {"elasticity", [](const Scene& s) { return !s.bodies.empty(); }},
    {"viscosity",
     [](const Scene& s) {
         return any_body(s, [](const Body& b) {
             return b.material.viscosity_pa_s ||
                    std::ranges::any_of(b.material_regions, [](const RegionMaterial& r) {
                        return r.material.viscosity_pa_s.has_value();
                    });
         });
     }},
    {"magnetic field", [](const Scene& s) { return s.magnetic_field.has_value(); }},
    {"field gradient",
     [](const Scene& s) { return s.magnetic_field && s.magnetic_field->gradient; }},
    {"gravity", [](const Scene& s) { return s.gravity.has_value(); }},
    {"damping", [](const Scene& s) { return s.damping.has_value(); }},
    {"platform", [](const Scene& s) { return s.platform.has_value(); }},
    {"friction", [](const Scene& s) { return s.platform && s.platform->friction; }},
    {"contact", [](const Scene& s) { return s.contact.has_value(); }},
    {"clamps",
     [](const Scene& s) {
         return any_body(s, [](const Body& b) { return !b.clamps.empty(); });
     }},
    {"rollers",
     [](const Scene& s) {
         return any_body(s, [](const Body& b) { return !b.rollers.empty(); });
     }},
    {"prescribed motion",
     [](const Scene& s) {
         return any_body(s, [](const Body& b) { return !b.prescribed_motion.empty(); });
     }},
    {"immersed boundary", [](const Scene& s) { return s.coupling.has_value(); }},
    {"fluid", [](const Scene& s) { return s.fluid.has_value(); }},
    {"body force",
     [](const Scene& s) { return s.fluid && s.fluid->body_force_n_m3.has_value(); }},
    {"eddy viscosity",
     [](const Scene& s) { return s.fluid && s.fluid->smagorinsky.has_value(); }},
    {"moving walls", has_moving_wall},
    {"inlets and outlets", has_opening},
    {"obstacles", [](const Scene& s) { return s.fluid && !s.fluid->obstacles.empty(); }},
    {"checkpoint", [](const Scene& s) { return s.checkpoint.has_value(); }},
};

std::vector<std::string> select(const Scene& scene, bool active) {
    std::vector<std::string> list;
    for (const Effect& effect : effects) {
        if (effect.active(scene) == active) list.emplace_back(effect.name);
    }
    return list;
}

}  // namespace

std::vector<std::string> active_effects(const Scene& scene) {
    return select(scene, true);
}
std::vector<std::string> absent_effects(const Scene& scene) {
    return select(scene, false);
}

}  // namespace magfsi::scene
