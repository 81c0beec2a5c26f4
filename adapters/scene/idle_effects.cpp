#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/effective.h"
#include "adapters/scene/names.h"

namespace magfsi::scene {

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
    if (*scene.damping == structure::Drag{})
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
