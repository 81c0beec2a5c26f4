#include <fmt/format.h>

#include <algorithm>

#include "adapters/scene/effective.h"
#include "adapters/scene/field.h"
#include "adapters/scene/names.h"

namespace magfsi::scene {

namespace {

// Where an effect acts.
enum class Step { structure, coupled, fluid, output };

struct Effect {
    Step step;
    const char* name;
    bool (*active)(const Scene&);
};

bool any_body(const Scene& scene, bool (*test)(const Body&)) {
    return std::ranges::any_of(scene.bodies, test);
}

bool has_moving_wall(const Scene& scene) {
    return scene.fluid && std::ranges::any_of(scene.fluid->boundaries, [](const auto& b) {
               return b.kind == BoundaryKind::no_slip && b.wall_velocity_m_s != Vec3{};
           });
}

bool has_side(const Scene& scene, BoundaryKind kind) {
    return scene.fluid &&
           std::ranges::any_of(scene.fluid->boundaries,
                               [&](const auto& b) { return b.kind == kind; });
}

bool has_scheme(const Scene& scene, Scheme scheme) {
    return scene.coupling && scene.coupling->scheme == scheme;
}

using enum Step;

// A coupled step: the structure's substeps, each with the immersed boundary's force, then
// the fluid, then what is written.
constexpr Effect effects[] = {
    {structure, "elasticity", [](const Scene& s) { return !s.bodies.empty(); }},
    {structure, "viscosity",
     [](const Scene& s) {
         return any_body(s, [](const Body& b) {
             return b.material.viscosity_pa_s > 0 ||
                    std::ranges::any_of(b.material_regions, [](const RegionMaterial& r) {
                        return r.material.viscosity_pa_s > 0;
                    });
         });
     }},
    {structure, "magnetic field",
     [](const Scene& s) { return s.magnetic_field.has_value(); }},
    {structure, "field gradient",
     [](const Scene& s) { return s.magnetic_field && s.magnetic_field->gradient; }},
    {structure, "gravity", [](const Scene& s) { return s.gravity.has_value(); }},
    {structure, "damping", [](const Scene& s) { return s.damping.has_value(); }},
    {structure, "platform", [](const Scene& s) { return s.platform.has_value(); }},
    {structure, "friction",
     [](const Scene& s) { return s.platform && s.platform->friction > 0; }},
    {structure, "contact", [](const Scene& s) { return s.contact.has_value(); }},
    {structure, "clamps",
     [](const Scene& s) {
         return any_body(s, [](const Body& b) { return !b.clamps.empty(); });
     }},
    {structure, "rollers",
     [](const Scene& s) {
         return any_body(s, [](const Body& b) { return !b.rollers.empty(); });
     }},
    {structure, "prescribed motion",
     [](const Scene& s) {
         return any_body(s, [](const Body& b) { return !b.prescribed_motion.empty(); });
     }},
    {coupled, "immersed boundary", [](const Scene& s) { return s.coupling.has_value(); }},
    {coupled, "buoyancy", [](const Scene& s) { return s.coupling && s.gravity; }},
    {coupled, "iterated forcing",
     [](const Scene& s) {
         return s.coupling && s.coupling->immersed_boundary.iterations > 1;
     }},
    {coupled, "parallel scheme",
     [](const Scene& s) { return has_scheme(s, Scheme::parallel); }},
    {coupled, "implicit scheme",
     [](const Scene& s) { return has_scheme(s, Scheme::implicit); }},
    {fluid, "fluid", [](const Scene& s) { return s.fluid.has_value(); }},
    {fluid, "body force",
     [](const Scene& s) { return s.fluid && s.fluid->body_force_n_m3.has_value(); }},
    {fluid, "eddy viscosity",
     [](const Scene& s) { return s.fluid && s.fluid->smagorinsky_constant > 0; }},
    {fluid, "moving walls", has_moving_wall},
    {fluid, "free slip",
     [](const Scene& s) { return has_side(s, BoundaryKind::free_slip); }},
    {fluid, "inlets and outlets",
     [](const Scene& s) {
         return has_side(s, BoundaryKind::velocity_inlet) ||
                has_side(s, BoundaryKind::pressure_outlet);
     }},
    {fluid, "obstacles",
     [](const Scene& s) { return s.fluid && !s.fluid->obstacles.empty(); }},
    {output, "probes", [](const Scene& s) { return s.probes.has_value(); }},
    {output, "interface balance",
     [](const Scene& s) { return s.probes && s.probes->interface_balance; }},
    {output, "energy audit",
     [](const Scene& s) { return s.probes && s.probes->energy_audit; }},
    {output, "structure fields",
     [](const Scene& s) { return s.output.structure.has_value(); }},
    {output, "fluid fields", [](const Scene& s) { return s.output.fluid.has_value(); }},
    {output, "checkpoint", [](const Scene& s) { return s.checkpoint.has_value(); }},
};

std::vector<std::string> select(const Scene& scene, bool active) {
    std::vector<std::string> list;
    for (const Effect& effect : effects) {
        if (effect.active(scene) == active) list.emplace_back(effect.name);
    }
    return list;
}

std::string words(const std::vector<std::string>& names) {
    return names.empty() ? "none" : joined(names);
}

}  // namespace

std::vector<std::string> active_effects(const Scene& scene) {
    return select(scene, true);
}
std::vector<std::string> absent_effects(const Scene& scene) {
    return select(scene, false);
}

std::vector<std::string> effects_by_step(const Scene& scene) {
    std::vector<std::string> lines;
    for (const auto& [step, name] :
         {std::pair{structure, "structure step"}, std::pair{coupled, "coupled step"},
          std::pair{fluid, "fluid step"}, std::pair{output, "outputs"}}) {
        std::vector<std::string> active, absent;
        for (const Effect& effect : effects) {
            if (effect.step != step) continue;
            (effect.active(scene) ? active : absent).emplace_back(effect.name);
        }
        lines.push_back(
            fmt::format("{}: {}; absent: {}", name, words(active), words(absent)));
    }
    return lines;
}

}  // namespace magfsi::scene
