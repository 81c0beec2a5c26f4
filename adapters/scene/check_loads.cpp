#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/checks.h"
#include "adapters/scene/names.h"
#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

void check_has_bodies(const Scene& scene, const Marks& marks, const std::string& effect) {
    if (scene.bodies.empty())
        refuse(marks.key({effect}), fmt::format("{} without bodies", effect),
               "it with bodies only", "add the key \"bodies\" or remove this one");
}

void check_table(const FieldTable& table, const Marks& marks) {
    const std::string field = "magnetic_field", name = "table";
    const std::size_t rows = table.time_s.size();
    for (std::size_t i = 1; i < rows; ++i) {
        if (table.time_s[i] > table.time_s[i - 1]) continue;
        refuse(marks.value({field, name, "time"}),
               fmt::format("the time {} after {}", format_si(table.time_s[i], "s"),
                           format_si(table.time_s[i - 1], "s")),
               "times that ascend");
    }
    if (table.magnitude_t.size() != rows)
        refuse(marks.value({field, name, "magnitude"}),
               fmt::format("{} magnitudes for {} times", table.magnitude_t.size(), rows),
               "one magnitude a time");
    if (table.direction_rad.size() != 1 && table.direction_rad.size() != rows)
        refuse(
            marks.value({field, name, "direction"}),
            fmt::format("{} directions for {} times", table.direction_rad.size(), rows),
            "one direction, or one a time");
    if (table.repeat && rows < 2)
        refuse(marks.value({field, name, "repeat"}), "repeat with one row",
               "it with at least 2 rows");
}

// curl B = 0 and div B = 0 where no current flows.
void check_gradient(const GradientInput& gradient, const Marks& marks) {
    const auto& g = gradient.matrix_t_m;
    double largest = 0, fault = std::abs(g[0][0] + g[1][1] + g[2][2]);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            largest = std::max(largest, std::abs(g[i][j]));
            fault = std::max(fault, std::abs(g[i][j] - g[j][i]));
        }
    }
    if (fault <= 1e-9 * largest) return;  // rounding of typed numbers is no fault
    refuse(
        marks.value({"magnetic_field", "gradient", "matrix"}),
        "a gradient that is not symmetric and traceless",
        "dB_i/dx_j = dB_j/dx_i with a sum of 0 on the diagonal (no current flows here)");
}

void check_magnetic_field(const Scene& scene, const Marks& marks) {
    if (!scene.magnetic_field) return;
    const auto magnetized = [](const Body& body) {
        return body.magnetization.has_value();
    };
    if (std::ranges::none_of(scene.bodies, magnetized))
        refuse(marks.key({"magnetic_field"}), "magnetic_field without a magnetized body",
               "it with at least one body that has a magnetization",
               "add a magnetization or remove this key");
    if (const auto* table = std::get_if<FieldTable>(&scene.magnetic_field->course))
        check_table(*table, marks);
    if (scene.magnetic_field->gradient)
        check_gradient(*scene.magnetic_field->gradient, marks);
}

void check_equilibrium(const Scene& scene, const Marks& marks) {
    if (!scene.time.equilibrium) return;
    const Origin& here = marks.key({"time", "equilibrium"});
    if (scene.fluid)
        refuse(here, "an equilibrium in a scene with a fluid", "it without a fluid",
               "remove the key \"fluid\" (fluid= on the command line)");
    check_has_bodies(scene, marks, "time");
    if (scene.time.step_s)
        refuse(marks.key({"time", "step"}), "a step in a scene of equilibria",
               "time.step for motion", "the points of the path are the probe rows");
    if (scene.time.equilibrium->method != EquilibriumMethod::newton) return;
    if (scene.magnetic_field && scene.magnetic_field->gradient)
        refuse(marks.key({"magnetic_field", "gradient"}),
               "a field gradient with the equilibrium method newton",
               "it with the method dynamics", "take time.equilibrium.method: dynamics");
    for (const auto& [present, name] :
         {std::pair{scene.platform.has_value(), "platform"},
          std::pair{scene.contact.has_value(), "contact"}}) {
        if (present)
            refuse(marks.key({name}),
                   fmt::format("{} with the equilibrium method newton", name),
                   "it with the method dynamics",
                   "take time.equilibrium.method: dynamics");
    }
}

void check_gravity(const Scene& scene, const Marks& marks) {
    if (!scene.gravity) return;
    check_has_bodies(scene, marks, "gravity");
    const Vec3& d = scene.gravity->direction;
    if (d == Vec3{})
        refuse(marks.value({"gravity", "direction"}), "a direction of length 0",
               "any other vector such as [0, 0, -1]");
}

// Beside a body at rest a velocity that alternates from step to step decays for strengths
// below 1/4 over the part, an eighth, by which the scheme draws it back: 2 in a volume of
// markers. Above it runs converge in every step and gain energy all the same.
constexpr double most_implicit_strength = 2;

void check_coupling(const Scene& scene, const Marks& marks) {
    if (!scene.coupling) return;
    if (!scene.fluid)
        refuse(marks.key({"coupling"}), "coupling without a fluid",
               "it with a fluid only", "add the key \"fluid\" or remove this one");
    check_has_bodies(scene, marks, "coupling");
    // The impulses of an iteration must act in the step whose slip they answer.
    if (scene.coupling->immersed_boundary.iterations > 1 &&
        scene.coupling->scheme != Scheme::serial)
        refuse(marks.value({"coupling", "immersed_boundary", "iterations"}),
               "iterations of the forcing outside the serial scheme",
               "1 in other schemes", "take coupling.scheme: serial");
    const Coupling& coupling = *scene.coupling;
    if (coupling.iteration && coupling.scheme != Scheme::implicit)
        refuse(marks.key({"coupling", "iteration"}),
               fmt::format("iteration in the {} scheme", name_of(coupling.scheme)),
               "it in the implicit scheme only",
               "add scheme: implicit or remove this key");
    if (coupling.scheme == Scheme::implicit &&
        coupling.immersed_boundary.strength > most_implicit_strength)
        refuse(marks.value({"coupling", "immersed_boundary", "strength"}),
               fmt::format("strength {} in the implicit scheme",
                           coupling.immersed_boundary.strength),
               fmt::format("at most {} there", most_implicit_strength),
               "take a smaller one, or coupling.scheme: serial");
    if (coupling.scheme == Scheme::parallel &&
        coupling.sampled_velocity == SampledVelocity::linear)
        refuse(marks.value({"coupling", "sampled_velocity"}),
               "sampled_velocity: linear in the parallel scheme",
               "frozen, which there is the mean of the last two samples",
               "remove this key or take another scheme");
}

}  // namespace

void check_loads(const Scene& scene, const Marks& marks) {
    check_magnetic_field(scene, marks);
    check_gravity(scene, marks);
    if (scene.damping) check_has_bodies(scene, marks, "damping");
    if (scene.platform) check_has_bodies(scene, marks, "platform");
    check_platform(scene, marks);
    if (scene.contact) check_has_bodies(scene, marks, "contact");
    // Markers name atoms by their place on a rank; contact lets atoms change ranks.
    if (scene.contact && scene.fluid)
        refuse(marks.key({"contact"}), "contact of bodies in a fluid",
               "contact without a fluid", "remove one of the two keys");
    check_equilibrium(scene, marks);
    check_coupling(scene, marks);
}

}  // namespace magfsi::scene
