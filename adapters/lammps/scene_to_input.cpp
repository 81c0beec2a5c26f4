#include "adapters/lammps/scene_to_input.h"

#include <algorithm>
#include <cmath>

#include "adapters/bodies/scene_to_body.h"
#include "structure/lammps/step_limit.h"
#include "structure/lattice/stable_step.h"

namespace magfsi::lammps {

namespace {

structure::Platform to_platform(const scene::Platform& platform) {
    structure::Platform out;
    out.point_m = platform.point_m;
    out.normal = platform.normal;
    out.stiffness_pa_m = platform.stiffness_pa_m.value_or(0);
    out.friction = platform.friction.value_or(0);
    return out;
}

structure::ContactLaw to_contact(const scene::Contact& contact) {
    structure::ContactLaw law;
    law.distance_m = contact.distance_m.value_or(0);
    law.stiffness_pa_m = contact.stiffness_pa_m.value_or(0);
    return law;
}

// All that acts on a body at once: each spring on the surface lowers the limit of the
// lattice alone, and their squared frequencies add up at most.
double stable_step_s(const structure::LammpsInput& input, const structure::Body& body,
                     double viscosity_pa_s) {
    const double alone = structure::stable_step_s(body, viscosity_pa_s);
    double inverse_square = 1 / (alone * alone);
    const auto add = [&](double with) {
        inverse_square += 1 / (with * with) - 1 / (alone * alone);
    };
    if (input.platform) {
        add(structure::platform_step_limit_s(
            body, structure::platform_of(input).stiffness_pa_m));
    }
    if (input.contact)
        add(structure::contact_step_limit_s(body, structure::contact_law(input)));
    return 1 / std::sqrt(inverse_square);
}

}  // namespace

structure::LammpsInput to_lammps_input(const scene::Scene& scene, double time_step_s) {
    structure::LammpsInput input;
    for (const scene::Body& body : scene.bodies) {
        input.bodies.push_back(bodies::to_body(scene, body));
        input.placements.push_back(bodies::to_placement(body.initial));
        input.viscosity_pa_s.push_back(body.material.viscosity_pa_s.value_or(0));
    }
    if (scene.magnetic_field) input.field = bodies::to_field(*scene.magnetic_field);
    if (scene.magnetic_field && scene.magnetic_field->gradient) {
        const auto& gradient = *scene.magnetic_field->gradient;
        input.gradient = structure::GradientInput{gradient.matrix_t_m, gradient.origin_m};
    }
    input.gravity_m_s2 = bodies::to_gravity(scene);
    if (scene.damping) input.drag_rate_1_s = scene.damping->rate_1_s;
    if (scene.platform) input.platform = to_platform(*scene.platform);
    if (scene.contact) input.contact = to_contact(*scene.contact);
    input.time_step_s = time_step_s;
    return input;
}

double stable_step_s(const scene::Scene& scene) {
    const structure::LammpsInput input = to_lammps_input(scene, 1);
    double smallest = 0;
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const double step =
            stable_step_s(input, input.bodies[b], input.viscosity_pa_s[b]);
        smallest = smallest > 0 ? std::min(smallest, step) : step;
    }
    return smallest;
}

}  // namespace magfsi::lammps
