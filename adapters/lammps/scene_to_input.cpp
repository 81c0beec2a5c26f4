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

// All that acts on a body at once. With damping c on top of the frequency omega the step
// keeps step^2 omega^2 + 2 step c <= 4 (structure/lattice/stable_step.h): the body's own
// steps with and without viscosity give c, the springs on its surface raise omega.
double stable_step_s(const structure::LammpsInput& input, const structure::Body& body,
                     double viscosity_pa_s) {
    double springs_pa_m = 0;
    if (input.platform) springs_pa_m += structure::platform_of(input).stiffness_pa_m;
    if (input.contact)
        springs_pa_m +=
            structure::contact_spring_pa_m(body, structure::contact_law(input));
    const double elastic_s = structure::step_limit_s(body, springs_pa_m);
    if (viscosity_pa_s == 0) return elastic_s;
    const double own = 2 / structure::stable_step_s(body);
    const double damped_s = structure::stable_step_s(body, viscosity_pa_s);
    const double damping = (4 - damped_s * damped_s * own * own) / (2 * damped_s);
    const double omega = 2 / elastic_s;
    const double z = damping / (2 * omega);
    return 2 / omega * (std::sqrt(1 + z * z) - z);
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
