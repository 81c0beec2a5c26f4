#include "adapters/lammps/scene_to_input.h"

#include <algorithm>

#include "adapters/bodies/fluid_inside.h"
#include "adapters/bodies/scene_to_body.h"
#include "structure/lammps/step_limit.h"

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

structure::MotionCourse to_course(const scene::PrescribedMotion& motion) {
    if (const auto* o = std::get_if<scene::Oscillation>(&motion.course))
        return structure::Oscillation{o->amplitude_m, o->frequency_hz, o->phase_rad};
    const auto& ramp = std::get<scene::DisplacementRamp>(motion.course);
    return structure::DisplacementRamp{ramp.displacement_m, ramp.duration_s};
}

}  // namespace

structure::LammpsInput to_lammps_input(const scene::Scene& scene, double time_step_s) {
    structure::LammpsInput input;
    input.bodies = bodies::bodies_in_fluid(scene);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        input.placements.push_back(bodies::to_placement(scene.bodies[b].initial));
        for (const scene::PrescribedMotion& motion : scene.bodies[b].prescribed_motion)
            input.motions.push_back({b, motion.faces, to_course(motion)});
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
    structure::check_effects(input);
    return input;
}

double stable_step_s(const scene::Scene& scene) {
    const structure::LammpsInput input = to_lammps_input(scene, 1);
    double smallest = 0;
    for (const structure::Body& body : input.bodies) {
        // All that acts on a body at once: the springs on its surface beside its own
        // stiffness and viscosity.
        const double step =
            structure::step_limit_s(body, structure::surface_spring_pa_m(input, body));
        smallest = smallest > 0 ? std::min(smallest, step) : step;
    }
    return smallest;
}

}  // namespace magfsi::lammps
