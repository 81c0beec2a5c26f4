// What a scene comes to: values, hash, effects, step; effects that can do nothing.
#include "adapters/scene/effective.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/field.h"
#include "adapters/scene/keys.h"

namespace magfsi::scene {

nlohmann::ordered_json effective_scene(const Scene& scene) {
    Scene copy = scene;  // the keys serve reading too
    JsonWriter writer;
    keys(writer, copy);
    return writer.take();
}

std::uint64_t scene_hash(const Scene& scene) {
    // nlohmann::json sorts the keys, ordered_json does not.
    const std::string text = nlohmann::json(effective_scene(scene)).dump();
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : text) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 1099511628211ULL;
    }
    return hash;
}

std::uint64_t state_hash(const Scene& scene) {
    Scene endless = scene;
    endless.time.end_s = 0;
    // What a run does when it diverges changes no state before that.
    if (endless.checkpoint) endless.checkpoint = Checkpoint{endless.checkpoint->every_s};
    return scene_hash(endless);
}

double path_step_s(const Scene& scene) {
    return scene.probes ? scene.probes->every_s : scene.time.end_s;
}

double halved(const Scene& scene, double step_s) {
    return std::ldexp(step_s, -scene.time.halvings);
}

std::optional<double> coupled_step_s(const Scene& scene) {
    if (scene.time.step_s) return halved(scene, *scene.time.step_s);
    if (!scene.fluid || !(scene.fluid->expected_speed_m_s > 0)) return std::nullopt;
    const Fluid& fluid = *scene.fluid;
    const double cells_a_step =
        fluid.solver == FluidSolver::openfoam ? fluid.courant : fluid.lattice_speed;
    return halved(scene, cells_a_step * fluid.spacing_m / fluid.expected_speed_m_s);
}

std::optional<double> relaxation_time(const Scene& scene) {
    const auto dt_s = coupled_step_s(scene);
    if (!dt_s || !scene.fluid || scene.fluid->solver != FluidSolver::lbm) return {};
    const double dx = scene.fluid->spacing_m;
    return 3 * scene.fluid->viscosity_m2_s * *dt_s / (dx * dx) + 0.5;
}

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

namespace {

using Lines = std::vector<std::string>;

std::string idle(const std::string& key, const std::string& why) {
    return fmt::format("{} can do nothing: {}; remove the key, or correct it", key, why);
}

bool all_zero(double value) {
    return value == 0;
}
bool all_zero(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return value == 0; });
}

// Every course has a magnitude, or one per row.
bool no_field_at_any_time(const MagneticField& field) {
    return std::visit([](const auto& course) { return all_zero(course.magnitude_t); },
                      field.course);
}

bool is_zero(const Vec3& v) {
    return v == Vec3{};
}

// Tables and regions, which take a mesh or a file to tell, count as magnetised.
bool has_no_moment(const Magnetization& magnetization) {
    if (const auto* uniform = std::get_if<UniformMagnetization>(&magnetization))
        return is_zero(uniform->vector_a_m);
    if (const auto* domains = std::get_if<DomainMagnetization>(&magnetization))
        return std::ranges::all_of(domains->domains, [](const MagneticDomain& d) {
            return is_zero(d.vector_a_m);
        });
    return false;
}

void check_field(const Scene& scene, Lines& lines) {
    if (!scene.magnetic_field) return;
    const MagneticField& field = *scene.magnetic_field;
    const bool bodies_without = std::ranges::all_of(scene.bodies, [](const Body& body) {
        return !body.magnetization || has_no_moment(*body.magnetization);
    });
    if (bodies_without)
        lines.push_back(idle("magnetic_field", "every magnetization is 0"));
    else if (no_field_at_any_time(field))
        lines.push_back(idle("magnetic_field", "its magnitude is 0 at all times"));
    if (field.gradient && std::ranges::all_of(field.gradient->matrix_t_m, is_zero))
        lines.push_back(idle("magnetic_field.gradient", "its matrix is 0"));
}

// Of one density, and that the fluid's: weight and buoyancy are the same everywhere.
bool floats(const Scene& scene, const Body& body) {
    const auto as_fluid = [&](const Material& m) {
        return m.density_kg_m3 == scene.fluid->density_kg_m3;
    };
    if (body.material_regions.empty()) return as_fluid(body.material);
    return std::ranges::all_of(body.material_regions,
                               [&](const auto& r) { return as_fluid(r.material); });
}

void check_gravity(const Scene& scene, Lines& lines) {
    if (!scene.gravity) return;
    if (scene.gravity->acceleration_m_s2 == 0) {
        lines.push_back(idle("gravity", "its acceleration is 0"));
        return;
    }
    const auto no_weight = [&](const Body& body) { return floats(scene, body); };
    if (scene.fluid && std::ranges::all_of(scene.bodies, no_weight))
        lines.push_back(idle("gravity", "every body has the fluid's density"));
}

void check_damping(const Scene& scene, Lines& lines) {
    if (!scene.damping) return;
    const auto& equilibrium = scene.time.equilibrium;
    if (scene.damping->rate_1_s == 0)
        lines.push_back(idle("damping", "its rate is 0"));
    else if (equilibrium && equilibrium->method == EquilibriumMethod::newton)
        lines.push_back(idle("damping", "Newton's method knows no motion"));
}

void check_fluid(const Scene& scene, Lines& lines) {
    if (!scene.fluid) return;
    const Fluid& fluid = *scene.fluid;
    if (fluid.body_force_n_m3 && is_zero(*fluid.body_force_n_m3))
        lines.push_back(idle("fluid.body_force", "it is 0"));
    if (fluid.initial_velocity_m_s && is_zero(*fluid.initial_velocity_m_s))
        lines.push_back(idle("fluid.initial_velocity", "it is 0"));
}

void check_interval(const Scene& scene, const char* key, double every_s, Lines& lines) {
    if (every_s <= scene.time.end_s) return;
    lines.push_back(idle(key, "its interval is longer than the run"));
}

}  // namespace

std::vector<std::string> idle_effects(const Scene& scene) {
    Lines lines;
    check_field(scene, lines);
    check_gravity(scene, lines);
    check_damping(scene, lines);
    check_fluid(scene, lines);
    if (scene.checkpoint)
        check_interval(scene, "checkpoint", scene.checkpoint->every_s, lines);
    return lines;
}

}  // namespace magfsi::scene
