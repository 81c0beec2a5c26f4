// SPDX-License-Identifier: GPL-2.0-or-later
// Values, effects and step of a scene, and warnings of effects without influence.
#include "adapters/scene/effective.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/field.h"
#include "adapters/scene/keys.h"
#include "base/fitted/constants.h"
#include "coupler/immersed_boundary/marker_stencil.h"
#include "coupler/step/clock.h"
#include "fluid_lbm/units.h"

namespace magfsi::scene {

// Defaults are included, so that scenes which differ only in spelled-out defaults are the
// same.
nlohmann::ordered_json effective_scene(const Scene& scene) {
    Scene copy = scene;  // keys() takes a reference that reading may change
    return JsonWriter::of(copy);
}

// The key under which JsonWriter writes the law, so that the names stand only in
// keys_field.cpp.
std::string law_key(const FieldLaw& law) {
    FieldTerm term{law};
    return JsonWriter::of(term).begin().key();
}

double path_step_s(const Scene& scene) {
    return scene.probes ? scene.probes->every_s : scene.time.end_s;
}

double halved(const Scene& scene, double step_s) {
    return std::ldexp(step_s, -scene.time.halvings);
}

// An expected speed of 0 means that none was given.
std::optional<double> coupled_step_s(const Scene& scene) {
    if (scene.time.step_s) return halved(scene, *scene.time.step_s);
    if (!scene.fluid || !(scene.fluid->expected_speed_m_s > 0)) return std::nullopt;
    const Fluid& fluid = *scene.fluid;
    const double cells_per_step =
        fluid.solver == FluidSolver::openfoam ? fluid.courant : fluid.lattice_speed;
    return halved(scene,
                  cells_per_step * fluid.finest_spacing_m() / fluid.expected_speed_m_s);
}

// The coarsest level advances by all coupled steps at once.
std::optional<double> relaxation_time(const Scene& scene) {
    const auto dt_s = coupled_step_s(scene);
    if (!dt_s || !scene.fluid || scene.fluid->solver != FluidSolver::lbm) return {};
    return fluid::relaxation_time(scene.fluid->viscosity_m2_s,
                                  *dt_s * scene.fluid->coupled_steps_in_one(),
                                  scene.fluid->spacing_m);
}

std::optional<double> relaxation_time_at_bodies(const Scene& scene) {
    const auto coarsest = relaxation_time(scene);
    if (!coarsest) return {};
    return 0.5 + (*coarsest - 0.5) * scene.fluid->coupled_steps_in_one();
}

Following following(const Fluid& fluid) {
    const int every = std::max(4, fluid.coupled_steps_in_one());
    return {every, every / 2};  // the lattice's limit is 0.4 cells a step
}

// In finest cells: half the kernel, one for the interpolation between cells, the motion
// between two looks, and one cell of the level below (two of the finest). Rounded up to
// cells of the level below.
int least_margin_cells(const Scene& scene) {
    const int kernel =
        scene.coupling ? coupler::support(scene.coupling->immersed_boundary.kernel) : 0;
    const int fine_cells = kernel / 2 + 1 + following(*scene.fluid).moves_cells + 2;
    return (fine_cells + 1) / 2;
}

namespace {

// Step in which an effect acts.
enum class Step { structure, coupled, fluid, output };

// An effect with its name, as summaries and explain show it.
struct Effect {
    Step step;
    std::string_view name;
    bool active;
};

// True if any material of the body has the property.
template <class Test>
bool some_material(const Body& body, const Test& test) {
    return test(body.material) ||
           std::ranges::any_of(body.material_regions, [&](const RegionMaterial& region) {
               return test(region.material);
           });
}

// Adds boundary conditions beyond the named ones as effects under their own names, so
// that a new kind needs no entry in the list below.
void add_further_kinds(std::vector<Effect>& effects, auto side_of) {
    constexpr auto last_named = static_cast<std::size_t>(BoundaryKind::pressure_outlet);
    for (std::size_t k = last_named + 1; k < names<BoundaryKind>.size(); ++k)
        effects.push_back(
            {Step::fluid, names<BoundaryKind>[k], side_of(static_cast<BoundaryKind>(k))});
}

// All effects in the order of a coupled step: the structure's substeps, each with the
// immersed-boundary force, then the fluid, then the outputs.
std::vector<Effect> effects_of(const Scene& s) {
    using enum Step;
    const auto some_body = [&](auto test) { return std::ranges::any_of(s.bodies, test); };
    const auto of_material = [&](auto test) {
        return some_body([&](const Body& body) { return some_material(body, test); });
    };
    const auto some_side = [&](auto test) {
        return s.fluid && std::ranges::any_of(s.fluid->boundaries, test);
    };
    const auto side_of = [&](BoundaryKind kind) {
        return some_side([&](const Boundary& side) { return side.kind == kind; });
    };
    std::vector<Effect> effects{
        {structure, "elasticity", !s.bodies.empty()},
        {structure, "stiffening",
         of_material([](const Material& m) { return m.stiffening.has_value(); })},
        {structure, "viscosity",
         of_material([](const Material& m) { return m.viscosity_pa_s > 0; })},
        {structure, "viscoelasticity",
         of_material([](const Material& m) { return !m.branches.empty(); })},
        {structure, "magnetic field", s.magnetic_field && s.magnetic_field->uniform},
        {structure, "field gradient", s.magnetic_field && s.magnetic_field->gradient},
        {structure, "field sources",
         s.magnetic_field && !s.magnetic_field->sources.empty()},
        {structure, "dipoles", s.dipoles.has_value()},
        {structure, "control", s.control.has_value()},
        {structure, "gravity", s.gravity.has_value()},
        {structure, "damping", s.damping.has_value()},
        {structure, "platform", s.platform.has_value()},
        {structure, "friction",
         (s.platform && s.platform->friction > 0) ||
             (s.contact && s.contact->friction > 0)},
        {structure, "contact", s.contact.has_value()},
        {structure, "clamps",
         some_body([](const Body& body) { return !body.clamps.empty(); })},
        {structure, "rigid parts",
         some_body([](const Body& body) { return !body.rigid.empty(); })},
        {structure, "rollers",
         some_body([](const Body& body) { return !body.rollers.empty(); })},
        {structure, "prescribed motion", some_body([](const Body& body) {
             return !body.prescribed_motion.empty() || body.moved() != nullptr;
         })},
        {coupled, "immersed boundary", s.coupling.has_value()},
        {coupled, "buoyancy", s.coupling && s.gravity},
        {coupled, "overlap check",
         !s.bodies.empty() && s.coupling &&
             s.coupling->overlap == coupler::OverlapRule::stop},
        {coupled, "implicit scheme",
         s.coupling && s.coupling->scheme == Scheme::implicit},
        {fluid, "fluid", s.fluid.has_value()},
        {fluid, "body force", s.fluid && s.fluid->body_force_n_m3},
        {fluid, "bulk viscosity", s.fluid && s.fluid->bulk_viscosity_m2_s},
        {fluid, "eddy viscosity", s.fluid && s.fluid->smagorinsky_constant > 0},
        {fluid, "rheology", s.fluid && s.fluid->rheology},
        {fluid, "moving walls", some_side([](const Boundary& side) {
             return side.kind == BoundaryKind::no_slip &&
                    side.wall_velocity_m_s != Vec3{};
         })},
        {fluid, "free slip", side_of(BoundaryKind::free_slip)},
        {fluid, "inlets and outlets",
         side_of(BoundaryKind::velocity_inlet) || side_of(BoundaryKind::pressure_outlet)},
        {fluid, "refinement", s.fluid && s.fluid->refinement},
        {fluid, "obstacles", s.fluid && !s.fluid->obstacles.empty()},
        {output, "probes", s.probes.has_value()},
        {output, "interface balance", s.probes && s.probes->interface_balance},
        {output, "energy audit", s.probes && s.probes->energy_audit},
        {output, "structure fields", s.output.structure.has_value()},
        {output, "fluid fields", s.output.fluid.has_value()},
        {output, "checkpoint", s.checkpoint.has_value()},
    };
    add_further_kinds(effects, side_of);
    return effects;
}

// Names of the active (or absent) effects of one step, or of all steps.
std::vector<std::string> select(const Scene& scene, bool active,
                                std::optional<Step> step = {}) {
    std::vector<std::string> list;
    for (const Effect& effect : effects_of(scene)) {
        if (effect.active == active && effect.step == step.value_or(effect.step))
            list.emplace_back(effect.name);
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

bool has_effect(const Scene& scene, std::string_view name) {
    const auto all = effects_of(scene);
    const auto found = std::ranges::find(all, name, &Effect::name);
    if (found == all.end())
        throw std::logic_error(fmt::format("no effect is called {}", in_quotes(name)));
    return found->active;
}

std::vector<std::string> effects_by_step(const Scene& scene) {
    std::vector<std::string> lines;
    for (const auto& [step, name] :
         {std::pair{Step::structure, "structure step"},
          std::pair{Step::coupled, "coupled step"}, std::pair{Step::fluid, "fluid step"},
          std::pair{Step::output, "outputs"}})
        lines.push_back(fmt::format("{}: {}; absent: {}", name,
                                    words(select(scene, true, step)),
                                    words(select(scene, false, step))));
    return lines;
}

namespace {

using Lines = std::vector<std::string>;

// Adds a warning that an effect has no influence, if `idle`.
void note(Lines& lines, bool idle, const char* key, const char* why) {
    if (idle)
        lines.push_back(fmt::format(
            "{} can do nothing: {}; remove the key, or correct it", key, why));
}

// True if a value, all components, or all rows are exactly zero.
bool is_zero(double value) {
    return value == 0;
}
bool is_zero(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return value == 0; });
}
bool is_zero(const Vec3& v) {
    return v == Vec3{};
}

bool is_zero(const std::vector<Vec3>& rows) {
    return std::ranges::all_of(rows, [](const Vec3& row) { return is_zero(row); });
}

// True if the field is zero at all times. Every law has a magnitude, a vector, components
// or an amplitude, one for all times or one per row.
bool is_zero(const FieldLaw& law) {
    return std::visit(
        []<class Law>(const Law& one) {
            if constexpr (requires { one.magnitude_t; })
                return is_zero(one.magnitude_t);
            else if constexpr (requires { one.vector_t; })
                return is_zero(one.vector_t);
            else if constexpr (requires { one.component_t; })
                return std::ranges::all_of(one.component_t,
                                           [](const auto& f) { return f.si == "0"; });
            else
                return is_zero(one.amplitude_t);
        },
        law);
}

// Sources are taken as nonzero.
bool no_field_at_any_time(const MagneticField& field) {
    if (!field.sources.empty()) return false;
    return is_zero(field.course) && std::ranges::all_of(field.plus, [](const auto& term) {
               return is_zero(term.law);
           });
}

// True if the body surely has no magnetisation. Tables and regions count as magnetised,
// since only the mesh or the file could tell.
bool has_no_moment(const Body& body) {
    if (!body.magnetization) return true;
    if (const auto* uniform = std::get_if<UniformMagnetization>(&*body.magnetization))
        return is_zero(uniform->vector_a_m);
    const auto* domains = std::get_if<DomainMagnetization>(&*body.magnetization);
    return domains && std::ranges::all_of(domains->domains, [](const MagneticDomain& d) {
               return is_zero(d.vector_a_m);
           });
}

// Warnings on the field: no moments, no field, no gradient.
void check_field(const MagneticField& field, const Scene& scene, Lines& lines) {
    const bool no_moment = std::ranges::all_of(scene.bodies, has_no_moment);
    note(lines, no_moment, "magnetic_field", "every magnetization is 0");
    const bool no_gradient =
        !field.gradient || std::ranges::all_of(field.gradient->matrix_t_m,
                                               [](const Vec3& v) { return is_zero(v); });
    note(lines, !no_moment && no_gradient && no_field_at_any_time(field),
         "magnetic_field", "its magnitude is 0 at all times");
    note(lines, field.gradient && no_gradient, "magnetic_field.gradient",
         "its matrix is 0");
}

// True if the body has the fluid's density everywhere, so that weight and buoyancy cancel
// at each point.
bool floats(const Scene& scene, const Body& body) {
    const auto as_fluid = [&](const Material& m) {
        return m.density_kg_m3 == scene.fluid->density_kg_m3;
    };
    if (body.material_regions.empty()) return as_fluid(body.material);
    return std::ranges::all_of(body.material_regions,
                               [&](const auto& r) { return as_fluid(r.material); });
}

// Warnings on gravity: no acceleration, or bodies of the fluid's density.
void check_gravity(const Gravity& gravity, const Scene& scene, Lines& lines) {
    const bool none = gravity.acceleration_m_s2 == 0;
    note(lines, none, "gravity", "its acceleration is 0");
    const auto no_weight = [&](const Body& body) { return floats(scene, body); };
    note(lines, !none && scene.fluid && std::ranges::all_of(scene.bodies, no_weight),
         "gravity", "every body has the fluid's density");
}

}  // namespace

double lightest_ratio(const Scene& scene, const Body& body) {
    double lightest = body.material.density_kg_m3;
    for (const auto& region : body.material_regions)
        lightest = std::min(lightest, region.material.density_kg_m3);
    return lightest / scene.fluid->density_kg_m3;
}

const Body* light_in_contact(const Scene& scene) {
    if (!scene.fluid || !(scene.contact || scene.platform)) return nullptr;
    const auto light = [&](const Body& body) {
        return lightest_ratio(scene, body) < fitted::least_serial_contact_ratio;
    };
    const auto found = std::ranges::find_if(scene.bodies, light);
    return found == scene.bodies.end() ? nullptr : &*found;
}

bool holds_openfoam(const Scene& scene) {
    return scene.coupling && scene.fluid &&
           scene.fluid->solver == FluidSolver::openfoam &&
           scene.coupling->immersed_boundary.forcing == coupler::Forcing::no_slip;
}

std::vector<std::string> idle_effects(const Scene& scene) {
    Lines lines;
    if (scene.magnetic_field) check_field(*scene.magnetic_field, scene, lines);
    if (scene.gravity) check_gravity(*scene.gravity, scene, lines);
    const bool still = scene.damping && scene.damping->rate_1_s == 0;
    note(lines, still, "damping", "its rate is 0");
    const auto& equilibrium = scene.time.equilibrium;
    note(lines,
         scene.damping && !still && equilibrium &&
             equilibrium->method == EquilibriumMethod::newton,
         "damping", "Newton's method knows no motion");
    const Fluid fluid = scene.fluid.value_or(Fluid{});
    note(lines, fluid.body_force_n_m3 == Vec3{}, "fluid.body_force", "it is 0");
    note(lines, fluid.initial_velocity_m_s == Vec3{}, "fluid.initial_velocity",
         "it is 0");
    note(lines, scene.checkpoint && scene.checkpoint->every_s > scene.time.end_s,
         "checkpoint", "its interval is longer than the run");
    return lines;
}

// clock.every() gives the number of coupled steps that an interval becomes.
std::vector<std::string> rounded_intervals(const Scene& scene) {
    constexpr double unnoticed = 0.05;  // relative change that needs no warning
    Lines lines;
    const auto dt_s = coupled_step_s(scene);
    if (!dt_s) return lines;
    const int at_a_time = scene.fluid ? scene.fluid->coupled_steps_in_one() : 1;
    const coupler::Clock clock(*dt_s, scene.time.end_s, at_a_time);
    const auto note_rounding = [&](const char* key, double every_s) {
        const double is_s = static_cast<double>(clock.every(every_s)) * *dt_s;
        if (std::abs(is_s - every_s) <= unnoticed * every_s) return;
        lines.push_back(fmt::format(
            "{}: {:.4g} ms becomes {:.4g} ms, a whole number of steps of {:.4g} ms{}",
            key, every_s * 1e3, is_s * 1e3, at_a_time * *dt_s * 1e3,
            at_a_time > 1 ? ", those of the coarsest level" : ""));
    };
    if (scene.probes) note_rounding("probes.every", scene.probes->every_s);
    if (scene.output.structure)
        note_rounding("output.structure.every", scene.output.structure->every_s);
    if (scene.output.fluid)
        note_rounding("output.fluid.every", scene.output.fluid->every_s);
    if (scene.checkpoint) note_rounding("checkpoint.every", scene.checkpoint->every_s);
    return lines;
}

}  // namespace magfsi::scene
