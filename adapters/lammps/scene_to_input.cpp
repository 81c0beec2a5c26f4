// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/lammps/scene_to_input.h"

#include <algorithm>

#include "adapters/bodies/fluid_inside.h"
#include "adapters/bodies/marker_placement.h"
#include "adapters/bodies/probe_row.h"
#include "adapters/bodies/scene_to_body.h"
#include "structure/lammps/step_limit.h"

namespace magfsi::lammps {

namespace {

// With contact in a fluid: all sides of its box that a body could go through. One that
// spans the box touches them anyway.
std::vector<structure::Wall> walls_of(const scene::Scene& scene) {
    std::vector<structure::Wall> walls;
    if (!scene.contact || !scene.fluid) return walls;
    for (std::size_t side = 0; side < scene.fluid->boundaries.size(); ++side) {
        if (scene.fluid->boundaries[side].kind == scene::BoundaryKind::periodic) continue;
        const std::size_t axis = side / 2;
        structure::Wall wall{std::string(scene::names<scene::Face>[side]), {}, {}};
        wall.plane.normal = {};
        wall.plane.normal[axis] = side % 2 == 0 ? 1 : -1;
        if (side % 2 == 1) wall.plane.point_m[axis] = scene.fluid->box_m[axis];
        for (std::size_t b = 0; b < scene.bodies.size(); ++b)
            if (!bodies::spans_fluid(*scene.fluid, scene.bodies[b], true)[axis])
                wall.bodies.push_back(b);
        if (!wall.bodies.empty()) walls.push_back(std::move(wall));
    }
    return walls;
}

}  // namespace

structure::LammpsInput to_lammps_input(const scene::Scene& scene, double time_step_s) {
    structure::LammpsInput input;
    input.bodies = bodies::bodies_in_fluid(scene);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        input.placements.push_back(scene.bodies[b].initial);
        for (structure::PrescribedMotion motion : scene.bodies[b].prescribed_motion) {
            motion.body = b;
            input.motions.push_back(motion);
        }
    }
    if (scene.magnetic_field) {
        if (scene.magnetic_field->uniform) input.field = scene.magnetic_field;
        input.gradient = scene.magnetic_field->gradient;
        input.sources = scene.magnetic_field->sources;
    }
    input.dipoles = scene.dipoles;
    input.gravity_m_s2 = bodies::to_gravity(scene);
    input.drag = scene.damping;
    input.platform = scene.platform;
    input.contact = scene.contact;
    input.walls = walls_of(scene);
    input.reactions = bodies::needs(scene, bodies::Load::support);
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
